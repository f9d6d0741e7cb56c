#!/usr/bin/python3
"""MCAP recordings as input: arrays, pictures and comparisons against those of HDF5: mcap_input_test.py INSONIFY."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import numpy as np
    import insonify
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

INSONIFY = sys.argv[1]
del sys.argv[1:]

# A fan whose name is not ASCII, and a head that turns more than once round.
SCENARIO = """
world: floor.obj
duration: 0.12
sonars:
  - {name: "büg", beam_count: 12, bin_count: 40, min_range: 1, max_range: 12, orientation_deg: [0, 25, 10],
     sampling: {columns_per_beam: 2, rows: 40}}
  - {name: around, preset: tritech-micron-dst, bin_count: 25, max_range: 9, step_deg: 72, orientation_deg: [3, 0, 0],
     sampling: {columns_per_beam: 2, rows: 40}}
"""
FLOOR = "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n"

GAIN = 30.0                    # That levels have over range [dB/decade] ...
LOW, HIGH = -100.0, -40.0      # ... and what they cover [dB].
STEP = (HIGH - LOW) / 65535
ROUNDING = 1e-6                # Of 32-bit intensities [dB].


def bytes_read():
    """By this process, from whatever file [bytes]."""
    return int(pathlib.Path("/proc/self/io").read_text().split()[1])


def chunks_of(data):
    """Where the chunks of an MCAP file begin that are there as a whole."""
    found, at = [], 8
    while at + 9 <= len(data):
        length = int.from_bytes(data[at + 1:at + 9], "little")
        if data[at] == 6 and at + 9 + length <= len(data):
            found.append(at)
        at += 9 + length
    return found


class McapInputTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        os.chdir(cls.folder)
        pathlib.Path("floor.obj").write_text(FLOOR)
        pathlib.Path("s.yaml").write_text(SCENARIO)
        cls.run_insonify("run", "s.yaml", "-o", "out", "--no-pictures", "-q", "--record", "h5,mcap")
        # Levels that no echo of this scene leaves.
        cls.run_insonify("run", "s.yaml", "-o", "wide", "--no-pictures", "-q", "--record", "mcap", "--levels", "-130:-10")
        cls.run_insonify("export", "out/around.mcap", "out/büg.mcap", "-o", "both.mcap")

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        cls.scratch.cleanup()

    @staticmethod
    def run_insonify(*words, status=0):
        done = subprocess.run([INSONIFY, *words], capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120,
                              check=False)
        assert done.returncode == status, (words, done.returncode, done.stderr)
        return done.stderr if status else done.stdout

    def check_intensity(self, found, exact, ranges, step=STEP):
        """What is read back is within half a step; 0 below the levels, and cut above."""
        self.assertEqual(found.shape, exact.shape)
        self.assertEqual(found.dtype, np.float32)
        gain = GAIN * np.log10(ranges)[None, :, None]
        with np.errstate(divide="ignore"):
            level, back = 10 * np.log10(exact) + gain, 10 * np.log10(found) + gain
        inside = (level > LOW + step) & (level < HIGH)
        self.assertGreater(inside.sum(), 20)
        self.assertLessEqual(np.abs(back - level)[inside].max(), step / 2 + ROUNDING)
        self.assertTrue(np.all(found[level < LOW] == 0))
        np.testing.assert_allclose(back[level >= HIGH], HIGH, atol=10 * ROUNDING)  # And of gains added to it.

    def test_arrays_are_those_of_hdf5_within_half_a_step(self):
        for sonar in ("büg", "around"):
            exact = insonify.open(f"out/{sonar}.h5")
            for path in (f"out/{sonar}.mcap", "both.mcap"):
                found = insonify.open(path, sonar)
                self.assertEqual(found.shape, exact.shape)
                self.assertEqual(found.model, "calibrated")
                self.assertEqual(found.sonar.name, sonar)
                self.assertEqual(found.sonar.max_range, exact.sonar.max_range)
                self.check_intensity(np.asarray(found.intensity), np.asarray(exact.intensity), exact.range)
                np.testing.assert_allclose(found.time, exact.time, atol=0.6e-9)
                np.testing.assert_array_equal(found.world_from_sonar, exact.world_from_sonar)
                np.testing.assert_array_equal(found.range, exact.range)
                np.testing.assert_array_equal(found.azimuth, exact.azimuth)
                if sonar == "around":
                    self.assertGreater(exact.head_angle.max(), 2 * np.pi)
                    np.testing.assert_allclose(found.head_angle, exact.head_angle, atol=1e-12)
                else:
                    self.assertIsNone(found.head_angle)

    def test_parts_are_read_as_they_are_indexed(self):
        layer = insonify.open("out/büg.mcap").intensity
        whole = np.asarray(layer)
        np.testing.assert_array_equal(layer[1, 5:30:3, ::-2], whole[1, 5:30:3, ::-2])
        np.testing.assert_array_equal(layer[-1], whole[-1])
        np.testing.assert_array_equal(layer[:, 7], whole[:, 7])
        self.assertEqual(layer.description, "Echo intensity, from levels of -100 to -40 dB in steps of 0.00092 dB, with "
                         "30 dB a decade of range added; 0 below, cut above.")

    def test_there_is_no_ground_truth_but_its_names(self):
        exact = insonify.open("out/büg.h5")
        self.assertEqual(len(exact.instance_names), 1)
        self.assertIn("sand", exact.material_names)
        for path in ("out/büg.mcap", "both.mcap"):
            recorded = insonify.open(path, "büg")
            self.assertEqual(recorded.layers, ["intensity"])
            self.assertIsNone(recorded.instance)
            self.assertEqual(recorded.instance_names, exact.instance_names)
            self.assertEqual(recorded.material_names, exact.material_names)
        # From HDF5 to MCAP and on to NumPy.
        self.run_insonify("export", "out/büg.h5", "-o", "names.mcap")
        self.run_insonify("export", "names.mcap", "-o", "names.npz")
        with np.load("names.npz") as archive:
            self.assertEqual(list(archive["instance_names"]), exact.instance_names)
            self.assertEqual(list(archive["material_names"]), exact.material_names)

    def test_names_that_are_no_list_are_refused(self):
        data = pathlib.Path("out/büg.mcap").read_bytes()
        name = b'["' + insonify.open("out/büg.h5").instance_names[0].encode() + b'"]'
        self.assertEqual(data.count(name), 1)
        # The checksum of the file is that of its messages and summary.
        pathlib.Path("wrong.mcap").write_bytes(data.replace(name, name[:-1] + b" "))
        with self.assertRaisesRegex(insonify.Error, "^wrong.mcap: its metadata instance_names must be a list of texts$"):
            insonify.open("wrong.mcap")

    def test_pings_can_be_drawn(self):
        for sonar in ("büg", "around"):
            ping = insonify.open(f"out/{sonar}.mcap", sonar)[1]
            self.assertEqual(ping.intensity.shape, insonify.open(f"out/{sonar}.h5")[1].intensity.shape)
        recorded = insonify.open("wide/büg.mcap")
        exact = insonify.open("out/büg.h5")
        # A step of the levels is a three-hundredth of one of the colours.
        drawn = [insonify.fan(one[2], levels=(-95, -45), height=240).astype(int) for one in (recorded, exact)]
        self.assertGreater(drawn[1].std(), 20)
        self.assertLessEqual(np.abs(drawn[0] - drawn[1]).max(), 6)

    def test_several_sonars_must_be_named(self):
        with self.assertRaisesRegex(insonify.Error, "^both.mcap: holds several sonars: name one; there are around, büg$"):
            insonify.open("both.mcap")
        with self.assertRaisesRegex(insonify.Error, "^both.mcap: has no sonar port; there are around, büg$"):
            insonify.open("both.mcap", sonar="port")
        with self.assertRaisesRegex(insonify.Error, "^out/büg.h5: has no sonar around; its sonar is büg$"):
            insonify.open("out/büg.h5", "around")

    def test_npz_has_what_python_reads(self):
        self.run_insonify("export", "both.mcap", "-o", "both.npz")
        with np.load("both.npz") as archive:
            for sonar in ("büg", "around"):
                recorded = insonify.open("both.mcap", sonar)
                np.testing.assert_array_equal(archive[f"{sonar}/intensity"], np.asarray(recorded.intensity))
                np.testing.assert_array_equal(archive[f"{sonar}/time"], recorded.time)
                facts = json.loads(str(archive[f"{sonar}/attributes"]))
                self.run_insonify("export", f"out/{sonar}.h5", "-o", "h5.npz", "-f")
                with np.load("h5.npz") as exact:
                    wanted = json.loads(str(exact["attributes"]))
                    for part in ("sonar", "receiver"):
                        self.assertEqual(facts["settings"][part], wanted["settings"][part])
                    for name in ("sonar", "seed", "model", "scenario", "version", "engine", "frequency"):
                        self.assertEqual(facts[name], wanted[name])
        self.run_insonify("export", "both.mcap", "--sonar", "around", "-o", "one.npz")
        with np.load("one.npz") as archive:
            self.assertEqual(archive["intensity"].shape[1:], (25, 1))
        insonify.export(insonify.open("both.mcap", "around"), "again.npz")
        self.assertEqual(pathlib.Path("again.npz").read_bytes(), pathlib.Path("one.npz").read_bytes())

    def test_mcap_of_mcap_loses_nothing_more(self):
        for sonar in ("büg", "around"):
            np.testing.assert_array_equal(np.asarray(insonify.open("both.mcap", sonar).intensity),
                                          np.asarray(insonify.open(f"out/{sonar}.mcap").intensity))

    def test_values_of_8_bits_are_as_exact_as_they_say(self):
        self.run_insonify("export", "out/büg.h5", "-o", "coarse.mcap", "--bits", "8")
        exact = insonify.open("out/büg.h5")
        self.check_intensity(np.asarray(insonify.open("coarse.mcap").intensity), np.asarray(exact.intensity), exact.range,
                             (HIGH - LOW) / 255)
        told = self.run_insonify("info", "coarse.mcap")
        self.assertIn("\n    intensity from levels of -100 to -40 dB in steps of 0.24 dB, with 30 dB a decade of range "
                      "added; 0 below, cut above\n", told)

    def test_the_paper_model_is_linear(self):
        self.run_insonify("run", "s.yaml", "-o", "paper", "--no-pictures", "-q", "--record", "h5,mcap", "--set",
                          "model=paper")
        exact = np.asarray(insonify.open("paper/büg.h5").intensity)
        found = np.asarray(insonify.open("paper/büg.mcap").intensity)
        self.assertGreater(exact.max(), 0.1)
        self.assertLessEqual(np.abs(found - np.minimum(exact, 1)).max(), 0.5 / 65535 + 1e-7)

    def test_compare_takes_either(self):
        self.assertGreater(insonify.compare("out/büg.h5", "wide/büg.mcap").ssim, 0.9999)
        told = json.loads(self.run_insonify("compare", "out/büg.h5", "wide/büg.mcap", "--json"))
        self.assertGreater(told["ssim"], 0.9999)
        told = json.loads(self.run_insonify("compare", "out", "wide", "--sonar", "büg", "--json"))
        self.assertEqual((told["a"], told["b"]), ("out/büg.h5", "wide/büg.mcap"))

    def test_a_killed_run_has_the_pings_until_then(self):
        process = subprocess.Popen([INSONIFY, "run", "s.yaml", "-o", "killed", "--no-pictures", "-q", "--record", "mcap",
                                    "--duration", "1e6"])
        file = pathlib.Path("killed/büg.mcap")
        deadline = time.monotonic() + 60
        while (not file.exists() or len(chunks_of(file.read_bytes())) < 24) and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
        process.wait()
        whole = insonify.open("out/büg.mcap")
        killed = insonify.open(file)
        self.assertGreaterEqual(len(killed), 2)
        np.testing.assert_array_equal(killed.intensity[1], whole.intensity[1])
        # A ping costs the one chunk that it is in; the first chunk is read for the scenario.
        before = bytes_read()
        self.assertGreater(insonify.open(file).intensity[1].max(), 0)
        self.assertLess(bytes_read() - before, 0.7 * file.stat().st_size)
        # Cut in the middle of a chunk it has those before.
        data = file.read_bytes()
        pathlib.Path("cut.mcap").write_bytes(data[:chunks_of(data)[-1] + 1000])
        self.assertGreater(len(insonify.open("cut.mcap")), 0)
        self.assertLess(len(insonify.open("cut.mcap")), len(killed))
        self.run_insonify("export", "cut.mcap", "-o", "cut.npz", "--store")

    def test_files_of_others_are_refused(self):
        pathlib.Path("text.mcap").write_text("hello, this is not a recording")
        with self.assertRaisesRegex(insonify.Error, "^text.mcap: is not a recording: it is neither HDF5 nor MCAP"):
            insonify.open("text.mcap")
        other = b"\x89MCAP0\r\n" + b"\x01" + (8).to_bytes(8, "little") + bytes(8)  # A header without texts.
        other += b"\x0f" + (4).to_bytes(8, "little") + bytes(4) + b"\x89MCAP0\r\n"
        pathlib.Path("other.mcap").write_bytes(other)
        message = "other.mcap: was not recorded by insonify: it has no metadata insonify"
        with self.assertRaisesRegex(insonify.Error, f"^{message}$"):
            insonify.open("other.mcap")
        for words in (["info"], ["draw"], ["export", "-o", "x.npz"]):
            self.assertEqual(self.run_insonify(*words, "other.mcap", status=2), f"insonify: {message}\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
