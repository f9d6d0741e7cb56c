#!/usr/bin/python3
"""`insonify export` to XTF and JSF, read field by field at the places that the formats' documents state.

side_scan_files_test.py INSONIFY
"""

import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

INSONIFY = os.path.abspath(sys.argv.pop(1))

# A level floor 6.5 m below a fish that goes north-east at 2 m/s, 3 deg bow down, rolled by 4 deg to starboard (port up):
# compass heading 30 deg is a yaw of 60 deg. The second sonar has counts of 8 bits.
HEADING, PITCH, ROLL, SPEED, ALTITUDE, DEPTH = 30, -3, 4, 2, 6.5, 11
SOUND_SPEED = 1487.5
SCENARIO = """
water: {{sound_speed: {speed}}}
duration: 1.05
trajectory:
{track}
world: floor.sdf
receiver: {{noise: false}}
sonars:
  - name: low
    type: sss
    frequency: 430.0e3
    bin_count: 300
    min_range: 0.5
    max_range: 30.5
    azimuth_aperture_deg: 2
    azimuth_resolution_deg: 1.5
    elevation_aperture_deg: 60
    depression_deg: 35
    ping_period: 0.2
  - name: high
    type: sss
    frequency: 850.0e3
    bin_count: 100
    min_range: 0
    max_range: 10
    azimuth_aperture_deg: 1
    elevation_aperture_deg: 60
    depression_deg: 35
    ping_period: 0.25
    bits: 8
    receiver: {{counts: true, full_scale_db: -20}}
"""
FLOOR = f"""<sdf version="1.9"><world name="w"><model name="floor"><static>true</static>
<link name="l"><collision name="c"><geometry><box><size>200 200 1</size></box></geometry></collision>
<visual name="v"><geometry><box><size>200 200 1</size></box></geometry></visual></link>
<pose>0 0 {-DEPTH - ALTITUDE - 0.5} 0 0 0</pose></model></world></sdf>"""
# Of WGS84 at 48 degrees north, by hand: radii of curvature M = a (1 - e2) / w^3, N = a / w, w = sqrt(1 - e2 sin2).
ORIGIN = (48.0, -68.5)
E2 = 0.00669437999014
W = math.sqrt(1 - E2 * math.sin(math.radians(ORIGIN[0])) ** 2)
METRES_NORTH = math.radians(6378137 * (1 - E2) / W ** 3)  # A degree of latitude.
METRES_EAST = math.radians(6378137 / W * math.cos(math.radians(ORIGIN[0])))
KNOT = 1852 / 3600


def insonify(*arguments):
    return subprocess.run([INSONIFY, *arguments], check=False, capture_output=True, text=True)


def track():
    """Waypoints over 2 s."""
    lines = []
    for time in (0, 2):
        east, north = place_of(time)
        lines.append(f"  - {{time: {time}, position: [{east!r}, {north!r}, {-DEPTH}], "
                     f"orientation_deg: [{ROLL}, {-PITCH}, {90 - HEADING}]}}")
    return "\n".join(lines)


def table(path, name):
    """A table of an .npz as numbers in a flat list, and its shape."""
    with zipfile.ZipFile(path) as archive:
        data = archive.read(name + ".npy")
    length = struct.unpack_from("<H", data, 8)[0]
    header = eval(data[10:10 + length].decode(), {})  # pylint: disable=eval-used
    code = {"<f4": "f", "<f8": "d", "<u2": "H", "|u1": "B"}[header["descr"]]
    count = math.prod(header["shape"])
    return list(struct.unpack_from(f"<{count}{code}", data, 10 + length)), header["shape"]


def place_of(time):
    return (10 + SPEED * time * math.sin(math.radians(HEADING)), -20 + SPEED * time * math.cos(math.radians(HEADING)))


def xtf_packets(data):
    at = 1024
    while at < len(data):
        size = struct.unpack_from("<I", data, at + 10)[0]
        yield data[at:at + size]
        at += size


def jsf_messages(data):
    at = 0
    while at < len(data):
        sync, version, session, kind, command, subsystem, channel, sequence, reserved, size = struct.unpack_from(
            "<HBBHBBBBHi", data, at)
        assert (sync, session, kind, command, sequence, reserved) == (0x1601, 0, 80, 0, 0, 0), at
        assert version == 13
        yield subsystem, channel, data[at + 16:at + 16 + size]
        at += 16 + size


class SideScanFilesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # pylint: disable=consider-using-with
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        for name, text in (("line.yaml", SCENARIO.format(track=track(), speed=SOUND_SPEED)), ("floor.sdf", FLOOR)):
            with open(name, "w", encoding="ascii") as file:
                file.write(text)
        run = insonify("run", "line.yaml", "-o", "out", "--no-pictures", "--quiet")
        assert run.returncode == 0, run.stderr
        for sonar in ("low", "high"):
            cls.export(f"out/{sonar}.h5", "-o", f"{sonar}.npz")

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    @staticmethod
    def export(*arguments):
        done = insonify("export", *arguments)
        assert done.returncode == 0, done.stderr

    @staticmethod
    def read(path):
        with open(path, "rb") as file:
            return file.read()

    def near(self, found, wanted, slack=1e-6):
        self.assertLessEqual(abs(found - wanted), slack, f"{found} is not {wanted}")

    def test_xtf_header(self):
        self.export("out/low.h5", "out/high.h5", "-o", "both.xtf")
        data = self.read("both.xtf")
        self.assertEqual(data[:10], b"{\x01insonify")
        self.assertEqual(data[18:34].rstrip(b"\0"), b"low")
        self.assertEqual(data[100:164].rstrip(b"\0"), b"both.xtf")
        self.assertEqual(struct.unpack_from("<5H", data, 164), (0, 4, 0, 0, 0))  # Metres, four channels.
        for channel, (kind, name, frequency, width, samples) in enumerate((
                (1, b"PORT", 430, 1.5, 305), (2, b"STARBOARD", 430, 1.5, 305),
                (1, b"PORT", 850, 1, 100), (2, b"STARBOARD", 850, 1, 100))):
            at = 256 + 128 * channel
            self.assertEqual(struct.unpack_from("<BBHHHI", data, at), (kind, channel, 1, 1, 2, samples))
            self.assertEqual(data[at + 12:at + 28].rstrip(b"\0"), name)
            for found, wanted in zip(struct.unpack_from("<4f", data, at + 32), (frequency, width, 35, 60)):
                self.near(found, wanted, 1e-4)
            self.assertEqual(data[at + 74], 3)  # Two-byte integers.
        packets = list(xtf_packets(data))
        self.assertEqual(sum(map(len, packets)) + 1024, len(data))
        # Pings at 0, 0.2 ... 1 and at 0, 0.25 ... 1, in the order of their times.
        self.assertEqual([struct.unpack_from("<H", packet, 256)[0] for packet in packets],
                         [0, 2, 0, 2, 0, 2, 0, 2, 0, 0, 2])

    def test_xtf_pings(self):
        self.export("out/low.h5", "-o", "low.xtf", "--start", "2024-02-29T23:59:59.5Z")
        intensity, (pings, bins, beams) = table("low.npz", "intensity")
        self.assertEqual((pings, bins, beams), (6, 300, 2))
        packets = list(xtf_packets(self.read("low.xtf")))
        self.assertEqual(len(packets), pings)
        weight = struct.unpack_from("<h", packets[0], 256 + 58)[0]
        loudest = math.sqrt(max(intensity)) * 2 ** weight
        self.assertTrue(16383 < loudest <= 32767, loudest)
        for ping, packet in enumerate(packets):
            self.assertEqual(struct.unpack_from("<HBBH", packet), (0xface, 0, 0, 2))
            # 256 + 2 * (64 + 305 * 2) = 1604 bytes, filled up to 26 * 64.
            self.assertEqual((len(packet), struct.unpack_from("<I", packet, 10)[0]), (1664, 1664))
            time = 0.2 * ping
            second = (59.5 + time) % 60
            midnight = ping >= 3
            date = (2024, 3, 1, 0, 0) if midnight else (2024, 2, 29, 23, 59)
            self.assertEqual(struct.unpack_from("<H6BH", packet, 14),
                             (*date, int(second + 1e-6), round(100 * (second % 1)) % 100, 61 if midnight else 60))
            self.assertEqual(packet[18:22], packet[148:152])
            self.assertEqual(struct.unpack_from("<II", packet, 24), (0, ping))
            east, north = place_of(time)
            for at, code, wanted, slack in ((32, "f", SOUND_SPEED / 2, 1e-3), (72, "f", SOUND_SPEED, 1e-3),
                                            (120, "f", SPEED / KNOT, 1e-4), (124, "f", HEADING, 1e-4),
                                            (128, "d", north, 1e-6), (136, "d", east, 1e-6),
                                            (152, "f", SPEED / KNOT, 1e-4), (160, "d", north, 1e-6),
                                            (168, "d", east, 1e-6), (184, "f", 0, 0), (192, "f", DEPTH, 1e-5),
                                            (196, "f", ALTITUDE, 0.11), (204, "f", PITCH, 1e-4),
                                            (208, "f", ROLL, 1e-4), (212, "f", HEADING, 1e-4)):
                self.near(struct.unpack_from("<" + code, packet, at)[0], wanted, slack)
            altitude = struct.unpack_from("<f", packet, 196)[0]
            for side in (0, 1):
                at = 256 + side * (64 + 2 * 305)
                channel, _, slant, ground, delay, duration, period = struct.unpack_from("<HH5f", packet, at)
                self.assertEqual((channel, delay), (side, 0))
                self.near(slant, 30.5, 1e-5)
                self.near(ground, math.sqrt(30.5 ** 2 - altitude ** 2), 1e-3)
                self.near(duration, 30.5 / (SOUND_SPEED / 2), 1e-6)
                self.near(period, 0.2, 1e-6)
                self.assertEqual(struct.unpack_from("<H", packet, at + 26)[0], 430)
                self.assertEqual(struct.unpack_from("<I", packet, at + 42)[0], 305)
                self.assertEqual(struct.unpack_from("<h", packet, at + 58)[0], weight)
                samples = struct.unpack_from("<305H", packet, at + 64)
                outwards = samples[::-1] if side == 0 else samples
                self.assertEqual(outwards[:5], (0,) * 5)  # Before min_range.
                row = intensity[ping * 600 + side:(ping + 1) * 600:2]
                for sample, value in zip(outwards[5:], row):
                    self.near(sample, math.sqrt(value) * 2 ** weight, 0.51)

    def test_counts_are_stored_as_they_are(self):
        self.export("out/high.h5", "-o", "high.xtf")
        counts, shape = table("high.npz", "counts")
        self.assertEqual(shape, (5, 100, 2))
        data = self.read("high.xtf")
        self.assertEqual((struct.unpack_from("<H", data, 256 + 6)[0], data[256 + 74]), (1, 8))
        for ping, packet in enumerate(xtf_packets(data)):
            port, starboard = packet[256 + 64:][:100], packet[256 + 64 + 100 + 64:][:100]
            row = counts[200 * ping:200 * (ping + 1)]
            self.assertEqual((list(port[::-1]), list(starboard)), (row[::2], row[1::2]))
        self.assertGreater(max(counts), 0)

    def test_positions_are_degrees_with_an_origin(self):
        self.export("out/low.h5", "-o", "geographic.xtf", f"--origin={ORIGIN[0]},{ORIGIN[1]}")
        self.export("out/low.h5", "-o", "geographic.jsf", f"--origin={ORIGIN[0]},{ORIGIN[1]}")
        data = self.read("geographic.xtf")
        self.assertEqual(struct.unpack_from("<H", data, 164)[0], 3)
        messages = list(jsf_messages(self.read("geographic.jsf")))
        for ping, packet in enumerate(xtf_packets(data)):
            east, north = place_of(0.2 * ping)
            latitude, longitude = struct.unpack_from("<2d", packet, 160)
            # The radii are those at the origin: 20 m from it they are as good as 1e-5 of the way.
            self.near((latitude - ORIGIN[0]) * METRES_NORTH, north, 1e-3)
            self.near((longitude - ORIGIN[1]) * METRES_EAST, east, 1e-3)
            _, _, trace = messages[2 * ping]
            x, y, units = struct.unpack_from("<iih", trace, 80)
            self.assertEqual(units, 2)
            self.near(x, longitude * 600000, 0.5001)
            self.near(y, latitude * 600000, 0.5001)

    def test_jsf_messages(self):
        self.export("out/low.h5", "out/high.h5", "-o", "both.jsf", "--start", "2024-02-29T23:59:59.5Z")
        intensity, _ = table("low.npz", "intensity")
        messages = list(jsf_messages(self.read("both.jsf")))
        self.assertEqual([message[:2] for message in messages[:6]], [(20, 0), (20, 1), (21, 0), (21, 1), (20, 0), (20, 1)])
        low = [message for message in messages if message[0] == 20]
        self.assertEqual((len(low), len(messages)), (12, 22))
        for number, (_, side, trace) in enumerate(low):
            ping = number // 2
            self.assertEqual(side, number % 2)
            time = 1709251199.5 + 0.2 * ping  # date --date=2024-02-29T23:59:59.5Z +%s
            seconds = int(time + 1e-4)
            clock = (2024, 61, 0, 0) if ping >= 3 else (2024, 60, 23, 59)
            self.assertEqual(struct.unpack_from("<III", trace), (seconds, 0, ping))
            self.assertEqual(struct.unpack_from("<5h", trace, 156), (*clock, seconds % 60))
            self.assertEqual(struct.unpack_from("<3h", trace, 186), (*clock[2:], seconds % 60))
            self.assertEqual(struct.unpack_from("<2h", trace, 196), (clock[1], clock[0]))
            self.assertEqual(struct.unpack_from("<I", trace, 200)[0], round(1000 * time) % 86400000)
            self.assertEqual(struct.unpack_from("<h", trace, 166)[0], 3)
            east, north = place_of(0.2 * ping)
            self.assertEqual(struct.unpack_from("<iih", trace, 80), (round(1000 * east), round(1000 * north), 1))
            # Position, course, speed, heading, pitch and roll, altitude, depth and sound speed are valid.
            self.assertEqual(struct.unpack_from("<hHHh", trace, 28), (1, 0b100001001101111, 0, 0))
            # 430 kHz is 43000 daHz; a sample lasts 2 * 0.1 m / 1487.5 m/s = 134454 ns, as the pulse: 134 us.
            self.assertEqual(struct.unpack_from("<HI", trace, 114), (305, 134454))
            self.assertEqual(struct.unpack_from("<3H", trace, 126), (43000, 43000, 0))
            self.assertEqual(struct.unpack_from("<H", trace, 140)[0], 7438)  # 1 / 134.454 us
            self.assertEqual(struct.unpack_from("<i", trace, 136)[0], 1000 * DEPTH)
            self.near(struct.unpack_from("<i", trace, 144)[0], 1000 * ALTITUDE, 110)
            self.near(struct.unpack_from("<f", trace, 148)[0], SOUND_SPEED, 1e-3)
            heading, pitch, roll = struct.unpack_from("<Hhh", trace, 172)
            self.assertEqual(heading, 100 * HEADING)
            self.near(pitch, PITCH / 180 * 32768, 0.51)
            self.near(roll, ROLL / 180 * 32768, 0.51)
            # 2 m/s are 3.8877 knots: 38 tenths and 9 hundredths.
            course, speed = struct.unpack_from("<hh", trace, 192)
            bits, fraction, more = struct.unpack_from("<BBH", trace, 18)
            self.assertEqual((course, fraction, speed, bits, more), (HEADING, 0, 38, 0, 9 | 134 << 4))
            self.assertEqual(struct.unpack_from("<HH", trace, 16)[0], 0)
            self.assertEqual(struct.unpack_from("<H", trace, 220)[0], 1)
            weight = struct.unpack_from("<h", trace, 168)[0]
            samples = struct.unpack_from("<305H", trace, 240)
            self.assertEqual((len(trace), max(samples)), (240 + 610, struct.unpack_from("<H", trace, 204)[0]))
            for sample, value in zip(samples[5:], intensity[ping * 600 + side:(ping + 1) * 600:2]):
                self.near(sample * 2.0 ** -weight, math.sqrt(value), 0.51 * 2.0 ** -weight)

    def test_what_cannot_be_is_told(self):
        with open("fls.yaml", "w", encoding="ascii") as file:
            file.write("world: floor.sdf\npings: 1\nsonars: [{name: fls, bin_count: 10, beam_count: 8}]\n")
        self.assertEqual(insonify("run", "fls.yaml", "-o", "fan", "--no-pictures", "--quiet").returncode, 0)
        for arguments, message in (
                (("fan/fls.h5", "-o", "a.xtf"),
                 "fan/fls.h5: its sonar fls is not a side-scan sonar; .xtf holds these alone"),
                (("out/low.h5", "-o", "a.jsf", "--origin", "95,10"),
                 "origin.latitude = 95 deg must be from -89 to 89 deg"),
                (("out/low.h5", "-o", "a.xtf", "--origin", "48"),
                 "--origin: 48 must be a latitude and a longitude in degrees, such as 48.45,-68.83 (insonify export --help)"),
                (("out/low.h5", "-o", "a.npz", "--origin", "48,10"),
                 "--origin has no effect on .npz, only on .xtf, .jsf, .xyz, .gsf, .kmall")):
            done = insonify("export", *arguments)
            self.assertEqual((done.returncode, done.stderr), (2, f"insonify: {message}\n"))

    def test_the_files_are_read_again(self):
        self.export("out/low.h5", "-o", "again.xtf")
        told = insonify("info", "again.xtf")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("6 pings from 0 to 1 s", told.stdout)


if __name__ == "__main__":
    unittest.main()
