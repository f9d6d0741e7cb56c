"""A client of Oculus sonars, written from the layout of their messages alone. All numbers are little-endian, packed."""

import functools
import itertools
import socket
import struct
import time

STATUS_PORT, DATA_PORT = 52102, 52100
FIRE, PING, USER_CONFIG, DUMMY = 0x15, 0x23, 0x55, 0xff
HEADER = "<HHHHHIH"  # Check, source, destination, id, version, payload size, reserved.
FIRE_BODY = "<BBBBBdddd"  # Mode, ping rate, network speed, gamma, flags, range, gain, sound speed, salinity.
BITS32 = 0x200  # An extended flag.
METRES, BITS16, GAIN_SENT, SIMPLE, ASSIST, BEAMS512 = 0x01, 0x02, 0x04, 0x08, 0x10, 0x40
RATE_10, RATE_15, RATE_40, RATE_5, RATE_2, STANDBY = range(6)


def message(number, payload=b"", version=0):
    return struct.pack(HEADER, 0x4f53, 0, 1, number, version, len(payload), 0) + payload


def fire(mode=1, rate=RATE_10, gamma=255, flags=METRES | SIMPLE | BEAMS512, reach=10.0, gain=50.0, speed=0.0,
         salinity=0.0, layout=1, extended=0, reserved=(0,) * 8):
    """A fire message."""
    payload = struct.pack(FIRE_BODY, mode, rate, 255, gamma, flags, reach, gain, speed, salinity)
    if layout == 2:
        payload += struct.pack("<I8I", extended, *reserved)
    return message(FIRE, payload, version=layout if layout == 2 else 0)


class Ping:
    """A simple ping result. Every size and offset in it must fit."""

    def __init__(self, data):
        self.size = len(data)
        self.version = struct.unpack_from("<H", data, 8)[0]
        layout2 = self.version == 2
        (self.mode, self.rate, self.network_speed, self.gamma, self.flags, self.reach, self.gain, self.asked_speed,
         self.salinity) = struct.unpack_from(FIRE_BODY, data, 16)
        self.extended = struct.unpack_from("<I8I", data, 53) if layout2 else None
        fields = "<IIddd" + ("ddd" if layout2 else "") + "d" + ("d" if layout2 else "I") + "Bd HH".replace(" ", "") + \
            ("4I" if layout2 else "") + "III"
        start = 89 if layout2 else 53
        values = list(struct.unpack_from(fields, data, start))
        end = start + struct.calcsize(fields)
        assert end == (202 if layout2 else 122), end
        self.number, self.status, self.frequency, self.temperature, self.pressure = values[:5]
        del values[:5]
        if layout2:
            self.heading, self.pitch, self.roll = values[:3]
            del values[:3]
        self.speed, self.start, self.data_size, self.resolution, self.rows, self.beams = values[:6]
        self.offset, self.image_size, message_size = values[-3:]
        if not layout2:
            self.start *= 1e-6
        assert message_size == len(data) == self.offset + self.image_size, (message_size, len(data), self.offset)
        assert self.offset == end + 2 * self.beams
        self.bearings = [hundredths / 100 for hundredths in struct.unpack_from(f"<{self.beams}h", data, end)]
        pixel = {0: "B", 1: "H", 3: "I"}[self.data_size]
        word = "I" if self.flags & GAIN_SENT else ""
        row = struct.Struct(f"<{word}{self.beams}{pixel}")
        assert self.image_size == row.size * self.rows, (self.image_size, row.size, self.rows)
        self._row, self._data = row, data

    def row(self, row):
        """Pixels of a row."""
        values = self._row.unpack_from(self._data, self.offset + row * self._row.size)
        return values[1:] if self.flags & GAIN_SENT else values

    @functools.cached_property
    def image(self):
        """Pixels, by row and beam."""
        return [self.row(row) for row in range(self.rows)]

    @functools.cached_property
    def gains(self):
        """Gain words of the rows."""
        assert self.flags & GAIN_SENT
        return [struct.unpack_from("<I", self._data, self.offset + row * self._row.size)[0]
                for row in range(self.rows)]

    def distance(self, row):
        """Of the middle of a row [m]."""
        return (row + 0.5) * self.resolution

    def brightest(self):
        """Row and beam of the brightest pixel."""
        row = max(range(self.rows), key=lambda row: max(self.image[row]))
        return row, max(range(self.beams), key=lambda beam: self.image[row][beam])


class Client:
    """A connection to a sonar."""

    def __init__(self, address, port=DATA_PORT, timeout=10):
        self.socket = socket.create_connection((address, port), timeout=timeout)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.data = bytearray()

    def send(self, data):
        self.socket.sendall(data)

    def receive(self):
        """Id and all bytes of the next message."""
        while True:
            if len(self.data) >= 16:
                check, source, _, number, _, size, _ = struct.unpack_from(HEADER, self.data)
                assert (check, source) == (0x4f53, 1), (check, source)
                if len(self.data) >= 16 + size:
                    whole = bytes(self.data[:16 + size])
                    del self.data[:16 + size]
                    return number, whole
            more = self.socket.recv(1 << 20)
            if not more:
                raise ConnectionError("the sonar closed the connection")
            self.data += more

    def ping(self):
        """The next ping."""
        while True:
            number, data = self.receive()
            if number == PING:
                return Ping(data)

    def ask(self, wanted=None, **settings):
        """Fires, and returns the first ping that has been made with the settings."""
        asked = fire(**settings)
        self.send(asked)
        end = time.monotonic() + 20
        for received in itertools.count(1):
            assert time.monotonic() < end, f"no ping with {settings} {wanted}"
            number, data = self.receive()
            # The fire message of another client, perhaps one that has gone, may have been read after this one.
            if number == DUMMY or received % 10 == 0:
                self.send(asked)
            if number != PING:
                continue
            ping = Ping(data)
            same = {"mode": ping.mode, "flags": ping.flags, "reach": ping.reach, "gamma": ping.gamma, "rate": ping.rate,
                    "gain": (ping.gain - 40) / 0.6 if ping.mode == 2 else ping.gain, "speed": ping.asked_speed,
                    "salinity": ping.salinity, **(wanted or {})}
            wish = {**settings, **(wanted or {})}
            if all(abs(same[name] - value) < 1e-6 for name, value in wish.items() if name in same):
                return ping

    def close(self):
        self.socket.close()


def status_listener(address=""):
    """A socket that hears of sonars. Without an address, of all on this machine."""
    listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.bind((address, STATUS_PORT))
    listener.settimeout(60)
    return listener


def next_status(listener):
    """Address, part number, mask, client, temperatures and pressure of the next status message."""
    data = listener.recv(2048)
    assert len(data) == 142, len(data)
    check, source, _, _, _, size, _ = struct.unpack_from(HEADER, data)
    device, kind, part, state = struct.unpack_from("<IHHI", data, 16)
    assert (check, source, size, device, kind, state & 7) == (0x4f53, 1, 126, 1, 1, 3), data
    address, mask, client = (socket.inet_ntoa(data[at:at + 4]) for at in (52, 56, 60))
    *temperatures, pressure = struct.unpack_from("<9d", data, 70)
    return address, part, mask, client, temperatures, pressure

