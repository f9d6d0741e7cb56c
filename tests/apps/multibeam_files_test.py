#!/usr/bin/python3
"""`insonify export` of multibeams to XYZ, GSF and KMALL, read field by field at the places that the formats' documents
state: GSF specification 03.06, Kongsberg's EMdgmFormat revision F.

multibeam_files_test.py INSONIFY
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

# A level floor 9 m below a sonar 4 m deep that goes at 2 m/s with heading 30 deg, 3 deg bow down, rolled by 4 deg to
# starboard (port up). Its outer beams reach beyond the range. It assumes 1500 m/s, so that its ranges, and with them its
# soundings, are farther away by 1500 / 1487.5.
HEADING, PITCH, ROLL, SPEED, ALTITUDE, DEPTH = 30, -3, 4, 2, 9, 4
ASSUMED, TRUE = 1500.0, 1487.5
START = 1709251199.5  # date --date=2024-02-29T23:59:59.5Z +%s
PERIOD, BEAMS, BINS, RANGE, LEVEL = 0.4, 36, 400, 16, 211
SCENARIO = """
water: {{sound_speed: {speed}}}
duration: 1
trajectory:
{track}
world: floor.sdf
receiver: {{noise: false, time_varied_gain: 30}}
sonars:
  - name: swath
    type: mbes
    model: Swath 9
    frequency: 310.0e3
    source_level_db: {level}
    beam_count: {beams}
    bin_count: {bins}
    min_range: 0
    max_range: {most}
    azimuth_aperture_deg: 144
    azimuth_resolution_deg: 3
    elevation_aperture_deg: 3
    assumed_sound_speed: {assumed}
    ping_period: {period}
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
CAST = ((0, 1500), (5, 1480), (20, 1430))


def insonify(*arguments, **options):
    return subprocess.run([INSONIFY, *arguments], check=False, capture_output=True, text=True, **options)


def place_of(time):
    return (10 + SPEED * time * math.sin(math.radians(HEADING)), -20 + SPEED * time * math.cos(math.radians(HEADING)))


def scenario(most=RANGE):
    lines = []
    for time in (0, 2):
        east, north = place_of(time)
        lines.append(f"  - {{time: {time}, position: [{east!r}, {north!r}, {-DEPTH}], "
                     f"orientation_deg: [{ROLL}, {-PITCH}, {90 - HEADING}]}}")
    return SCENARIO.format(track="\n".join(lines), speed=TRUE, assumed=ASSUMED, most=most, beams=BEAMS, bins=BINS,
                           period=PERIOD, level=LEVEL)


def direction(azimuth):
    """Of a beam: ahead, to starboard and down, level. In the vehicle it is (0, sin, -cos), y to port, z up."""
    roll, pitch = math.radians(ROLL), math.radians(-PITCH)  # SDF's pitch is positive bow down.
    y, z = math.sin(azimuth), -math.cos(azimuth)
    y, z = y * math.cos(roll) - z * math.sin(roll), y * math.sin(roll) + z * math.cos(roll)
    x, z = z * math.sin(pitch), z * math.cos(pitch)
    return x, -y, -z


def ray(angle, time, steps=4000):
    """Horizontal distance and depth from the sonar, after a launch angle below horizontal and a time, through CAST,
    whose depth 0 is that of the sonar: by the midpoint rule."""
    speeds = [speed for _, speed in CAST]
    depths = [depth for depth, _ in CAST]

    def speed_at(depth):
        if depth <= depths[0]:
            return speeds[0]
        for i in range(1, len(depths)):
            if depth < depths[i]:
                return speeds[i - 1] + (depth - depths[i - 1]) * (speeds[i] - speeds[i - 1]) / (depths[i] - depths[i - 1])
        return speeds[-1]

    snell = math.cos(angle) / speed_at(0)
    distance, depth, step = 0, 0, time / steps
    for _ in range(steps):
        speed = speed_at(depth)
        middle = speed_at(depth + 0.5 * step * speed * math.sqrt(1 - (snell * speed) ** 2))
        distance += step * middle * snell * middle
        depth += step * middle * math.sqrt(1 - (snell * middle) ** 2)
    return distance, depth


def tables(path):
    """Tables of an .npz as numbers in flat lists."""
    found = {}
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            data = archive.read(name)
            length = struct.unpack_from("<H", data, 8)[0]
            header = eval(data[10:10 + length].decode(), {})  # pylint: disable=eval-used
            code = {"<f4": "f", "<f8": "d", "<u2": "H", "|u1": "B", "<i4": "i"}.get(header["descr"])
            if code:
                found[name[:-4]] = struct.unpack_from(f"<{math.prod(header['shape'])}{code}", data, 10 + length)
    return found


def gsf_records(data):
    at = 0
    while at < len(data):
        size, kind = struct.unpack_from(">II", data, at)
        assert size % 4 == 0, at
        yield kind, data[at + 8:at + 8 + size]
        at += 8 + size


def gsf_subrecords(ping):
    at, found = 56, {}
    while at + 4 <= len(ping):
        head = struct.unpack_from(">I", ping, at)[0]
        kind, size = head >> 24, head & 0xffffff
        if kind == 0:
            break  # Filled up.
        found[kind] = ping[at + 4:at + 4 + size]
        at += 4 + size
    return found


def kmall_datagrams(data):
    at = 0
    while at < len(data):
        size, kind, version, system, sounder, seconds, nanoseconds = struct.unpack_from("<I4sBBHII", data, at)
        assert size % 4 == 0 and struct.unpack_from("<I", data, at + size - 4)[0] == size, at
        assert (system, sounder) == (0, 2040)
        yield kind, version, seconds + 1e-9 * nanoseconds, data[at + 20:at + size - 4]
        at += size


class MultibeamFilesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # pylint: disable=consider-using-with
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        for name, text in (("line.yaml", scenario()), ("blind.yaml", scenario(5)), ("floor.sdf", FLOOR)):
            with open(name, "w", encoding="ascii") as file:
                file.write(text)
        for name in ("line", "blind"):
            run = insonify("run", f"{name}.yaml", "-o", name, "--no-pictures", "--quiet")
            assert run.returncode == 0, run.stderr
        cls.export("line/swath.h5", "-o", "line.npz")
        cls.tables = tables("line.npz")
        cls.pings = len(cls.tables["time"])
        assert cls.pings == 3

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    @staticmethod
    def export(*arguments):
        done = insonify("export", *arguments)
        assert done.returncode == 0, done.stderr

    def origin_export(self, name, *arguments):
        self.export("line/swath.h5", "-o", name, f"--origin={ORIGIN[0]},{ORIGIN[1]}", "--start",
                    "2024-02-29T23:59:59.5Z", *arguments)
        with open(name, "rb") as file:
            return file.read()

    def near(self, found, wanted, slack=1e-6):
        self.assertLessEqual(abs(found - wanted), slack, f"{found} is not {wanted}")

    def beams(self, ping):
        """(azimuth, sounding's members by name) of each beam."""
        for beam in range(BEAMS):
            at = ping * BEAMS + beam
            yield self.tables["azimuth"][beam], {name[9:]: values[at] for name, values in self.tables.items()
                                                 if name.startswith("sounding_")}

    def test_soundings_lie_on_the_floor(self):
        found = 0
        for ping in range(self.pings):
            for azimuth, sounding in self.beams(ping):
                ahead, starboard, down = direction(azimuth)
                range_there = ALTITUDE / down * ASSUMED / TRUE if down > 0 else math.inf
                self.assertEqual(sounding["detection"] > 0, not math.isnan(sounding["range"]))
                if 0.55 * range_there > RANGE:
                    self.assertEqual(sounding["detection"], 0)
                elif range_there < 0.9 * RANGE:
                    self.near(sounding["range"], range_there, 0.02 * range_there)
                    found += 1
        self.assertGreater(found, 40)

    def test_xyz(self):
        self.export("line/swath.h5", "-o", "line.xyz")
        with open("line.xyz", encoding="ascii") as file:
            lines = [list(map(float, line.split())) for line in file]
        expected = []
        for ping in range(self.pings):
            east, north = place_of(PERIOD * ping)
            turn = math.radians(HEADING)
            for azimuth, sounding in self.beams(ping):
                if sounding["detection"]:
                    ahead, starboard, down = (sounding["range"] * part for part in direction(azimuth))
                    expected.append((east + ahead * math.sin(turn) + starboard * math.cos(turn),
                                     north + ahead * math.cos(turn) - starboard * math.sin(turn), -DEPTH - down,
                                     sounding["uncertainty"] * direction(azimuth)[2]))
        self.assertEqual(len(lines), len(expected))
        for line, wanted in zip(lines, expected):
            self.assertEqual(len(line), 3)
            for part in range(3):
                self.near(line[part], wanted[part], 1e-4)
        self.export("line/swath.h5", "-o", "degrees.xyz", f"--origin={ORIGIN[0]},{ORIGIN[1]}", "--uncertainty")
        with open("degrees.xyz", encoding="ascii") as file:
            for line, wanted in zip(file, expected):
                longitude, latitude, depth, deviation = map(float, line.split())
                self.near((latitude - ORIGIN[0]) * METRES_NORTH, wanted[1], 1e-3)
                self.near((longitude - ORIGIN[1]) * METRES_EAST, wanted[0], 1e-3)
                self.near(depth, -wanted[2], 1e-4)
                self.near(deviation, wanted[3], 1e-4)

    def test_a_profile_bends_the_rays(self):
        with open("cast.csv", "w", encoding="ascii") as file:
            file.write("depth,speed\n" + "".join(f"{depth},{speed}\n" for depth, speed in CAST))
        self.export("line/swath.h5", "-o", "bent.xyz", "--profile", "cast.csv")
        with open("bent.xyz", encoding="ascii") as file:
            lines = iter([list(map(float, line.split())) for line in file])
        turn, bent = math.radians(HEADING), 0
        for ping in range(self.pings):
            east, north = place_of(PERIOD * ping)
            for azimuth, sounding in self.beams(ping):
                if sounding["detection"]:
                    ahead, starboard, down = direction(azimuth)
                    across = math.hypot(ahead, starboard)
                    distance, depth = ray(math.asin(down), sounding["range"] / ASSUMED)
                    ahead, starboard = (distance * part / across for part in (ahead, starboard))
                    line = next(lines)
                    self.near(line[0], east + ahead * math.sin(turn) + starboard * math.cos(turn), 2e-3)
                    self.near(line[1], north + ahead * math.cos(turn) - starboard * math.sin(turn), 2e-3)
                    self.near(line[2], -DEPTH - depth, 2e-3)
                    bent = max(bent, abs(depth - sounding["range"] * down))
        self.assertIsNone(next(lines, None))
        self.assertGreater(bent, 0.1)
        records = list(gsf_records(self.origin_export("bent.gsf", "--profile", "cast.csv")))
        points = [value for depth, speed in CAST for value in (100 * depth, 100 * speed)]
        self.assertEqual(struct.unpack(">7I", records[3][1][24:]), (len(CAST), *points))
        datagrams = list(kmall_datagrams(self.origin_export("bent.kmall", "--profile", "cast.csv")))
        self.assertEqual(struct.unpack_from("<HH", datagrams[1][3]), (28, len(CAST)))
        for i, point in enumerate(CAST):
            self.assertEqual(struct.unpack_from("<ff", datagrams[1][3], 28 + 20 * i), point)

    def test_gsf_records(self):
        records = list(gsf_records(self.origin_export("line.gsf")))
        self.assertEqual([kind for kind, _ in records], [1, 9, 4, 3, 2, 2, 2])
        self.assertEqual(records[0][1], b"GSF-v03.06\0\0")
        summary = struct.unpack(">IIII6i", records[1][1])
        self.assertEqual(summary[:4], (int(START), 500000000, int(START + 0.8), 300000000))
        deepest = max(DEPTH + sounding["range"] * direction(azimuth)[2] for ping in range(self.pings)
                      for azimuth, sounding in self.beams(ping) if sounding["detection"])
        self.near(summary[9] / 100, deepest, 0.00501)
        self.assertLess(summary[4], summary[6])
        seconds, nanoseconds, count = struct.unpack_from(">IIh", records[2][1])
        at, texts = 10, []
        for _ in range(count):
            size = struct.unpack_from(">h", records[2][1], at)[0]
            texts.append(records[2][1][at + 2:at + 2 + size])
            at += 2 + size
        self.assertEqual((seconds, nanoseconds), (int(START), 500000000))
        self.assertEqual(texts[0], b"REFERENCE TIME=1970/001 00:00:00\0")
        self.assertIn(b"DEPTH_CALCULATION=CORRECTED\0", texts)
        self.assertLess(len(records[2][1]) - at, 4)
        profile = struct.unpack(">IIIIiiIIIII", records[3][1])
        self.assertEqual(profile[6:], (2, 0, 150000, 1200000, 150000))

    def test_gsf_pings(self):
        pings = [record for kind, record in gsf_records(self.origin_export("pings.gsf")) if kind == 2]
        scales = {}
        for number, ping in enumerate(pings):
            (seconds, nanoseconds, longitude, latitude, beams, centre, flags, reserved, tide, corrector, heading, pitch,
             roll, heave, course, speed, height, separation, gps, spare) = struct.unpack_from(">IIiiHHHHhiHhhhHHiiih", ping)
            time = START + PERIOD * number
            self.near(seconds + 1e-9 * nanoseconds, time, 1e-6)
            east, north = place_of(PERIOD * number)
            self.near((latitude * 1e-7 - ORIGIN[0]) * METRES_NORTH, north, 0.01)
            self.near((longitude * 1e-7 - ORIGIN[1]) * METRES_EAST, east, 0.01)
            self.assertEqual((beams, flags, reserved, tide, corrector, heave), (BEAMS, 0, 0, 0, 100 * DEPTH, 0))
            self.assertEqual((heading, pitch, roll, course), (100 * HEADING, 100 * PITCH, 100 * ROLL, 100 * HEADING))
            self.near(speed, 100 * SPEED / KNOT, 0.51)
            self.assertEqual((height, separation, gps, spare), (0, 0, 0, 0))
            found = gsf_subrecords(ping)
            self.assertEqual(100 in found, number == 0)
            if number == 0:
                factors = struct.unpack_from(">I", found[100])[0]
                self.assertEqual(len(found[100]), 4 + 12 * factors)
                for i in range(factors):
                    kind, flag, _, multiplier, offset = struct.unpack_from(">BBHii", found[100], 4 + 12 * i)
                    scales[kind] = (flag, multiplier, offset)
            self.assertEqual(set(found) - {16, 100}, set(scales))
            self.check_gsf_beams(number, found, scales, centre)

    def check_gsf_beams(self, number, found, scales, centre):
        codes = {1: "I", 2: "i", 3: "i", 4: "I", 5: "h", 6: "h", 9: "B", 18: "H", 19: "H", 20: "H", 23: "B"}
        sizes = {"I": 0x40, "i": 0x40}
        values = {}
        for kind, (flag, multiplier, offset) in scales.items():
            self.assertEqual(flag, 0x20 if kind == 6 else sizes.get(codes[kind], 0), kind)
            stored = struct.unpack(f">{BEAMS}{codes[kind]}", found[kind])
            values[kind] = [value / multiplier - offset for value in stored]
        angles = []
        for beam, (azimuth, sounding) in enumerate(self.beams(number)):
            ahead, starboard, down = direction(azimuth)
            angles.append(math.degrees(math.acos(down)))
            self.near(values[5][beam], angles[-1], 0.0051)
            self.near((values[18][beam] - math.degrees(math.atan2(ahead, starboard)) + 180) % 360, 180, 0.0051)
            self.assertEqual(found[16][beam], 0 if sounding["detection"] else 1)
            self.assertEqual(values[23][beam], sounding["detection"])
            if not sounding["detection"]:
                self.assertEqual([values[kind][beam] for kind in (1, 2, 3, 4, 6, 9, 19, 20)], [0] * 8)
                continue
            reach = sounding["range"]
            for kind, wanted, slack in (
                    (1, DEPTH + reach * down, 1e-3), (2, reach * starboard, 1e-3), (3, reach * ahead, 1e-3),
                    (4, 2 * reach / ASSUMED, 1e-7), (9, sounding["quality"], 0.051),
                    (19, 1.96 * sounding["uncertainty"] * down, 1.1e-3),
                    (20, 1.96 * sounding["uncertainty"] * math.sqrt(1 - down ** 2), 1.1e-3)):
                self.near(values[kind][beam], wanted, slack)
            # The gain of 30 dB a decade, with some absorption, is taken away again.
            level = LEVEL + 10 * math.log10(sounding["intensity"]) - 30 * math.log10(reach)
            self.assertLess(level - 4, values[6][beam])
            self.assertLess(values[6][beam], level)
        self.assertLess(angles[centre - 1] - min(angles), 0.01)  # Two beams are equally near to the vertical.

    def test_a_gsf_ping_without_bottom_is_to_be_ignored(self):
        self.export("blind/swath.h5", "-o", "blind.gsf", "--origin=0,0")
        with open("blind.gsf", "rb") as file:
            pings = [record for kind, record in gsf_records(file.read()) if kind == 2]
        self.assertEqual(len(pings), 3)
        for ping in pings:
            self.assertEqual(struct.unpack_from(">H", ping, 20)[0], 1)
            self.assertEqual(gsf_subrecords(ping)[16], bytes([1] * BEAMS))

    def test_kmall_datagrams(self):
        datagrams = list(kmall_datagrams(self.origin_export("line.kmall")))
        self.assertEqual([kind for kind, *_ in datagrams], [b"#IIP", b"#SVP"] + 3 * [b"#SPO", b"#SKM", b"#MRZ"])
        size, info, status = struct.unpack_from("<HHH", datagrams[0][3])
        text = datagrams[0][3][6:size].decode()
        self.assertEqual((info, status), (0, 0))
        self.assertIn("TRAI_TX1:N=0;X=0.000;", text)
        size, points, form, _, latitude, longitude = struct.unpack_from("<HH4sIdd", datagrams[1][3])
        self.assertEqual((size, points, form), (28, 2, b"S00\0"))
        self.assertEqual(struct.unpack_from("<ffIff", datagrams[1][3], 28), (0, ASSUMED, 0, 0, 0))
        for ping in range(self.pings):
            east, north = place_of(PERIOD * ping)
            position, attitude = datagrams[2 + 3 * ping][3], datagrams[3 + 3 * ping][3]
            self.assertEqual(struct.unpack_from("<4H", position), (8, 0, 1, 0))
            seconds, nanoseconds, _, latitude, longitude, speed, course, height = struct.unpack_from("<IIfddfff", position, 8)
            self.near(seconds + 1e-9 * nanoseconds, START + PERIOD * ping, 1e-6)
            self.near((latitude - ORIGIN[0]) * METRES_NORTH, north, 1e-3)
            self.near((longitude - ORIGIN[1]) * METRES_EAST, east, 1e-3)
            for value, wanted in ((speed, SPEED), (course, HEADING), (height, -DEPTH)):
                self.near(value, wanted, 1e-4)
            self.assertEqual(struct.unpack_from("<HBBHHHH", attitude), (12, 0, 1, 1, 1, 132, 15))
            self.assertEqual(len(attitude), 12 + 132)
            self.assertEqual(struct.unpack_from("<4sHH", attitude, 12), (b"#KMB", 120, 1))
            roll, pitch, heading, heave = struct.unpack_from("<4f", attitude, 12 + 40)
            for value, wanted in ((roll, ROLL), (pitch, PITCH), (heading, HEADING), (heave, 0)):
                self.near(value, wanted, 1e-4)
            velocities = struct.unpack_from("<3f", attitude, 12 + 68)
            for value, wanted in zip(velocities, (SPEED * math.cos(math.radians(HEADING)),
                                                  SPEED * math.sin(math.radians(HEADING)), 0)):
                self.near(value, wanted, 1e-4)

    def test_kmall_soundings(self):
        datagrams = [datagram for kind, *_, datagram in kmall_datagrams(self.origin_export("soundings.kmall"))
                     if kind == b"#MRZ"]
        for ping, datagram in enumerate(datagrams):
            self.assertEqual(struct.unpack_from("<4H8B", datagram), (1, 1, 12, ping, 1, 0, 1, 0, 0, 0, 1, 0))
            info = 4 + 12
            self.assertEqual(struct.unpack_from("<H", datagram, info)[0], 144)
            self.near(struct.unpack_from("<f", datagram, info + 4)[0], 1 / PERIOD, 1e-5)
            self.assertEqual(datagram[info + 8], 1)
            for value in struct.unpack_from("<3f", datagram, info + 16):
                self.near(value, 310e3, 0.1)
            self.assertEqual(struct.unpack_from("<HH", datagram, info + 92), (1, 36))
            for value, wanted in zip(struct.unpack_from("<4f", datagram, info + 96), (HEADING, ASSUMED, DEPTH, -DEPTH)):
                self.near(value, wanted, 1e-4)
            east, north = place_of(PERIOD * ping)
            latitude, longitude, height = struct.unpack_from("<ddf", datagram, info + 124)
            self.near((latitude - ORIGIN[0]) * METRES_NORTH, north, 1e-3)
            self.near((longitude - ORIGIN[1]) * METRES_EAST, east, 1e-3)
            self.near(height, -DEPTH, 1e-5)
            sector = info + 144
            self.near(struct.unpack_from("<f", datagram, sector + 12)[0], LEVEL, 1e-4)
            self.near(struct.unpack_from("<f", datagram, sector + 20)[0], 310e3, 0.1)
            receiver = sector + 36
            valid = sum(sounding["detection"] > 0 for _, sounding in self.beams(ping))
            self.assertEqual(struct.unpack_from("<4H", datagram, receiver), (32, BEAMS, valid, 120))
            self.near(struct.unpack_from("<f", datagram, receiver + 8)[0], ASSUMED / 2 / (RANGE / BINS), 0.1)
            self.assertEqual(len(datagram), receiver + 32 + 120 * BEAMS)
            for beam, (azimuth, sounding) in enumerate(self.beams(ping)):
                self.check_kmall_sounding(datagram[receiver + 32 + 120 * beam:][:120], beam, azimuth, sounding)

    def check_kmall_sounding(self, data, beam, azimuth, sounding):
        index, sector, kind, method = struct.unpack_from("<HBBB", data)
        self.assertEqual((index, sector, kind, method),
                         (beam, 0, 0 if sounding["detection"] else 2, sounding["detection"]))
        factor, quality, vertical, horizontal, window, _ = struct.unpack_from("<6f", data, 12)
        water_beam, samples, across = struct.unpack_from("<HHf", data, 36)
        _, _, reflectivity, _, level, _, gain = struct.unpack_from("<7f", data, 44)
        angle, _, time, _ = struct.unpack_from("<4f", data, 72)
        north, east, z, y, x, _ = struct.unpack_from("<6f", data, 88)
        self.assertEqual((factor, water_beam, level), (100, beam, LEVEL))
        self.near(angle, math.degrees(azimuth), 1e-4)
        self.near(across, math.degrees(azimuth), 1e-4)
        self.assertEqual(struct.unpack_from("<4H", data, 112), (0, 0, 0, 0))
        if not sounding["detection"]:
            self.assertEqual((quality, vertical, horizontal, window, samples, reflectivity, time), (0,) * 7)
            self.assertEqual((north, east, z, y, x), (0,) * 5)
            return
        reach = sounding["range"]
        ahead, starboard, down = (reach * part for part in direction(azimuth))
        turn = math.radians(HEADING)
        for value, wanted, slack in (
                (quality, 100 * 10 ** -sounding["quality"], 1e-3), (vertical, sounding["uncertainty"] * down / reach, 1e-5),
                (horizontal, sounding["uncertainty"] * math.sqrt(1 - (down / reach) ** 2), 1e-5),
                (window, 2 * RANGE / BINS / ASSUMED * (sounding["snippet_end"] - sounding["snippet_begin"]), 1e-7),
                (samples, reach / (RANGE / BINS), 1), (time, 2 * reach / ASSUMED, 1e-7), (z, down, 1e-4),
                (y, starboard, 1e-4), (x, ahead, 1e-4),
                (north * METRES_NORTH, ahead * math.cos(turn) - starboard * math.sin(turn), 1e-3),
                (east * METRES_EAST, ahead * math.sin(turn) + starboard * math.cos(turn), 1e-3),
                # The receiver's gain is the same 30 dB a decade, with the same absorption.
                (reflectivity, 10 * math.log10(sounding["intensity"]), 1e-3)):
            self.near(value, wanted, slack)
        self.assertGreater(gain, 30 * math.log10(reach))

    def test_what_cannot_be_is_told(self):
        with open("fls.yaml", "w", encoding="ascii") as file:
            file.write("world: floor.sdf\npings: 1\nsonars: [{name: fls, bin_count: 10, beam_count: 8}]\n")
        self.assertEqual(insonify("run", "fls.yaml", "-o", "fan", "--no-pictures", "--quiet").returncode, 0)
        for arguments, message in (
                (("fan/fls.h5", "-o", "a.xyz"), "fan/fls.h5: its sonar fls is not a multibeam; .xyz holds these alone"),
                (("line/swath.h5", "-o", "a.xtf"),
                 "line/swath.h5: its sonar swath is not a side-scan sonar; .xtf holds these alone"),
                (("line/swath.h5", "-o", "a.gsf"),
                 "a.gsf: .gsf holds latitudes and longitudes, for which an origin is needed"),
                (("line/swath.h5", "-o", "a.kmall"),
                 "a.kmall: .kmall holds latitudes and longitudes, for which an origin is needed"),
                (("line/swath.h5", "-o", "a.gsf", "--uncertainty", "--origin=1,2"),
                 "--uncertainty has no effect on .gsf, only on .xyz"),
                (("line/swath.h5", "-o", "a.npz", "--profile", "cast.csv"),
                 "--profile has no effect on .npz, only on .xyz, .gsf, .kmall"),
                (("line/swath.h5", "-o", "a.xyz", "--profile", "none.svp"), "none.svp: no such file")):
            done = insonify("export", *arguments)
            self.assertEqual((done.returncode, done.stderr), (2, f"insonify: {message}\n"))
        with open("short.csv", "w", encoding="ascii") as file:
            file.write("depth,speed\n0,1500\n5,1490\n")
        done = insonify("export", "line/swath.h5", "-o", "a.xyz", "--profile", "short.csv")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr,
                         r"^insonify: profile ends at 5 m, above the bottom, which reaches down to 9\.\d+ m\n$")
        done = insonify("export", "blind/swath.h5", "-o", "a.xyz")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "insonify: a.xyz: there is no sounding to write: no beam found the bottom\n")
        self.assertFalse(os.path.exists("a.xyz"))


if __name__ == "__main__":
    unittest.main()
