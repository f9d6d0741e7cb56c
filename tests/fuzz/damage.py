"""damage.py -- damages the bytes of a file as disks, transfers and attackers do."""

import re

NUMBER = re.compile(rb"-?\d+(\.\d*)?([eE][-+]?\d+)?")
ODD_NUMBERS = [b"0", b"-1", b"1e999", b"-1e308", b"nan", b"1e-320", b"4294967296", b"18446744073709551615", b"9" * 400, b"0x7f",
               b"", b"1,5", b"2147483647", b"999999"]
ODD_WORDS = [b"\xff", b"\x7f", b"\x80", b"\x00"]


def place(bytes_, chance):
    """Of a byte; half of the time of one that is not 0, since headers and indices are among those."""
    at = chance.randrange(len(bytes_))
    if chance.random() < 0.5:
        return at
    return next((i for i in range(at, min(at + 4000, len(bytes_))) if bytes_[i] != 0), at)


def cut(bytes_, chance):
    """The file ends early."""
    return bytes_[: chance.randrange(len(bytes_))]


def flip(bytes_, chance):
    """Up to eight bits are others."""
    changed = bytearray(bytes_)
    for _ in range(chance.randint(1, 8)):
        changed[place(changed, chance)] ^= 1 << chance.randrange(8)
    return bytes(changed)


def word(bytes_, chance):
    """A word of 1 to 8 bytes is all ones, the greatest, the least or zero; or small, in one of the byte orders."""
    size = chance.choice([1, 2, 4, 8])
    at = place(bytes_, chance)
    kind = chance.randrange(6)
    if kind < 4:
        new = ODD_WORDS[kind] * size if kind != 1 else b"\xff" * (size - 1) + b"\x7f"
    else:
        new = chance.randint(1, 255).to_bytes(size, "little" if kind == 4 else "big")
    return bytes_[:at] + new + bytes_[at + size:]


def splice(bytes_, chance):
    """A piece of the file is elsewhere too, in the place of what was there or before it."""
    start = chance.randrange(len(bytes_))
    piece = bytes_[start: start + chance.randint(1, 200)]
    at = chance.randrange(len(bytes_))
    return bytes_[:at] + piece + bytes_[at + (len(piece) if chance.random() < 0.5 else 0):]


def drop(bytes_, chance):
    """A piece is missing."""
    at = chance.randrange(len(bytes_))
    return bytes_[:at] + bytes_[at + chance.randint(1, 40):]


def number(bytes_, chance):
    """A number in a text is another, too long or none."""
    found = list(NUMBER.finditer(bytes_))
    if not found:
        return word(bytes_, chance)
    at = chance.choice(found)
    return bytes_[: at.start()] + chance.choice(ODD_NUMBERS) + bytes_[at.end():]


def repeat(bytes_, chance):
    """A piece comes many times."""
    start = chance.randrange(len(bytes_))
    end = start + chance.randint(1, 60)
    return bytes_[:end] + bytes_[start:end] * chance.choice([10, 1000]) + bytes_[end:]


KINDS = [cut, flip, word, word, splice, drop, number, number, repeat]


def damaged(bytes_, chance):
    """@return  (bytes, names of what was done): one damage, at times two or three."""
    names = []
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        kind = chance.choice(KINDS)
        bytes_ = kind(bytes_, chance) or b"\x00"
        names.append(kind.__name__)
    return bytes_, "+".join(names)
