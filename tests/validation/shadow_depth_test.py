"""Measures of shadow_depth.py, on a floor whose level falls by 10 dB every 100 bins, with a shadow 20 dB deep."""

import unittest

import numpy as np

from shadow_depth import MEASURES, by_rows

BINS, BEAMS = 200, 80
FLOOR = np.repeat(10 ** (-np.arange(BINS) / 100), BEAMS).reshape(BINS, BEAMS)
DARK = np.zeros((BINS, BEAMS), bool)
DARK[120:160, 16:48] = True


def decibels(measure, intensity):
    return 10 * np.log10(MEASURES[measure](intensity, DARK, ~DARK))


class ShadowDepthTest(unittest.TestCase):
    def test_same_range_divides_out_how_the_floor_falls(self):
        self.assertAlmostEqual(decibels("same range", np.where(DARK, 0.01, 1) * FLOOR), -20)

    def test_same_beam_does_not(self):
        # Half of the lit bins are nearer than 80, half of the dark ones than 140: 6 dB on top.
        self.assertAlmostEqual(decibels("same beam", np.where(DARK, 0.01, 1) * FLOOR), -26)

    def test_as_recorded_is_that_of_the_darkest_eight_beams(self):
        depth = np.where(DARK, 0.01, 1.0)
        depth[:, 24:32] *= np.where(DARK[:, 24:32], 0.1, 1)
        self.assertAlmostEqual(decibels("as recorded", depth * FLOOR), -30)
        self.assertAlmostEqual(decibels("same range", depth * FLOOR), -20)

    def test_by_rows_counts_bright_cells_of_the_shadow_and_leaves_out_half_hidden_beams(self):
        shadow = np.where(DARK, 0.99, 0.0)
        shadow[120:160, 48:60] = 0.5
        intensity = np.where(shadow > 0.9, 0.01, 1) * FLOOR
        intensity[:, 48:60] *= 50
        self.assertAlmostEqual(10 * np.log10(by_rows(intensity, shadow)), -20)
        intensity[:, 20] = FLOOR[:, 20]  # One of 32 beams as loud as the floor: (31 * 0.01 + 1) / 32.
        self.assertAlmostEqual(by_rows(intensity, shadow), 1.31 / 32)


if __name__ == "__main__":
    unittest.main()
