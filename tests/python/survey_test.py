# survey_test.py -- insonify.survey over pings that are simulated here.

import math
import sys
import tempfile
import unittest

import numpy as np

import insonify
from insonify import survey
from kit import floor_scene


LINE = """
world: none
sonars:
  - {name: sss, type: sss, azimuth_aperture_deg: 1, elevation_aperture_deg: 70, elevation_pattern: rectangular,
     depression_deg: 40, max_range: 20, bin_count: 400, ping_period: 0.5}
trajectory:
  - {time: 0, position: [0, 0, 3]}
  - {time: 4, position: [4, 0, 3]}
pings: 9
"""


MULTIBEAM = """
world: none
receiver: {time_varied_gain: 30}
sonars:
  - {name: mb, type: mbes, frequency: 300.0e3, beam_count: 31, azimuth_aperture_deg: 90, azimuth_resolution_deg: 3,
     elevation_aperture_deg: 20, transmit_elevation_aperture_deg: 3, max_range: 12, bin_count: 400, ping_period: 0.25}
trajectory:
  - {time: 0, position: [0, 0, 3]}
  - {time: 4, position: [4, 0, 3]}
pings: 17
"""


class SurveyTest(unittest.TestCase):
    def test_heights_by_hand(self):
        # Altitude 6 m, a post of 2 m at 8 m: foot at 10 m, top at sqrt(80) m, end of the shadow at sqrt(180) m.
        self.assertAlmostEqual(survey.height_from_shadow(6, 10, math.sqrt(180)), 2)
        np.testing.assert_allclose(survey.height_from_highlight(6, [math.sqrt(80)] * 2, math.sqrt(180)), [2, 2])
        self.assertAlmostEqual(survey.shadow_length(6, 2, 8), 4)
        self.assertEqual(survey.ground_range(5, 3), 4)

    def test_a_line_over_a_level_bed(self):
        simulator = insonify.Simulator(insonify.Scenario.from_text(LINE), floor_scene())
        pings = [simulator.ping(number=number) for number in range(9)]
        # A running mean of the water column's end, in bins of 5 cm.
        track = survey.track_bottom(pings)
        np.testing.assert_allclose(track.altitude, 5, atol=0.2)
        self.assertEqual(track.side_range.shape, (9, 2))
        self.assertGreater(track.quality.min(), 0.3)
        self.assertAlmostEqual(survey.true_altitude(pings[0]), 5, delta=0.1)
        ground = survey.slant_to_ground(pings[0], 5, cell=0.5)
        self.assertEqual(ground.shape, (40, 2))
        # The last bin ends at sqrt(20^2 - 5^2) = 19.36 m.
        np.testing.assert_array_equal(np.isnan(ground[:, 0]), np.arange(40) > 38)
        # To 19.36 m on each side of 4 m of track, and cells that are touched count: at most one more at each edge.
        mosaic = survey.make_mosaic([pings], cell=0.5, altitudes=[5])
        seen = ~np.isnan(mosaic.intensity)
        self.assertAlmostEqual(seen.sum() * 0.25, 2 * 19.36 * 4.5, delta=30)
        self.assertEqual(set(np.unique(mosaic.line[seen])), {0})
        self.assertAlmostEqual(mosaic.north, 20, delta=0.7)

    def test_a_chart_of_a_level_floor(self):
        scene = floor_scene()
        simulator = insonify.Simulator(insonify.Scenario.from_text(MULTIBEAM), scene)
        pings = [simulator.ping(number=number) for number in range(17)]
        grid = survey.make_sounding_grid([pings[:9], pings[9:]], cell=1, scene=scene)
        known = grid.count > 0
        # Beams of 45 degrees to both sides, 5 m above the floor: 10 m x 4 m.
        self.assertAlmostEqual(known.sum(), 40, delta=22)
        np.testing.assert_array_equal(known, ~np.isnan(grid.height))
        np.testing.assert_allclose(grid.height[known], -2, atol=0.2)
        np.testing.assert_allclose(grid.truth[known], -2, atol=1e-6)
        self.assertEqual(grid.count.sum() + grid.refused, grid.given)
        errors = grid.errors(datum=8)
        self.assertEqual(errors.cells, known.sum())
        self.assertAlmostEqual(errors.mean, (grid.height[known] + 2).mean(), places=5)
        self.assertEqual(errors.order_1a, 1)
        with tempfile.TemporaryDirectory() as folder:
            grid.write(folder + "/a.npz", origin=(54, 8), datum=1)
            with np.load(folder + "/a.npz") as stored:
                np.testing.assert_allclose(stored["height"], grid.height - 1, atol=1e-6)
                np.testing.assert_array_equal(stored["count"], grid.count)
                self.assertEqual(stored["x"][0], grid.west + 0.5)
                self.assertEqual(stored["datum"], 1)
                np.testing.assert_array_equal(stored["origin"], (54, 8))
        shoal = survey.make_sounding_grid([pings], cell=1, method="shoal", outliers=0)
        self.assertTrue((shoal.height[known] >= grid.height[known] - 1e-6).all())
        self.assertIsNone(shoal.truth)
        self.assertIsNone(shoal.errors())
        phase = survey.make_sounding_grid([pings], cell=1, detection="phase")
        self.assertEqual(phase.left_out, sum((ping.soundings["detection"] == 1).sum() for ping in pings))
        with self.assertRaisesRegex(insonify.Error, "method = best must be one of mean, median, shoal"):
            survey.make_sounding_grid([pings], method="best")
        with self.assertRaisesRegex(insonify.Error, "there is no sounding to grid"):
            survey.make_sounding_grid([])

    def test_what_an_xtf_file_says(self):
        with tempfile.TemporaryDirectory() as folder:
            simulator = insonify.Simulator(insonify.Scenario.from_text(LINE), floor_scene())
            with insonify.Recording(folder + "/line.h5", simulator) as recording:
                for number in range(9):
                    recording.add(simulator.ping(number=number))
            self.assertIsNone(insonify.open(folder + "/line.h5").origin)
            insonify.export(folder + "/line.h5", folder + "/line.xtf", origin=(48.5, -68.8))
            line = insonify.open(folder + "/line.xtf")
            np.testing.assert_allclose(line.altitude, 5, atol=0.1)
            np.testing.assert_allclose(line.origin, (48.5, -68.8), atol=1e-9)
            self.assertEqual(insonify.compare(line, folder + "/line.xtf").ssim, 1)
            np.testing.assert_allclose(line.world_from_sonar[:, 0], 0.5 * np.arange(9), atol=1e-4)

    def test_bad_input_is_refused(self):
        with self.assertRaisesRegex(insonify.Error, "altitude = 0 m must be greater than 0 m"):
            survey.ground_range(5, 0)
        with self.assertRaisesRegex(insonify.Error, "must hold at least one ping"):
            survey.track_bottom([])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
