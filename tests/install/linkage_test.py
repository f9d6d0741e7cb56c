#!/usr/bin/python3
"""Programs and libraries that we link open no doors: see cmake/Hardening.cmake, and CMakeLists.txt on search paths.

    linkage_test.py [--hardened] FILE|FOLDER...    # exit status 1 where one does; --hardened: release builds

Of a folder, each program and library in it.

A search path with an empty element, or one that is not absolute, makes the loader run a library that lies in the current
folder, such as that of a downloaded scene.
"""

import pathlib
import re
import subprocess
import sys


def readelf(option, file):
    return subprocess.run(["readelf", "--wide", option, file], check=True, capture_output=True, text=True).stdout


def search_path_faults(dynamic):
    for kind, path in re.findall(r"\((RPATH|RUNPATH)\).*\[(.*)\]", dynamic):
        for element in path.split(":"):
            if element != "$ORIGIN" and not element.startswith(("/", "$ORIGIN/")):
                yield f"{kind} [{path}] has the element '{element}'"


def hardening_faults(dynamic, file):
    if "BIND_NOW" not in dynamic and not re.search(r"FLAGS_1.*\bNOW\b", dynamic):
        yield "calls are bound while it runs: no BIND_NOW"
    segments = readelf("--program-headers", file)
    if "GNU_RELRO" not in segments:
        yield "its tables of calls stay writable: no RELRO"
    if not re.search(r"GNU_STACK\b.*\bRW\s", segments):
        yield "its stack can be executed"
    if "Elf file type is DYN" not in segments:
        yield "it has one fixed place in memory: no PIE"
    symbols = readelf("--dyn-syms", file)
    for symbol, what in (("__stack_chk_fail", "no stack protector"), (r"__\w+_chk\b", "no _FORTIFY_SOURCE")):
        if not re.search(symbol, symbols):
            yield what


def faults(file, hardened):
    dynamic = readelf("--dynamic", file)
    yield from search_path_faults(dynamic)
    if hardened:
        yield from hardening_faults(dynamic, file)


def is_linked(path):
    """Whether it is a program or a shared library."""
    with open(path, "rb") as file:
        head = file.read(18)
    return head[:4] == b"\x7fELF" and head[16] in (2, 3)


def main():
    arguments = sys.argv[1:]
    hardened = "--hardened" in arguments
    files = [file for name in arguments if name != "--hardened"
             for file in (sorted(path for path in pathlib.Path(name).rglob("*") if path.is_file() and not path.is_symlink()
                                 and is_linked(path)) if pathlib.Path(name).is_dir() else [name])]
    found = [f"{file}: {fault}" for file in files for fault in faults(file, hardened)]
    # The test of the test: the loader's own view of a path that ends in nothing.
    assert list(search_path_faults(" 0x1d (RUNPATH) Library runpath: [/usr/lib:]")), "an empty element is not seen"
    print("\n".join(found) if found else f"Nothing to complain about: {len(files)} files")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
