"""Forms of poses: one, and the many of ping_batch(). What is no pose is named with its index.

    PYTHONPATH=build/dev/python tests/python/pose_forms_test.py INSONIFY_PROGRAM SOURCE_FOLDER
"""

import math
import sys
import unittest
import warnings

import numpy as np

import insonify

TEXT = """
world: none
seed: 5
points: [{position: [8, 0.5, 0], target_strength_db: -10}]
sonars:
  - {name: fls, bin_count: 40, beam_count: 16, max_range: 12, ping_period: 0.1, azimuth_aperture_deg: 60}
"""
FORMS = "a position of three numbers, a 4 x 4 matrix, a pair (position, quaternion w x y z), the seven numbers of these or a Pose"
MANY = "poses must be a list of poses, at least one, an array [n, 3], [n, 4, 4] or [n, 7], or a tuple of arrays [n, 3] and [n, 4]"

# Three poses 0, 0.7 and 1.4 m ahead, turned by 0, 10 and 20 degrees to port.
POSES = [insonify.Pose.rpy((0.7 * i, 0, 0.1 * i), (0, 0, 10 * i)) for i in range(3)]


def simulator():
    return insonify.Simulator(insonify.Scenario.from_text(TEXT))


class PoseFormsTest(unittest.TestCase):
    def message(self, act, kind=insonify.Error):
        with self.assertRaises(kind) as caught:
            act()
        return str(caught.exception)

    def refusal(self, poses, **more):
        return self.message(lambda: simulator().ping_batch("fls", poses, **more))

    def test_a_batch_takes_poses_in_every_form(self):
        expected = simulator().ping_batch("fls", POSES)["intensity"]
        self.assertGreater(np.abs(expected[0] - expected[2]).max(), 0)
        positions = np.array([pose.position for pose in POSES])
        quaternions = np.array([pose.orientation for pose in POSES])
        for name, poses in (("matrices", np.stack([pose.matrix for pose in POSES])),
                            ("sevens", np.hstack([positions, quaternions])),
                            ("lists of seven", np.hstack([positions, quaternions]).tolist()),
                            ("two arrays", (positions, quaternions)),
                            ("pairs", list(zip(positions, quaternions))),
                            ("a generator", (pose for pose in POSES)),
                            ("requests", (insonify.PingRequest(pose) for pose in POSES))):
            with self.subTest(name):
                np.testing.assert_allclose(simulator().ping_batch("fls", poses)["intensity"], expected, rtol=1e-4)

    def test_a_position_is_a_pose(self):
        pose = insonify.Pose((1, 2, 3))
        self.assertEqual(pose, insonify.Pose.rpy((1, 2, 3)))
        for again in (insonify.Pose(np.array([1, 2, 3])), insonify.Pose(position=(1, 2, 3)),
                      insonify.Pose((1, 2, 3), (1, 0, 0, 0)), insonify.Pose((1, 2, 3), angles_deg=(0, 0, 0))):
            self.assertEqual(again, pose)
        turned = insonify.Pose((1, 2, 3), angles_deg=(10, -20, 30))
        self.assertEqual(turned, insonify.Pose.rpy((1, 2, 3), (10, -20, 30)))
        np.testing.assert_allclose(turned.angles_deg, (10, -20, 30))
        np.testing.assert_array_equal(np.asarray(turned), turned.matrix)
        self.assertEqual(turned @ pose, turned * pose)
        np.testing.assert_allclose(turned * (4, 5, 6), (turned.matrix @ (4, 5, 6, 1))[:3])
        np.testing.assert_allclose(turned @ [(4, 5, 6), (0, 0, 0)], [(turned.matrix @ (4, 5, 6, 1))[:3], (1, 2, 3)])
        self.assertEqual(self.message(lambda: turned * 3), "a Pose times an array []: must be a Pose, or points [3] or [n, 3]")
        np.testing.assert_array_equal(simulator().ping((0.7, 0, 0)).intensity,
                                      simulator().ping("fls", insonify.Pose.rpy((0.7, 0, 0))).intensity)
        for act, text in ((lambda: insonify.Pose((1, 2)), "pose = (1, 2) must be " + FORMS),
                          (lambda: insonify.Pose((1, 2, math.nan)), "pose[0] = [1, 2, nan] must be finite"),
                          (lambda: insonify.Pose((1, 2, 3), position=(1, 2, 3)),
                           "position is given twice: as the first argument, and by its name"),
                          (lambda: insonify.Pose((1, 2, 3), (1, 0, 0, 0), angles_deg=(0, 0, 0)),
                           "orientation is given twice: as a quaternion, and in degrees as angles_deg")):
            self.assertEqual(self.message(act), text)

    def test_a_pose_looks_at_a_point_without_a_roll(self):
        for target in ((5, 1, -2), (-3, 0, 4), (1, 2, 10), (1, -7, 3), (1, 2, -5)):
            start = np.array([1.0, 2, 3])
            matrix = insonify.look_at(start, target).matrix
            towards = (np.array(target) - start) / np.linalg.norm(np.array(target) - start)
            np.testing.assert_allclose(matrix[:3, 0], towards, atol=1e-12)
            self.assertAlmostEqual(matrix[2, 1], 0)  # y stays level, and z up.
            self.assertGreaterEqual(matrix[2, 2], -1e-12)
            np.testing.assert_array_equal(matrix[:3, 3], start)
        np.testing.assert_allclose(insonify.Pose.look_at((0, 0, 0), (0, 3, -3)).angles_deg, (0, 45, 90), atol=1e-12)
        self.assertEqual(self.message(lambda: insonify.look_at((1, 2, 3), (1, 2, 3))),
                         "target = (1, 2, 3) must be another point than position")

    def test_the_same_numbers_repeat_a_batch(self):
        sim = simulator()
        first = sim.ping_batch(POSES, numbers=range(3))["intensity"]
        on = sim.ping_batch(POSES)["intensity"]
        self.assertGreater(np.count_nonzero(on != first), 0)  # The noise of pings 3 to 5.
        np.testing.assert_array_equal(sim.ping_batch(POSES, numbers=np.arange(3))["intensity"], first)
        np.testing.assert_array_equal(sim.ping_batch("fls", [{"pose": pose} for pose in POSES], numbers=[3, 4, 5])["intensity"], on)
        positions = np.array([pose.position for pose in POSES])
        np.testing.assert_array_equal(sim.ping_batch(positions, numbers=range(3))["intensity"],
                                      sim.ping_batch([insonify.Pose(one) for one in positions], numbers=range(3))["intensity"])
        self.assertEqual(self.refusal(POSES, numbers=[1, 2]), "numbers must be a list of 3 whole numbers, one for each pose")
        self.assertEqual(self.refusal(POSES, numbers=[1, 2, "x"]), "numbers[2] = 'x' must be a whole number of at least 0")

    def test_poses_of_a_recording_are_seven_numbers(self):
        pose = POSES[1]
        self.assertEqual(insonify.Pose(np.array([*pose.position, *pose.orientation])), pose)
        self.assertEqual(self.message(lambda: insonify.Pose([0, 0, 0, 2, 0, 0, 0])),
                         "pose[1] = [2, 0, 0, 0] must have a norm of 1, not 2")

    def test_what_is_no_pose_is_named_with_its_index(self):
        matrices = np.stack([np.eye(4)] * 4)
        matrices[2, 0, 3] = math.nan
        rigid = "must be a rigid transform: a rotation, a position in the last column, and 0 0 0 1 below"
        self.assertEqual(self.refusal(matrices), "poses[2] " + rigid)
        self.assertEqual(self.refusal([POSES[0], 5]), "poses[1] = 5 must be " + FORMS)
        self.assertEqual(self.refusal([POSES[0], insonify.PingRequest(np.ones((4, 4)))]), "poses[1].pose " + rigid)
        self.assertEqual(self.refusal([insonify.PingRequest(), insonify.PingRequest(time=math.inf)]).split(" must")[0],
                         "poses[1].time = inf s")
        self.assertEqual(self.refusal([insonify.PingRequest(number=-1)]),
                         "poses[0].number = -1 must be a whole number of at least 0")
        self.assertEqual(self.refusal([POSES[0], ((0, math.nan, 1), (1, 0, 0, 0))]),
                         "poses[1][0] = [0, nan, 1] must be finite")
        self.assertEqual(self.refusal(POSES[:2], times=[0, "x"]), "times[1] = 'x' must be a number")
        self.assertEqual(self.refusal([POSES[0], ((1e30, 0, 0), (1, 0, 0, 0))]).split(" must")[0],
                         "poses[1].position[0] = 1e+30 m")

    def test_what_are_not_many_poses_is_refused(self):
        self.assertEqual(self.refusal(np.eye(4)), MANY + ", not one (4, 4)")
        self.assertEqual(self.refusal(np.zeros((3, 6))), MANY + ", not one (3, 6)")
        self.assertEqual(self.refusal(np.eye(4).tolist()), "poses[0] = [1.0, 0.0, 0.0, 0.0] must be " + FORMS)
        self.assertEqual(self.refusal((np.zeros((3, 3)), np.zeros((2, 4)))), "poses has 3 positions and 2 quaternions")
        for poses in ([], None, "here", {}, 3, iter(())):
            self.assertEqual(self.refusal(poses), MANY)

    def test_errors_of_a_generator_are_its_own(self):
        def failing():
            yield POSES[0]
            raise KeyError("x")

        self.message(lambda: simulator().ping_batch("fls", failing()), KeyError)

    def test_complex_numbers_are_no_numbers(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for kind in (complex, np.complex64):
                self.assertIn("must be a number", self.message(lambda: insonify.Pose(np.eye(4, dtype=kind))))
            self.assertEqual(self.message(lambda: insonify.SonarConfig(max_range=3 + 0j)), "max_range = (3+0j) must be a number")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
