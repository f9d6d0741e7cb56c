#!/usr/bin/python3
"""insonify emulate omniscan450 and surveyor240 as clients meet them: their published layouts decoded here, by hand.

ping_streamers_test.py INSONIFY
"""

import math
import socket
import struct
import subprocess
import unittest

from emulated import INSONIFY, Emulated
from ping360_client import NACK, frame, parsed

# The Surveyor looks down on the bed 4 m below, and the world has a target above it at y = 2, to port.
SCENARIO = """
world: bed.obj
water: {sound_speed: 1500}
points: [{position: [0, 9, -1], target_strength_db: 20}]
sonars:
  - {name: down, orientation_deg: [0, 90, 0], beam_count: 40, bin_count: 300, azimuth_aperture_deg: 80, max_range: 9,
     frequency: 240e3, elevation_aperture_deg: 4, sampling: {columns_per_beam: 2, rows: 200}}
  - {name: side, orientation_deg: [0, 0, 90], position: [0, 0, -1], beam_count: 1, bin_count: 300, azimuth_aperture_deg: 2,
     elevation_aperture_deg: 30, max_range: 20, frequency: 450e3, sampling: {columns_per_beam: 4, rows: 40}}
"""
BED = "v -50 -50 -4\nv 50 -50 -4\nv 50 50 -4\nv -50 50 -4\nf 1 2 3 4\n"
PROFILE, YZ, ATOF, ATTITUDE, WATER = 2198, 3011, 3012, 504, 118


def os_ping_params(start=0, length=12000, period=0, results=600, enable=1, tail=b"\0\0\0"):
    return frame(2197, struct.pack("<IIIffffhHB", start, length, period, 0, 0, 0.002, 0.0015, -1, results, enable) + tail)


def set_ping_parameters(start=0, end=8000, enable=1, yz=1, atof=1, steps=400, sound_speed=1500.0):
    return frame(3023, struct.pack("<iifhhHBBBBBBiHHf", start, end, sound_speed, -1, 10, 0, 0, enable, 0, 0, yz, atof,
                                   240000, steps, 0, 1.5))


class Client(Emulated):
    """A program that emulates an instrument, and a connection to it by TCP or UDP."""

    def __init__(self, instrument, *options, kind=socket.SOCK_STREAM):
        super().__init__(instrument, "dive.yaml", "--port", "0", "-q", *options,
                         files={"dive.yaml": SCENARIO, "bed.obj": BED})
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError(self.process.communicate()[1])
        self.address = ("127.0.0.1", int(line.rsplit(":", 1)[1]))
        self.socket = socket.socket(socket.AF_INET, kind)
        self.socket.settimeout(60)
        self.socket.connect(self.address)
        self.stream = self.socket.makefile("rb") if kind == socket.SOCK_STREAM else None

    def send(self, data):
        self.socket.sendall(data)

    def receive(self):
        """Id and payload of the next frame."""
        if self.stream is None:
            return parsed(self.socket.recv(65536))
        header = self.stream.read(8)
        return parsed(header + self.stream.read(struct.unpack_from("<H", header, 2)[0] + 2))

    def next(self, wanted):
        """The payload of the next frame with an id."""
        while True:
            number, payload = self.receive()
            if number == wanted:
                return payload

    def close(self):
        if self.stream:
            self.stream.close()
        self.socket.close()
        super().close()


class StreamersTest(unittest.TestCase):
    def client(self, *words, **more):
        client = Client(*words, **more)
        self.addCleanup(client.close)
        return client

    def check_profile(self, payload, number):
        fields = struct.unpack_from("<IIIIIHHHBBffffff", payload)
        ping, start, length, _, frequency, _, count, speed, channel, _, pulse, _, most, least, heading, _ = fields
        self.assertEqual((ping, start, length, frequency, count, speed, channel), (number, 0, 12000, 450000, 600, 15000, 0))
        self.assertEqual(len(payload), 52 + 2 * count)
        self.assertAlmostEqual(pulse, 0.002 * 2 * 12 / 1500, delta=1e-9)  # 0.2 % of the way there and back.
        self.assertAlmostEqual(heading, 0, delta=1e-3)  # It looks along y: north.
        self.assertAlmostEqual(most - least, 120, delta=1e-3)
        values = struct.unpack_from(f"<{count}H", payload, 52)
        loudest = max(range(count), key=lambda i: values[i])
        self.assertEqual(values[loudest], 65535)
        self.assertAlmostEqual((loudest + 0.5) * 12 / count, 9, delta=0.05)  # The pulse is 24 mm long, twice a bin.
        return most

    def test_an_omniscan_sends_profiles_over_tcp_and_udp(self):
        for kind in (socket.SOCK_STREAM, socket.SOCK_DGRAM):
            sonar = self.client("omniscan450", "--sonar", "side", kind=kind)
            sonar.send(frame(6, struct.pack("<H", 4)))
            self.assertEqual(sonar.receive(), (4, b"\0\0\x01\0\0\0"))
            sonar.send(os_ping_params())
            level = self.check_profile(sonar.next(PROFILE), 0)
            # 200 dB and a target of 20 dB, 9 m away: spreading both ways takes 38 dB, and the water some 2 dB.
            self.assertAlmostEqual(level, 200 + 20 - 40 * math.log10(9) - 2.4, delta=3)
            self.check_profile(sonar.next(PROFILE), 1)
            sonar.send(os_ping_params(enable=0, tail=b"\0"))  # An older definition is two bytes shorter.
            sonar.send(frame(6, struct.pack("<H", 5)))
            self.assertEqual(sonar.next(5), b"\x01\0\0\0")

    def test_a_surveyor_finds_the_bed(self):
        sonar = self.client("surveyor240", "--sonar", "down")
        sonar.send(set_ping_parameters())
        yz = sonar.next(YZ)
        head = struct.unpack_from("<IIf3f3f10Ifffff2H", yz)
        self.assertEqual(head[1:3], (0, 1500))
        for value, expected in zip(head[3:6], (0, 0, 1)):  # Level.
            self.assertAlmostEqual(value, expected, delta=1e-6)
        self.assertAlmostEqual(head[22], 0.05 * 8, delta=1e-6)  # Its start is 5 % of its end at least.
        self.assertAlmostEqual(head[23], 8, delta=1e-6)
        count = head[-1]
        self.assertGreater(count, 30)
        points = struct.unpack_from(f"<{2 * count}f", yz, 100)
        self.assertEqual(len(yz), 100 + 8 * count)
        for y, z in zip(points[::2], points[1::2]):
            self.assertAlmostEqual(z, -4, delta=0.15, msg=y)  # At the edges a beam's footprint is 0.2 m long in range.
        self.assertGreater(points[0], 2)  # The first beam is the one furthest to port: y is positive.
        self.assertLess(points[-2], -2)
        atof = sonar.next(ATOF)
        _, utc, listening, speed, _, hertz, pulse, _, number, _ = struct.unpack_from("<IQffIIfIHH", atof)
        self.assertEqual((utc, speed, hertz, number, len(atof)), (0, 1500, 240000, count, 40 + 16 * count))
        self.assertAlmostEqual(listening, 16 / 1500, delta=1e-6)
        self.assertAlmostEqual(pulse, 1.5 * 2 * 7.6 / 400 / 1500, delta=1e-8)  # 1.5 steps of 19 mm.
        for i in range(count):
            angle, time = struct.unpack_from("<ff", atof, 40 + 16 * i)
            self.assertAlmostEqual(750 * time * math.sin(angle), points[2 * i], delta=1e-3)
            self.assertAlmostEqual(-750 * time * math.cos(angle), points[2 * i + 1], delta=1e-3)
        self.assertEqual(struct.unpack_from("<3f", sonar.next(ATTITUDE)), head[3:6])
        self.assertEqual(len(sonar.next(WATER)), 8)
        sonar.send(set_ping_parameters(end=-6000, atof=0))  # Automatic, to 6 m at most.
        ends = (struct.unpack_from("<f", sonar.next(YZ), 92)[0] for _ in range(1000))
        self.assertTrue(any(abs(end - 6) < 1e-6 for end in ends))

    def test_refusals_tell_why(self):
        sonar = self.client("surveyor240", "--sonar", "down")
        for command, reason in ((set_ping_parameters(steps=100), b"n_range_steps = 100 must be from 200 to 800"),
                                (set_ping_parameters(sound_speed=900.0), b"sos_mps = 900 must be from 1300 to 1700"),
                                (set_ping_parameters(start=8000), b"start_mm = 8000 must be from 0 to 7999"),
                                (set_ping_parameters(sound_speed=math.nan), b"sos_mps = nan must be from 1300 to 1700"),
                                (frame(3023, b"\0"), b"payload has 1 bytes, must have 36")):
            sonar.send(command)
            self.assertEqual(sonar.receive(), (NACK, struct.pack("<H", 3023) + reason))
        for number, payload in ((2601, b""), (6, struct.pack("<H", 2601))):  # Sent, and asked for.
            sonar.send(frame(number, payload))
            self.assertEqual(sonar.receive(), (NACK, struct.pack("<H", 2601) + b"unknown message"))
        status, _, err, _ = sonar.end()
        self.assertEqual((status, err), (0, ""))

    def test_damaged_frames_are_skipped_and_answers_not_answered(self):
        asked, answer = frame(6, struct.pack("<H", 5)), (5, b"\x01\0\0\0")
        damaged = bytearray(os_ping_params())
        damaged[12] ^= 1
        endless = b"BR" + struct.pack("<HHBB", 65535, 2197, 0, 0)
        for kind in (socket.SOCK_STREAM, socket.SOCK_DGRAM):
            sonar = self.client("omniscan450", "--sonar", "side", kind=kind)
            for noise in (b"BRBBR\xffU", bytes(damaged), endless, frame(1), frame(NACK, b"\0\0no")):
                sonar.send(noise)
            sonar.send(os_ping_params()[:20])  # The start of a frame: a whole one by itself, or the first part of it.
            sonar.send(os_ping_params()[20:] + asked)
            replies = [sonar.receive()]
            while replies[-1] != answer:
                replies.append(sonar.receive())
            # Over TCP the two parts are a command; datagrams stand for themselves.
            self.assertTrue(all(number == PROFILE for number, _ in replies[:-1]))
            sonar.send(os_ping_params())
            # A ping that was being made when the command came is not sent.
            number = struct.unpack_from("<I", sonar.next(PROFILE))[0]
            self.assertIn(number, (len(replies) - 1, len(replies)))

    def test_a_client_that_is_gone_or_does_not_read_stops_nobody(self):
        sonar = self.client("omniscan450", "--sonar", "side")
        deaf = socket.create_connection(sonar.address)
        self.addCleanup(deaf.close)
        gone = socket.create_connection(sonar.address)
        gone.sendall(os_ping_params(length=200, results=1200))  # As fast as it can, to all.
        gone.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        sonar.next(PROFILE)
        gone.close()  # A reset: what it has not read is lost.
        for _ in range(20):
            sonar.next(PROFILE)
        again = socket.create_connection(sonar.address)
        self.addCleanup(again.close)
        again.settimeout(60)
        again.sendall(os_ping_params(enable=0))
        again.sendall(frame(6, struct.pack("<H", 5)))
        self.assertTrue(again.recv(4096))
        status, out, err, _ = sonar.end()
        self.assertEqual((status, err), (0, ""))

    def test_wrong_input_is_one_line(self):
        sonar = self.client("omniscan450", "--sonar", "side")
        done = subprocess.run([INSONIFY, "emulate", "omniscan450", "dive.yaml", "--port", "0", "--sonar", "down"],
                              cwd=sonar.path, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (2, "insonify: down has 40 beams; emulate omniscan450 needs a sonar with one\n"))


if __name__ == "__main__":
    unittest.main()
