"""Python, C++ and the command line write the same bytes for the same scenario, away from the usual values.

    PYTHONPATH=build/dev/python tests/python/same_bytes_test.py COMMAND_LINE SOURCE_FOLDER
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import insonify

COMMAND_LINE = ""

# Two sonars with receivers of their own, one of them scanning; motion in a ping, moving object, sea surface, all ground truth.
SCENARIO = """
world: world.obj
seed: 4711
pings: 5
ground_truth: full
motion_in_ping: true
max_surfaces: 3
water: {temperature_c: 7, salinity: 28, volume_backscatter_db: -72}
receiver: {speckle: true, noise: true, field: true, counts: true, full_scale_db: -45}
surface: {level: 3.5, wind_speed: 6}
materials: {clay: mud}
points: [{position: [5, 1, -1], target_strength_db: -18}]
interferers: [{position: [12, -3, 0], source_level_db: 185, period: 0.07}]
sonars:
  - {name: ahead, beam_count: 37, bin_count: 83, min_range: 0.7, max_range: 11, frequency: 430e3,
     azimuth_aperture_deg: 77, orientation_deg: [3, 21, -5], position: [0.3, 0.1, -0.2], ping_period: 0.31,
     sampling: {columns_per_beam: 2, rows: 23}}
  - {name: round, type: msis, beam_count: 1, bin_count: 59, max_range: 9, azimuth_aperture_deg: 4, step_deg: 13,
     orientation_deg: [0, 30, 0], receiver: {pulse: lfm, pulse_bandwidth: 60000, pulse_duration: 0.0005}}
trajectory:
  - {time: 0, position: [0, 0, 0], orientation_deg: [0, 0, 0]}
  - {time: 2, position: [1.5, 0.4, -0.3], orientation_deg: [4, -3, 35]}
"""
WORLD = "v -20 -20 -3\nv 20 -20 -3\nv 20 20 -3\nv -20 20 -3\nv 6 -2 -3\nv 6 3 -3\nv 6.5 1 0\n" \
        "usemtl clay\nf 1 2 3\nf 1 3 4\nusemtl steel\nf 5 6 7\n"


class SameBytesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.file = self.folder / "s.yaml"
        self.file.write_text(SCENARIO)
        (self.folder / "world.obj").write_text(WORLD)

    def expect_same(self, *settings):
        """`insonify run`, which calls the C++ library, against Python."""
        told = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([COMMAND_LINE, "run", self.file, "-q", "--no-pictures", "--force", "-o", self.folder / "cli",
                               *told], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        sim = insonify.Simulator(insonify.Scenario.load(self.file, settings), threads=3)
        for sonar in ("ahead", "round"):
            theirs = self.folder / f"cli/{sonar}.h5"
            ours = self.folder / f"{sonar}.h5"
            pings = len(insonify.open(theirs))
            self.assertGreaterEqual(pings, 5)
            with insonify.Recording(ours, sim, sonar, replace=True) as recording:
                for number in range(pings):
                    recording.add(sim.ping(sonar, number=number))
            self.assertEqual(ours.read_bytes(), theirs.read_bytes(), (sonar, settings))
        return sim

    def test_in_the_calibrated_model(self):
        sim = self.expect_same()
        self.assertEqual(len(insonify.open(self.folder / "ahead.h5").layers), 12)
        self.assertEqual({"clay", "steel"} - set(sim.material_names) - {"mud"}, set())

    def test_in_the_paper_model(self):
        for line in ("ground_truth: full\n", "motion_in_ping: true\n", "points: [", "interferers: [", "surface: {", "max_surfaces"):
            text = self.file.read_text()
            start = text.index(line)
            self.file.write_text(text[:start] + text[text.index("\n", start) + 1:])
        text = self.file.read_text()
        text = text.replace("receiver: {speckle: true, noise: true, field: true, counts: true, full_scale_db: -45}\n", "")
        text = text.replace(", volume_backscatter_db: -72", "")
        text = text.replace(", receiver: {pulse: lfm, pulse_bandwidth: 60000, pulse_duration: 0.0005}", "")
        self.file.write_text(text)
        self.expect_same("model=paper")

    def test_without_a_surface_a_batch_gives_them_too(self):
        text = self.file.read_text()
        self.file.write_text(text.replace("surface: {level: 3.5, wind_speed: 6}\n", "").replace("motion_in_ping: true\n", ""))
        sim = self.expect_same()
        for sonar in ("ahead", "round"):
            recorded = insonify.open(self.folder / f"cli/{sonar}.h5")
            scenario = sim.scenario.copy()
            del scenario.sonars[0 if sonar == "round" else 1]
            alone = insonify.Simulator(scenario, sim.scene, threads=2)
            count = len(recorded)
            numbered = [sim.ping(sonar, number=number) for number in range(count)]
            config = scenario.sonars[0]
            vehicle_from_sonar = insonify.Pose.rpy(config.position, config.orientation_deg)
            poses = [ping.pose * vehicle_from_sonar.inverse() for ping in numbered]
            batch = alone.ping_batch(0, poses, [ping.time for ping in numbered])
            for number, pose in enumerate(poses):
                one = alone.ping(0, pose, numbered[number].time, number)
                for name, table in batch.items():
                    self.assertEqual(table[number].tobytes(), getattr(one, name).tobytes(), (sonar, name, number))
            self.assertEqual(set(batch), set(recorded.layers))


if __name__ == "__main__":
    COMMAND_LINE = str(pathlib.Path(sys.argv[1]).resolve())
    unittest.main(argv=["same_bytes_test.py"])
