"""Arguments of another kind are named with their value; spellings and names that are given twice are told of.

    PYTHONPATH=build/dev/python tests/python/arguments_test.py INSONIFY_PROGRAM SOURCE_FOLDER
"""

import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np

import insonify
from insonify import acoustics

TEXT = """
seed: 5
points: [{position: [8, 0.5, 0], target_strength_db: -10}]
sonars:
  - {name: fls, bin_count: 40, beam_count: 16, max_range: 12, ping_period: 0.1, azimuth_aperture_deg: 60}
  - {name: aft, bin_count: 30, beam_count: 8, max_range: 12, ping_period: 0.1}
"""
CORNERS = [[7, -4, -3], [7, 4, -3], [7, 4, 3], [7, -4, 3]]
FACES = [[0, 1, 2], [0, 2, 3]]


def simulator():
    return insonify.Simulator(insonify.Scenario.from_text(TEXT))


class ArgumentsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(scratch.name)

    def message(self, act, kind=insonify.Error):
        with self.assertRaises(kind) as caught:
            act()
        return str(caught.exception)

    def test_nothing_can_be_moved_in_an_empty_world(self):
        self.assertEqual(self.message(lambda: simulator().ping("fls", moved={"x": np.eye(4)})),
                         "ping 0 of fls: moved[0].name = x is not in the world; there are none")

    def test_a_wrong_value_is_told_of_before_what_is_missing(self):
        self.assertIn("sonars[0].max_range = -3 m must be", self.message(
            lambda: insonify.Scenario.from_text("sonars: [{max_range: -3}]")))
        self.assertIn("world is missing", self.message(lambda: insonify.Scenario.from_text("sonars: [{max_range: 3}]")))

    def test_pictures_are_png_files(self):
        picture = insonify.fan(simulator().ping())
        insonify.write_png("a.PNG", picture)
        self.assertEqual(pathlib.Path("a.PNG").read_bytes()[:4], b"\x89PNG")
        for name in ("a.jpg", "a", "png"):
            self.assertEqual(self.message(lambda: insonify.write_png(name, picture)), f"path = {name} must end in .png")
            self.assertFalse(pathlib.Path(name).exists())

    def test_faces_may_be_of_any_kind_of_whole_number(self):
        expected = insonify.Scene()
        expected.add("wall", CORNERS, FACES)
        for kind in (np.uint64, np.int16, np.uint8):
            scene = insonify.Scene()
            scene.add("wall", CORNERS, np.array(FACES, kind))
            np.testing.assert_array_equal(scene.triangles("wall"), expected.triangles("wall"))
        self.assertEqual(
            self.message(lambda: insonify.Scene().add("wall", CORNERS, np.array([[0, 1, 2**64 - 1]], np.uint64))),
            "faces[0][2] = 9223372036854775807 must be from 0 to 3, the last vertex")

    def test_the_colour_map_has_both_spellings(self):
        ping = simulator().ping()
        for draw in (insonify.fan, insonify.draw_polar):
            grey = draw(ping, color_map="grey")
            np.testing.assert_array_equal(grey, draw(ping, colour_map="grey"))
            self.assertGreater(np.count_nonzero(grey != draw(ping)), 0)
            np.testing.assert_array_equal(draw(ping, colour_map="inferno"), draw(ping))
            self.assertEqual(self.message(lambda: draw(ping, colour_map="grey", color_map="grey")),
                             "colour_map is given twice: color_map is the same")
        with insonify.Recording("a.h5", simulator()) as recording:
            recording.add(ping)
        insonify.export("a.h5", "british.mcap", colour_map="grey", levels=(-100, 0))
        insonify.export("a.h5", "american.mcap", color_map="grey", levels=(-100, 0))
        self.assertEqual(pathlib.Path("british.mcap").read_bytes(), pathlib.Path("american.mcap").read_bytes())
        self.assertEqual(self.message(lambda: insonify.export("a.h5", "b.mcap", colour_map="grey", color_map="grey")),
                         "colour_map is given twice: color_map is the same")

    def test_functions_name_the_argument(self):
        ping = simulator().ping()
        for act, message in ((lambda: insonify.fan(ping, height=1e9), "height = 1000000000.0 must be a whole number"),
                             (lambda: insonify.fan(ping, annotations=1), "annotations = 1 must be True or False"),
                             (lambda: insonify.draw_polar(ping, scale=3), "scale = 3 must be text"),
                             (lambda: insonify.draw_polar(ping, color_map=3), "color_map = 3 must be text")):
            self.assertEqual(self.message(act), message)
        self.assertEqual(
            self.message(lambda: simulator().ping(foo=1), TypeError),
            "ping() has no argument 'foo'; it takes sonar, pose, time, number, twist, moved and head_angle")
        self.assertEqual(self.message(lambda: insonify.fan(ping, cmap="grey"), TypeError),
                         "draw_fan() got an unexpected keyword argument 'cmap'")

    def test_small_pictures_are_averages_without_letters(self):
        ping = simulator().ping()
        large = insonify.fan(ping, height=240, annotations=False).astype(float)
        small = insonify.fan(ping, height=80)
        self.assertEqual(small.shape, (80, large.shape[1] // 3, 3))
        self.assertEqual(small[40, 20].tolist(), np.rint(large[120:123, 60:63].mean(axis=(0, 1))).tolist())
        for options, message in (({"height": 15}, "height = 15 pixels must be from 16 to 8192 pixels"),
                                 ({"height": 100, "annotations": True},
                                  "annotations need a height of at least 240 pixels, not 100")):
            self.assertEqual(self.message(lambda: insonify.draw_polar(ping, **options)), message)

    def test_grey_pictures_and_notebooks(self):
        grey = np.arange(12, dtype=np.uint8).reshape(3, 4) * 20
        insonify.write_png("grey.png", grey)
        insonify.write_png("rgb.png", np.repeat(grey[:, :, None], 3, axis=2))
        self.assertEqual(pathlib.Path("grey.png").read_bytes(), pathlib.Path("rgb.png").read_bytes())
        shown = simulator().ping()._repr_png_()
        self.assertEqual((shown[:4], int.from_bytes(shown[20:24], "big")), (b"\x89PNG", 480))

    def test_formulas_name_the_argument(self):
        kinds = " must be a number or an array of numbers"
        for act, message in (
                (lambda: acoustics.mackenzie_sound_speed(10, "x", 0), "salinity = 'x'" + kinds),
                (lambda: acoustics.mackenzie_sound_speed([[10], [3, 4]], 35, 0), "temperature_c = [[10], [3, 4]]" + kinds),
                (lambda: acoustics.transmission_loss_db(10, absorption_db_per_m=None), "absorption_db_per_m = None" + kinds),
                (lambda: acoustics.plate_reflection(1j, 2, 3, 4, 5), "water_impedance = 1j" + kinds),
                (lambda: acoustics.absorption_db_per_m("x", insonify.Water()), "frequency = 'x'" + kinds),
                (lambda: acoustics.bottom_backscatter("rock", 1, "x"), "frequency = 'x'" + kinds),
                (lambda: acoustics.mackenzie_sound_speed(np.zeros(3), np.zeros((4, 2)), 0),
                 "the shapes of the arrays do not fit together: temperature_c (3,), salinity (4, 2)"),
                (lambda: acoustics.bottom_backscatter("rock", np.ones(3), np.full(4, 3e4)),
                 "the shapes of the arrays do not fit together: grazing (3,), frequency (4,)")):
            self.assertEqual(self.message(act), message)
        speeds = acoustics.mackenzie_sound_speed(np.array([[4], [10], [17]]), [30, 35], np.float32(20))
        self.assertEqual(speeds.shape, (3, 2))
        self.assertEqual(speeds[2, 1], acoustics.mackenzie_sound_speed(17, 35, 20))
        self.assertIsInstance(acoustics.mackenzie_sound_speed(17, 35, 20), float)

    def test_fields_are_given_once_and_by_their_names(self):
        self.assertEqual(self.message(lambda: insonify.SonarConfig(azimuth_aperture=1, azimuth_aperture_deg=90)),
                         "azimuth_aperture is given twice: in radians, and in degrees as azimuth_aperture_deg")
        self.assertEqual(insonify.SonarConfig(preset="tritech-gemini-1200ik", mode="high", max_range=12),
                         insonify.SonarConfig.preset("tritech-gemini-1200ik", "high", max_range=12))
        self.assertEqual(self.message(lambda: insonify.SonarConfig(mode="high")), "mode belongs to a preset, and none is named")
        self.assertEqual(self.message(lambda: insonify.SonarConfig(copy=1), TypeError), "SonarConfig has no field 'copy'")
        self.assertEqual(self.message(lambda: insonify.Water(preset=1), TypeError), "Water has no field 'preset'")
        rule = "sonar.name must not be empty, start with '.' or hold a slash, a backslash or a control character"
        self.assertEqual(self.message(lambda: insonify.SonarConfig(name="")), rule)
        sonar = insonify.SonarConfig(name="čeština 2")
        self.assertEqual(self.message(lambda: setattr(sonar, "name", "a/b")), rule)
        self.assertEqual(sonar.name, "čeština 2")

    def test_a_sonar_keeps_its_name(self):
        sim = simulator()
        sonar = sim.sonar("aft").copy()
        sonar.max_range = 9
        self.assertEqual(self.message(lambda: sim.set_sonar(0, sonar)), "config.name = aft cannot be set: the sonar stays fls")
        self.assertEqual(sim.sonar(0).max_range, 12)
        sim.set_sonar(0, insonify.SonarConfig(max_range=7))  # Has no name but the default's.
        self.assertEqual((sim.sonar(0).name, sim.sonar(0).max_range), ("fls", 7))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
