#!/usr/bin/python3
"""Soundings as messages: those in an MCAP recording (CDR) and in an exported bag (ROS 1), read byte by byte, are those of the
HDF5 recording of the same run; and recordings in MCAP are exported as HDF5 ones are.

sounding_messages_test.py INSONIFY
"""

import ctypes.util
import hashlib
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

INSONIFY = os.path.abspath(sys.argv.pop(1))

# A level floor 9 m below a multibeam that is rolled, whose outer beams reach beyond the range, and a fan beside it. The
# water is slower than the multibeam assumes. `blind` does not reach the floor.
SCENARIO = """
water: {{sound_speed: 1487.5}}
pings: 3
seed: 4
trajectory:
  - {{time: 0, position: [10, -20, -4], orientation_deg: [4, 3, 60]}}
  - {{time: 2, position: [12, -16, -4], orientation_deg: [4, 3, 60]}}
world: floor.obj
receiver: {{time_varied_gain: 30, noise: {noise}}}
sonars:
  - {{name: head 1, type: mbes, frequency: 310.0e3, beam_count: 36, bin_count: 400, min_range: 0, max_range: {most},
     azimuth_aperture_deg: 144, azimuth_resolution_deg: 3, elevation_aperture_deg: 3, transmit_elevation_aperture_deg: 2,
     assumed_sound_speed: 1500, ping_period: 0.4}}
  - {{name: fls, beam_count: 12, bin_count: 40, max_range: 15, ping_period: 0.4, orientation_deg: [0, 30, 0]}}
"""
FLOOR = "v -90 -90 -13\nv 90 -90 -13\nv 90 90 -13\nv -90 90 -13\nf 1 2 3 4\n"
BEAMS, BINS, PINGS, SPEED, PERIOD = 36, 400, 3, 1500, 0.4
FIELDS = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("intensity", 12, 7), ("uncertainty", 16, 7), ("quality", 20, 7),
          ("beam", 24, 4), ("detection", 26, 2), ("snippet_begin", 28, 5), ("snippet_end", 32, 5)]
TOPICS = ["/head_1/detections", "/head_1/soundings"]


def insonify(*arguments):
    return subprocess.run([INSONIFY, *arguments], check=False, capture_output=True, text=True)


def tables(path):
    """Tables of an .npz as (type, shape, numbers in a flat list)."""
    found = {}
    with zipfile.ZipFile(path) as archive:
        for name in archive.namelist():
            data = archive.read(name)
            length = struct.unpack_from("<H", data, 8)[0]
            header = eval(data[10:10 + length].decode(), {})  # pylint: disable=eval-used
            code = {"<f4": "f", "<f8": "d", "<u2": "H", "|u1": "B", "<i4": "i"}.get(header["descr"])
            if code:
                values = struct.unpack_from(f"<{math.prod(header['shape'])}{code}", data, 10 + length)
                found[name[:-4]] = (header["descr"], header["shape"], values)
    return found


class Reader:
    """Fields of a message: of ROS 2 aligned, and texts with a zero; of ROS 1 neither."""

    def __init__(self, data, ros2):
        self.data, self.ros2, self.at = data, ros2, 0
        if ros2:
            assert data[:4] == b"\0\1\0\0"
            self.data = data[4:]

    def number(self, code):
        size = struct.calcsize(code)
        if self.ros2:
            self.at += -self.at % size
        self.at += size
        return struct.unpack_from("<" + code, self.data, self.at - size)[0]

    def text(self):
        length = self.number("I")
        self.at += length
        data = self.data[self.at - length:self.at]
        return data[:-1].decode() if self.ros2 else data.decode()

    def numbers(self, code):
        return [self.number(code) for _ in range(self.number("I"))]

    def header(self):
        """Sequence, time and frame."""
        sequence = None if self.ros2 else self.number("I")
        seconds, nanoseconds = self.number("i"), self.number("I")
        return sequence, seconds + 1e-9 * nanoseconds, self.text()

    def ended(self):
        return self.at == len(self.data)


def mcap_messages(path):
    """Messages by topic."""
    zstd = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    with open(path, "rb") as file:
        data = file.read()
    channels, found = {}, {}

    def records(data, at):
        while at < len(data):
            kind, size = struct.unpack_from("<BQ", data, at)
            yield kind, data[at + 9:at + 9 + size]
            at += 9 + size

    def take(data, at):
        for kind, record in records(data, at):
            if kind == 4:  # Channel.
                size = struct.unpack_from("<I", record, 4)[0]
                channels[struct.unpack_from("<H", record)[0]] = record[8:8 + size].decode()
            elif kind == 5:  # Message: channel, sequence, two times.
                found.setdefault(channels[struct.unpack_from("<H", record)[0]], []).append(record[22:])
            elif kind == 6:  # Chunk: two times, size, checksum, compression, records.
                size, = struct.unpack_from("<Q", record, 16)
                length = struct.unpack_from("<I", record, 28)[0]
                assert record[32:32 + length] == b"zstd"
                packed = record[32 + length + 8:]
                unpacked = ctypes.create_string_buffer(size)
                assert zstd.ZSTD_decompress(unpacked, ctypes.c_size_t(size), packed, ctypes.c_size_t(len(packed))) == size
                take(unpacked.raw, 0)
            elif kind == 15:  # End of data: what follows says the same again.
                return
    take(data[:-8], 8)
    return found


def bag_records(data):
    at = 0
    while at < len(data):
        length = struct.unpack_from("<I", data, at)[0]
        fields, place = {}, at + 4
        while place < at + 4 + length:
            size = struct.unpack_from("<I", data, place)[0]
            name, _, value = data[place + 4:place + 4 + size].partition(b"=")
            fields[name.decode()] = value
            place += 4 + size
        size = struct.unpack_from("<I", data, place)[0]
        yield fields, data[place + 4:place + 4 + size]
        at = place + 4 + size


def bag_messages(path):
    """Messages by topic, and for each topic the facts of its connection."""
    with open(path, "rb") as file:
        data = file.read()
    assert data.startswith(b"#ROSBAG V2.0\n")
    topics, facts, found = {}, {}, {}
    for fields, body in bag_records(data[13:]):
        for inner, message in bag_records(body) if fields["op"] == b"\5" else ():
            connection = struct.unpack("<I", inner["conn"])[0]
            if inner["op"] == b"\7":
                topics[connection] = inner["topic"].decode()
                whole = struct.pack("<I", len(message)) + message + struct.pack("<I", 0)
                facts[topics[connection]] = next(bag_records(whole))[0]
            else:
                found.setdefault(topics[connection], []).append(message)
    return found, facts


def ros1_md5(name, definition):
    """As genmsg has it: constants first, types replaced by their own checksums."""
    texts = re.split(r"(?m)^=+\nMSG: ", definition)
    fields = {text.split("\n", 1)[0].strip(): text.split("\n", 1)[1] for text in texts[1:]}

    def md5(package, text):
        constants, members = [], []
        for line in text.splitlines():
            line = re.sub(r"#.*", "", line).strip()
            if not line:
                continue
            if "=" in line:
                constants.append(re.sub(r"\s*=\s*", "=", line))
                continue
            kind, member = line.split()
            bare = kind.split("[")[0]
            candidates = [bare, f"{package}/{bare}", "std_msgs/Header" if bare == "Header" else bare]
            inner = next((candidate for candidate in candidates if candidate in fields), None)
            members.append(f"{md5(inner.split('/')[0], fields[inner])} {member}" if inner else f"{kind} {member}")
        return hashlib.md5("\n".join(constants + members).encode()).hexdigest()
    return md5(name.split("/")[0], texts[0])


class SoundingMessagesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # pylint: disable=consider-using-with
        cls.folder = tempfile.TemporaryDirectory()
        os.chdir(cls.folder.name)
        with open("floor.obj", "w", encoding="ascii") as file:
            file.write(FLOOR)
        for name, most, noise in (("line", 16, "true"), ("blind", 5, "false")):
            with open(f"{name}.yaml", "w", encoding="ascii") as file:
                file.write(SCENARIO.format(most=most, noise=noise))
            cls.call("run", f"{name}.yaml", "-o", name, "--no-pictures", "--quiet", "--record", "h5,mcap")
            cls.call("export", f"{name}/head 1.h5", f"{name}/fls.h5", "-o", f"{name}.bag")
            cls.call("export", f"{name}/head 1.h5", "-o", f"{name}.npz")
        cls.tables = tables("line.npz")
        cls.bag, cls.facts = bag_messages("line.bag")
        cls.mcap = mcap_messages("line/head 1.mcap")

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.folder.cleanup()

    @staticmethod
    def call(*arguments):
        done = insonify(*arguments)
        assert done.returncode == 0, done.stderr
        return done.stdout

    def near(self, found, wanted, slack=1e-6):
        self.assertLessEqual(abs(found - wanted), slack, f"{found} is not {wanted}")

    def soundings(self, ping):
        """(azimuth, members by name) of each beam of the HDF5 recording."""
        for beam in range(BEAMS):
            yield self.tables["azimuth"][2][beam], {name[9:]: values[2][ping * BEAMS + beam]
                                                    for name, values in self.tables.items() if name.startswith("sounding_")}

    def check_detections(self, data, ros2, ping):
        reader = Reader(data, ros2)
        sequence, time, frame = reader.header()
        self.assertEqual((sequence, frame), (None if ros2 else ping, "head_1_swath"))
        self.near(time, PERIOD * ping, 1e-9)
        self.assertEqual((reader.number("f"), reader.number("f")), (310e3, SPEED))
        for width in (2, 3):
            values = reader.numbers("f")
            self.assertEqual(len(values), BEAMS)
            self.near(max(values), math.radians(width), 1e-6)
            self.near(min(values), math.radians(width), 1e-6)
        flags = reader.numbers("B")
        times, delays, levels, along, across = (reader.numbers("f") for _ in range(5))
        self.assertTrue(reader.ended())
        self.assertEqual((delays, along), ([0] * BEAMS, [0] * BEAMS))
        self.assertEqual([len(each) for each in (flags, times, levels, across)], [BEAMS] * 4)
        for beam, (azimuth, sounding) in enumerate(self.soundings(ping)):
            self.near(across[beam], -azimuth, 1e-6)
            if not sounding["detection"]:
                self.assertEqual((flags[beam], times[beam], levels[beam]), (1, 0, 0))
                continue
            self.assertEqual(flags[beam], 0)
            self.near(times[beam], 2 * sounding["range"] / SPEED, 2e-9)
            self.near(levels[beam], 10 * math.log10(sounding["intensity"]), 1e-5)
        return sum(flags)

    def check_cloud(self, data, ros2, ping):
        reader = Reader(data, ros2)
        sequence, time, frame = reader.header()
        self.assertEqual((sequence, frame), (None if ros2 else ping, "head_1"))
        self.near(time, PERIOD * ping, 1e-9)
        height, width = reader.number("I"), reader.number("I")
        fields = []
        for _ in range(reader.number("I")):
            fields.append((reader.text(), reader.number("I"), reader.number("B")))
            self.assertEqual(reader.number("I"), 1)
        self.assertEqual((height, fields, reader.number("B")), (1, FIELDS, 0))
        self.assertEqual((reader.number("I"), reader.number("I"), reader.number("I")), (36, 36 * width, 36 * width))
        points = [struct.unpack_from("<6fHBxii", reader.data, reader.at + 36 * i) for i in range(width)]
        reader.at += 36 * width
        self.assertEqual(reader.number("B"), 1)
        self.assertTrue(reader.ended())
        placed = [(beam, *each) for beam, each in enumerate(self.soundings(ping)) if each[1]["detection"]]
        self.assertEqual(len(points), len(placed))
        for point, (beam, azimuth, sounding) in zip(points, placed):
            reach = sounding["range"]
            for value, wanted in zip(point[:4], (reach * math.cos(azimuth), reach * math.sin(azimuth), 0,
                                                 10 * math.log10(sounding["intensity"]))):
                self.near(value, wanted, 1e-5)
            self.assertEqual(point[4:], (sounding["uncertainty"], sounding["quality"], beam, sounding["detection"],
                                         sounding["snippet_begin"], sounding["snippet_end"]))
        return len(points)

    def test_messages_hold_the_soundings_of_the_hdf5_recording(self):
        for ros2, messages in ((True, self.mcap), (False, self.bag)):
            found = lost = 0
            for topic in TOPICS:
                self.assertEqual(len(messages[topic]), PINGS)
            for ping in range(PINGS):
                lost += self.check_detections(messages[TOPICS[0]][ping], ros2, ping)
                found += self.check_cloud(messages[TOPICS[1]][ping], ros2, ping)
            self.assertEqual(found + lost, PINGS * BEAMS)
            self.assertGreater(found, 40)
            self.assertGreater(lost, 5)

    def test_where_nothing_is_found_all_beams_are_bad_and_there_is_no_point(self):
        self.assertEqual(set(tables("blind.npz")["sounding_detection"][2]), {0})
        for ros2, messages in ((True, mcap_messages("blind/head 1.mcap")), (False, bag_messages("blind.bag")[0])):
            for data in messages[TOPICS[0]]:
                reader = Reader(data, ros2)
                reader.header()
                reader.number("f"), reader.number("f"), reader.numbers("f"), reader.numbers("f")
                self.assertEqual([reader.numbers("B"), reader.numbers("f")], [[1] * BEAMS, [0] * BEAMS])
            for data in messages[TOPICS[1]]:
                reader = Reader(data, ros2)
                reader.header()
                self.assertEqual((reader.number("I"), reader.number("I")), (1, 0))
                self.assertEqual(data[-5:], b"\0\0\0\0\1")  # No bytes; dense.

    def test_checksums_of_ros1_are_those_of_the_definitions(self):
        for topic, name in zip(TOPICS, ("marine_acoustic_msgs/SonarDetections", "sensor_msgs/PointCloud2")):
            facts = self.facts[topic]
            self.assertEqual(facts["type"].decode(), name)
            self.assertEqual(facts["md5sum"].decode(), ros1_md5(name, facts["message_definition"].decode()))
        self.assertEqual(self.facts[TOPICS[0]]["md5sum"], b"588993519ccaab99fb0df80256b440ff")

    def test_rosbag_reads_them(self):
        try:
            import rosbag  # pylint: disable=import-outside-toplevel
        except ImportError as missing:
            self.skipTest(f"{missing} (package python3-rosbag)")
        with rosbag.Bag("line.bag") as bag:
            messages = [message for _, message, _ in bag.read_messages(TOPICS[0])]
            clouds = [message for _, message, _ in bag.read_messages(TOPICS[1])]
        for ping in range(PINGS):
            flags = [flag.flag for flag in messages[ping].flags]
            self.assertEqual(flags, [0 if sounding["detection"] else 1 for _, sounding in self.soundings(ping)])
            self.assertEqual((messages[ping].flags[0].DETECT_BAD_SONAR, messages[ping].header.seq), (1, ping))
            self.assertEqual(clouds[ping].width, flags.count(0))

    def test_an_mcap_recording_has_the_soundings(self):
        self.call("export", "line/head 1.mcap", "-o", "again.npz")
        again = tables("again.npz")
        names = [name for name in self.tables if name.startswith("sounding_")]
        self.assertEqual(len(names), 7)
        for name in names:
            self.assertEqual(again[name][:2], self.tables[name][:2], name)
            for value, wanted in zip(again[name][2], self.tables[name][2]):
                if math.isnan(wanted):
                    self.assertTrue(math.isnan(value), name)
                else:
                    self.near(value, wanted, 2e-6 * abs(wanted) if name == "sounding_intensity" else 2e-7 * abs(wanted))

    def test_an_mcap_recording_is_exported_for_survey_programs(self):
        self.call("export", "line/head 1.h5", "line/fls.h5", "-o", "both.mcap")
        for source in ("line/head 1.mcap", "both.mcap"):
            words = ("--sonar", "head 1") if source == "both.mcap" else ()
            for ending, options in (("xyz", ("--uncertainty",)), ("gsf", ("--origin", "48,-68.5")),
                                    ("kmall", ("--origin", "48,-68.5"))):
                self.call("export", source, *words, "-o", f"mcap.{ending}", "--force", *options)
            self.call("export", "line/head 1.h5", "-o", "h5.xyz", "--force", "--uncertainty")
            with open("mcap.xyz", encoding="ascii") as mine, open("h5.xyz", encoding="ascii") as theirs:
                mine, theirs = ([list(map(float, line.split())) for line in file] for file in (mine, theirs))
            self.assertGreater(len(mine), 40)
            self.assertEqual(len(mine), len(theirs))
            for line, wanted in zip(mine, theirs):
                for value, there in zip(line, wanted, strict=True):
                    self.near(value, there, 1.01e-4)  # The last of four digits.

    def test_a_recording_without_them_is_told(self):
        done = insonify("export", "line/fls.mcap", "-o", "a.xyz")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "insonify: line/fls.mcap: its sonar fls is not a multibeam; .xyz holds these alone\n"))

    def test_info_names_the_topics(self):
        contents = json.loads(self.call("info", "line/head 1.mcap", "--json"))[0]
        self.assertIn("/head_1/detections marine_acoustic_msgs/msg/SonarDetections", contents["contents"])
        self.assertIn("/head_1/soundings sensor_msgs/msg/PointCloud2", contents["contents"])

    def test_the_run_of_a_fan_has_no_such_topics(self):
        self.assertEqual(sorted(topic for topic in self.bag if topic.startswith("/fls")),
                         ["/fls/fan", "/fls/points", "/fls/pose", "/fls/sonar_image", "/fls/true_points"])
        self.assertEqual(sorted(mcap_messages("line/fls.mcap")),
                         ["/fls/fan", "/fls/points", "/fls/pose", "/fls/sonar_image", "/fls/true_points", "/scenario", "/tf"])


if __name__ == "__main__":
    unittest.main()
