"""The Python package: scenarios and their settings, errors, help.

    PYTHONPATH=build/dev/python tests/python/config_test.py COMMAND_LINE SOURCE_FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

import insonify
from kit import COMMAND_LINE, TEXT


class ConfigTest(unittest.TestCase):
    def test_every_key_of_files_is_an_attribute(self):
        sections = {"scenario": insonify.Scenario, "sonars": insonify.SonarConfig, "water": insonify.Water,
                    "profile": insonify.ProfilePoint,
                    "receiver": insonify.ReceiverConfig, "sampling": insonify.Sampling, "paper": insonify.PaperModel,
                    "materials": insonify.MaterialOverride, "points": insonify.PointTarget,
                    "interferers": insonify.Interferer, "thrusters": insonify.Thruster,
                    "surface": insonify.SeaSurface,
                    "pattern": insonify.SurveyPattern, "lines": insonify.SurveyLines,
                    "motion_noise": insonify.MotionNoise, "ping_spans": insonify.PingSpan,
                    "trajectory": insonify.Waypoint, "motions": insonify.Motion, "view": insonify.ViewConfig}
        told = subprocess.run([COMMAND_LINE, "describe", "--markdown"], capture_output=True, text=True, check=True).stdout
        section, count = None, 0
        for line in told.splitlines():
            if line.startswith("## "):
                section = sections.get(line[3:].strip().strip("`"))
            elif section is not None and line.startswith("| <a id="):
                key = line.split("`")[1]
                if key in ("preset", "mode") or key.endswith("_wxyz"):
                    continue  # SonarConfig.preset(); Pose has quaternions.
                self.assertTrue(hasattr(section, key), f"{section.__name__}.{key}")
                count += 1
        self.assertGreater(count, 80)

    def test_angles_have_two_names(self):
        sonar = insonify.SonarConfig(azimuth_aperture_deg=90)
        self.assertAlmostEqual(sonar.azimuth_aperture, np.pi / 2)
        sonar.azimuth_aperture = np.pi / 4
        self.assertAlmostEqual(sonar.azimuth_aperture_deg, 45)

    def test_values_out_of_limits_are_refused_at_once(self):
        sonar = insonify.SonarConfig()
        with self.assertRaisesRegex(insonify.Error, r"^max_range = -2 m must be greater than 0, at most 100000 m$"):
            sonar.max_range = -2
        self.assertEqual(sonar.max_range, 50)
        for value in ("12", None, [1], True):
            with self.assertRaises(insonify.Error):
                sonar.max_range = value
        with self.assertRaisesRegex(insonify.Error, "type = 'flx' must be fls, msis"):
            sonar.type = "flx"
        with self.assertRaises(AttributeError):
            sonar.max_rnage = 3
        with self.assertRaisesRegex(TypeError, "SonarConfig has no field 'max_rnage'"):
            insonify.SonarConfig(max_rnage=3)

    def test_indices_are_whole_numbers(self):
        sonar = insonify.SonarConfig(missing_beams=[3, np.int64(7)])
        self.assertEqual(repr(sonar.missing_beams), "(3, 7)")
        for value, told in (([3, 2.5], r"^missing_beams\[1\] = 2.5 must be a whole number$"),
                            ([True], r"^missing_beams\[0\] = True must be a whole number$"),
                            ([4096], r"^missing_beams\[0\] = 4096 must be from 0 to 4095$"),
                            ([-1], r"^missing_beams\[0\] = -1 must be from 0 to 4095$"),
                            (3, "^missing_beams = 3 must be a list of whole numbers$")):
            with self.assertRaisesRegex(insonify.Error, told):
                sonar.missing_beams = value
        self.assertEqual(sonar.missing_beams, (3, 7))
        sonar.beam_count = 5
        with self.assertRaisesRegex(insonify.Error, r"missing_beams\[1\] = 7 must be less than beam_count = 5$"):
            sonar.validate()
        self.assertEqual(repr(insonify.ReceiverConfig(dead_elements=[2]).dead_elements), "(2,)")

    def test_parts_are_objects_of_their_own(self):
        scenario = insonify.Scenario.from_text(TEXT)
        sonar = scenario.sonars[0]
        sonar.max_range = 9
        scenario.sonars.append(insonify.SonarConfig(name="second"))
        scenario.sonars += [insonify.SonarConfig(name=f"more_{i}") for i in range(50)]
        self.assertEqual(scenario.sonars[0].max_range, 9)
        sonar.bin_count = 30
        self.assertIn("bin_count: 30", scenario.to_yaml())
        scenario.surface = insonify.SeaSurface(level=4)
        self.assertIn("level: 4", scenario.to_yaml())
        scenario.surface = None
        self.assertNotIn("level: 4", scenario.to_yaml())
        scenario.materials["hull"] = "steel"
        self.assertIn("steel", scenario.to_yaml())
        scenario.sonars.append(3)
        with self.assertRaisesRegex(insonify.Error, r"sonars\[52\] = 3 must be a SonarConfig or a dict of its fields$"):
            scenario.to_yaml()
        with self.assertRaisesRegex(insonify.Error, "must be a list"):
            scenario.sonars = 5

    def test_copies_are_whole(self):
        scenario = insonify.Scenario.from_text(TEXT)
        other = scenario.copy()
        other.sonars[0].max_range = 5
        other.water.salinity = 0
        self.assertEqual((scenario.sonars[0].max_range, scenario.water.salinity), (12, 35))

    def test_text_and_dict_and_file_are_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "s.yaml")
            path.write_text(TEXT)
            loaded = insonify.Scenario.load(path, ["pings=7"])
        self.assertEqual(loaded.pings, 7)
        loaded.pings = 3
        text = insonify.Scenario.from_text(TEXT)
        self.assertEqual(loaded.to_yaml(), text.to_yaml())
        made = insonify.Scenario.from_dict(
            {"world": "none", "pings": 3,
             "sonars": [{"name": "ahead", "beam_count": 16, "bin_count": 40, "max_range": 12,
                         "orientation_deg": [0, 20, 0], "sampling": {"columns_per_beam": 2, "rows": 20}}],
             "trajectory": [{"time": 0, "position": [0, 0, 0]}, {"time": 10, "position": [5, 0, 0]}]})
        self.assertEqual(made.to_yaml(), text.to_yaml())

    def test_dicts_stand_for_structs(self):
        made = insonify.Scenario(sonars=[{"preset": "tritech-gemini-720i", "max_range": 12, "sampling": {"rows": 20}}],
                                 water={"salinity": 0}, materials={"hull": {"like": "steel", "density": 7000}, "net": "rubber"},
                                 surface={"level": 3})
        self.assertEqual(made.sonars[0], insonify.SonarConfig.preset("tritech-gemini-720i", max_range=12,
                                                                     sampling=insonify.Sampling(rows=20)))
        self.assertEqual((made.water.salinity, made.materials["hull"].density, made.surface.level), (0, 7000, 3))
        made.sonars.append({"name": "second", "max_range": 3})
        for none in (None, "none", ""):  # As in files.
            self.assertEqual(insonify.Scenario(world=none, points=[{"position": (5, 0, 0)}]).world, "")
        self.assertEqual(insonify.Scenario(world="floor.obj").world, "floor.obj")
        self.assertIn('name: "second"', made.to_yaml())
        self.assertEqual(insonify.acoustics.absorption_db_per_m(7e5, {"salinity": 0}),
                         insonify.acoustics.absorption_db_per_m(7e5, insonify.Water(salinity=0)))
        for fields, told in (({"sonars": [{"max_rnage": 3}]}, "sonars[0]: SonarConfig has no field 'max_rnage'; did you mean max_range?"),
                             ({"sonars": [{}, {"max_range": -3}]},
                              "sonars[1].max_range = -3 m must be greater than 0, at most 100000 m"),
                             ({"sonars": [{"sampling": {"rows": 1}}]}, "sonars[0].sampling.rows = 1 must be from 2 to 8192"),
                             ({"materials": {"hull": {"density": "x"}}}, "materials.hull.density = 'x' must be a number"),
                             ({"water": 3}, "water = 3 must be a Water or a dict of its fields")):
            with self.assertRaises(insonify.Error) as caught:
                insonify.Scenario(**fields)
            self.assertEqual(str(caught.exception), told)

    def test_a_simulator_takes_what_describes_a_scenario(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "s.yaml")
            path.write_text(TEXT.replace("world: none", "world: floor.obj"))
            floor = pathlib.Path(folder, "floor.obj")
            floor.write_text("v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nf 1 2 3\n")
            expected = insonify.Simulator(insonify.Scenario.load(path)).ping().intensity
            self.assertGreater(np.count_nonzero(expected), 0)
            settings = {"max_range": 12, "sonars[0].name": "ahead"}
            for given in ((str(path),), (path,), (insonify.load(path),), (insonify.load(path, settings),),
                          (TEXT and insonify.Scenario.from_text(TEXT), floor)):
                np.testing.assert_array_equal(insonify.Simulator(*given).ping().intensity, expected)
        sonar = {"preset": "tritech-gemini-720i", "max_range": 12, "beam_count": 16}
        points = [{"position": [8, 0.5, 0], "target_strength_db": -10}]
        scene = insonify.Scene()
        scene.sphere(radius=1, pose=(8, 0, 0))
        for given in (({"world": "none", "sonars": [sonar], "points": points},), ({"sonars": [sonar]}, scene), (insonify.SonarConfig(**sonar), scene)):
            self.assertEqual(insonify.Simulator(*given).ping().shape, (1000, 16))

    # The settings of a simulator's sonar are filled in; those that follow from its range must not stay as they were.
    def test_what_follows_from_the_range_of_a_copy_follows_it(self):
        def settings(**sonar):
            given = insonify.Scenario.from_dict({"water": {"temperature_c": 4}, "sonars": [{"name": "fls", **sonar}],
                                                 "points": [{"position": [8, 0.5, 0], "target_strength_db": -10}]})
            return insonify.Simulator(given).sonar()

        longer, narrower = {"max_range": 4.5}, {"max_range": 3.0, "min_range": 0.9}
        for one, new in (({"preset": "tritech-gemini-720i"}, longer), ({"preset": "tritech-gemini-720i"}, narrower),
                         ({"preset": "blueprint-oculus-m750d", "mode": "high"}, longer), ({}, narrower),
                         ({"preset": "soundmetrics-aris-explorer-3000"}, longer), ({"preset": "bluerobotics-ping360"}, narrower),
                         ({"preset": "tritech-gemini-720i", "bin_count": 200}, longer), ({"ping_period": 0.5}, longer)):
            with self.subTest(sonar=one, range=new):
                wanted, before = settings(**one, **new), settings(**one, max_range=2.5)
                self.assertEqual(before.copy(**new), wanted)
                step = before.copy()
                for name, value in new.items():
                    setattr(step, name, value)
                self.assertEqual(step, wanted)
        sim = insonify.Simulator({"world": "none", "points": [{"position": [8, 0.5, 0], "target_strength_db": -10}],
                                  "sonars": [{"preset": "tritech-gemini-720i", "max_range": 15}]})
        sim.set_sonar(max_range=30)
        self.assertEqual((sim.sonar().max_range, sim.ping().shape), (30, (1000, 256)))
        sim.set_sonar(0, {"max_range": 2})
        self.assertEqual((sim.sonar().max_range, sim.ping().sonar.bin_count), (2, sim.sonar().bin_count))
        self.assertLess(sim.sonar().bin_count, 1000)

    def test_presets(self):
        self.assertEqual(list(insonify.presets()), insonify.preset_names())
        self.assertEqual(insonify.presets()["tritech-micron-dst"].max_range, 75)
        self.assertEqual(insonify.materials()["steel"].density, 7850)
        self.assertIn("tritech-gemini-720i", insonify.preset_names())
        sonar = insonify.SonarConfig.preset("tritech-gemini-720i", max_range=20)
        self.assertEqual((sonar.beam_count, sonar.max_range), (256, 20))
        with self.assertRaisesRegex(insonify.Error, "did you mean tritech-gemini-720i"):
            insonify.SonarConfig.preset("gemini")


class ErrorTest(unittest.TestCase):
    def test_says_file_line_and_field(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "wrong.yaml")
            path.write_text("world: none\nsonars:\n  - {max_range: -3}\npoints: [{position: [1, 0, 0]}]\n")
            with self.assertRaises(insonify.Error) as caught:
                insonify.Scenario.load(path)
            error = caught.exception
            told = subprocess.run([COMMAND_LINE, "run", path], capture_output=True, text=True).stderr
        self.assertEqual((error.file, error.line, error.object, error.field), (str(path), 3, "sonars[0]", "max_range"))
        self.assertEqual(f"insonify: {error}\n", told)
        self.assertIsInstance(error, ValueError)

    def test_warnings_are_pythons(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            insonify.Scenario.from_text(TEXT, settings=["receiver.pulse_bandwidth=3e5"])
        self.assertEqual([str(w.message) for w in caught],
                         ["--set receiver.pulse_bandwidth=3e5: receiver.pulse_bandwidth has no effect unless pulse is lfm"])
        self.assertTrue(issubclass(caught[0].category, insonify.Warning))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(insonify.Warning):
                insonify.Scenario.from_text(TEXT, settings=["receiver.pulse_bandwidth=3e5"])


class HelpTest(unittest.TestCase):
    def test_tells_units_limits_and_defaults(self):
        text = insonify.SonarConfig.max_range.__doc__
        self.assertEqual(text, "Far edge of the last bin. [m, greater than 0, at most 100000, default 50]")
        self.assertIn("default 120]", insonify.SonarConfig.azimuth_aperture_deg.__doc__)
        self.assertIn("one of fls, msis", insonify.SonarConfig.type.__doc__)
        for name in insonify.__all__:
            self.assertTrue(getattr(insonify, name).__doc__, name)

    def test_version(self):
        told = subprocess.run([COMMAND_LINE, "version"], capture_output=True, text=True, check=True).stdout
        self.assertIn(insonify.__version__, told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
