"""insonify.compare() gives the numbers of `insonify compare`.

    PYTHONPATH=build/dev/python tests/python/compare_test.py COMMAND_LINE SOURCE_FOLDER
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import insonify

COMMAND_LINE = ""
MEASURES = ("mse", "psnr_db", "ssim", "ms_ssim", "correlation", "ks_distance")


def record(path, seed, count=2, model="calibrated", **sonar):
    config = insonify.SonarConfig(name="ahead", **{"beam_count": 190, "bin_count": 180, "max_range": 12,
                                                   "orientation_deg": (0, 25, 0), **sonar})
    scene = insonify.Scene()
    scene.add("floor", [[-30, -30, -2], [30, -30, -2], [30, 30, -2], [-30, 30, -2]], [[0, 1, 2], [0, 2, 3]])
    scene.add("board", [[5, -1, -2], [5, 1, -2], [5, 1, 0]], [[0, 1, 2]], "steel")
    sim = insonify.Simulator(insonify.Scenario(sonars=[config], seed=seed, model=model), scene)
    with insonify.Recording(path, sim) as recording:
        for _ in range(count):
            recording.add(sim.ping())


class CompareTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def expect_as_command_line(self, a, b, *options, **same):
        done = subprocess.run([COMMAND_LINE, "compare", a, b, "--json", *options], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        told, found = json.loads(done.stdout), insonify.compare(a, b, **same)
        for name in MEASURES:
            expected = told[name] if told[name] is not None else (np.inf if name == "psnr_db" else np.nan)
            np.testing.assert_allclose(getattr(found, name), expected, rtol=1e-12, err_msg=name)
        return found

    def test_of_recordings(self):
        a, b = self.folder / "a.h5", self.folder / "b.h5"
        record(a, seed=1)
        record(b, seed=2, count=3)
        found = self.expect_as_command_line(a, b)
        self.assertTrue(0 < found.ssim < 1 and 0 < found.ms_ssim < 1)
        self.expect_as_command_line(a, b, "--floor-db=-70", "--ping", "1", floor_db=-70, pings=[1])
        self.expect_as_command_line(a, b, "--scale", "linear", "--full-scale", "0.5", scale="linear", full_scale=0.5)
        self.assertEqual(insonify.compare(a, a).ssim, 1)
        self.assertEqual(repr(insonify.compare(insonify.open(a), b)), repr(found))
        normal = insonify.similarity.normalised(found)
        self.assertAlmostEqual(normal.mse, 1 - found.mse)

    def test_of_scans_and_of_the_paper_model(self):
        for name, seed in (("a.h5", 1), ("b.h5", 2)):
            record(self.folder / name, seed, 40, type="msis", beam_count=1, azimuth_aperture_deg=3, step_deg=9)
            record(self.folder / f"paper_{name}", seed, model="paper")
        found = self.expect_as_command_line(self.folder / "a.h5", self.folder / "b.h5")
        self.assertTrue(0 < found.ms_ssim < 1)  # At two scales.
        self.expect_as_command_line(self.folder / "paper_a.h5", self.folder / "paper_b.h5")

    def test_of_arrays(self):
        random = np.random.default_rng(5)
        a, b = random.random((40, 30)), random.random((40, 30))
        found = insonify.compare(a, b)
        self.assertAlmostEqual(found.mse, np.mean((a - b) ** 2))
        self.assertAlmostEqual(found.correlation, np.corrcoef(a.ravel(), b.ravel())[0, 1])
        controls = insonify.similarity.compare_controls(a, ms_ssim=False)
        self.assertAlmostEqual(controls["flat_grey"].mse, a.var())
        np.testing.assert_allclose(insonify.similarity.mean_range_profile(a)[3], a[3].mean())

    def test_of_counts_in_files_of_other_programs(self):
        random = np.random.default_rng(6)
        a, b = random.integers(0, 256, (2, 40, 30)), random.integers(0, 256, (2, 40, 30), dtype=np.uint8)
        np.save(self.folder / "a.npy", a)
        np.savez(self.folder / "b.npz", intensity=b)
        found = self.expect_as_command_line(self.folder / "a.npy", self.folder / "b.npz")
        self.assertAlmostEqual(found.mse, np.mean((a / 255 - b / 255) ** 2))
        recorded = insonify.open(self.folder / "a.npy")
        self.assertEqual(recorded.shape, (2, 40, 30))
        self.assertEqual(recorded.full_scale, 255)
        np.testing.assert_array_equal(recorded.intensity[1], a[1])
        self.assertIn("taken as counts of 8 bits", recorded.notes[0])
        (self.folder / "c.pgm").write_bytes(b"P5 30 40 255\n" + b[1].tobytes())
        self.assertEqual(insonify.compare(self.folder / "b.npz", self.folder / "c.pgm", pings=[1]).mse, 0)

    def test_what_cannot_be_compared_is_told(self):
        a = np.random.default_rng(5).random((40, 30))
        for call, text in (
                (lambda: insonify.compare(a, a[:, 1:]), "30"),
                (lambda: insonify.compare(a, 2 * a), "b"),
                (lambda: insonify.compare(a, np.zeros_like(a)), "b"),
                (lambda: insonify.compare(a[0], a[0]), r"must be an array \[rows, columns\]"),
                (lambda: insonify.compare(a, "nowhere.h5"), "no such file"),
                (lambda: insonify.compare(a, a, scale="log"), "scale = 'log' must be db or linear"),
                (lambda: insonify.compare(a, a, floor_db=3), "floor_db = 3 dB must be less than 0"),
        ):
            with self.assertRaisesRegex(insonify.Error, text):
                call()


if __name__ == "__main__":
    COMMAND_LINE = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=["compare_test.py"])
