"""The Python package: pings as arrays, poses, batches, errors, recordings and pictures.

    PYTHONPATH=build/dev/python tests/python/package_test.py COMMAND_LINE SOURCE_FOLDER
"""

import gc
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import insonify

COMMAND_LINE, SOURCES = "", pathlib.Path()

FLOOR = {"vertices": [[-20, -20, -2], [20, -20, -2], [20, 20, -2], [-20, 20, -2]], "faces": [[0, 1, 2], [0, 2, 3]]}
TEXT = """
world: none
pings: 3
sonars:
  - {name: ahead, beam_count: 16, bin_count: 40, max_range: 12, orientation_deg: [0, 20, 0],
     sampling: {columns_per_beam: 2, rows: 20}}
trajectory:
  - {time: 0, position: [0, 0, 0]}
  - {time: 10, position: [5, 0, 0]}
"""


def floor_scene():
    scene = insonify.Scene()
    scene.add("floor", np.array(FLOOR["vertices"], dtype=float), np.array(FLOOR["faces"]), material="sand")
    return scene


def simulator(**changes):
    scenario = insonify.Scenario.from_text(TEXT)
    for name, value in changes.items():
        setattr(scenario, name, value)
    return insonify.Simulator(scenario, floor_scene())


class ConfigTest(unittest.TestCase):
    def test_every_key_of_files_is_an_attribute(self):
        sections = {"scenario": insonify.Scenario, "sonars": insonify.SonarConfig, "water": insonify.Water,
                    "receiver": insonify.ReceiverConfig, "sampling": insonify.Sampling, "paper": insonify.PaperModel,
                    "materials": insonify.MaterialOverride, "points": insonify.PointTarget,
                    "interferers": insonify.Interferer, "surface": insonify.SeaSurface,
                    "trajectory": insonify.Waypoint, "motions": insonify.Motion, "view": insonify.ViewConfig}
        told = subprocess.run([COMMAND_LINE, "describe", "--markdown"], capture_output=True, text=True, check=True).stdout
        section, count = None, 0
        for line in told.splitlines():
            if line.startswith("## "):
                section = sections.get(line[3:].strip().strip("`"))
            elif section is not None and line.startswith("| `"):
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
        with self.assertRaisesRegex(insonify.Error, r"sonars\[52\] = 3 must be a SonarConfig"):
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

    def test_presets(self):
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


class PingTest(unittest.TestCase):
    def test_tables_share_the_pings_memory_and_keep_it_alive(self):
        ping = simulator().ping("ahead")
        intensity, instance = ping.intensity, ping.instance
        self.assertEqual((intensity.shape, intensity.dtype, instance.dtype), ((40, 16), np.float32, np.uint16))
        self.assertTrue(np.shares_memory(intensity, ping.intensity))
        self.assertFalse(intensity.flags.owndata)
        kept = intensity.copy()
        del ping
        gc.collect()
        np.testing.assert_array_equal(intensity, kept)
        self.assertGreater(np.count_nonzero(instance != insonify.NO_LABEL), 0)

    def test_layers_are_there_when_they_are_asked_for(self):
        ping = simulator().ping()
        self.assertIsNone(ping.field)
        self.assertIsNone(ping.shadow)
        sim = simulator(ground_truth="full", receiver=insonify.ReceiverConfig(field=True, speckle=True, counts=True, full_scale_db=-40))
        ping = sim.ping()
        self.assertEqual(ping.field.dtype, np.complex64)
        np.testing.assert_allclose(np.abs(ping.field) ** 2, ping.intensity, rtol=1e-5)
        self.assertEqual(ping.strongest_share.ndim, 3)
        self.assertEqual(ping.counts.dtype, np.uint16)

    def test_poses_have_three_forms(self):
        sim = simulator()
        matrix = np.eye(4)
        matrix[:3, 3] = (1, 2, 0.5)
        pings = [sim.ping("ahead", pose, number=0) for pose in
                 (matrix, ((1, 2, 0.5), (1, 0, 0, 0)), insonify.Pose.rpy((1, 2, 0.5)))]
        for ping in pings[1:]:
            np.testing.assert_array_equal(ping.intensity, pings[0].intensity)
        self.assertEqual(pings[0].pose.position, (1, 2, 0.5))

    def test_without_a_pose_it_is_the_scenarios(self):
        sim = simulator()
        second = [sim.ping(), sim.ping()][1]
        self.assertEqual(second.number, 1)
        self.assertAlmostEqual(second.time, sim.sonar().ping_period)
        self.assertEqual(sim.ping(time=4.0, number=0).pose.position, (2, 0, 0))
        self.assertEqual(sim.ping(number=1).intensity.tobytes(), second.intensity.tobytes())

    def test_what_is_no_whole_number_is_refused(self):
        scenario, sim = insonify.Scenario.from_text(TEXT), simulator()
        for value in (1.5, "x", None, [], np.float64(3), 10**30):
            for act in (lambda: setattr(scenario, "seed", value), lambda: setattr(scenario.sonars[0], "beam_count", value),
                        lambda: insonify.SonarConfig(bin_count=value), lambda: sim.sonar(value) if value != "x" else sim.ping(number=value)):
                with self.assertRaises(insonify.Error):
                    act()
        self.assertEqual(sim.ping(number=np.int64(7)).number, 7)
        with self.assertRaises(insonify.Error):
            sim.ping(number=50, head_angle=1)  # A sonar without a head.
        self.assertEqual(sim.ping().number, 8)  # A refused ping counts for nothing.

    def test_threads_share_the_numbers_of_pings(self):
        sim, numbers = simulator(), []
        threads = [threading.Thread(target=lambda: numbers.extend(sim.ping().number for _ in range(10))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(numbers), list(range(40)))
        with self.assertRaises(insonify.Error):
            sim.ping(time=1e30)
        self.assertEqual(sim.ping().number, 40)

    def test_a_request_is_what_keywords_say(self):
        sim = simulator()
        request = insonify.PingRequest(((1, 2, 0.5), (1, 0, 0, 0)), number=3)
        by_keywords = sim.ping("ahead", ((1, 2, 0.5), (1, 0, 0, 0)), number=3)
        self.assertEqual(sim.ping("ahead", request).intensity.tobytes(), by_keywords.intensity.tobytes())
        request.number = 4
        together = sim.ping_batch("ahead", [insonify.PingRequest(request.pose, number=3), request])
        self.assertEqual(together["intensity"][0].tobytes(), by_keywords.intensity.tobytes())
        self.assertEqual(together["intensity"][1].tobytes(), sim.ping("ahead", request).intensity.tobytes())
        with self.assertRaisesRegex(insonify.Error, "number is given twice"):
            sim.ping("ahead", request, number=5)

    def test_a_time_has_the_trajectorys_motion(self):
        turning = [insonify.Waypoint(time=0), insonify.Waypoint(time=1, orientation_deg=(0, 0, 170))]
        sim = simulator(motion_in_ping=True, trajectory=turning)
        period = sim.sonar().ping_period
        usual = sim.ping(number=5)
        np.testing.assert_array_equal(sim.ping(number=5, time=5 * period).intensity, usual.intensity)
        resting = sim.ping(number=5, time=5 * period, pose=usual.pose)
        self.assertGreater(np.abs(insonify.to_db(resting.intensity) - insonify.to_db(usual.intensity)).max(), 0)

    def test_two_sonars_count_for_themselves(self):
        scenario = insonify.Scenario.from_text(TEXT)
        own = insonify.ReceiverConfig(speckle=False, noise=False, pulse="cw", pulse_duration=2e-4)
        scenario.sonars.append(insonify.SonarConfig(name="astern", type="msis", beam_count=1, bin_count=7, max_range=6,
                                                    azimuth_aperture_deg=3, step_deg=9, orientation_deg=(0, 30, 180),
                                                    receiver=own))
        scenario.surface = insonify.SeaSurface(level=3, wind_speed=5)
        sim = insonify.Simulator(scenario, floor_scene())
        self.assertEqual([sim.ping("ahead").number, sim.ping("ahead").number, sim.ping("astern").number], [0, 1, 0])
        turned = sim.ping("astern")
        self.assertEqual((turned.number, turned.shape), (1, (7, 1)))
        self.assertAlmostEqual(np.degrees(turned.head_angle), 9)
        self.assertEqual(turned.sonar.receiver.pulse, "cw")
        aside = sim.ping("astern", head_angle=0.5)
        self.assertEqual((aside.number, aside.head_angle), (2, 0.5))
        with self.assertRaisesRegex(insonify.Error, "belongs to a scanning sonar"):
            sim.ping("ahead", head_angle=0.5)
        with self.assertRaisesRegex(insonify.Error, "above|below"):
            sim.ping("ahead", pose=insonify.Pose.rpy((0, 0, 4)))

    def test_a_simulator_changes_while_another_thread_pings(self):
        sim = simulator()
        shapes, failures = set(), []

        def ping():
            try:
                for _ in range(60):
                    made = sim.ping()
                    shapes.add((made.shape, (made.sonar.bin_count, made.sonar.beam_count)))
            except Exception as error:  # pylint: disable=broad-except
                failures.append(error)

        threads = [threading.Thread(target=ping) for _ in range(2)]
        for thread in threads:
            thread.start()
        for number in range(30):
            sonar = sim.scenario.sonars[0].copy()
            sonar.bin_count = 30 + number % 2 * 10
            sim.set_sonar(0, sonar)
            sim.instance_names  # pylint: disable=pointless-statement
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])
        for shape, told in shapes:
            self.assertEqual(shape, told)

    def test_wrong_arguments_are_told_of(self):
        sim = simulator()
        for arguments, text in (
                ({"sonar": "astern"}, "sonar = 'astern' is not there; there are ahead"),
                ({"sonar": 4}, "sonar = 4 must be from 0 to 0"),
                ({"pose": "here"}, "pose = 'here' must be a 4 x 4 matrix"),
                ({"pose": np.eye(3)}, "must be a 4 x 4 matrix"),
                ({"pose": 2 * np.eye(4)}, "pose must be a rigid transform"),
                ({"pose": ((0, 0, 0), (2, 0, 0, 0))}, "must have a norm of 1"),
                ({"pose": ((0, 0, float("nan")), (1, 0, 0, 0))}, "nan"),
                ({"number": -1}, "number = -1 must be a whole number of at least 0"),
                ({"time": float("inf")}, "time = inf"),
                ({"moved": {"whale": np.eye(4)}}, "whale is not in the world"),
        ):
            with self.assertRaisesRegex(insonify.Error, text.replace("[", r"\[")):
                sim.ping(**arguments)
        self.assertEqual(sim.ping().number, 0)

    def test_a_batch_is_the_pings_one_by_one(self):
        sim = simulator()
        poses = np.stack([insonify.Pose.rpy((x, 0, 0)).matrix for x in (0, 1, 2.5)])
        batch = sim.ping_batch("ahead", poses)
        self.assertEqual(batch["intensity"].shape, (3, 40, 16))
        for number, pose in enumerate(poses):
            one = sim.ping("ahead", pose, number=number)
            np.testing.assert_array_equal(batch["intensity"][number], one.intensity)
            np.testing.assert_array_equal(batch["instance"][number], one.instance)
        with self.assertRaisesRegex(insonify.Error, "at least one"):
            sim.ping_batch("ahead", [])

    def test_objects_move_come_and_go(self):
        scene = floor_scene()
        box = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                 [0, 6, 4], [1, 5, 7], [1, 7, 3]]
        scene.add("box", box, faces, material="rock", pose=((4, 0, -2), (1, 0, 0, 0)))
        sim = insonify.Simulator(insonify.Scenario.from_text(TEXT), scene, movable=["box"])
        here = sim.ping(number=0)
        away = sim.ping(number=0, moved={"box": ((0, 0, 50), (1, 0, 0, 0))})
        label = sim.instance_names.index("box")
        self.assertGreater(np.count_nonzero(here.instance == label), 0)
        self.assertEqual(np.count_nonzero(away.instance == label), 0)
        sim.remove("box")
        np.testing.assert_array_equal(sim.ping(number=0).intensity, away.intensity)
        more = insonify.Scene()
        more.add("again", box, faces, material="rock", pose=((4, 0, -2), (1, 0, 0, 0)))
        index = sim.add(more)
        self.assertGreater(np.count_nonzero(sim.ping(number=0).instance == index), 0)

    def test_sonars_change(self):
        sim = simulator()
        sonar = sim.scenario.sonars[0].copy()
        sonar.max_range, sonar.bin_count = 6, 25
        sim.set_sonar("ahead", sonar)
        ping = sim.ping()
        self.assertEqual((ping.shape, ping.sonar.max_range), ((25, 16), 6))

    def test_two_threads_have_two_simulators(self):
        expected = [simulator(seed=seed).ping(number=0).intensity.copy() for seed in (1, 2)]
        found = {}

        def make(seed):
            sim = simulator(seed=seed)
            found[seed] = [sim.ping(number=0).intensity.copy() for _ in range(10)]

        threads = [threading.Thread(target=make, args=(seed,)) for seed in (1, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed in (1, 2):
            for intensity in found[seed]:
                np.testing.assert_array_equal(intensity, expected[seed - 1])

    def test_broken_meshes_are_told_of(self):
        scene = floor_scene()
        with self.assertRaisesRegex(insonify.Error, r"faces\[0\]\[2\] = 9 must be from 0 to 3"):
            scene.add("bad", FLOOR["vertices"], [[0, 1, 9]])
        with self.assertRaisesRegex(insonify.Error, "whole numbers"):
            scene.add("bad", FLOOR["vertices"], [[0.5, 1, 2]])
        with self.assertRaisesRegex(insonify.Error, "is there already"):
            scene.add("floor", FLOOR["vertices"], FLOOR["faces"])
        with self.assertRaisesRegex(insonify.Error, "no triangles left"):
            scene.add("flat", [[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
        scene.add("two", FLOOR["vertices"], FLOOR["faces"], material=["mud", "rock"], pose=((0, 0, -9), (1, 0, 0, 0)))
        sim = insonify.Simulator(insonify.Scenario.from_text(TEXT), scene)
        self.assertLessEqual({"sand", "mud", "rock"}, set(sim.material_names))


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


class AcousticsTest(unittest.TestCase):
    def test_numbers_and_arrays(self):
        acoustics = insonify.acoustics
        self.assertAlmostEqual(acoustics.sphere_cross_section(0.5), 0.0625)
        np.testing.assert_allclose(acoustics.target_strength_db(np.array([1, 0.01])), [0, -20])
        self.assertAlmostEqual(acoustics.transmission_loss_db(10, 0.1), 21)
        self.assertAlmostEqual(acoustics.mackenzie_sound_speed(10, 35, 0), 1489.8, delta=0.1)
        self.assertGreater(acoustics.absorption_db_per_m(720e3, insonify.Water()), 0.1)
        with self.assertRaises(insonify.Error):
            acoustics.sphere_cross_section(-1)


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
    COMMAND_LINE, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
