"""What Python users do wrong is one clear message, and never a crash; what they may do works.

    PYTHONPATH=build/dev/python tests/python/mistakes_test.py INSONIFY_PROGRAM SOURCE_FOLDER
"""

import copy
import math
import os
import pickle
import sys
import tempfile
import unittest

import numpy as np

import insonify

TEXT = """
world: none
seed: 5
points: [{position: [8, 0.5, 0], target_strength_db: -10}]
sonars:
  - {name: ahead, bin_count: 40, beam_count: 16, max_range: 12, ping_period: 0.1, azimuth_aperture_deg: 60}
"""


def scenario():
    return insonify.Scenario.from_text(TEXT)


class MistakesTest(unittest.TestCase):
    def message(self, act, kind=insonify.Error):
        with self.assertRaises(kind) as caught:
            act()
        return str(caught.exception)

    def test_objects_without_a_value_are_refused(self):
        text = "this object was not initialised: its class must be called, not __new__() alone"
        for kind, act in [
            (insonify.Simulator, lambda empty: empty.ping()),
            (insonify.Pose, lambda empty: empty.matrix),
            (insonify.SonarConfig, lambda empty: empty.max_range),
            (insonify.Scenario, lambda empty: empty.to_yaml()),
            (insonify.Scene, repr),
            (insonify.PingRequest, lambda empty: empty.pose),
            (insonify.RecordedPings, lambda empty: empty.shape),
            (insonify.Recording, lambda empty: empty.close()),
        ]:
            with self.subTest(kind.__name__):
                empty = kind.__new__(kind)
                if kind.__repr__ is object.__repr__ and act is repr:
                    continue
                self.assertIn("not initialised", self.message(lambda: act(empty), TypeError))
        self.assertEqual(self.message(lambda: insonify.Simulator.__new__(insonify.Simulator).ping(), TypeError), text)

    def test_poses_must_be_finite(self):
        self.assertEqual(
            self.message(lambda: insonify.Pose.rpy((0, math.nan, 1))), "position = (0, nan, 1) must be finite"
        )
        self.assertEqual(
            self.message(lambda: insonify.Pose.rpy((0, 0, 1), (math.inf, 0, 0))),
            "angles_deg = (inf, 0, 0) must be finite",
        )

    def test_arguments_of_another_kind_are_named(self):
        given = scenario()
        self.assertEqual(
            self.message(lambda: insonify.Simulator(given, 5)), "scene = 5 must be a Scene, the path of one or None"
        )
        self.assertEqual(
            self.message(lambda: insonify.Simulator(5)),
            "scenario = 5 must be a Scenario, the path of one, a dict of its keys or a SonarConfig",
        )
        self.assertEqual(
            self.message(lambda: insonify.Simulator(given, threads=1.5)), "threads = 1.5 must be a whole number"
        )
        self.assertEqual(self.message(lambda: insonify.draw_fan(5)), "ping = 5 must be a Ping")
        self.assertEqual(self.message(lambda: insonify.draw_polar("x")), "ping = 'x' must be a Ping")
        self.assertEqual(
            self.message(lambda: insonify.write_png("x.png", np.zeros((3, 4, 3)))),
            "picture must be an array uint8 [height, width, 3] or, for grey, [height, width], not float64 [3, 4, 3]",
        )
        self.assertEqual(
            self.message(lambda: insonify.write_png("x.png", np.zeros((3, 4, 2), np.uint8))),
            "picture must be an array uint8 [height, width, 3] or, for grey, [height, width], not uint8 [3, 4, 2]",
        )
        self.assertEqual(
            self.message(lambda: insonify.write_png("x.png", 7)),
            "picture = 7 must be an array uint8 [height, width, 3] or, for grey, [height, width]",
        )

    def test_a_call_that_is_refused_says_what_was_given(self):
        sim, scene = insonify.Simulator(scenario()), insonify.Scene()
        for act, kind, message in (
            (lambda: insonify.Simulator(), TypeError, "Simulator() needs scenario; it takes scenario, scene, threads and movable"),
            (lambda: insonify.Recording("a.h5", 3), insonify.Error, "simulator = 3 must be a Simulator"),
            (lambda: insonify.SonarConfig("gemini"), TypeError, "SonarConfig() takes its fields by keyword, not 'gemini'"),
            (lambda: insonify.Scene.load("x.obj", colisions=True), TypeError,
             "load() has no argument 'colisions'; did you mean collisions?"),
            (lambda: insonify.Scene.load("x.obj", strict="no"), insonify.Error, "strict = 'no' must be True or False"),
            (lambda: scene.add("x", "here", [[0, 1, 2]]), insonify.Error, "vertices = 'here' must be an array of numbers"),
            (lambda: scene.triangles(3), insonify.Error, "name = 3 must be text"),
            (lambda: scene.triangles("x"), insonify.Error, "name = x is not in the scene, which has no objects"),
            (lambda: scene.set_material("x"), TypeError, "set_material() needs material; it takes object and material"),
            (lambda: sim.add(3), insonify.Error, "objects = 3 must be a Scene"),
            (lambda: sim.ping(0, None, 0, 0, None), TypeError,
             "ping() was given 5 arguments without a name; it takes sonar, pose, time, number, twist, moved and head_angle, "
             "the last 3 by their names"),
            (lambda: sim.ping("ahead", sonar=0), TypeError, "ping() was given sonar twice, by its place and by its name"),
            (lambda: insonify.Scenario.from_text(3), insonify.Error, "text = 3 must be text"),
            (lambda: insonify.acoustics.sphere_cross_section(), TypeError,
             "sphere_cross_section() needs radius; it takes radius and range"),
            (lambda: insonify.materials()["steel"].reflection_at("x"), insonify.Error, "frequency = 'x' must be a number"),
            (lambda: insonify.load("a.h5"), insonify.Error,
             "a.h5: is not a scenario but a recording; insonify.open() reads it"),
            (lambda: insonify.load("a.STL"), insonify.Error,
             "a.STL: is not a scenario but a mesh; insonify.Scene.load() reads it"),
        ):
            with self.subTest(message):
                self.assertEqual(self.message(act, kind), message)

    def test_recordings_take_slices(self):
        simulator = insonify.Simulator(scenario())
        with insonify.Recording("a.h5", simulator) as recording:
            for _ in range(5):
                recording.add(simulator.ping())
            self.assertEqual(self.message(lambda: recording.add(5)), "ping = 5 must be a Ping")
        recorded = insonify.open("a.h5")
        self.assertEqual([ping.number for ping in recorded[1:5:2]], [1, 3])
        self.assertEqual([ping.number for ping in recorded[::-2]], [4, 2, 0])
        self.assertEqual(recorded[9:], [])
        self.assertEqual(recorded[np.int64(-1)].number, 4)
        self.assertEqual(
            self.message(lambda: recorded["x"], TypeError),
            "the number of a ping must be a whole number or a slice, not 'x'",
        )
        self.assertIn("there is no ping 5", self.message(lambda: recorded[5], IndexError))

    def test_settings_can_be_pickled(self):
        given = scenario()
        again = pickle.loads(pickle.dumps(given))
        self.assertEqual(again.to_yaml(), given.to_yaml())
        sonar = insonify.SonarConfig(name="fls", max_range=0.1 + 12, azimuth_resolution=0.013)
        other = pickle.loads(pickle.dumps(sonar))
        self.assertEqual((other.name, other.max_range, other.azimuth_resolution), ("fls", 0.1 + 12, 0.013))
        given.sonars[0].max_range = 11
        self.assertEqual(pickle.loads(pickle.dumps(given)).sonars[0].max_range, 11)
        steel = [material for material in insonify.material_library() if material.name == "steel"][0]
        self.assertEqual(pickle.loads(pickle.dumps(steel)).name, "steel")
        pose = insonify.Pose.rpy((1, 2, 3), (10, 20, 30))
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(pose)).matrix, pose.matrix)
        np.testing.assert_array_equal(copy.deepcopy(pose).matrix, pose.matrix)

    def test_a_pickled_scenario_makes_the_same_pings(self):
        given = scenario()
        ping = insonify.Simulator(given).ping()
        again = insonify.Simulator(pickle.loads(pickle.dumps(given))).ping()
        self.assertGreater(ping.intensity.max(), 0)
        np.testing.assert_array_equal(again.intensity, ping.intensity)

    def test_copies_of_settings_refuse_a_change_that_would_reach_nobody(self):
        simulator = insonify.Simulator(scenario())
        sonars = "this is a copy of a simulator's sonar; change a copy() of it and pass that to Simulator.set_sonar()"
        self.assertEqual(
            self.message(lambda: setattr(simulator.sonar("ahead"), "max_range", 3), AttributeError),
            "SonarConfig.max_range cannot be set: " + sonars,
        )
        self.assertEqual(
            self.message(lambda: setattr(simulator.sonar().sampling, "columns_per_beam", 9), AttributeError),
            "Sampling.columns_per_beam cannot be set: " + sonars,
        )
        self.assertEqual(
            self.message(lambda: setattr(simulator.scenario, "seed", 3), AttributeError),
            "Scenario.seed cannot be set: this is a copy of a simulator's scenario; pass a changed copy() of a sonar to "
            "Simulator.set_sonar(), of the scenario to a new Simulator()",
        )
        self.assertIn(
            "SonarConfig.azimuth_aperture_deg cannot be set",
            self.message(lambda: setattr(simulator.scenario.sonars[0], "azimuth_aperture_deg", 3), AttributeError),
        )
        self.message(lambda: simulator.scenario.points.clear(), AttributeError)
        with self.assertRaises(TypeError):
            simulator.scenario.materials["steel"] = insonify.MaterialOverride()
        self.assertEqual(
            self.message(lambda: setattr(simulator.ping().sonar, "bits", 3), AttributeError),
            "SonarConfig.bits cannot be set: a ping was made with these settings; change a copy() of them",
        )
        self.assertEqual(
            self.message(lambda: simulator.scene.add("x", [[0, 0, 0]], [[0, 0, 0]]), AttributeError),
            "this is a copy of a simulator's scene; Simulator.add() adds objects to the simulator's",
        )

    def test_a_copy_of_a_simulators_settings_can_be_changed_and_set(self):
        given = scenario()
        given.materials = {"hull": "steel"}
        given.points[0].position = (5, 0, 0)
        scene = insonify.Scene()
        scene.add("plate", [[3, -1, -1], [3, 1, -1], [3, 0, 1]], [[0, 1, 2]], material="hull")
        simulator = insonify.Simulator(given, scene)
        for copied in (insonify.SonarConfig.copy, copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))):
            sonar = copied(simulator.sonar("ahead"))
            sonar.max_range = 9
            simulator.set_sonar("ahead", sonar)
            self.assertEqual(simulator.sonar().max_range, 9)
            simulator.set_sonar("ahead", given.sonars[0])
        again = simulator.scenario.copy()
        self.assertEqual(again, simulator.scenario)
        self.assertEqual(pickle.loads(pickle.dumps(simulator.scenario)), again)
        again.materials["hull"].density = 7000
        again.points.append(insonify.PointTarget(position=(7, 0, 0)))
        self.assertNotEqual(again, simulator.scenario)
        brighter = insonify.Simulator(again, simulator.scene).ping()
        self.assertGreater(np.count_nonzero(brighter.intensity != simulator.ping().intensity), 0)
        self.assertIn("points=[1]", repr(simulator.scenario))

    def test_a_material_that_nobody_knows_is_told_of(self):
        scene = insonify.Scene()
        scene.add("hull", [[3, -1, -1], [3, 1, -1], [3, 0, 1], [4, 0, 1]], [[0, 1, 2], [1, 2, 3]],
                  material=["steel", "steal"])
        text = "hull: material = steal is not a known material; did you mean steel?"
        self.assertEqual(self.message(lambda: insonify.Simulator(scenario(), scene)), text)
        simulator = insonify.Simulator(scenario())
        self.assertEqual(self.message(lambda: simulator.add(scene)), text)
        given = scenario()
        given.materials = {"steal": insonify.MaterialOverride(like="steel", density=7000)}
        self.assertEqual(insonify.Simulator(given, scene).material_names, ["steel", "steal"])


if __name__ == "__main__":
    del sys.argv[1:]
    with tempfile.TemporaryDirectory() as place:
        os.chdir(place)
        unittest.main()
