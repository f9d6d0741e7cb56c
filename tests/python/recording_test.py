"""The Python package: recordings and pictures.

    PYTHONPATH=build/dev/python tests/python/recording_test.py COMMAND_LINE SOURCE_FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import insonify
from kit import COMMAND_LINE, SOURCES, TEXT, floor_scene, simulator


class RecordingTest(unittest.TestCase):
    def test_python_and_the_command_line_write_the_same_bytes(self):
        scenario_file = SOURCES / "scenes/tank.yaml"
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([COMMAND_LINE, "run", scenario_file, "-q", "--no-pictures", "-o", folder], check=True)
            theirs = sorted(pathlib.Path(folder).glob("*.h5"))[0]
            sim = insonify.Simulator(insonify.Scenario.load(scenario_file))
            pings = len(insonify.open(theirs))
            with insonify.Recording(f"{folder}/ours.h5", sim, theirs.stem) as recording:
                for number in range(pings):
                    recording.add(sim.ping(theirs.stem, number=number))
            self.assertEqual(pathlib.Path(folder, "ours.h5").read_bytes(), theirs.read_bytes())

    def test_markers_of_an_operator_are_read(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/r.h5"
            sim = simulator()
            with insonify.Recording(path, sim) as recording:
                recording.add(sim.ping())
            self.assertEqual(insonify.open(path).markers, [])
            with h5py.File(path, "a") as file:
                file["markers"] = ['{"name": "wreck", "position": [1, 2, -3.5], "time": 4.5, "sonar": "fls", "ping": 9}',
                                   '{"name": "pipe", "position": [0, 0, 0], "time": 1, "sonar": "fish", "ping": 3, "range": 8.5, "side": "port"}']
            self.assertEqual(insonify.open(path).markers,
                             [{"name": "wreck", "position": (1.0, 2.0, -3.5), "time": 4.5, "sonar": "fls", "ping": 9},
                              {"name": "pipe", "position": (0.0, 0.0, 0.0), "time": 1.0, "sonar": "fish", "ping": 3, "range": 8.5, "side": "port"}])

    def test_the_scenario_told_is_the_one_that_was_run(self):
        import h5py

        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "s.yaml")
            path.write_text(TEXT)

            def told(change):
                scenario = insonify.Scenario.load(path)
                change(scenario)
                sim = insonify.Simulator(scenario, floor_scene())
                with insonify.Recording(f"{folder}/r.h5", sim, replace=True) as recording:
                    recording.add(sim.ping())
                with h5py.File(f"{folder}/r.h5") as file:
                    return file.attrs["scenario"]

            self.assertEqual(told(lambda scenario: None), TEXT)
            for change, text in (
                (lambda s: setattr(s, "seed", 5), "seed: 5"),
                (lambda s: setattr(s.water, "salinity", 3), "salinity: 3"),
                (lambda s: setattr(s.sonars[0], "gain", 1), None),
                (lambda s: setattr(s.sonars[0].sampling, "rows", 33), "rows: 33"),
            ):
                if text is None:
                    self.assertEqual(told(change), TEXT)
                else:
                    self.assertIn(text, told(change))
            copied = insonify.Scenario.load(path)
            copied.sonars[0].max_range = 7
            self.assertIn("max_range: 7", told(lambda s: setattr(s, "sonars", copied.copy().sonars)))

    def test_pings_come_back(self):
        sim = simulator()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "r.h5")
            made = [sim.ping() for _ in range(3)]
            with insonify.Recording(path, sim) as recording:
                for ping in made:
                    recording.add(ping)
            with self.assertRaisesRegex(insonify.Error, "r.h5"):
                insonify.Recording(path, sim)
            rec = insonify.open(path)
            self.assertEqual((rec.shape, len(rec), rec.sonar.name, rec.model), ((3, 40, 16), 3, "ahead", "calibrated"))
            np.testing.assert_array_equal(rec.intensity, [ping.intensity for ping in made])
            np.testing.assert_array_equal(rec[-1].intensity, made[2].intensity)
            self.assertEqual([ping.number for ping in rec], [0, 1, 2])
            self.assertEqual((rec[1].instance_names, rec[1].material_names), (["floor"], ["sand"]))
            np.testing.assert_array_equal(rec.ranges, rec.range)
            np.testing.assert_allclose(rec.azimuths, rec.azimuth)
            with self.assertRaises(IndexError):
                rec[3]
        with self.assertRaisesRegex(insonify.Error, "no such file"):
            insonify.open("nowhere.h5")


    def test_a_failed_with_keeps_the_earlier_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/r.h5"
            sim = simulator()
            with insonify.Recording(path, sim) as recording:
                recording.add(sim.ping())
                recording.add(sim.ping())
            with self.assertRaises(KeyError), insonify.Recording(path, sim, replace=True) as recording:
                recording.add(sim.ping())
                raise KeyError
            self.assertEqual(len(insonify.open(path)), 2)
            with self.assertRaisesRegex(insonify.Error, "closed"):
                recording.add(sim.ping())

    def test_a_preset_takes_a_sonar_s_place_but_not_its_name(self):
        sim = simulator()
        sim.set_sonar("ahead", insonify.SonarConfig.preset("teledyne-blueview-p900-130", max_range=9))
        self.assertEqual(sim.sonar("ahead").name, "ahead")
        self.assertEqual(sim.ping("ahead").intensity.shape[1], insonify.SonarConfig.preset("teledyne-blueview-p900-130").beam_count)

    def test_equal_settings_are_equal(self):
        one, other = insonify.Scenario.from_text(TEXT), insonify.Scenario.from_text("# A comment.\n" + TEXT)
        self.assertEqual(one, other)
        self.assertEqual(one.sonars, other.sonars)
        other.sonars[0].sampling.rows += 1
        self.assertNotEqual(one, other)
        self.assertNotEqual(one.sonars[0], other.sonars[0])
        self.assertNotEqual(insonify.SonarConfig(), insonify.Water())
        self.assertNotEqual(*insonify.material_library()[:2])
        self.assertEqual(insonify.Pose.rpy((1, 2, 3), (4, 5, 6)), insonify.Pose.rpy((1, 2, 3), (4, 5, 6)))
        self.assertNotEqual(insonify.Pose.rpy((1, 2, 3), (4, 5, 6)), insonify.Pose.rpy((1, 2, 3), (4, 5, 6.1)))
        with self.assertRaises(TypeError):
            hash(insonify.Pose())

    def test_angles_are_shown_as_they_were_given(self):
        self.assertIn("orientation_deg=(0.0, 15.0, -7.3)", repr(insonify.SonarConfig(orientation_deg=(0, 15, -7.3))))

    def test_pings_of_other_settings_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            sim, other = simulator(), simulator()
            further = other.sonar().copy()
            further.max_range = 11
            with insonify.Recording(f"{folder}/r.h5", sim) as recording:
                recording.add(other.ping())
                other.set_sonar(0, further)
                with self.assertRaisesRegex(insonify.Error, "ping 1 was made with other settings"):
                    recording.add(other.ping())
            for name in ("r.mcap", "r.foo", "r"):
                with self.assertRaisesRegex(insonify.Error, f"{name} must end in .h5 or .hdf5"):
                    insonify.Recording(f"{folder}/{name}", sim)


class PictureTest(unittest.TestCase):
    def test_fan_and_polar_are_those_of_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "s.yaml")
            pathlib.Path(folder, "floor.obj").write_text(
                "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n")
            path.write_text(TEXT.replace("world: none", "world: floor.obj").replace("pings: 3", "pings: 1"))
            for more in ([], ["--set", "model=paper"], ["--levels=-90:-40"]):
                subprocess.run([COMMAND_LINE, "run", path, "-q", "--force", "--no-view", "-o", folder, *more], check=True)
                scenario = insonify.Scenario.load(path, more[1:] if "--set" in more else [])
                ping = insonify.Simulator(scenario).ping()
                levels = (-90, -40) if "--levels=-90:-40" in more else None
                for kind, draw in (("fan", insonify.fan), ("polar", insonify.draw_polar)):
                    picture = draw(ping, levels=levels)
                    self.assertEqual((picture.dtype, picture.shape[0]), (np.uint8, 720))
                    insonify.write_png(f"{folder}/ours.png", picture)
                    self.assertEqual(pathlib.Path(folder, "ours.png").read_bytes(),
                                     pathlib.Path(folder, f"ahead_{kind}_0000.png").read_bytes(), (kind, more))

    def test_decibels(self):
        levels = insonify.to_db(np.array([1, 0.1, 0, np.nan, 1e-30]))
        np.testing.assert_allclose(levels, [0, -10, -200, np.nan, -200], atol=1e-5)
        ping = simulator().ping()
        np.testing.assert_array_equal(insonify.to_db(ping), insonify.to_db(ping.intensity))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
