"""Simulator.line(): the pings of a side-scan sonar as arrays, against places and pings worked out otherwise.

    PYTHONPATH=build/dev/python tests/python/line_test.py COMMAND_LINE SOURCE_FOLDER
"""

import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import insonify
from kit import COMMAND_LINE

SONAR = {"name": "fish", "type": "sss", "azimuth_aperture_deg": 1, "elevation_aperture_deg": 60, "depression_deg": 35,
         "elevation_pattern": "rectangular", "max_range": 20, "bin_count": 400, "ping_period": 0.25}


def simulator(**changes):
    """Over a floor at z = -2 with a wall along x, from 1 m below the floor to 3 m above it, whose face is at y = 8."""
    scene = insonify.Scene()
    scene.plane("floor", 120, material="sand", pose=(0, 0, -2))
    scene.box("wall", (100, 1, 4), material="concrete", pose=(0, 8.5, -1))
    sonar = {key: value for key, value in {**SONAR, **changes}.items() if value is not None}
    return insonify.Simulator({"world": None, "sonars": [sonar], "receiver": {"noise": False}}, scene)


class LineTest(unittest.TestCase):
    def test_goes_straight_from_begin_to_end(self):
        # 5 m in the direction (3, 4), 0.5 m a ping: the one at the end is left out.
        line = simulator().line(begin=(1, -2, 3), end=(4, 2, 3), speed=2)
        self.assertEqual(len(line), 10)
        np.testing.assert_allclose(line.time, 0.25 * np.arange(10))
        np.testing.assert_allclose(line.world_from_sonar[:, :3], np.add([1, -2, 3], np.outer(0.5 * np.arange(10), [0.6, 0.8, 0])),
                                   atol=1e-9)
        half = math.atan2(4, 3) / 2
        np.testing.assert_allclose(line.world_from_sonar[:, 3:], np.tile([math.cos(half), 0, 0, math.sin(half)], (10, 1)),
                                   atol=1e-9)
        self.assertEqual(line.sonar.name, "fish")
        self.assertEqual(repr(line), "<Line of fish: 10 pings of 400 bins x 2 sides>")

    def test_looks_along_a_line_that_climbs(self):
        # 3 m over 4 m: the bow is up, and the axis of the housing along the line.
        line = simulator().line(begin=(0, 0, 2), end=(4, 0, 5), speed=4)
        np.testing.assert_allclose(line[0].pose.matrix[:3, 0], [0.8, 0, 0.6], atol=1e-9)

    def test_sees_the_wall_on_its_side(self):
        # Along x, 8 m from the wall, whose top is 2 m below: its nearest point is its upper edge at sqrt(8^2 + 2^2) m.
        # The floor at the same range does not echo as a wall does.
        line = simulator().line(begin=(0, 0, 3), end=(3, 0, 3))
        np.testing.assert_allclose(line.altitude, 5, atol=0.06)  # A bin is 5 cm long.
        edge = np.searchsorted(line.ranges, math.hypot(8, 2))
        wall = slice(edge, edge + 12)
        self.assertGreater(line.port[:, wall].mean(), 3 * line.starboard[:, wall].mean())
        back = simulator().line(begin=(3, 0, 3), end=(0, 0, 3))
        self.assertGreater(back.starboard[:, wall].mean(), 3 * back.port[:, wall].mean())

    def test_pings_are_those_of_ping(self):
        sim = simulator()
        line = sim.line("fish", (1, -2, 3), (4, 2, 3), 2, number=7)
        turn = (math.cos(math.atan2(4, 3) / 2), 0, 0, math.sin(math.atan2(4, 3) / 2))
        for index in (0, 4, 9):
            ping = sim.ping(pose=((1 + 0.3 * index, -2 + 0.4 * index, 3), turn), time=0.25 * index, number=7 + index)
            np.testing.assert_array_equal(line.intensity[index], ping.intensity)
            np.testing.assert_array_equal(line[index].intensity, ping.intensity)
            self.assertEqual((line[index].number, line[index].time), (7 + index, 0.25 * index))
        self.assertEqual(sim.line(begin=(0, 0, 3), end=(3, 0, 3))[0].number, 17)  # The one after the last, 16.
        np.testing.assert_array_equal(line.port, line.intensity[:, :, 0])
        self.assertTrue(np.shares_memory(line.starboard, line.intensity))

    def test_of_a_multibeam_has_soundings(self):
        sim = simulator(type="mbes", beam_count=24, azimuth_aperture_deg=90, azimuth_resolution_deg=3,
                        elevation_aperture_deg=3, depression_deg=None)
        line = sim.line(begin=(0, -20, 3), end=(3, -20, 3), speed=2)
        self.assertEqual(line.soundings.shape, (6, 24))
        self.assertEqual(line.intensity.shape, (6, 400, 24))
        for index, ping in enumerate(line):
            for name in ping.soundings.dtype.names:
                np.testing.assert_array_equal(ping.soundings[name], line.soundings[index][name])
            np.testing.assert_allclose(ping.sounding_positions()[:, 2], -2, atol=0.25)
        self.assertEqual(repr(line), "<Line of fish: 6 pings of 400 bins x 24 beams>")
        with self.assertRaisesRegex(AttributeError, "fish has no sides; intensity holds its beams"):
            line.port  # pylint: disable=pointless-statement
        self.assertEqual(line._repr_png_(), line[-1]._repr_png_())
        self.assertIsNone(simulator().line(begin=(0, 0, 3), end=(3, 0, 3)).soundings)

    def test_is_drawn_as_a_waterfall(self):
        line = simulator().line(begin=(0, 0, 3), end=(3, 0, 3))
        picture = insonify.draw_waterfall(line, height=300, annotations=False)
        # The wall is to port, on the left, from 8.25 m on, and 8 m of shadow behind it.
        half = picture.shape[1] / 2
        wall, shadow = (np.arange(round(half * a / 20), round(half * b / 20)) for a, b in ((8.3, 8.7), (12, 16)))
        port, starboard = picture[:, ::-1][:, round(half):], picture[:, round(half):]
        self.assertGreater(port[:, wall].mean(), 1.2 * starboard[:, wall].mean())
        self.assertLess(port[:, shadow].mean(), 0.3 * starboard[:, shadow].mean())
        np.testing.assert_array_equal(picture, insonify.draw_waterfall(list(line), height=300, annotations=False))
        self.assertNotEqual(picture.tobytes(), insonify.draw_waterfall(line[::-1], height=300, annotations=False,
                                                                       corrected=True).tobytes())
        for shown in (line, line[0]):
            self.assertEqual(shown._repr_png_()[:4], b"\x89PNG")
        with self.assertRaisesRegex(insonify.Error, "along = way must be one of ping, time, distance"):
            insonify.draw_waterfall(line, along="way")
        with self.assertRaisesRegex(insonify.Error, "pings must hold at least one ping"):
            insonify.draw_waterfall([])

    def test_is_a_sequence_of_pings(self):
        line = simulator().line(begin=(0, 0, 3), end=(3, 0, 3))
        self.assertEqual([ping.time for ping in line], list(line.time))
        self.assertEqual([ping.time for ping in line[-2:]], list(line.time[-2:]))
        self.assertEqual(line[-1].time, line.time[-1])
        self.assertIsNone(line[0].instance)
        with self.assertRaisesRegex(IndexError, "there is no ping 8; the line has 8"):
            line[8]

    def test_flies_a_pattern_as_the_command_line_does(self):
        pattern = {"lines": {"center": [0, 0], "length": 6, "width": 8, "spacing": 4, "altitude": 3, "speed": 2, "turns": "skip"},
                   "motion_noise": {"roll_deg": 2, "heave": 0.1}}
        with tempfile.TemporaryDirectory() as folder:
            world = pathlib.Path(folder, "floor.obj")
            world.write_text("v -40 -40 -2\nv 40 -40 -2\nv 40 40 -2\nv -40 40 -2\nf 1 2 3 4\n")
            scenario = insonify.Scenario.from_dict({"world": str(world), "sonars": [SONAR], "pattern": pattern})
            file = pathlib.Path(folder, "survey.yaml")
            file.write_text(scenario.to_yaml())
            subprocess.run([COMMAND_LINE, "run", file, "-q", "--no-pictures", "-o", pathlib.Path(folder, "run")], check=True)
            line = insonify.Simulator(file).line()
            recorded = insonify.open(pathlib.Path(folder, "run", "fish.h5"))
            # Two lines of 3 s, a ping each quarter of a second.
            self.assertEqual((len(line), len(recorded)), (24, 24))
            np.testing.assert_array_equal(line.intensity, recorded.intensity)
            np.testing.assert_array_equal(line.time, recorded.time)
            np.testing.assert_array_equal(line.world_from_sonar, recorded.world_from_sonar)
            np.testing.assert_array_equal(line.ranges, recorded.ranges)

    def test_memory_does_not_grow_with_the_line_but_for_its_arrays(self):
        # 1 km, 1000 pings of 2 x 1000 intensities: 8 MB. Labels of as many pings would be 24 MB more.
        code = """
import resource, insonify
scene = insonify.Scene()
scene.plane("floor", 2500, pose=(0, 0, -2))
sim = insonify.Simulator({"world": None, "receiver": {"speckle": False}, "sonars": [{"name": "fish", "type": "sss",
    "azimuth_aperture_deg": 1, "elevation_aperture_deg": 60, "max_range": 20, "bin_count": 1000, "ping_period": 0.25,
    "sampling": {"columns_per_beam": 2, "rows": 60}}]}, scene)
def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
sim.line(begin=(0, 0, 3), end=(128, 0, 3), speed=4)
before = peak()
line = sim.line(begin=(0, 0, 3), end=(1000, 0, 3), speed=4)
print(len(line), line.intensity.nbytes, 1024 * (peak() - before))
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        pings, arrays, grown = map(int, done.stdout.split())
        self.assertEqual((pings, arrays), (1000, 8_000_000))
        self.assertLess(grown, arrays + 4_000_000)

    def test_refuses_what_is_no_line(self):
        sim = simulator()
        ahead = insonify.Simulator({"world": None, "sonars": [{"name": "ahead", "max_range": 10}]})
        for call, message in (
            (lambda: sim.line(), "begin and end of the line are missing: the scenario has no trajectory or pattern"),
            (lambda: sim.line(begin=(0, 0, 3)), "end of the line is missing"),
            (lambda: sim.line(end=(0, 0, 3)), "begin of the line is missing"),
            (lambda: sim.line(begin=(0, 0, 3), end=(0, 0, 3)), "end of a line must differ from its begin"),
            (lambda: sim.line(begin=(0, 0, 3), end=(1, 0, 3), speed=0), "speed = 0 m/s must be greater than 0, at most 50 m/s"),
            (lambda: sim.line(begin=(0, 0, 3), end=(math.nan, 0, 3)), "end[0] = nan m must be from -10000000 to 10000000 m"),
            (lambda: sim.line(speed=2), "speed is that of a line from begin to end; the scenario's pings have their own"),
            (lambda: sim.line(number=2), "number is that of a line from begin to end; the scenario's pings have their own"),
            (lambda: ahead.line(begin=(0, 0, 3), end=(1, 0, 3)),
             "sonar = ahead is neither a side-scan sonar (type: sss) nor a multibeam (mbes); ping_batch() takes any")):
            with self.assertRaisesRegex(insonify.Error, "^" + re.escape(message) + "$"):
                call()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
