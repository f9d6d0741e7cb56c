"""Everything in the public headers of acoustics and similarity can be reached from Python.

    PYTHONPATH=build/dev/python tests/python/acoustics_test.py COMMAND_LINE SOURCE_FOLDER
"""

import pathlib
import re
import sys
import unittest

import numpy as np

import insonify
from insonify import acoustics

SOURCES = pathlib.Path()


def names_in(path):
    """Functions, constants (as Python writes them) and structs that a header declares outside of classes."""
    text = path.read_text()
    functions = set(re.findall(r"^\[\[nodiscard\]\] [\w:<>*& ]+?[ *&](\w+)\(", text, re.M))
    constants = {re.sub(r"(?<!^)(?=[A-Z])", "_", name[1:]).upper()
                 for name in re.findall(r"^inline constexpr \w+ (k\w+)", text, re.M)}
    structs = set(re.findall(r"^struct (\w+) \{", text, re.M))
    return functions, constants, structs


class AcousticsTest(unittest.TestCase):
    def test_nothing_in_the_headers_is_missing(self):
        headers = sorted((SOURCES / "include/insonify/acoustics").glob("*.h"))
        self.assertEqual(len(headers), 10)
        count = 0
        for header in headers:
            for name in set().union(*names_in(header)):
                self.assertTrue(hasattr(acoustics, name), f"{header.name}: {name}")
                count += 1
        self.assertGreater(count, 45)

    def test_rays_bend_as_in_cpp(self):
        water = acoustics.SoundSpeedProfile([(50, 1550), insonify.ProfilePoint(depth=150, sound_speed=1450)])
        there = water.at_distance(100, 0, 50)
        self.assertAlmostEqual(there.depth, 100.8335649435050052, 9)
        self.assertAlmostEqual(water.after_time(100, 0, there.time).distance, 50, 9)
        self.assertAlmostEqual(water.eigenray(100, there.depth, 50).launch_angle, 0, 9)
        self.assertIsNone(acoustics.SoundSpeedProfile([(0, 1520), (400, 1320)]).eigenray(20, 30, 1300))
        with self.assertRaisesRegex(insonify.Error, r"points\[1\]\.depth = 0 m must be greater than points\[0\]"):
            acoustics.SoundSpeedProfile([(0, 1500), (0, 1500)])

    def test_similarity_has_all_measures(self):
        functions, _, structs = names_in(SOURCES / "include/insonify/similarity.h")
        structs -= {"GreyPicture", "SimilarityOptions", "ControlSimilarities"}  # An array, arguments, a dict.
        for name in functions | structs | {"load_grey_picture"}:
            self.assertTrue(hasattr(insonify.similarity, name), name)
        self.assertGreater(len(functions), 9)

    def test_docstrings_tell_units(self):
        for name, function in vars(acoustics).items():
            if not name.startswith("_") and callable(function) and not isinstance(function, type):
                self.assertGreater(len(function.__doc__.splitlines()[-1]), 20, name)

    def test_arrays_are_mapped_element_by_element(self):
        frequencies = np.array([3e4, 2.5e5, 1.1e6])
        water = insonify.Water(temperature_c=4, salinity=30)
        np.testing.assert_array_equal(acoustics.absorption_db_per_m(frequencies, water),
                                      [acoustics.absorption_db_per_m(f, water) for f in frequencies])
        self.assertIsInstance(acoustics.absorption_db_per_m(3e4, water), float)
        grazing = np.radians([5, 20, 70])
        np.testing.assert_array_equal(acoustics.bottom_backscatter("fine_sand", grazing, 30e3),
                                      [acoustics.bottom_backscatter("fine_sand", g, 30e3) for g in grazing])
        sediment = acoustics.find_sediment("fine sand")
        self.assertEqual(acoustics.bottom_backscatter(sediment, 0.3, 3e4), acoustics.bottom_backscatter("fine_sand", 0.3, 3e4))
        np.testing.assert_allclose(acoustics.bottom_reflection(1.5, 1.1, 0.01, grazing),
                                   [acoustics.bottom_reflection(1.5, 1.1, 0.01, g) for g in grazing])

    def test_values_by_hand(self):
        # mu cos(60) cos(0) = 0.2 * 0.5
        self.assertAlmostEqual(acoustics.lambert_scatter(0.2, np.pi / 3, 0), 0.1)
        # Halfway between straight up and 60 degrees off is 30 degrees off.
        self.assertAlmostEqual(acoustics.half_vector_tilt((0, 0, 1), (0, 0, 1), (np.sin(np.pi / 3), 0, 0.5)), np.pi / 6)
        # s_v width 2 sin(height/2) (1/r1 - 1/r2) = 1e-6 * 0.1 * 2 * 0.5 * (1/10 - 1/20)
        self.assertAlmostEqual(acoustics.volume_reverberation_intensity(1e-6, 0.1, np.pi / 3, 10, 20), 5e-9, delta=1e-15)
        # Radius c0/(g cos 0) = 1500/0.016
        path = acoustics.bent_path(1500, 0.016, 0, 100)
        self.assertAlmostEqual(path.radius, 93750)
        self.assertAlmostEqual(abs(path.drop), 100**2 / 2 / 93750, delta=1e-5)
        self.assertAlmostEqual(acoustics.NEPER_PER_DECIBEL, np.log(10) / 20)
        self.assertEqual(acoustics.FAR_FIELD, np.inf)
        self.assertIsNone(acoustics.find_sediment("cheese"))
        self.assertIn("fine_sand", [one.name for one in acoustics.sediment_table()])

    def test_what_is_out_of_limits_is_refused(self):
        for call in (lambda: acoustics.bottom_backscatter("cheese", 0.3, 3e4), lambda: acoustics.lambert_scatter(-1, 0, 0),
                     lambda: acoustics.sediment_of_grain_size(12), lambda: acoustics.bent_path(1500, 0, 0, 1)):
            with self.assertRaises(insonify.Error):
                call()

    def test_materials_are_those_of_the_library(self):
        library = {one.name: one for one in insonify.material_library()}
        steel = library["steel"]
        # (Z2 - Z1)/(Z2 + Z1) with the impedance of sea water, 1026 * 1500.
        impedance = steel.density * steel.sound_speed
        if steel.reflection is None and steel.thickness is None:
            self.assertAlmostEqual(steel.reflection_at(5e5), (impedance - 1539000) / (impedance + 1539000))
        self.assertTrue(steel.source)
        scene = insonify.Scene()
        scene.add("plate", [[5, -1, -1], [5, 1, -1], [5, 1, 1]], [[0, 1, 2]], "steel", insonify.Pose.rpy((1, 0, 0)))
        sim = insonify.Simulator(insonify.Scenario(sonars=[insonify.SonarConfig()]), scene)
        self.assertIn("steel", [one.name for one in sim.scene.materials])
        np.testing.assert_allclose(sim.scene.triangles("plate"), [[[6, -1, -1], [6, 1, -1], [6, 1, 1]]], atol=1e-6)


if __name__ == "__main__":
    SOURCES = pathlib.Path(sys.argv[2])
    unittest.main(argv=["acoustics_test.py"])
