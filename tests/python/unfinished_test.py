#!/usr/bin/python3
"""Warnings and states of recordings that end before their runs did: unfinished_test.py INSONIFY SOURCE_FOLDER."""

import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
import warnings

try:
    import insonify
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

INSONIFY = sys.argv[1]

SCENARIO = """
world: floor.obj
pings: 7
sonars:
  - {name: ahead, beam_count: 12, bin_count: 400, max_range: 12, orientation_deg: [0, 25, 0],
     sampling: {columns_per_beam: 2, rows: 20}}
"""
FLOOR = "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n"

# Records five pings and is killed.
KILLED = """
import os, signal
import insonify
sim = insonify.Simulator(insonify.Scenario.load("s.yaml"))
recording = insonify.Recording("killed.h5", sim)
for number in range(5):
    recording.add(sim.ping())
os.kill(os.getpid(), signal.SIGKILL)
"""


def opened(path):
    """The recording, and what was warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        recorded = insonify.open(path)
    for warning in caught:
        assert warning.category is insonify.Warning, warning.category
        assert warning.filename == __file__, warning.filename  # The line that opens, not one of the package.
    return recorded, [str(warning.message) for warning in caught]


def limit_files():
    """Files of a child process end at 900 kB, which stands for a full disk."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (900_000, 900_000))


class UnfinishedTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(scratch.name)
        pathlib.Path("floor.obj").write_text(FLOOR)
        pathlib.Path("s.yaml").write_text(SCENARIO)

    def run_insonify(self, *words, **options):
        return subprocess.run([INSONIFY, *words], capture_output=True, text=True, timeout=120, check=False, **options)

    def record(self, *words):
        self.assertEqual(self.run_insonify("run", "s.yaml", "-q", "--no-pictures", "-o", "out", *words).returncode, 0)

    def test_a_whole_recording_is_opened_in_silence(self):
        self.record("--record", "h5,mcap")
        for path in ("out/ahead.h5", "out/ahead.mcap"):
            recorded, told = opened(path)
            self.assertEqual((recorded.state, told, len(recorded)), ("whole", [], 7))

    def test_a_killed_run_is_warned_of_once(self):
        done = subprocess.run([sys.executable, "-c", KILLED], check=False, timeout=120)
        self.assertEqual(done.returncode, -signal.SIGKILL)
        recorded, told = opened("killed.h5")
        self.assertEqual(recorded.state, "unfinished")
        self.assertEqual(told, ["killed.h5 is unfinished: the run that wrote it was killed; it has 5 pings"])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertGreater(recorded[4].intensity.max(), 0)  # Its pings are read in silence ...
            with self.assertRaises(insonify.Warning):
                insonify.open("killed.h5")  # ... and who wants an error instead gets one.

    def test_an_mcap_file_without_its_end_is_warned_of(self):
        self.record("--record", "mcap")
        whole = pathlib.Path("out/ahead.mcap").read_bytes()
        pathlib.Path("cut.mcap").write_bytes(whole[:-100])
        recorded, told = opened("cut.mcap")
        self.assertEqual(recorded.state, "unfinished")
        self.assertEqual(told, ["cut.mcap is unfinished: the run that wrote it was killed, or the disk was full; it has 7 "
                                "pings"])

    def test_a_full_disk_is_warned_of(self):
        for kind, ending in (("h5", "h5"), ("mcap", "mcap")):
            done = self.run_insonify("run", "s.yaml", "-q", "--no-pictures", "-o", kind, "--record", kind, "--pings", "2000",
                                     preexec_fn=limit_files)
            self.assertEqual(done.returncode, 1, done.stderr)
            path = f"{kind}/ahead.{ending}"
            recorded, told = opened(path)
            self.assertEqual(recorded.state, "disk_full")
            self.assertGreater(len(recorded), 0)
            pings = "1 ping" if len(recorded) == 1 else f"{len(recorded)} pings"
            self.assertEqual(told, [f"{path} is cut short: the disk was full; it has {pings}"])

    def test_a_growing_recording_says_so_and_is_no_fault(self):
        sim = insonify.Simulator(insonify.Scenario.load("s.yaml"))
        with insonify.Recording("grows.h5", sim) as recording:
            recording.add(sim.ping())
            recorded, told = opened(recording.place)
            self.assertEqual((recorded.state, told, len(recorded)), ("growing", [], 1))
        self.assertEqual(recorded.state, "growing")  # As it was when it was opened.
        del recorded  # HDF5 shares what it has read among all that a process has open of a file.
        self.assertEqual(opened("grows.h5")[0].state, "whole")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
