#!/usr/bin/python3
"""Fan pictures and starts of MCAP files and bags, by the command line and from Python: message_options_test.py INSONIFY ..."""

import collections
import datetime
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings

try:
    import numpy as np
    import insonify
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

INSONIFY = sys.argv[1]

# 18 pings of a fan, and 30 of a head from 0 to 1.74 s: in four half seconds.
SCENARIO = """
world: floor.obj
duration: 1.75
sonars:
  - {name: ahead, beam_count: 12, bin_count: 40, max_range: 12, ping_period: 0.1, orientation_deg: [0, 25, 10],
     sampling: {columns_per_beam: 2, rows: 20}}
  - {name: around, type: msis, beam_count: 1, bin_count: 40, max_range: 12, ping_period: 0.06, step_deg: 9,
     sampling: {columns_per_beam: 2, rows: 20}}
"""
FLOOR = "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n"

JUNE = 1780308000  # `date -u -d 2026-06-01T10:00:00Z +%s`


def mcap_facts(path):
    """Messages by topic, and the times of the first and the last, from the file's statistics [ns]."""
    data = pathlib.Path(path).read_bytes()
    at, topics, counts, times = 8, {}, {}, None
    while at + 9 <= len(data) - 8:
        operation, length = struct.unpack_from("<BQ", data, at)
        body = data[at + 9:at + 9 + length]
        if operation == 4:
            number, _, size = struct.unpack_from("<HHI", body)
            topics[number] = body[8:8 + size].decode()
        elif operation == 11:
            times = struct.unpack_from("<QQ", body, 26)
            counts = dict(struct.iter_unpack("<HQ", body[46:]))
        at += 9 + length
    return {topics[number]: count for number, count in counts.items()}, times


def bag_facts(path):
    """The same of a bag, from the index of each chunk."""
    data = pathlib.Path(path).read_bytes()

    def fields(block):
        found = {}
        while block:
            size, = struct.unpack_from("<I", block)
            name, _, value = block[4:4 + size].partition(b"=")
            found[name.decode()] = value
            block = block[4 + size:]
        return found

    at, topics, counts, times = data.index(b"\n") + 1, {}, collections.Counter(), []
    while at < len(data):
        size, = struct.unpack_from("<I", data, at)
        header = fields(data[at + 4:at + 4 + size])
        length, = struct.unpack_from("<I", data, at + 4 + size)
        body = data[at + 8 + size:at + 8 + size + length]
        if header["op"] == b"\x04":
            counts[header["conn"]] += struct.unpack("<I", header["count"])[0]
            times += [seconds * 10**9 + nanoseconds for seconds, nanoseconds, _ in struct.iter_unpack("<III", body)]
        elif header["op"] == b"\x07":
            topics[header["conn"]] = header["topic"].decode()
        at += 8 + size + length
    return {topics[number]: count for number, count in counts.items()}, (min(times), max(times))


class MessageOptionsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(scratch.name)
        pathlib.Path("floor.obj").write_text(FLOOR)
        pathlib.Path("s.yaml").write_text(SCENARIO)
        cls.insonify("run", "s.yaml", "-o", "out", "-q", "--no-pictures")

    @staticmethod
    def insonify(*words, status=0):
        done = subprocess.run([INSONIFY, *words], capture_output=True, text=True, timeout=120, check=False)
        assert done.returncode == status, (words, done.returncode, done.stderr)
        return done.stderr if status else done.stdout

    def check_fans(self, facts, ahead, around):
        counts, _ = facts
        self.assertEqual((counts["/ahead/sonar_image"], counts["/around/sonar_image"], counts["/around/points"]), (18, 30, 30))
        self.assertEqual((counts.get("/ahead/fan", 0), counts.get("/around/fan", 0)), (ahead, around))

    def test_a_scanning_head_has_two_fan_pictures_a_second(self):
        recordings = ["out/ahead.h5", "out/around.h5"]
        for ending, facts in (("mcap", mcap_facts), ("bag", bag_facts)):
            for rate, ahead, around in ((None, 18, 4), (4, 7, 7), (1000, 18, 30), (0, 0, 0)):
                with self.subTest(ending=ending, rate=rate):
                    words = [] if rate is None else ["--fan-rate", str(rate)]
                    self.insonify("export", *recordings, "-o", f"a.{ending}", "-f", *words)
                    self.check_fans(facts(f"a.{ending}"), ahead, around)
                    options = {} if rate is None else {"fan_rate": rate}
                    insonify.export(recordings, f"b.{ending}", replace=True, **options)
                    self.assertEqual(pathlib.Path(f"b.{ending}").read_bytes(), pathlib.Path(f"a.{ending}").read_bytes())

    def test_runs_record_as_exports_do(self):
        self.insonify("run", "s.yaml", "-o", "live", "-q", "--no-pictures", "--record", "mcap", "--fan-rate", "4", "--start",
                      "2026-06-01T10:00:00Z")
        for sonar, pings in (("ahead", 18), ("around", 30)):
            counts, times = mcap_facts(f"live/{sonar}.mcap")
            self.assertEqual((counts[f"/{sonar}/pose"], counts[f"/{sonar}/fan"]), (pings, 7))
            self.assertEqual(times[0], JUNE * 10**9)

    def test_the_forecast_of_the_disk_follows(self):
        def forecast(*words):
            told = self.insonify("run", "s.yaml", "-o", "forecast", "-f", "--pings", "60", "--no-pictures", "--record", "mcap", *words)
            line = next(line for line in told.splitlines() if line.startswith("disk: the recordings need at most "))
            number, unit = line.split("at most ")[1].split(",")[0].split()
            return float(number) * {"kB": 1e3, "MB": 1e6, "GB": 1e9}[unit]

        # Pictures of 480 x 960 pixels: 60 of each sonar; or of `around` those of 8 half seconds begun, and one more.
        picture = 3 * 480 * 960 / 1e6
        self.assertAlmostEqual(forecast("--fan-rate", "1000") / 1e6, 120 * picture, delta=5)
        self.assertAlmostEqual(forecast() / 1e6, 69 * picture, delta=5)

    def test_times_count_from_the_start(self):
        for ending, facts in (("mcap", mcap_facts), ("bag", bag_facts)):
            for given in ("2026-06-01T10:00:00.5Z", "2026-06-01T12:00:00.5+02:00"):
                self.insonify("export", "out/around.h5", "-o", f"a.{ending}", "-f", "--start", given)
                times = facts(f"a.{ending}")[1]
                self.assertEqual(times, (JUNE * 10**9 + 500_000_000, JUNE * 10**9 + 2_240_000_000))
            zone = datetime.timezone(datetime.timedelta(hours=2))
            for given in ("2026-06-01T10:00:00.5Z", datetime.datetime(2026, 6, 1, 12, 0, 0, 500_000, zone)):
                insonify.export("out/around.h5", f"b.{ending}", replace=True, start=given)
                self.assertEqual(pathlib.Path(f"b.{ending}").read_bytes(), pathlib.Path(f"a.{ending}").read_bytes())
            insonify.export("out/around.h5", f"b.{ending}", replace=True, start=None)
            self.assertEqual(facts(f"b.{ending}")[1][1], 1_740_000_000)

    def test_readers_have_the_scenarios_times(self):
        self.insonify("export", "out/ahead.h5", "out/around.h5", "-o", "june.mcap", "--start", "2026-06-01T10:00:00.25Z")
        exact = insonify.open("out/around.h5")
        recorded = insonify.open("june.mcap", "around")
        np.testing.assert_allclose(recorded.time, exact.time, atol=0.6e-9, rtol=0)
        self.assertEqual((recorded[0].time, recorded[25].time), (0, 1.5))
        told = self.insonify("info", "june.mcap")
        self.assertIn("\n  started at 2026-06-01T10:00:00.25Z\n", told)
        self.assertIn("\n  around: 30 pings from 0 to 1.74 s\n", told)
        facts = json.loads(self.insonify("info", "june.mcap", "out/ahead.h5", "--json"))
        self.assertEqual([one["start"] for one in facts], ["2026-06-01T10:00:00.25Z", None])
        # What is made of it keeps the start, unless it is given another.
        self.insonify("export", "june.mcap", "--sonar", "around", "-o", "again.mcap")
        self.assertEqual(mcap_facts("again.mcap")[1][0], JUNE * 10**9 + 250_000_000)
        np.testing.assert_array_equal(insonify.open("again.mcap").time, recorded.time)
        self.insonify("export", "june.mcap", "-o", "other.bag", "--start", "1970-01-02T00:00:00Z")
        self.assertEqual(bag_facts("other.bag")[1][0], 86400 * 10**9)
        self.insonify("export", "june.mcap", "--sonar", "around", "-o", "june.npz")
        with np.load("june.npz") as archive:
            np.testing.assert_array_equal(archive["time"], recorded.time)
            self.assertEqual(json.loads(str(archive["attributes"]))["start"], "2026-06-01T10:00:00.25Z")
        self.insonify("export", "out/ahead.h5", "-o", "july.mcap", "--start", "2026-07-01T10:00:00Z")
        self.assertEqual(self.insonify("export", "again.mcap", "july.mcap", "-o", "both.mcap", status=2),
                         "insonify: again.mcap and july.mcap are of different runs: their starts are 2026-06-01T10:00:00.25Z and "
                         "2026-07-01T10:00:00Z; export each run to a file of its own\n")

    def test_values_that_are_cut_are_told_of(self):
        # The loudest value of the floor, raised by 30 dB per decade of range, is above the highest level of these levels.
        for ending in ("mcap", "bag"):
            with self.assertWarns(insonify.Warning) as caught:
                insonify.export("out/ahead.h5", f"cut.{ending}", levels=(-90, -70))
            told = subprocess.run([INSONIFY, "export", "out/ahead.h5", "-o", f"told.{ending}", "--levels=-90:-70"],
                                  capture_output=True, text=True, timeout=120, check=True).stderr
            self.assertRegex(told, rf"^insonify: warning: told.{ending}: \d+ of 8640 values of ahead are above the highest level, -70 dB, and "
                                   r"are clipped; the loudest has -\d+\.\d+ dB; --levels changes that\n$")
            self.assertEqual(str(caught.warning), told.removeprefix("insonify: warning: ").strip().replace(
                "told.", "cut.").replace("--levels changes", "levels=(low, high) changes"))
            self.assertEqual(caught.filename, __file__)
            self.assertEqual(len(caught.warnings), 1)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            insonify.export("out/ahead.h5", "whole.mcap", levels=(-100, 0))
            with self.assertRaises(insonify.Warning):
                insonify.export("out/ahead.h5", "cut.mcap", levels=(-90, -70), replace=True)
        self.assertEqual(mcap_facts("cut.mcap")[0]["/ahead/sonar_image"], 18)  # It is there all the same.

    def test_what_cannot_be_is_refused(self):
        export = ("export", "out/around.h5", "-o")
        self.assertEqual(self.insonify(*export, "x.mcap", "--fan-rate", "-1", status=2),
                         "insonify: --fan-rate: -1 must be a number, from 0 to 1000 (insonify export --help)\n")
        self.assertEqual(self.insonify(*export, "x.npz", "--fan-rate", "2", status=2),
                         "insonify: --fan-rate has no effect on .npz, only on .mcap, .bag\n")
        self.assertEqual(self.insonify(*export, "x.gif", "--start", "2026-06-01T10:00:00Z", status=2),
                         "insonify: --start has no effect on .gif, only on .mcap, .bag, .xtf, .jsf, .gsf, .kmall\n")
        self.assertEqual(self.insonify(*export, "x.mcap", "--start", "2026-06-01T10:00:00", status=2),
                         "insonify: --start: 2026-06-01T10:00:00 must be a time with its zone, such as 2026-06-01T10:00:00Z "
                         "(insonify export --help)\n")
        for option, value in (("--fan-rate", "2"), ("--start", "2026-06-01T10:00:00Z")):
            self.assertEqual(self.insonify("run", "s.yaml", "-o", "x", option, value, status=2),
                             f"insonify: {option} has no effect on --record h5, only on mcap\n")
        self.assertFalse(pathlib.Path("x").exists())
        for options, message in (({"fan_rate": 1001}, "x.mcap: messages.fan_rate = 1001 1/s must be from 0 to 1000 1/s"),
                                 ({"start": "noon"}, "start = noon must be a time with its zone, such as 2026-06-01T10:00:00Z"),
                                 ({"start": datetime.datetime(2039, 1, 1, tzinfo=datetime.timezone.utc)},
                                  "start = 2039-01-01T00:00:00+00:00 must be from 1970-01-01T00:00:00Z to before "
                                  "2038-01-19T03:14:08Z, as ROS messages hold it"),
                                 ({"start": 5}, "start = 5 must be text")):
            with self.assertRaises(insonify.Error) as caught:
                insonify.export("out/around.h5", "x.mcap", **options)
            self.assertEqual(str(caught.exception), message)
        self.assertFalse(pathlib.Path("x.mcap").exists())

    def test_a_start_that_is_no_time_is_a_fault_of_the_file(self):
        self.insonify("export", "out/around.h5", "-o", "start.mcap", "--start", "2026-06-01T10:00:00Z")
        data = pathlib.Path("start.mcap").read_bytes()
        self.assertEqual(data.count(b"2026-06-01T10:00:00Z"), 1)
        pathlib.Path("wrong.mcap").write_bytes(data.replace(b"2026-06-01T10:00:00Z", b"2026-06-31T10:00:00Z"))
        message = "wrong.mcap: its metadata start: 2026-06-31T10:00:00Z must be a time with its zone, such as 2026-06-01T10:00:00Z"
        with self.assertRaises(insonify.Error) as caught:
            insonify.open("wrong.mcap")
        self.assertEqual(str(caught.exception), message)
        self.assertEqual(self.insonify("info", "wrong.mcap", status=2), f"insonify: {message}\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
