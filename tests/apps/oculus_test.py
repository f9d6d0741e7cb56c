#!/usr/bin/python3
"""insonify emulate oculus as a driver meets it: discovery, layouts, pixels, settings, rates.

oculus_test.py INSONIFY
"""

import math
import signal
import socket
import subprocess
import unittest

try:
    import h5py
except ImportError:
    h5py = None

from emulated import INSONIFY
from oculus_client import (ASSIST, BITS16, BITS32, DUMMY, GAIN_SENT, METRES, RATE_10, RATE_15, RATE_40, SIMPLE,
                           USER_CONFIG, Client, fire, message, next_status, status_listener)
from oculus_rig import NOISE, SCENARIO, USUAL, OculusCase


class OculusTest(OculusCase):
    def test_it_tells_of_itself_and_is_found(self):
        sonar = self.sonar()
        listener = status_listener(sonar.address)
        self.addCleanup(listener.close)
        address, part, mask, client, temperatures, pressure = next_status(listener)
        self.assertEqual((address, part, mask, client), (sonar.address, 0, "255.0.0.0", "0.0.0.0"))
        self.assertEqual(temperatures, [12] * 8)
        self.assertAlmostEqual(pressure, 1.01325)
        found = Client(address)
        self.addCleanup(found.close)
        self.assertEqual(next_status(listener)[3], found.socket.getsockname()[0])
        # It knows its own network.
        found.send(message(USER_CONFIG, bytes(12)))
        number, data = found.receive()
        while number == DUMMY:
            number, data = found.receive()
        self.assertEqual((number, data[16:]), (USER_CONFIG, socket.inet_aton(sonar.address) + b"\xff\0\0\0" + bytes(4)))

    def test_a_network_is_told_by_broadcast(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.connect(("198.51.100.1", 9))  # Sends nothing: it tells the address that would be used.
            except OSError:
                self.skipTest("this machine has no network")
            own = probe.getsockname()[0]
        listener = status_listener()
        self.addCleanup(listener.close)
        sonar = self.sonar()
        with subprocess.Popen([INSONIFY, "emulate", "oculus", "dive.yaml", "--address", own, "--port", "0"],
                              cwd=sonar.path, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
            try:
                line = program.stdout.readline()
                self.assertRegex(line, rf"^Oculus fls on TCP {own}:\d+, status to UDP [\d.]+:52102$")
                status = next_status(listener)
                while status[0] != own:  # Others on this machine tell of themselves too.
                    status = next_status(listener)
                # The broadcast address is the own one with all bits set that the mask has not.
                number = [int.from_bytes(socket.inet_aton(text), "big") for text in (own, status[2], line.split()[-1][:-6])]
                self.assertEqual(number[2], number[0] | ~number[1] & 0xffffffff)
            finally:
                program.send_signal(signal.SIGINT)
                err = program.communicate(timeout=120)[1]
        self.assertEqual(err, f"insonify: warning: whoever reaches {own} can command this sonar: its protocol knows no "
                              "password\n")

    def test_targets_are_where_the_world_has_them(self):
        client = self.sonar().client()
        ping = client.ask(reach=8.0, gain=30.0)
        # Without a preset rows are as many as the scenario's bins: 400 of 20 mm.
        self.assertEqual((ping.rows, ping.beams, ping.speed, ping.frequency), (400, 60, 1500, 720e3))
        self.assertAlmostEqual(ping.resolution, 0.02)
        # 60 beams of 2 degrees, from port (below 0) to starboard.
        self.assertEqual(ping.bearings, [2 * beam - 59 for beam in range(60)])
        for beam, distance in ((29, 4.1), (56, 5.0)):  # 53.13 is in the beam from 52 to 54.
            loudest = max(range(ping.rows), key=lambda row: ping.image[row][beam])
            self.assertAlmostEqual(ping.distance(loudest), distance, delta=0.02)
            self.assertGreater(ping.image[loudest][beam], 60)
        # To port there is nothing but noise.
        self.assertLess(max(max(row[:20]) for row in ping.image), 60)
        # Nearer than 0.5 m, which are 25 rows, the sonar hears nothing.
        self.assertEqual(max(max(row) for row in ping.image[:25]), 0)

    def test_layouts_pixels_and_gains_are_as_asked(self):
        client = self.sonar(*NOISE).client()
        for layout in (1, 2):
            for bits in (0, BITS16):
                for gain in (0, GAIN_SENT):
                    flags = METRES | SIMPLE | bits | gain
                    ping = client.ask(flags=flags, reach=7.5, layout=layout, extended=7, reserved=range(1, 9))
                    while ping.version != layout:
                        ping = client.ping()
                    # Ping checks all sizes. 400 rows of 60 pixels of 1 or 2 bytes, and of 4 bytes of gain.
                    self.assertEqual(ping.image_size, 400 * (60 * (2 if bits else 1) + (4 if gain else 0)))
                    self.assertEqual(ping.offset, (202 if layout == 2 else 122) + 120)
                    self.assertGreater(max(map(max, ping.image)), 256 if bits else 100)
                    if layout == 2:
                        self.assertEqual(ping.extended, (7, *range(1, 9)))
                        self.assertEqual((ping.heading, ping.pitch, ping.roll), (90, 0, 0))  # x is east.

    def test_the_extended_flag_of_layout_2_makes_pixels_of_32_bits(self):
        client = self.sonar(*NOISE).client()
        ping = client.ask(flags=METRES | SIMPLE | GAIN_SENT, reach=7.5, layout=2, extended=BITS32)
        self.assertEqual((ping.data_size, ping.image_size), (3, 400 * (60 * 4 + 4)))
        self.assertEqual(ping.extended, (BITS32, *[0] * 8))
        self.assertGreater(max(map(max, ping.image)), 2**24)
        client.send(fire(flags=METRES | SIMPLE | GAIN_SENT, reach=7.5, layout=1, extended=BITS32))
        while ping.version != 1:  # Layout 1 has no extended flags.
            ping = client.ping()
        self.assertEqual((ping.data_size, ping.image_size), (0, 400 * (60 + 4)))

    def test_the_pose_is_told_as_heading_pitch_and_roll(self):
        sonar = self.sonar(scenario=SCENARIO + "trajectory:\n"
                           "  - {time: 0, position: [0, 0, 0], orientation_deg: [11, 7, 30]}\n")
        ping = sonar.client().ask(layout=2)
        # A yaw of 30 degrees from east to north is a heading of 60; a positive pitch looks down.
        for told, expected in ((ping.heading, 60), (ping.pitch, -7), (ping.roll, 11)):
            self.assertAlmostEqual(told, expected)

    @unittest.skipIf(h5py is None, "no h5py")
    def test_pixels_are_those_of_the_recording(self):
        sonar = self.sonar(*NOISE)
        # 0.5 m are 26.7 rows of 18.75 mm: 27 are blank.
        blank, row_length = 27, 7.5 / 400
        settings = [f"min_range={blank * row_length}", "max_range=7.5", f"bin_count={400 - blank}"]
        subprocess.run([INSONIFY, "run", "dive.yaml", "-o", "out", "--pings", "1", "--no-pictures", *NOISE,
                        *[word for s in settings for word in ("--set", f"sonars.fls.{s}")]],
                       cwd=sonar.path, check=True, capture_output=True)
        with h5py.File(sonar.path / "out/fls.h5") as recording:
            intensity = recording["intensity"][0]
        for bits, gamma, gain in ((0, 255, 50.0), (BITS16, 127, 35.0)):
            sonar = self.sonar(*NOISE)  # Each ping has other noise: the first is that of the recording.
            ping = sonar.client().ask(flags=USUAL | bits | GAIN_SENT, gamma=gamma, gain=gain, reach=7.5)
            self.assertEqual(ping.number, 0)
            self.assertEqual(set(map(max, ping.image[:blank])), {0})
            full = 65535 if bits else 255
            different = 0
            for row, values in enumerate(intensity):
                # 30 dB per decade of range, 0.2 dB a percent; words stand for a gain of 1/50.
                decibels = 30 * math.log10((blank + row + 0.5) * row_length) + 0.2 * (gain - 50)
                word = max(1, round(50 * 10 ** (decibels / 10)))
                self.assertEqual(ping.gains[blank + row], word)
                for beam, value in enumerate(values):
                    # Full amplitude is at -40 dB: docs/reference/messages.md.
                    amplitude = min(1, math.sqrt(value * 1e4 * word / 50))
                    expected = full * amplitude ** (gamma / 255)
                    pixel = ping.image[blank + row][beam]
                    self.assertLess(abs(pixel - expected), 0.51 + 1e-6 * full)
                    different += 0 < pixel < full
            self.assertGreater(different, 5000, "most pixels are neither dark nor bright")

    def test_range_frequency_beams_and_sound_speed_act(self):
        sonar = self.sonar(scenario=SCENARIO.replace("name: fls, beam_count: 60, azimuth_aperture_deg: 120, bin_count: "
                                                     "400, min_range: 0.5, max_range: 12",
                                                     "name: fls, preset: blueprint-oculus-m750d"))
        client = sonar.client()
        low = client.ask(reach=6.0)
        # The preset's rows of 4 mm, at most 1000.
        self.assertEqual((low.rows, low.beams, low.frequency, low.mode), (1000, 512, 750e3, 1))
        self.assertEqual(client.ask(reach=2.0).rows, 500)
        self.assertEqual(client.ask(reach=2.0, flags=METRES | SIMPLE).beams, 256)
        # 5 percent of 120 m.
        percent = client.ask(reach=5.0, flags=SIMPLE)
        self.assertAlmostEqual(percent.rows * percent.resolution, 6)
        # The other mode of the preset: 40 m is its longest range. Gains are repeated as 40 to 100 percent.
        high = client.ask(mode=2, reach=70.0, gain=30.0, wanted={"reach": 40})
        self.assertEqual((high.rows, high.beams, high.frequency, high.reach, high.gain), (1000, 512, 1.2e6, 40, 58))
        self.assertGreater(high.bearings[0], -35)
        self.assertAlmostEqual(high.resolution, 0.04)
        # With another sound speed the target ahead, at 4.1 m, seems elsewhere.
        for speed in (0.0, 1600.0):
            ping = client.ask(reach=6.0, speed=speed)
            self.assertEqual(ping.speed, speed or 1500)
            row = max(range(300, ping.rows), key=lambda row: max(ping.image[row][250:262]))
            self.assertAlmostEqual(ping.distance(row), 4.1 * ping.speed / 1500, delta=0.02)
        # Saltier than the water: 35 for 20 PSU, by 1.2 m/s per PSU or so, is faster.
        self.assertAlmostEqual(client.ask(salinity=35.0).speed, 1500 + 15 * 1.2, delta=3)
        _, _, err, _ = sonar.end()
        self.assertEqual(err, "insonify: warning: range = 70 m is limited to 40 m, the longest in mode 2\n")

    def test_another_sonar_is_the_high_mode(self):
        client = self.sonar("--sonar", "fls", "--high", "fine").client()
        ping = client.ask(mode=2, reach=6.0)
        self.assertEqual((ping.beams, ping.rows, ping.frequency), (40, 300, 1.9e6))
        ping = client.ask(mode=1, reach=6.0)
        self.assertEqual((ping.beams, ping.rows, ping.frequency), (60, 400, 720e3))

    def test_without_a_high_mode_there_is_one(self):
        sonar = self.sonar()
        ping = sonar.client().ask(mode=2, reach=6.0)
        self.assertEqual((ping.mode, ping.frequency), (2, 720e3))
        self.assertEqual(sonar.end()[2],
                         "insonify: warning: fls has one mode, which is used for mode 2 (high frequency) too\n")

    def test_gain_gamma_and_gain_assist_act(self):
        client = self.sonar(*NOISE).client()

        def mean(**settings):
            image = client.ask(reach=8.0, flags=USUAL | BITS16, **settings).image
            return sum(sum(row[:20]) for row in image[100:]) / (300 * 20)  # To port, where there is no target.

        # 6 dB are a factor of 2 in amplitude.
        quiet, loud = mean(gain=0.0), mean(gain=30.0)
        self.assertAlmostEqual(loud / quiet, 2, delta=0.1)
        # Roots of values below 1 are larger.
        self.assertGreater(mean(gain=0.0, gamma=127), 3 * quiet)
        self.assertEqual(client.ask(reach=8.0, gamma=0).gamma, 0)
        # Assist brings 0.5 percent of the pixels above half: with little gain as with much noise.
        for gain, half in ((50.0, 127.5), (20.0, 127.5 * 10 ** -0.3)):
            assisted = client.ask(reach=8.0, gain=gain, flags=USUAL | ASSIST).image
            bright = sum(pixel > half for row in assisted for pixel in row)
            self.assertAlmostEqual(bright / (375 * 60), 0.005, delta=0.002)

    def test_pings_come_at_the_rate_asked_for(self):
        client = self.sonar().client()
        for rate, period in ((RATE_15, 1 / 15), (RATE_40, 1 / 40), (RATE_10, 1 / 10)):
            first = client.ask(reach=5.0, rate=rate, layout=2)
            last = first
            while last.number < first.number + 5:
                last = client.ping()
            # The schedule holds on average, whatever else the machine does.
            self.assertAlmostEqual((last.start - first.start) / (last.number - first.number), period, delta=0.4 * period)

    def test_the_scenarios_ping_period_is_a_limit(self):
        client = self.sonar("--set", "sonars.fls.ping_period=0.3").client()
        first = client.ask(reach=5.0, rate=RATE_40, layout=2)
        second = client.ping()
        self.assertAlmostEqual(second.start - first.start, 0.3, delta=0.05)

    def test_no_ping_is_lost_when_settings_change(self):
        client = self.sonar("--set", "sonars.fls.max_range=120").client()
        client.send(fire(reach=110.0, rate=RATE_40))  # 147 ms of listening ...
        numbers = [client.ping().number]
        client.send(fire(reach=2.0, rate=RATE_40))  # ... and then a ping each 25 ms.
        numbers += [client.ping().number for _ in range(8)]
        self.assertEqual(numbers, list(range(9)))


if __name__ == "__main__":
    unittest.main()
