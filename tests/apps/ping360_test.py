#!/usr/bin/python3
"""insonify emulate ping360 as a driver meets it: values, settings, scans, serial line, hostile packets.

ping360_test.py INSONIFY
"""

import math
import os
import random
import select
import signal
import socket
import struct
import subprocess
import time
import tty
import unittest

try:
    import h5py
except ImportError:
    h5py = None

from emulated import INSONIFY, PROMPT, Emulated
from ping360_client import ACK, AUTO_DATA, DATA, NACK, auto_transmit, frame, introduced, loudest, parsed, samples_of, transducer

# A target 4.1 m ahead, and one 5.3 m to starboard. 80 ticks of 25 ns are 2 us; with 1500 m/s a sample is 1.5 mm.
SCENARIO = """
water: {sound_speed: 1500}
points:
  - {position: [4.1, 0, 0], target_strength_db: -12}
  - {position: [0, -5.3, 0], target_strength_db: -12}
sonars:
  - {name: fls, beam_count: 8, bin_count: 50, max_range: 9}
  - {name: head, type: msis, beam_count: 1, bin_count: 100, azimuth_aperture_deg: 2, elevation_aperture_deg: 25,
     min_range: 0.75, max_range: 20, step_deg: -0.9, sampling: {columns_per_beam: 4, rows: 20}}
"""
NOISE = ("--set", "receiver.ambient_noise_db=76")  # Fills samples with values between dark and bright.


class Instrument(Emulated):
    """insonify emulate ping360 in a folder of its own, and a socket that talks with it."""

    def __init__(self, *options, scenario=SCENARIO, fast=True, address=None):
        where = ["--address", address] if address else ["--port", "0"]
        super().__init__("ping360", "scan.yaml", *where, *(["--fast"] if fast else []), *options,
                         files={"scan.yaml": scenario})
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError(self.process.communicate()[1])
        self.address = (address or "127.0.0.1", int(line.rsplit(":", 1)[1]))
        self.serial = self.process.stdout.readline().split()[-1] if "--pty" in options else None
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(60)

    def send(self, data):
        self.socket.sendto(data, self.address)

    def receive(self):
        return parsed(self.socket.recv(65536))

    def ask(self, data):
        self.send(data)
        return self.receive()

    def quiet(self, seconds=0.3):
        return not select.select([self.socket], [], [], seconds)[0]

    def close(self):
        self.socket.close()
        super().close()


class Ping360Test(unittest.TestCase):
    def instrument(self, *options, **more):
        instrument = Instrument(*options, **more)
        self.addCleanup(instrument.close)
        return instrument

    def test_targets_are_where_the_world_has_them(self):
        sonar = self.instrument()
        # 400 ticks are 10 us: a sample is 7.5 mm, 4.1 m is in sample 546. Angle 100 is to starboard.
        for angle, distance in ((0, 4.1), (100, 5.3)):
            number, payload = sonar.ask(transducer(angle))
            self.assertEqual(number, DATA)
            fields, samples = samples_of(payload)
            self.assertEqual(fields, (1, 1, angle, 40, 400, 750, 1000))
            self.assertEqual(len(samples), 1000)
            # A tone of 40 us is 30 mm long: speckle has its loudest sample anywhere in it.
            self.assertAlmostEqual((loudest(samples) + 0.5) * 0.0075, distance, delta=0.03)
            self.assertGreater(max(samples), 100)
        # Where nothing is, to port, only noise.
        weak = samples_of(sonar.ask(transducer(300))[1])[1]
        self.assertLess(max(weak), 60)

    @unittest.skipIf(h5py is None, "no h5py")
    def test_samples_are_those_of_the_recording(self):
        sonar = self.instrument(*NOISE)
        settings = ["receiver.pulse=cw", "receiver.pulse_duration=40e-6", "bin_count=900", "frequency=750e3",
                    "min_range=0.75", "max_range=7.5"]
        # 0.75 m are 100 samples of 7.5 mm, which are blank.
        subprocess.run([INSONIFY, "run", "scan.yaml", "-o", "out", "--pings", "3", "--no-pictures", *NOISE,
                        *[word for s in settings for word in ("--set", f"sonars.head.{s}")]],
                       cwd=sonar.path, check=True, capture_output=True)
        with h5py.File(sonar.path / "out/head.h5") as recording:
            intensity = recording["intensity"][:, :, 0]
        different = 0
        for angle in range(3):
            samples = samples_of(sonar.ask(transducer(angle))[1])[1]
            self.assertEqual(samples[:100], bytes(100))
            for i, value in enumerate(intensity[angle]):
                # From -100 to -40 dB, with 30 dB per decade of range: docs/reference/messages.md.
                level = 10 * math.log10(max(value, 1e-30)) + 30 * math.log10(0.0075 * (100.5 + i))
                expected = 255 * min(1, max(0, (level + 100) / 60))
                self.assertLess(abs(samples[100 + i] - expected), 0.51)
                different += samples[100 + i] not in (0, 255)
        self.assertGreater(different, 500, "most samples are neither dark nor bright")

    def test_settings_act(self):
        sonar = self.instrument(*NOISE)
        low, normal, high = (samples_of(sonar.ask(transducer(300, gain=gain))[1])[1] for gain in range(3))
        # 6 dB of 60 dB are 25.5 counts.
        mean = [sum(samples[500:]) / 500 for samples in (low, normal, high)]
        self.assertAlmostEqual(mean[2] - mean[1], 25.5, delta=4)
        self.assertAlmostEqual(mean[1] - mean[0], 25.5, delta=4)
        sonar = self.instrument()
        # Twice the period: the target is at half the sample.
        fine = loudest(samples_of(sonar.ask(transducer(0, period=400))[1])[1])
        coarse = loudest(samples_of(sonar.ask(transducer(0, period=800, count=600))[1])[1])
        self.assertAlmostEqual(fine, 2 * coarse, delta=8)
        # A longer tone makes a longer echo.
        def length(duration):
            samples = samples_of(sonar.ask(transducer(0, duration=duration))[1])[1]
            return sum(value > 0.8 * max(samples) for value in samples)
        self.assertGreater(length(400), 3 * length(20))
        # At 500 kHz water absorbs less than at 1 MHz: over 2 x 4.1 m by more than 1 dB, which is 4 counts of 60 dB.
        sonar = self.instrument("--set", "receiver.full_scale_db=0")
        low, high = (max(samples_of(sonar.ask(transducer(0, frequency=frequency))[1])[1]) for frequency in (500, 1000))
        self.assertLess(low, 255)
        self.assertGreaterEqual(low - high, 4)

    def test_the_answer_comes_when_the_echoes_are_in(self):
        sonar = self.instrument()
        start = time.monotonic()
        sonar.ask(transducer(0, period=8000, count=1200))
        self.assertGreater(time.monotonic() - start, 1200 * 8000 * 25e-9)  # 0.24 s

    def test_a_search_finds_it_at_its_own_port(self):
        own = f"127.{os.getpid() // 250 % 250 + 1}.{os.getpid() % 250 + 1}.201"
        sonar = self.instrument(address=own)
        self.assertEqual(sonar.address[1], 12345)
        sonar.socket.sendto(b"Discovery", (own, 30303))
        data, sender = sonar.socket.recvfrom(2048)
        self.assertEqual((sender[0], introduced(data)), (own, ("SONAR PING360", own)))
        sonar.socket.sendto(b"SetSS1IP 000.000.000.000", (own, 30303))  # Not a search: nothing follows.
        self.assertEqual(sonar.ask(frame(6, struct.pack("<H", 5))), (5, b"\x01\x00\x00\x00"))

    def test_the_head_takes_its_time_to_turn(self):
        sonar = self.instrument(fast=False)
        # 6.2 ms a gradian, the shorter way, and 18.2 ms to read out: docs/how-to/instruments.md.
        for command, least in ((transducer(30), 0.2042), (transducer(30), 0.0182), (transducer(390, transmit=0), 0.248)):
            start = time.monotonic()
            self.assertEqual(sonar.ask(command)[0], DATA)
            self.assertGreater(time.monotonic() - start, least)
        # A scan begins with the way to its start: from 390 to 10 are 20 gradians, then 5 between pings.
        start = time.monotonic()
        sonar.send(auto_transmit(10, 30, 5))
        self.assertEqual([sonar.receive()[0] for _ in range(3)], [AUTO_DATA] * 3)
        self.assertGreater(time.monotonic() - start, (20 + 5 + 5) * 0.0062 + 3 * 0.0182)

    def test_a_scan_sweeps_its_sector_until_the_motor_is_off(self):
        sonar = self.instrument()
        sonar.send(auto_transmit(395, 9, 5))
        angles = []
        for _ in range(7):
            number, payload = sonar.receive()
            self.assertEqual(number, AUTO_DATA)
            fields, samples = samples_of(payload, "<BBHHHHHHBBHH")
            self.assertEqual(fields[6:], (395, 9, 5, 0, 200))
            self.assertEqual(len(samples), 200)
            angles.append(fields[2])
        self.assertEqual(angles, [395, 0, 5, 0, 395, 0, 5])
        sonar.send(frame(2903))
        number = AUTO_DATA
        while number == AUTO_DATA:
            number, payload = sonar.receive()
        self.assertEqual((number, payload), (ACK, struct.pack("<H", 2903)))
        self.assertTrue(sonar.quiet())

    def test_refusals_tell_why(self):
        sonar = self.instrument()
        number, payload = sonar.ask(transducer(400))
        self.assertEqual((number, payload), (NACK, struct.pack("<H", 2601) + b"angle = 400 must be from 0 to 399"))
        damaged = bytearray(transducer(3))
        damaged[-1] ^= 1
        self.assertEqual(sonar.ask(damaged), (NACK, struct.pack("<H", 2601) + b"checksum"))
        self.assertEqual(sonar.ask(transducer(3)[:-3]), (NACK, struct.pack("<H", 2601) + b"truncated"))
        self.assertEqual(sonar.ask(frame(2601, bytes(3000)))[0], NACK)
        sonar.send(b"hello")
        self.assertTrue(sonar.quiet())

    def test_random_packets_do_not_end_it(self):
        sonar = self.instrument()
        chance = random.Random(19)
        good = [frame(6, struct.pack("<H", 4)), transducer(7, transmit=0), auto_transmit(1, 2, 1), frame(2903),
                frame(2000, b"\x05\x00"), frame(2600, b"\0\0")]
        for _ in range(2000):
            packet = bytearray(chance.choice(good) if chance.random() < 0.7 else chance.randbytes(chance.randrange(200)))
            for _ in range(chance.randrange(4)):
                if packet:
                    packet[chance.randrange(len(packet))] = chance.randrange(256)
            if chance.random() < 0.5 and len(packet) > 8:  # Get past the checksum.
                packet[-2:] = struct.pack("<H", sum(packet[:-2]) & 0xffff)
            sonar.send(packet[:chance.randrange(len(packet) + 1)] if chance.random() < 0.2 else packet)
            if chance.random() < 0.05:
                time.sleep(0.002)
        sonar.send(frame(2903, destination=255))
        while not sonar.quiet(0.5):
            sonar.socket.recv(65536)
        self.assertEqual(sonar.ask(frame(6, struct.pack("<H", 5))), (5, b"\x01\x00\x00\x00"))
        self.assertEqual(sonar.ask(transducer(0))[0], DATA)
        status, _, err, _ = sonar.end()
        self.assertEqual((status, err), (0, ""))

    def test_the_serial_line_speaks_the_same(self):
        sonar = self.instrument("--pty")
        line = os.open(sonar.serial, os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(os.close, line)
        tty.setraw(line)

        def read(count):
            data = b""
            while len(data) < count:
                self.assertTrue(select.select([line], [], [], 10)[0], "an answer")
                data += os.read(line, count - len(data))
            return data

        os.write(line, b"UU" + transducer(0)[:9])
        time.sleep(0.05)
        os.write(line, transducer(0)[9:])  # In pieces.
        by_line = parsed(read(10 + 14 + 1000))
        self.assertEqual(by_line[0], DATA)
        self.assertAlmostEqual((loudest(by_line[1][14:]) + 0.5) * 0.0075, 4.1, delta=0.03)
        # A 'U' after a line break ends a scan.
        os.write(line, auto_transmit(0, 399, 1))
        self.assertEqual(parsed(read(10 + 20 + 200))[0], AUTO_DATA)
        os.write(line, b"U")
        time.sleep(0.3)
        while select.select([line], [], [], 0.3)[0]:
            self.assertTrue(os.read(line, 4096))
        os.write(line, frame(6, struct.pack("<H", 5)))
        self.assertEqual(parsed(read(14)), (5, b"\x01\x00\x00\x00"))

    def test_it_ends_at_once_and_tells_its_rate(self):
        sonar = self.instrument()
        sonar.ask(transducer(0))
        sonar.process.send_signal(signal.SIGUSR1)
        self.assertIn("1 pings in", sonar.process.stdout.readline())
        status, out, err, seconds = sonar.end()
        self.assertEqual((status, err), (0, ""))
        self.assertIn("ms from transmission to message", out)
        self.assertLess(seconds, PROMPT)

    def test_wrong_input_is_one_line(self):
        sonar = self.instrument()
        for options, message in (
                (["--sonar", "fls"],
                 "--sonar fls: is forward-looking (type: fls); emulate ping360 needs one that is scanning (type: msis)"),
                (["--sonar", "x"], "--sonar x: scan.yaml has no such sonar; it has fls, head"),
                (["--address", "here"],
                 "--address here must be an IP address, such as 127.0.0.1 or ::1, or localhost")):
            done = subprocess.run([INSONIFY, "emulate", "ping360", "scan.yaml", "--port", "0", *options],
                                  cwd=sonar.path, capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual((done.returncode, done.stderr), (2, f"insonify: {message}\n"))
        done = subprocess.run([INSONIFY, "emulate", "ping360", "scan.yaml", "--port", str(sonar.address[1])],
                              cwd=sonar.path, capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (1, f"insonify: cannot listen on UDP port {sonar.address[1]} of 127.0.0.1: "
                             "Address already in use\n"))


if __name__ == "__main__":
    unittest.main()
