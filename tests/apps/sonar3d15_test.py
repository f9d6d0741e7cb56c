#!/usr/bin/python3
"""insonify emulate sonar3d15 as a client meets it: its packets are taken apart here, by the published layout alone.

sonar3d15_test.py INSONIFY
"""

import math
import socket
import struct
import subprocess
import time
import unittest
import zlib

from emulated import INSONIFY, Emulated

# A wall 5 m ahead, a box in front of it to starboard and below, and nothing above 1 m.
SCENARIO = """
world: wall.obj
water: {sound_speed: 1500}
sonars: [{name: eye, azimuth_aperture_deg: 90, elevation_aperture_deg: 40, beam_count: 4, bin_count: 10, max_range: 15,
          frequency: 1.2e6, sampling: {columns_per_beam: 1, rows: 8}}]
"""
WALL = """
v 5 -30 -30
v 5 30 -30
v 5 30 1
v 5 -30 1
f 4 3 2 1
v 3 -2 -1
v 3 -1 -1
v 3 -1 -0.5
v 3 -2 -0.5
f 8 7 6 5
"""


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        value |= (byte & 127) << shift
        at, shift = at + 1, shift + 7
        if byte < 128:
            return value, at


def fields(data):
    """The fields of a message of Protocol Buffers, by number."""
    found, at = {}, 0
    while at < len(data):
        key, at = varint(data, at)
        if key & 7 == 0:
            found[key >> 3], at = varint(data, at)
        elif key & 7 == 5:
            found[key >> 3] = struct.unpack_from("<f", data, at)[0]
            at += 4
        else:
            assert key & 7 == 2, key
            size, at = varint(data, at)
            found[key >> 3] = data[at:at + size]
            at += size
    assert at == len(data)
    return found


def unsnapped(block):
    """The contents of a Snappy block of literals."""
    size, at = varint(block, 0)
    contents = b""
    while at < len(block):
        tag = block[at]
        assert tag & 3 == 0, "a literal"
        length, at = tag >> 2, at + 1
        if length >= 60:
            count = length - 59
            length = int.from_bytes(block[at:at + count], "little")
            at += count
        contents += block[at:at + length + 1]
        at += length + 1
    assert len(contents) == size
    return contents


class Image:
    """A packet with a range image."""

    def __init__(self, packet):
        magic, size = struct.unpack_from("<4sI", packet)
        assert (magic, size) == (b"RIP2", len(packet))
        assert struct.unpack_from("<I", packet, size - 4)[0] == zlib.crc32(packet[:-4])
        wrapped = fields(fields(unsnapped(packet[8:-4]))[1])
        assert wrapped[1] == b"type.googleapis.com/waterlinked.sonar.protocol.RangeImage"
        image = fields(wrapped[2])
        header = fields(image[1])
        stamp = fields(header[1])
        self.time, self.number = stamp[1] + 1e-9 * stamp.get(2, 0), header.get(2, 0)
        self.speed, self.range, self.frequency, self.width, self.height = (image[i] for i in range(2, 7))
        self.fov = (image[7], image[8])
        self.scale, packed = image[9], image[10]
        self.pixels, at = [], 0
        while at < len(packed):
            value, at = varint(packed, at)
            self.pixels.append(value)
        assert len(self.pixels) == self.width * self.height

    def points(self):
        """x forward, y to starboard, z down, as the maker's page has it."""
        for i, value in enumerate(self.pixels):
            yaw = math.radians((i % self.width) / (self.width - 1) * self.fov[0] - self.fov[0] / 2)
            pitch = math.radians((i // self.width) / (self.height - 1) * self.fov[1] - self.fov[1] / 2)
            radius = value * self.scale
            yield (value > 0, radius * math.cos(pitch) * math.cos(yaw), radius * math.cos(pitch) * math.sin(yaw),
                   -radius * math.sin(pitch), math.tan(pitch) / math.cos(yaw))


class Sonar3d15Test(unittest.TestCase):
    def start(self, *options):
        listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(listener.close)
        listener.bind(("127.0.0.1", 0))
        listener.settimeout(60)
        program = Emulated("sonar3d15", "dive.yaml", "--to", "127.0.0.1", "--port", str(listener.getsockname()[1]),
                           *options, files={"dive.yaml": SCENARIO, "wall.obj": WALL})
        self.addCleanup(program.close)
        return program, listener

    def test_a_wall_is_where_it_is(self):
        program, listener = self.start()
        image = Image(listener.recv(65536))
        self.assertEqual((image.number, image.width, image.height, image.speed, image.range, image.frequency),
                         (0, 256, 64, 1500, 15, 1200000))
        for found, expected in zip(image.fov, (90, 40)):
            self.assertAlmostEqual(found, expected, delta=1e-5)
        self.assertLess(abs(image.time - time.time()), 60)
        met = boxes = 0
        for there, x, y, z, slope in image.points():
            if abs(5 * slope - 1) < 0.1:
                continue  # At the upper edge of the wall.
            self.assertEqual(there, 5 * slope < 1)  # Above it, water.
            if there and x < 4:
                boxes += 1
                self.assertAlmostEqual(x, 3, delta=2e-3)
                self.assertTrue(0.95 < y < 2.05 and 0.45 < z < 1.05, (y, z))
            elif there:
                met += 1
                self.assertAlmostEqual(x, 5, delta=2e-3)  # A pixel's step is 1 mm.
        self.assertGreater(met, 9000)
        # 1 m at 1 to 2 m to starboard is 15.3 degrees of 90 wide, 0.5 m is 8.5 of 40 high, at 3 m: some 600 pixels.
        self.assertTrue(450 < boxes < 750, boxes)
        self.assertEqual(Image(listener.recv(65536)).number, 1)
        status, out, err, _ = program.end()
        self.assertEqual((status, err), (0, ""))
        self.assertIn("Sonar 3D-15 eye to UDP 127.0.0.1", out)
        self.assertIn("256 x 64, 5 Hz", out)

    def test_wrong_input_is_one_line(self):
        program, _ = self.start()
        for words, status, message in (
                (("--to", "there"), 2, "--to there must be an IPv4 address, such as 224.0.0.96, and so must --address 127.0.0.1"),
                (("--address", "192.0.2.1"), 1, "--address 192.0.2.1: no network interface of this machine has it"),
                (("--port", "0"), 2, "--port: 0 must be a whole number, from 1 to 65535 (insonify emulate sonar3d15 --help)")):
            done = subprocess.run([INSONIFY, "emulate", "sonar3d15", "dive.yaml", "-q", *words], cwd=program.path,
                                  capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual((done.returncode, done.stderr), (status, f"insonify: {message}\n"))


if __name__ == "__main__":
    unittest.main()
