"""The Python package: pings as arrays, poses, batches, changes, threads.

    PYTHONPATH=build/dev/python tests/python/package_test.py COMMAND_LINE SOURCE_FOLDER
"""

import gc
import sys
import threading
import unittest

import numpy as np

import insonify
from kit import FLOOR, SOURCES, TEXT, floor_scene, simulator


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
                ({"sonar": "astern"}, "sonar = 'astern' does not exist; available: ahead"),
                ({"sonar": 4}, "sonar = 4 must be from 0 to 0"),
                ({"pose": "here"}, "pose = 'here' must be a position of three numbers, a 4 x 4 matrix"),
                ({"pose": np.eye(3)}, "must be a position of three numbers, a 4 x 4 matrix"),
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

    def test_tensor_libraries_take_arrays_without_a_copy(self):
        sim = simulator()
        ping, batch = sim.ping("ahead"), sim.ping_batch("ahead", [(0, 0, 0), (1, 0, 0)])
        for array in (ping.intensity, ping.instance, ping.elevation, batch["intensity"], batch["instance"]):
            self.assertTrue(np.shares_memory(np.from_dlpack(array), array))
        kept = np.from_dlpack(ping.intensity)
        values = ping.intensity.copy()
        del ping
        sim.ping("ahead", (2, 0, 0))
        np.testing.assert_array_equal(kept, values)

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
        self.assertEqual((sim.instance_names, here.instance_names), (["floor", ""], ["floor", "box"]))
        self.assertEqual(sim.scene.instance_names, ["floor", ""])
        np.testing.assert_array_equal(sim.ping(number=0).intensity, away.intensity)
        more = insonify.Scene()
        more.add("again", box, faces, material="rock", pose=((4, 0, -2), (1, 0, 0, 0)))
        index = sim.add(more)
        self.assertGreater(np.count_nonzero(sim.ping(number=0).instance == index), 0)

    def test_a_ping_has_its_ranges_and_names(self):
        ping = simulator().ping()
        np.testing.assert_array_equal(ping.ranges, ping.sonar.bin_ranges())
        np.testing.assert_array_equal(ping.azimuths, ping.sonar.azimuths())
        self.assertEqual((ping.instance_names, ping.material_names), (["floor"], ["sand"]))

    def test_scenes_are_built_of_shapes(self):
        scene = insonify.Scene()
        self.assertEqual(scene.box("crate", (2, 1, 4), "wood", (5, 0, 0)), "crate")
        self.assertEqual([scene.box(2, material=insonify.materials()["steel"]), scene.box(), scene.sphere(0.5, pose=(9, 0, 1)),
                          scene.plane((20, 10), pose=(0, 0, -3)), scene.cylinder("pile", 0.2, 6)],
                         ["box", "box_2", "sphere", "plane", "pile"])
        for name, low, high in (("crate", (4, -0.5, -2), (6, 0.5, 2)), ("box", (-1, -1, -1), (1, 1, 1)),
                                ("box_2", (-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)), ("sphere", (8.5, -0.5, 0.5), (9.5, 0.5, 1.5)),
                                ("plane", (-10, -5, -3), (10, 5, -3)), ("pile", (-0.2, -0.2, -3), (0.2, 0.2, 3))):
            corners = scene.triangles(name).reshape(-1, 3)
            np.testing.assert_allclose([corners.min(axis=0), corners.max(axis=0)], [low, high], atol=2e-3, err_msg=name)
        scene.set_material("box", "mud")
        materials = insonify.Simulator(insonify.Scenario.from_text(TEXT), scene).ping().material_names
        self.assertEqual(materials, ["wood", "mud", "sand"])
        for act, text in ((lambda: scene.box(size=(1, 2)), "size = (1, 2) must be 3 numbers, or one for all"),
                          (lambda: scene.box(size=(1, 2, 0)), "size[2] = 0 m must be greater than 0, at most 1000000 m"),
                          (lambda: scene.sphere(radius="x"), "radius = 'x' must be a number"),
                          (lambda: scene.box("crate"), "name = crate exists already"),
                          (lambda: scene.box("x", material=3), "material = 3 must be a name or a Material"),
                          (lambda: scene.box("x", material=insonify.Material(density=3000)),
                           "material has no name: one of your own is an entry of the scenario's `materials`, whose name is given here"),
                          (lambda: scene.set_material("boxx", "mud"),
                           "name = boxx is not in the scene, which has crate, box, box_2, sphere, plane, pile")):
            with self.assertRaises(insonify.Error) as caught:
                act()
            self.assertEqual(str(caught.exception), text)

    def test_heights_lie_as_in_pictures(self):
        scene = insonify.Scene()
        grid = np.zeros((3, 5))
        grid[0, 4] = 1.5  # The north-east corner.
        self.assertEqual(scene.heights(grid - 10, spacing=(2, 0.5)), "heights")
        corners = scene.triangles("heights").reshape(-1, 3)
        np.testing.assert_allclose([corners.min(axis=0), corners.max(axis=0)], [(-4, -0.5, -10), (4, 0.5, -8.5)])
        np.testing.assert_allclose(corners[np.argmax(corners[:, 2])], (4, 0.5, -8.5))
        with self.assertRaisesRegex(insonify.Error, r"^heights must be an array \[rows, columns\] of at least 2 x 2, not \[3\]$"):
            scene.heights([1, 2, 3])

    def test_scenes_and_files_are_merged(self):
        ship = insonify.Scene()
        ship.box("ship::mast", (0.1, 0.1, 3), pose=(0, 0, 2))
        ship.box("ship::hull", (5, 1, 1), "steel")
        scene = floor_scene()
        self.assertEqual(scene.merge(ship, pose=insonify.Pose((9, 0, 0), angles_deg=(0, 0, 90))), ["ship::mast", "ship::hull"])
        self.assertEqual(scene.merge(ship, "wreck", "mud", (0, 9, 0)), ["wreck::mast", "wreck::hull"])
        np.testing.assert_allclose(np.abs(scene.triangles("ship::hull") - (9, 0, 0)).max(axis=(0, 1)), (0.5, 2.5, 0.5))
        scene.merge(scene, "copy", pose=(0, 0, 50))
        self.assertEqual(scene.instance_names[5:], ["copy::floor", "copy::ship::mast", "copy::ship::hull", "copy::wreck::mast",
                                                    "copy::wreck::hull"])
        self.assertEqual(scene.add_file(SOURCES / "scenes/sphere.sdf", "other", pose=(0, 0, -40))[-1], "other::sphere::link::sphere")
        scene.set_material("sphere", "ice")
        sim = insonify.Simulator(insonify.Scenario.from_text(TEXT), scene)
        self.assertEqual(set(sim.material_names), {"sand", "steel", "mud", "ice"})
        with self.assertRaisesRegex(insonify.Error, "^name = ship::mast exists already; give what is added another `name`$"):
            scene.merge(ship)
        for method in ("box", "heights", "merge", "add_file", "set_material"):
            with self.assertRaisesRegex(AttributeError, "this is a copy of a simulator's scene"):
                getattr(sim.scene, method)("x")

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
        with self.assertRaisesRegex(insonify.Error, "exists already"):
            scene.add("floor", FLOOR["vertices"], FLOOR["faces"])
        with self.assertRaisesRegex(insonify.Error, "no triangles left"):
            scene.add("flat", [[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
        scene.add("two", FLOOR["vertices"], FLOOR["faces"], material=["mud", "rock"], pose=((0, 0, -9), (1, 0, 0, 0)))
        sim = insonify.Simulator(insonify.Scenario.from_text(TEXT), scene)
        self.assertLessEqual({"sand", "mud", "rock"}, set(sim.material_names))


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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
