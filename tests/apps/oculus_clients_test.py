#!/usr/bin/python3
"""insonify emulate oculus with several clients, and with clients that are slow, wrong or hostile; how it ends.

oculus_clients_test.py INSONIFY
"""

import itertools
import math
import random
import signal
import struct
import subprocess
import time
import unittest

try:
    import h5py
except ImportError:
    h5py = None

from emulated import INSONIFY, PROMPT
from oculus_client import (BITS16, DUMMY, METRES, PING, RATE_2, RATE_40, SIMPLE, STANDBY, USER_CONFIG, fire,
                           message)
from oculus_rig import USUAL, OculusCase


class OculusClientsTest(OculusCase):
    def test_a_flood_of_fire_messages_holds_nothing_up(self):
        sonar = self.sonar()
        client = sonar.client()
        client.send(b"".join(fire(reach=2 + i / 1000, rate=RATE_40) for i in range(3000)))
        end = time.monotonic() + 20
        while abs(client.ping().reach - 4.999) > 1e-9:
            self.assertLess(time.monotonic(), end)
        status, _, err, seconds = sonar.end()
        self.assertEqual((status, err), (0, ""))
        self.assertLess(seconds, PROMPT)

    def test_it_does_not_ping_unasked_and_keeps_the_connection(self):
        client = self.sonar().client()
        client.send(message(DUMMY))
        self.assertEqual(client.receive(), (DUMMY, struct.pack("<HHHHHIH", 0x4f53, 1, 0, DUMMY, 0, 0, 0)))
        client.ask(reach=5.0)
        client.send(fire(reach=5.0, rate=STANDBY))
        number = PING
        while number == PING:
            number, _ = client.receive()
        self.assertEqual(number, DUMMY)
        self.assertEqual(client.receive()[0], DUMMY)
        self.assertEqual(client.ask(reach=4.0).reach, 4)

    def test_each_client_gets_each_ping_in_its_layout(self):
        sonar = self.sonar()
        one, two, silent = (sonar.client() for _ in range(3))
        one.ask(reach=5.0)
        two.ask(reach=6.0, layout=2)
        self.assertEqual(two.ping().version, 2)
        # The last message counts, for all; who has sent none gets layout 1.
        for client in (one, silent):
            ping = client.ping()
            while ping.reach != 6:
                ping = client.ping()
            self.assertEqual(ping.version, 1)
        numbers = [one.ping().number for _ in range(3)]
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + 3)))
        one.close()
        self.assertEqual(two.ping().version, 2)

    def test_a_client_that_does_not_read_stops_nobody(self):
        sonar = self.sonar("--set", "sonars.fls.bin_count=2000", "--set", "sonars.fls.beam_count=250")
        sonar.client().send(fire(reach=5.0, flags=USUAL | BITS16, rate=RATE_40))  # 1 MB a ping, never read.
        reader = sonar.client()
        for _ in range(20):  # More than the system's buffers take.
            self.assertEqual(reader.ping().rows, 2000)
        _, out, _, _ = sonar.end()
        self.assertIn("pings dropped, for they were not sent in time", out)

    def test_a_client_that_sends_nothing_is_disconnected(self):
        sonar = self.sonar("--silence", "2")
        silent, awake = sonar.client(), sonar.client()
        begun = time.monotonic()
        with self.assertRaises(ConnectionError):
            while time.monotonic() < begun + 20:
                awake.send(message(DUMMY))
                awake.receive()  # Dummy messages, one a second.
                silent.receive()
        self.assertGreater(time.monotonic(), begun + 2)
        self.assertEqual(awake.ask(reach=5.0).reach, 5)
        _, _, err, _ = sonar.end()
        self.assertRegex(err, r"^insonify: warning: [\d.]+ has sent nothing for 2 s: disconnected\n$")

    def test_a_driver_may_start_again(self):
        sonar = self.sonar()
        for reach in (5.0, 6.0):
            client = sonar.client()
            self.assertEqual(client.ask(reach=reach).reach, reach)
            client.close()

    def test_wrong_messages_change_nothing_and_are_told(self):
        sonar = self.sonar()
        client = sonar.client()
        client.ask(reach=5.0)
        for wrong in (fire(mode=0), fire(mode=3), fire(rate=6), fire(reach=0.0), fire(reach=math.nan), fire(gain=101.0),
                      fire(speed=1200.0), fire(salinity=-1.0), fire(flags=METRES), fire(reach=101.0, flags=SIMPLE),
                      message(0x15, bytes(36)), message(0x15, bytes(37), version=2), message(0x22), b"hello" * 9):
            client.send(wrong)
        # An answer is dropped where the pings before it have not been read: asked again, as a driver does.
        for received in itertools.count():
            if received % 10 == 0:
                client.send(message(USER_CONFIG, bytes(12)))
            if client.receive()[0] == USER_CONFIG:
                break
        ping = client.ping()
        self.assertEqual((ping.reach, ping.mode, ping.gain), (5, 1, 50))
        _, out, err, _ = sonar.end()
        told = [line.removeprefix("insonify: warning: ignored, from ").split(": ", 1)[1] for line in err.splitlines()]
        # The stream may deliver the last in pieces, each told by itself.
        pieces = [int(line.split()[0]) for line in told if line.endswith(" bytes that are not a message")]
        told = told[:len(told) - len(pieces)]
        self.assertEqual(sum(pieces), 45)
        self.assertEqual(told, [
            "mode = 0 must be from 1 to 2", "mode = 3 must be from 1 to 2", "ping rate = 6 must be from 0 to 5",
            "range = 0 must be greater than 0, at most 100000", "range = nan must be greater than 0, at most 100000",
            "gain = 101 must be from 0 to 100", "sound speed = 1200 must be from 1300 to 1700",
            "salinity = -1 must be from 0 to 50",
            "flags = 0x01 ask for the full return message, whose format is not public; 0x09 asks for the simple one",
            "range = 101 must be greater than 0, at most 100",
            "fire message of version 0 has a payload of 36 bytes and must have 37 or 73",
            "fire message of version 2 has a payload of 37 bytes and must have 73", "message 0x22, which is unknown"])
        self.assertIn(f"{len(told) + len(pieces)} packets refused", out)

    def test_random_packets_do_not_end_it(self):
        sonar = self.sonar()
        chance = random.Random(52100)
        good = [fire(reach=3.0), fire(reach=4.0, layout=2), message(DUMMY), message(USER_CONFIG, bytes(12)),
                fire(rate=STANDBY)]
        for _ in range(6):
            client = sonar.client()
            for _ in range(300):
                packet = bytearray(chance.choice(good) if chance.random() < 0.8 else chance.randbytes(chance.randrange(200)))
                for _ in range(chance.randrange(4)):
                    if packet:
                        packet[chance.randrange(len(packet))] = chance.randrange(256)
                try:
                    client.send(packet[:chance.randrange(len(packet) + 1)] if chance.random() < 0.1 else packet)
                except OSError:  # The sonar may not close; the test's buffer may be full.
                    self.fail("the sonar closed the connection")
                if chance.random() < 0.02:
                    time.sleep(0.002)
            client.close()
        client = sonar.client()
        self.assertEqual(client.ask(reach=2.5, rate=RATE_2).reach, 2.5)
        self.assertEqual(sonar.end()[0], 0)

    def test_it_ends_at_once_and_tells_its_rate(self):
        sonar = self.sonar()
        sonar.client().ask(reach=5.0)
        sonar.process.send_signal(signal.SIGUSR1)
        self.assertEqual(sonar.process.stdout.readline(), "mode 1 (low): 720 kHz, to 12 m\n")
        self.assertRegex(sonar.process.stdout.readline(), r"^\d+ pings in")
        status, out, err, seconds = sonar.end()
        self.assertEqual((status, err), (0, ""))
        self.assertIn("ms from transmission to message", out)
        self.assertLess(seconds, PROMPT)

    def test_in_the_papers_model_pixels_are_intensities(self):
        sonar = self.sonar(scenario="model: paper\nworld: wall.obj\nsonars:\n"
                           "  - {name: fls, beam_count: 30, bin_count: 200, max_range: 8}\n",
                           **{"wall.obj": "v 4 -9 -9\nv 4 9 -9\nv 4 9 9\nv 4 -9 9\nf 4 3 2 1\n"})
        ping = sonar.client().ask(reach=8.0)
        row, _ = ping.brightest()
        self.assertAlmostEqual(ping.distance(row), 4, delta=0.15)
        subprocess.run([INSONIFY, "run", "dive.yaml", "-o", "out", "--pings", "1", "--no-pictures"], cwd=sonar.path,
                       check=True, capture_output=True)
        if h5py is not None:
            with h5py.File(sonar.path / "out/fls.h5") as recording:
                brightest = recording["intensity"][0].max()
            self.assertAlmostEqual(max(map(max, ping.image)), round(255 * brightest), delta=30)

    def test_wrong_input_is_one_line(self):
        sonar = self.sonar()
        for options, message_text in (
                (["--sonar", "head"],
                 "--sonar head: is scanning (type: msis); emulate oculus needs one that is forward-looking (type: fls)"),
                (["--high", "head"],
                 "--high head: is scanning (type: msis); emulate oculus needs one that is forward-looking (type: fls)"),
                (["--high", "x"], "--high x: dive.yaml has no such sonar; it has head, fls, fine"),
                (["--address", "::1"],
                 "--address ::1 must be one IPv4 address: the sonar sends it in its status messages")):
            done = subprocess.run([INSONIFY, "emulate", "oculus", "dive.yaml", "--port", "0", *options],
                                  cwd=sonar.path, capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual((done.returncode, done.stderr), (2, f"insonify: {message_text}\n"))
        for address, failure in (
                (sonar.address, f"cannot listen on TCP port 52100 of {sonar.address}: Address already in use"),
                ("203.0.113.77", "--address 203.0.113.77: no network interface of this machine has it")):
            done = subprocess.run([INSONIFY, "emulate", "oculus", "dive.yaml", "--address", address],
                                  cwd=sonar.path, capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual((done.returncode, done.stderr.splitlines()[-1]), (1, f"insonify: {failure}"))


if __name__ == "__main__":
    unittest.main()
