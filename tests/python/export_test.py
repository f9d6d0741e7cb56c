#!/usr/bin/python3
"""What `insonify export` writes, read by NumPy, zarr and ffmpeg: export_test.py INSONIFY."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
try:
    import zarr
except ImportError:
    zarr = None

INSONIFY = sys.argv.pop(1)

# Full ground truth, the complex field and the counts: every table that recordings have.
SCENARIO = """
world: floor.obj
duration: 0.12
ground_truth: full
receiver: {field: true, counts: true, full_scale_db: -30}
sonars:
  - {name: "büg", beam_count: 9, bin_count: 40, min_range: 1, max_range: 12, orientation_deg: [0, 25, 10],
     sampling: {columns_per_beam: 2, rows: 40}}
  - {name: around, preset: tritech-micron-dst, bin_count: 25, max_range: 9, step_deg: 18,
     sampling: {columns_per_beam: 2, rows: 40}}
"""
FLOOR = "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n"


class ExportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        (cls.folder / "floor.obj").write_text(FLOOR)
        (cls.folder / "s.yaml").write_text(SCENARIO)
        cls.insonify("run", "s.yaml", "-o", "out", "--no-pictures", "-q")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def insonify(cls, *words, status=0, path=None):
        environment = {**os.environ, **({"PATH": path} if path else {})}
        done = subprocess.run([INSONIFY, *words], cwd=cls.folder, capture_output=True, text=True, env=environment,
                              stdin=subprocess.DEVNULL, timeout=120, check=False)
        assert done.returncode == status, (words, done.returncode, done.stderr)
        return done.stderr if status else done.stdout

    def recorded(self, sonar):
        """The recording's tables as NumPy would have them."""
        tables = {}
        with h5py.File(self.folder / f"out/{sonar}.h5") as file:
            for name, dataset in file.items():
                if isinstance(dataset, h5py.Dataset):
                    values = dataset.asstr()[()] if dataset.dtype == object else dataset[()]
                    tables[name] = values[..., 0] + 1j * values[..., 1] if name == "field" else values
            return tables, dict(file.attrs), file["settings/sonar/max_range"][()]

    def check_same(self, found, expected, name):
        self.assertEqual(found.shape, expected.shape, name)
        if expected.dtype != object:
            self.assertEqual(found.dtype, expected.dtype, name)
            same = np.array_equal(found, expected, equal_nan=expected.dtype.kind == "f")
        else:
            same = found.tolist() == expected.tolist()
        self.assertTrue(same, name)

    def check_attributes(self, found, attributes, max_range):
        self.assertEqual(found["scenario"], attributes["scenario"])
        self.assertEqual(found["seed"], attributes["seed"])
        self.assertEqual(found["sonar"], attributes["sonar"])
        self.assertEqual(found["settings"]["sonar"]["max_range"], max_range)

    def test_npz_of_one_sonar_has_the_tables_by_their_names(self):
        for store in ([], ["--store"]):
            self.insonify("export", "out/büg.h5", "-o", "one.npz", "--force", *store)
            tables, attributes, max_range = self.recorded("büg")
            with np.load(self.folder / "one.npz") as archive:
                self.assertEqual(set(archive.files), {*tables, "attributes"})
                for name, expected in tables.items():
                    self.check_same(archive[name], expected, name)
                self.check_attributes(json.loads(str(archive["attributes"])), attributes, max_range)
        self.assertEqual(subprocess.run([sys.executable, "-m", "zipfile", "-t", self.folder / "one.npz"],
                                        capture_output=True, text=True, check=True).stdout, "Done testing\n")

    def test_npz_of_two_sonars_has_them_by_name(self):
        self.insonify("export", "out/büg.h5", "out/around.h5", "-o", "two.npz")
        with np.load(self.folder / "two.npz") as archive:
            for sonar in ("büg", "around"):
                tables, _, _ = self.recorded(sonar)
                for name, expected in tables.items():
                    self.check_same(archive[f"{sonar}/{name}"], expected, name)

    @unittest.skipIf(zarr is None, "there is no python3-zarr")
    def test_zarr_has_a_chunk_for_each_ping(self):
        self.insonify("export", "out/büg.h5", "out/around.h5", "-o", "two.zarr")
        group = zarr.open(str(self.folder / "two.zarr"), mode="r")
        self.assertEqual(sorted(group.group_keys()), ["around", "büg"])
        for sonar in ("büg", "around"):
            tables, attributes, max_range = self.recorded(sonar)
            self.assertEqual(set(group[sonar].array_keys()), set(tables))
            for name, expected in tables.items():
                self.check_same(group[sonar][name][...], expected, name)
                self.assertEqual(len(group[sonar][name].attrs["_ARRAY_DIMENSIONS"]), expected.ndim)
            self.check_attributes(group[sonar].attrs.asdict(), attributes, max_range)
        self.assertEqual(group["büg/strongest_share"].chunks, (1, 40, 9, 3))
        self.assertEqual(group["büg/strongest_share"].attrs["_ARRAY_DIMENSIONS"], ["ping", "bin", "beam", "rank"])
        self.assertEqual(group["büg/intensity"].attrs["units"], "1")
        self.assertEqual(group["büg/intensity"].compressor.codec_id, "zlib")

    @unittest.skipIf(zarr is None, "there is no python3-zarr")
    def test_zarr_of_one_sonar_is_its_own_group(self):
        self.insonify("export", "out/around.h5", "-o", "one.zarr/")
        group = zarr.open(str(self.folder / "one.zarr"), mode="r")
        tables, _, _ = self.recorded("around")
        self.check_same(group["intensity"][...], tables["intensity"], "intensity")

    def test_force_replaces_only_what_is_an_export(self):
        self.insonify("export", "out/around.h5", "-o", "again.zarr")
        self.assertEqual(self.insonify("export", "out/around.h5", "-o", "again.zarr", status=2),
                         "insonify: again.zarr exists already: --force replaces it\n")
        self.insonify("export", "out/around.h5", "-o", "again.zarr", "--force")
        (self.folder / "mine.zarr").mkdir()
        (self.folder / "mine.zarr/letter.txt").write_text("dear")
        self.assertEqual(self.insonify("export", "out/around.h5", "-o", "mine.zarr", "-f", status=2),
                         "insonify: mine.zarr: cannot replace: it is a folder without .zgroup\n")
        self.assertTrue((self.folder / "mine.zarr/letter.txt").exists())
        self.assertEqual(self.insonify("export", "out/around.h5", "-o", "mine.zarr/x.npz/", status=2)[:25],
                         "insonify: mine.zarr/x.npz")
        self.assertEqual(list(self.folder.glob("*.new*")), [])

    def test_errors_name_the_file_and_the_reason(self):
        for status, words, message in (
            (2, ["out/around.h5", "-o", "run.tsv"],
             "run.tsv: its ending must be .mcap, .bag, .npz, .zarr, .xtf, .jsf, .xyz, .gsf, .kmall, .mp4 or .gif, which says the format"),
            (2, ["out/around.h5", "out/büg.h5", "-o", "two.gif"],
             "two.gif: a video shows one sonar, and there are 2: around, büg"),
            (2, ["out/around.h5", "out/around.h5", "-o", "x.npz"],
             "out/around.h5 and out/around.h5 are both of a sonar called around; one file holds one recording of each"),
        ):
            self.assertEqual(self.insonify("export", *words, status=status), f"insonify: {message}\n")
        for words, message in (
            (["s.yaml", "-o", "x.npz"], "s.yaml: is not a recording: it is neither HDF5 nor MCAP"),
            (["nowhere.h5", "-o", "x.npz"], "nowhere.h5: no such file"),
        ):
            self.assertTrue(self.insonify("export", *words, status=2).startswith(f"insonify: {message}"))
        self.assertEqual(self.insonify("export", "out/around.h5", "-o", "x.mp4", status=1, path="/nowhere"),
                         "insonify: x.mp4: the program ffmpeg makes videos, and it is not installed (Debian, Ubuntu: "
                         "apt-get install ffmpeg)\n")
        self.assertEqual(list(self.folder.glob("x.*")), [])

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_a_full_disk_keeps_the_earlier_video(self):
        for ending in ("mp4", "gif"):
            file = self.folder / f"kept.{ending}"
            self.insonify("export", "out/büg.h5", "-o", file.name)
            before = file.read_bytes()
            blocks = len(before) // 2 // 1024  # Of 1024 bytes: bash's unit.
            done = subprocess.run(["bash", "-c", f'ulimit -f {blocks}; "$0" export out/büg.h5 -o {file.name} -f', INSONIFY],
                                  cwd=self.folder, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertTrue(done.stderr.startswith(f"insonify: {file.name}: "), done.stderr)
            self.assertEqual(file.read_bytes(), before)
            file.unlink()

    def test_a_full_disk_leaves_nothing(self):
        script = 'ulimit -f 8; "$0" export out/büg.h5 -o full.$1'
        for ending in ("npz", "zarr", "mcap"):
            done = subprocess.run(["bash", "-c", script, INSONIFY, ending], cwd=self.folder, capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertRegex(done.stderr, rf"^insonify: full\.{ending}: cannot write: File too large")
            self.assertEqual(list(self.folder.glob("full*")), [])

    @unittest.skipIf(shutil.which("ffmpeg") is None, "there is no ffmpeg")
    def test_videos_have_a_picture_for_each_ping(self):
        for sonar, file in (("büg", "fan.gif"), ("büg", "fan.mp4"), ("around", "scan.mp4")):
            self.insonify("export", f"out/{sonar}.h5", "-o", file, "--height", "241", "--levels", "-90:-40")
            count = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                    "stream=nb_read_frames,width,height", "-of", "json", file],
                                   cwd=self.folder, capture_output=True, text=True, check=True).stdout
            stream = json.loads(count)["streams"][0]
            tables, _, _ = self.recorded(sonar)
            self.assertEqual(int(stream["nb_read_frames"]), len(tables["time"]))
            self.assertEqual(stream["height"], 241 if file.endswith(".gif") else 242)
            # The last picture shows echoes: it is not of one colour.
            raw = subprocess.run(["ffmpeg", "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                                 cwd=self.folder, capture_output=True, check=True).stdout
            self.assertGreater(np.frombuffer(raw[-3 * stream["width"] * stream["height"]:], np.uint8).std(), 20)


if __name__ == "__main__":
    unittest.main()
