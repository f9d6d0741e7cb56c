#!/usr/bin/python3
"""Soundings of a multibeam in Python: soundings_test.py INSONIFY SOURCE_FOLDER"""

import os
import pathlib
import pickle
import sys
import tempfile
import unittest

try:
    import numpy as np
    import insonify
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# A level floor 13 m below a sonar that goes west: port is south. 1500 m/s is assumed, 1470 m/s is true; a lens steers
# beams whatever is assumed.
DEPTH, SCALE = 13.0, 1470 / 1500
TEXT = """
world: floor.obj
water: {sound_speed: 1470}
receiver: {noise: false}
sonars:
  - {name: swath, type: mbes, frequency: 300.0e3, beam_count: 40, bin_count: 500, min_range: 0, max_range: 30,
     azimuth_aperture_deg: 100, elevation_aperture_deg: 2, assumed_sound_speed: 1500, steering: lens}
  - {name: ahead, beam_count: 8, bin_count: 40, max_range: 20}
trajectory:
  - {time: 0, position: [7, -3, 0], orientation_deg: [0, 0, 180]}
  - {time: 10, position: [2, -3, 0], orientation_deg: [0, 0, 180]}
pings: 3
"""
FLOOR = f"v -90 -90 -{DEPTH}\nv 90 -90 -{DEPTH}\nv 90 90 -{DEPTH}\nv -90 90 -{DEPTH}\nf 1 2 3\nf 1 3 4\n"
NAMES = ("azimuth", "range", "uncertainty", "quality", "intensity", "snippet_begin", "snippet_end", "detection")


class SoundingsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(scratch.name)
        pathlib.Path("floor.obj").write_text(FLOOR)
        pathlib.Path("s.yaml").write_text(TEXT)
        cls.simulator = insonify.Simulator("s.yaml")
        with insonify.Recording("swath.h5", cls.simulator, "swath") as recording:
            for number in range(3):
                recording.add(cls.simulator.ping("swath", number=number))

    def test_they_lie_on_the_floor(self):
        ping = self.simulator.ping("swath", number=0)
        found = ping.soundings
        self.assertEqual(found.dtype.names, NAMES)
        self.assertEqual(found.shape, (40,))
        self.assertTrue(np.all(np.isin(found["detection"], (1, 2))))
        positions = ping.sounding_positions(range_scale=SCALE)
        np.testing.assert_allclose(positions[:, 2], -DEPTH, atol=0.25)
        np.testing.assert_allclose(positions[:, 0], 7, atol=1e-6)
        # Port is at negative y: half of the swath, at 48.75 degrees.
        outermost = DEPTH * np.tan(np.radians(48.75))
        np.testing.assert_allclose(positions[[0, -1], 1], [-3 - outermost, -3 + outermost], atol=0.3)
        np.testing.assert_allclose(ping.sounding_positions() * SCALE - positions, [[7 * (SCALE - 1), 3 * (1 - SCALE), 0]] * 40,
                                   atol=1e-6)
        begin, end = found["snippet_begin"], found["snippet_end"]
        means = [ping.intensity[a:b, beam].mean() for beam, (a, b) in enumerate(zip(begin, end))]
        np.testing.assert_allclose(found["intensity"], means, rtol=1e-5)

    def test_profiles_bend_rays(self):
        ping = self.simulator.ping("swath", number=0)
        # Water of one speed, as the true one: straight rays to the floor.
        uniform = insonify.acoustics.SoundSpeedProfile([(0, 1470)])
        np.testing.assert_allclose(ping.sounding_positions(profile=uniform), ping.sounding_positions(range_scale=SCALE),
                                   atol=1e-6)
        # Water that becomes faster with depth bends rays up: the depths of outer beams are less.
        layered = insonify.acoustics.SoundSpeedProfile([(1, 1470), (21, 1530)])
        bent = ping.sounding_positions(profile=layered, surface=1.0)
        azimuth = ping.soundings["azimuth"].astype(float)
        for place, angle, range_ in zip(bent, azimuth, ping.soundings["range"].astype(float)):
            point = layered.after_time(1.0, np.pi / 2 - abs(angle), range_ / 1500)
            self.assertAlmostEqual(place[2], 1 - point.depth, delta=1e-6)
            self.assertAlmostEqual(abs(place[1] + 3), point.distance, delta=1e-6)
        straight = ping.sounding_positions(range_scale=1500 / 1500)[:, 2]
        self.assertGreater(np.abs(bent[:, 2] - straight).max(), 0.05)
        with self.assertRaisesRegex(insonify.Error, "range_scale has no effect with a profile"):
            ping.sounding_positions(range_scale=0.9, profile=layered)
        insonify.export("swath.h5", "bent.xyz", profile=[(0, 1470), (20, 1530)], replace=True)
        insonify.export("swath.h5", "flat.xyz", replace=True)
        self.assertNotEqual(pathlib.Path("bent.xyz").read_text(), pathlib.Path("flat.xyz").read_text())
        with self.assertRaisesRegex(insonify.Error, r"profile\[1\]"):
            insonify.export("swath.h5", "no.xyz", profile=[(0, 1470), (0, 1530)])

    def test_recordings_give_them_back(self):
        recording = insonify.open("swath.h5")
        self.assertEqual(recording.soundings.shape, (3, 40))
        for number, ping in enumerate(recording):
            wanted = self.simulator.ping("swath", number=number).soundings
            for given in (ping.soundings, recording.soundings[number], pickle.loads(pickle.dumps(ping)).soundings):
                self.assertEqual(given.tobytes(), wanted.tobytes())

    def test_batches_have_them(self):
        batch = self.simulator.ping_batch("swath", [(7, -3, 0), (7, -3, 1)])
        self.assertEqual(batch["soundings"].shape, (2, 40))
        self.assertGreater(np.diff(batch["soundings"]["range"], axis=0).mean(), 0.9)

    def test_other_sonars_have_none(self):
        ping = self.simulator.ping("ahead")
        self.assertIsNone(ping.soundings)
        self.assertEqual(ping.sounding_positions().shape, (0, 3))
        with insonify.Recording("ahead.h5", self.simulator, "ahead") as recording:
            recording.add(ping)
        self.assertIsNone(insonify.open("ahead.h5").soundings)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
