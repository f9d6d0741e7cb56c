#!/usr/bin/python3
"""Pings, requests and recordings that are pickled, copied and passed to other processes: pickle_test.py INSONIFY ..."""

import copy
import multiprocessing
import os
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
    import insonify
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

INSONIFY = sys.argv[1]

# All tables that a ping can have, and a head that turns.
TEXT = """
world: floor.obj
pings: 5
seed: 7
ground_truth: full
receiver: {field: true, speckle: true, counts: true, full_scale_db: -40}
sonars:
  - {name: ahead, beam_count: 12, bin_count: 60, max_range: 12, orientation_deg: [0, 25, 10], azimuth_resolution_deg: 3,
     sampling: {columns_per_beam: 2, rows: 20}}
  - {name: around, preset: tritech-micron-dst, bin_count: 25, max_range: 9, step_deg: 72,
     sampling: {columns_per_beam: 2, rows: 20}}
trajectory:
  - {time: 0, position: [0, 0, 0]}
  - {time: 10, position: [5, 0, 1]}
"""
FLOOR = "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n"
TABLES = ["intensity", "field", "counts", "instance", "material", "elevation", "strongest_instance", "strongest_share",
          "elevation_spread", "path_order", "shadow", "direct_intensity"]

WAYS = {"pickle": lambda one: pickle.loads(pickle.dumps(one)), "copy": copy.copy, "deepcopy": copy.deepcopy}

simulators = {}  # Of a worker.


def start_worker(scenario):
    simulators["its"] = insonify.Simulator(scenario, threads=1)


def make_ping(request):
    return simulators["its"].ping("ahead", request)


def make_wrong_ping(max_range):
    scenario = insonify.Scenario.from_text(TEXT)
    scenario.sonars[0].max_range = max_range


def strongest_of(item):
    recorded, number = item
    return float(np.nanmax(recorded[number].intensity)), os.getpid()


def layer_sum(layer):
    return float(np.sum(layer[1:3]))


class PickleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(scratch.name)
        pathlib.Path("floor.obj").write_text(FLOOR)
        pathlib.Path("s.yaml").write_text(TEXT)
        subprocess.run([INSONIFY, "run", "s.yaml", "-o", "out", "-q", "--no-pictures", "--record", "h5,mcap"], check=True)
        cls.scenario = insonify.Scenario.load("s.yaml")
        cls.simulator = insonify.Simulator(cls.scenario)

    def assert_same_ping(self, found, expected):
        for name in ("number", "time", "pose", "head_angle", "shape", "sonar", "model", "instance_names", "material_names"):
            self.assertEqual(getattr(found, name), getattr(expected, name), name)
        for name in TABLES:
            wanted, got = getattr(expected, name), getattr(found, name)
            if wanted is None:
                self.assertIsNone(got, name)
            else:
                self.assertEqual((got.dtype, got.shape), (wanted.dtype, wanted.shape), name)
                self.assertEqual(got.tobytes(), wanted.tobytes(), name)  # Also where they are NaN.
                self.assertFalse(np.shares_memory(got, wanted), name)
        np.testing.assert_array_equal(insonify.fan(found, height=240), insonify.fan(expected, height=240))

    def test_pings_have_all_that_they_had(self):
        pings = [self.simulator.ping("ahead", number=3), self.simulator.ping("around", number=2, time=0.25)]
        self.assertTrue(all(getattr(pings[0], name) is not None for name in TABLES))
        self.assertNotEqual(pings[1].head_angle, 0)
        for ping in pings:
            for way, again in WAYS.items():
                with self.subTest(way=way, sonar=ping.sonar.name):
                    self.assert_same_ping(again(ping), ping)

    def test_a_ping_without_labels_has_none_afterwards(self):
        scenario = self.scenario.copy()
        scenario.ground_truth = "none"
        scenario.receiver = insonify.ReceiverConfig()
        ping = insonify.Simulator(scenario).ping()
        again = pickle.loads(pickle.dumps(ping))
        self.assertIsNone(again.instance)
        self.assertIsNone(again.field)
        self.assert_same_ping(again, ping)

    def test_the_arrays_of_a_copy_are_its_own(self):
        ping = self.simulator.ping("ahead", number=0)
        again = copy.deepcopy(ping)
        before = ping.intensity.copy()
        again.intensity[:] = 5
        np.testing.assert_array_equal(ping.intensity, before)

    def test_recorded_pings_need_their_file_no_more(self):
        for path in ("out/ahead.h5", "out/around.h5", "out/ahead.mcap"):
            ping = insonify.open(path)[3]
            data = pickle.dumps(ping)  # No table of it was read before.
            moved = pathlib.Path(path).rename("elsewhere")
            try:
                again = pickle.loads(data)
                self.assertIsNotNone(again.intensity)
            finally:
                moved.rename(path)
            self.assert_same_ping(again, insonify.open(path)[3])

    def test_a_pickled_ping_can_be_recorded(self):
        with insonify.Recording("a.h5", self.simulator) as first, insonify.Recording("b.h5", self.simulator) as second:
            for number in range(3):
                ping = self.simulator.ping("ahead", number=number)
                first.add(ping)
                second.add(pickle.loads(pickle.dumps(ping)))
        self.assertEqual(pathlib.Path("a.h5").read_bytes(), pathlib.Path("b.h5").read_bytes())

    def test_requests_ask_for_the_same(self):
        pose = insonify.Pose.rpy((0.5, 0, -1), (3, 0, 20))
        requests = [insonify.PingRequest(pose, 0.25, 4, twist=((1, 0, 0), (0, 0, 0.2)), moved={"floor": pose}),
                    insonify.PingRequest(pose.matrix, head_angle=0.5), insonify.PingRequest()]
        for way, again in WAYS.items():
            for request in requests:
                found = again(request)
                for name in ("time", "number", "twist", "moved", "head_angle"):
                    self.assertEqual(getattr(found, name), getattr(request, name), (way, name))
                if request.pose is None:
                    self.assertIsNone(found.pose)
                else:
                    np.testing.assert_array_equal(insonify.Pose(found.pose).matrix, insonify.Pose(request.pose).matrix)
        deep = copy.deepcopy(requests[1])
        deep.pose[0, 3] = 7
        self.assertEqual(requests[1].pose[0, 3], 0.5)

    def test_recordings_are_opened_again(self):
        for path, sonar in (("out/ahead.h5", None), ("out/around.mcap", "around")):
            recorded = insonify.open(path, sonar)
            for way, again in WAYS.items():
                found = again(recorded)
                self.assertEqual((found.shape, found.sonar, found.model, found.state),
                                 (recorded.shape, recorded.sonar, recorded.model, recorded.state), way)
                np.testing.assert_array_equal(found.intensity[2], recorded.intensity[2])
                self.assertEqual(again(recorded.intensity)[2].tobytes(), recorded.intensity[2].tobytes())
        # From wherever the other process works, and not once the file is gone.
        data = pickle.dumps(insonify.open("out/ahead.h5"))
        place = os.getcwd()
        os.chdir("/")
        try:
            self.assertEqual(len(pickle.loads(data)), 5)
        finally:
            os.chdir(place)
        moved = pathlib.Path("out/ahead.h5").rename("elsewhere")
        try:
            with self.assertRaisesRegex(insonify.Error, "^" + place + "/out/ahead.h5: "):
                pickle.loads(data)
        finally:
            moved.rename("out/ahead.h5")

    def test_workers_make_pings_and_read_recordings(self):
        spawn = multiprocessing.get_context("spawn")
        requests = [insonify.PingRequest(insonify.Pose.rpy((0.3 * number, 0, 0)), 0.1 * number, number) for number in range(4)]
        recorded = insonify.open("out/ahead.h5")
        with spawn.Pool(2, start_worker, (self.scenario,)) as pool:
            for found, request in zip(pool.map(make_ping, requests), requests):
                self.assert_same_ping(found, self.simulator.ping("ahead", request))
            read = pool.map(strongest_of, [(recorded, number) for number in range(len(recorded))])
            self.assertEqual([value for value, _ in read], [float(ping.intensity.max()) for ping in recorded])
            self.assertNotIn(os.getpid(), {process for _, process in read})
            self.assertEqual(pool.map(layer_sum, [recorded.intensity]), [float(np.sum(recorded.intensity[1:3]))])
            with self.assertRaises(insonify.Error) as caught:
                pool.map(make_wrong_ping, [-3])
            self.assertEqual((caught.exception.field, str(caught.exception)[:9]), ("max_range", "max_range"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
