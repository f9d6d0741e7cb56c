# survey_test.py -- insonify.survey over pings that are simulated here.

import math
import unittest

import numpy as np

import insonify
from insonify import survey

class SurveyTest(unittest.TestCase):
    def test_heights_by_hand(self):
        # Altitude 6 m, a post of 2 m at 8 m: foot at 10 m, top at sqrt(80) m, end of the shadow at sqrt(180) m.
        self.assertAlmostEqual(survey.height_from_shadow(6, 10, math.sqrt(180)), 2)
        np.testing.assert_allclose(survey.height_from_highlight(6, [math.sqrt(80)] * 2, math.sqrt(180)), [2, 2])
        self.assertAlmostEqual(survey.shadow_length(6, 2, 8), 4)
        self.assertEqual(survey.ground_range(5, 3), 4)

    def test_bad_input_is_refused(self):
        with self.assertRaisesRegex(insonify.Error, "altitude = 0 m must be greater than 0 m"):
            survey.ground_range(5, 0)
        with self.assertRaisesRegex(insonify.Error, "must hold at least one ping"):
            survey.track_bottom([])


if __name__ == "__main__":
    unittest.main()
