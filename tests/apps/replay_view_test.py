#!/usr/bin/python3
"""insonify replay --view: pings of a recording as a page gets them, its time, and how it starts and ends.

replay_view_test.py INSONIFY
"""

import json
import math
import shutil
import signal
import subprocess
import sys
import time
import unittest

from serve_client import INSONIFY, Server, Socket

try:
    import h5py
    import numpy
except ImportError:
    print("skipped: no h5py (apt-get install python3-h5py)")
    sys.exit(77)

# Two sonars whose pings are not at the same times, and something that moves.
SCENARIO = """
world: world.sdf
points: [{position: [5, 1, 0], target_strength_db: -20}]
trajectory: [{time: 0, position: [0, 0, 0]}, {time: 4, position: [1.2, 0.4, 0]}]
motions: [{object: ball, trajectory: [{time: 0, position: [4, 0, 0]}, {time: 2, position: [4, 3, 0]}]}]
ground_truth: full
duration: 1.3
sonars:
  - {name: fls, beam_count: 24, bin_count: 70, azimuth_aperture_deg: 80, max_range: 9, ping_period: 0.11, position: [0.3, 0, -0.1]}
  - {name: head, type: msis, beam_count: 1, bin_count: 50, step_deg: 7.2, max_range: 8, ping_period: 0.043}
"""
WORLD = """<?xml version="1.0"?>
<sdf version="1.6"><world name="w"><model name="ball"><pose>4 0 0 0 0 0</pose><link name="l"><visual name="v">
<geometry><sphere><radius>0.4</radius></sphere></geometry></visual></link></model></world></sdf>
"""
RUN = ("run", "live.yaml", "-o", "out", "--no-pictures")


def replay(*options, files=("out/fls.h5", "out/head.h5"), world=WORLD, before=(RUN,)):
    return Server(*options, command=("replay", *files, "--view"), before=before, scenario=SCENARIO, others={"world.sdf": world})


def levels_of(intensity):
    """As the page gets them [dB]; none where there is no echo."""
    return [round(10 * math.log10(value), 2) if value > 0 else None for value in intensity.flat]


class Replaying(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = replay("--paused")
        cls.files = {name: h5py.File(cls.server.path / f"out/{name}.h5") for name in ("fls", "head")}
        cls.times = sorted(time for file in cls.files.values() for time in file["time"][:])

    @classmethod
    def tearDownClass(cls):
        status, out, err, seconds = cls.server.end()
        cls.server.close()
        assert (status, err) == (0, ""), (status, err)
        assert " pings shown\n" in out, out
        assert seconds < 2, seconds

    def setUp(self):
        self.page = Socket(self.server.port)
        self.assertEqual(self.page.open()[0], 101)
        self.hello = self.page.text("hello")
        self.page.say(op="pause", on=True)
        self.seek(0)

    def tearDown(self):
        self.page.raw.close()

    def seek(self, time):
        """Goes there, and waits until both sonars' pings have come."""
        self.page.say(op="watch", sonar="fls", tables=["level"])
        self.page.say(op="seek", time=time)
        want = self.number_at("fls", time)
        while self.page.ping("fls")[0]["number"] != want:
            pass

    def number_at(self, sonar, time):
        return max(0, int(numpy.searchsorted(self.files[sonar]["time"][:], time, side="right")) - 1)

    def watched(self, sonar, tables):
        self.page.say(op="watch", sonar=sonar, tables=tables)
        while True:
            header, body = self.page.ping(sonar)
            if [table["name"] for table in header["tables"]] == tables:
                return header, {table["name"]: body[table["offset"]:] for table in header["tables"]}

    def state(self, what):
        while True:
            state = self.page.text("state")
            if what(state):
                return state

    def shown(self, sonar, number, time):
        """Waits for a ping of the sonar and for a state at its time, whichever comes first."""
        missing = {"ping", "state"}
        while missing:
            opcode, data = self.page.frame()
            if opcode == 1:
                message = json.loads(data)
                if message["op"] == "state" and abs(message["time"] - time) < 1e-6:
                    missing.discard("state")
            elif opcode == 2 and data[0] == 1:
                header = json.loads(data[8:8 + int.from_bytes(data[4:8], "little")])
                if (header["sonar"], header["number"]) == (sonar, number):
                    missing.discard("ping")

    def refused(self, **message):
        self.page.say(**message)
        error = self.page.text("error")
        self.assertEqual(error["of"], message["op"])
        return error["text"]

    def test_the_greeting_tells_of_a_recording(self):
        self.assertEqual(self.hello["scenario_name"], "fls.h5 + 1")
        self.assertEqual(self.hello["recording"], {"first_time": 0, "last_time": self.times[-1], "pings": len(self.times)})
        self.assertEqual([sonar["name"] for sonar in self.hello["sonars"]], ["fls", "head"])
        self.assertIn("ball::l::v", self.hello["objects"])

    def test_markers_of_a_recording_are_shown(self):
        marker = {"name": "wreck", "position": [1, 2, -3.5], "time": 0.5, "sonar": "fls", "ping": 4}
        marked = self.server.path / "marked.h5"
        shutil.copy(self.server.path / "out/fls.h5", marked)
        with h5py.File(marked, "a") as file:
            file["markers"] = [json.dumps(marker)]
        server = replay(files=(marked,), before=())
        try:
            page = Socket(server.port)
            self.assertEqual(page.open()[0], 101)
            self.assertEqual(page.text("markers")["markers"], [marker])
        finally:
            server.close()

    def test_soundings_of_a_multibeam_are_those_of_the_file(self):
        scenario = """
world: bed.obj
pings: 2
sonars: [{name: head, preset: r2sonic-2024, mode: 400khz, max_range: 25, bin_count: 250}]
trajectory: [{time: 0, position: [0, 0, 8]}]
"""
        bed = "v -60 -60 0\nv 60 -60 0\nv 60 60 0\nv -60 60 0\nf 1 2 3 4\n"
        server = Server("--paused", command=("replay", "out/head.h5", "--view"), before=(RUN,), scenario=scenario, others={"bed.obj": bed})
        try:
            page = Socket(server.port)
            self.assertEqual(page.open()[0], 101)
            sonar = page.text("hello")["sonars"][0]
            self.assertEqual((sonar["type"], sonar["product"], len(sonar["azimuths"])), ("mbes", "image", sonar["beams"]))
            page.say(op="watch", sonar="head", tables=["level", "sounding_range", "detection"])
            page.say(op="seek", time=0)
            while True:
                header, body = page.ping("head")
                tables = {table["name"]: body[table["offset"]:] for table in header["tables"]}
                if len(tables) == 3:
                    break
            with h5py.File(server.path / "out/head.h5") as file:
                ranges = numpy.frombuffer(tables["sounding_range"], "<f4", sonar["beams"])
                numpy.testing.assert_array_equal(ranges, file["sounding_range"][header["number"]])
                detection = numpy.frombuffer(tables["detection"], "u1", sonar["beams"])
                numpy.testing.assert_array_equal(detection, file["sounding_detection"][header["number"]])
            self.assertGreater((detection == 1).sum(), 5)
            self.assertLess(abs(numpy.nanmin(ranges) - 8), 0.3)
        finally:
            server.close()

    def test_pings_are_those_of_the_file(self):
        for sonar, at in (("fls", 0.7), ("head", 0.7), ("fls", 1.2)):
            self.seek(at)
            number = self.number_at(sonar, at)
            header, tables = self.watched(sonar, ["level", "instance", "material", "elevation", "shadow", "multipath"])
            file = self.files[sonar]
            self.assertEqual((header["number"], header["time"]), (number, file["time"][number]))
            cells = header["beams"] * header["bins"]
            levels = numpy.frombuffer(tables["level"], "<u2", cells)
            told = [round(value / 100 - 400, 2) if value else None for value in levels.tolist()]
            for one, other in zip(told, levels_of(file["intensity"][number])):
                self.assertEqual(one is None, other is None)
                self.assertLess(abs((one or 0) - (other or 0)), 0.011)
            instances = numpy.frombuffer(tables["instance"], "<i4", cells)
            wanted = file["instance"][number].astype(int).ravel()
            wanted[wanted == 65535] = -1
            self.assertEqual(instances.tolist(), wanted.tolist())
            if sonar == "fls":
                self.assertGreater((instances >= 0).sum(), 0, "something is labelled")
            elevation = numpy.frombuffer(tables["elevation"], "<f4", cells)
            self.assertEqual(elevation.tobytes(), file["elevation"][number].tobytes())
            numpy.testing.assert_array_equal(numpy.frombuffer(tables["multipath"], "u1", cells), file["path_order"][number].ravel())

    def test_the_vehicle_is_where_it_was(self):
        self.seek(1.0)
        header, _ = self.watched("fls", ["level"])
        along = self.files["fls"]["time"][header["number"]] / 4
        for got, wanted in zip(header["vehicle"]["position"], (1.2 * along, 0.4 * along, 0)):
            self.assertAlmostEqual(got, wanted, places=6)

    def test_what_moves_is_where_it_was(self):
        self.page.say(op="seek", time=1.1)
        end = time.monotonic() + 10
        while time.monotonic() < end:
            opcode, data = self.page.frame()
            if opcode != 2 or data[0] != 3:
                continue
            size = int.from_bytes(data[4:8], "little")
            matrix = json.loads(data[8:8 + size])["objects"][0]["matrix"]
            when = self.files["fls"]["time"][self.number_at("fls", 1.1)]
            if abs(matrix[13] - 1.5 * when) < 1e-6:
                return
        self.fail("the ball was not seen where it was at that time")

    def test_steps_go_to_pings_of_the_sonar_that_is_watched(self):
        for sonar in ("fls", "head"):
            self.seek(0.5)
            self.state(lambda state: abs(state["time"] - 0.5) < 0.05)
            self.watched(sonar, ["level"])
            times = list(self.files[sonar]["time"][:])
            number = self.number_at(sonar, 0.5) + 1
            for back, to in ((False, number), (False, number + 1), (True, number), (True, number - 1)):
                self.page.say(op="step", back=back)
                self.shown(sonar, to, times[to])

    def test_past_the_last_ping_of_the_watched_sonar_steps_go_on(self):
        last = self.files["fls"]["time"][-1]
        self.seek(last)
        rest = [time for time in self.times if time > last]
        self.assertGreater(len(rest), 0)
        for time in rest:
            self.page.say(op="step")
            self.state(lambda state, time=time: abs(state["time"] - time) < 1e-6)
        self.page.say(op="step", back=True)
        self.state(lambda state: state["time"] == self.files["fls"]["time"][-1 if rest[-1] > last else -2])

    def test_it_ends_paused_and_begins_anew(self):
        self.page.say(op="seek", time=1e9)
        self.state(lambda state: state["time"] == self.times[-1])
        self.page.say(op="pause", on=False)
        self.state(lambda state: not state["paused"] and state["time"] < 1)
        self.page.say(op="speed", factor=50)
        self.state(lambda state: state["paused"] and state["time"] == self.times[-1])
        self.page.say(op="speed", factor=1)

    def test_speed_is_that_of_the_clock_times_the_factor(self):
        self.page.say(op="speed", factor=0.5)
        self.page.say(op="pause", on=False)
        start = None
        while True:
            header, _ = self.page.ping("fls")
            start = start or (header["made_at"], header["time"])
            if header["time"] > 0.75:
                break
        passed = header["made_at"] - start[0]
        self.assertGreaterEqual(passed, 2 * (header["time"] - start[1]) - 0.02)
        self.page.say(op="speed", factor=1)

    def test_what_is_made_cannot_be_changed(self):
        for message in ({"op": "fly", "linear": [1, 0, 0], "angular": [0, 0, 0]}, {"op": "follow", "on": False}, {"op": "save"},
                        {"op": "place", "position": [0, 0, 0], "orientation": [1, 0, 0, 0]}, {"op": "set", "settings": ["seed=3"]},
                        {"op": "material", "object": "ball::l::v", "material": "steel"}, {"op": "record", "on": True}):
            self.assertEqual(self.refused(**message), "this is a recording: its pings are made, and cannot be changed")

    def test_wrong_speeds_are_refused(self):
        self.assertEqual(self.refused(op="speed", factor=0), "speed = 0 must be from 0.01 to 100")


class Starting(unittest.TestCase):
    def fails(self, *words, folder):
        done = subprocess.run([INSONIFY, "replay", *words], cwd=folder, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
        return done.stderr

    def test_wrong_input_is_one_line(self):
        server = replay()
        try:
            folder = server.path
            other = ("run", "live.yaml", "-o", "other", "--no-pictures", "--seed", "9")
            subprocess.run([INSONIFY, *other], cwd=folder, check=True, capture_output=True)
            fls, head = "out/fls.h5", "out/head.h5"
            for words, part in (((fls, head, "--view", "--height", "300"), "--height is for pictures"),
                                ((fls, "--port", "0"), "--port is for the viewer"),
                                ((fls, head), "out/head.h5: pictures are drawn of one recording at a time"),
                                ((fls, fls, "--view"), "both of a sonar called fls"),
                                ((fls, "other/head.h5", "--view"), "of different runs: their scenarios differ"),
                                ((fls, "--view", "--sonar", "sas"), "there is no sonar sas"),
                                (("live.yaml", "--view"), "is not a recording"),
                                (("gone.h5", "--view"), "no such file"),
                                ((fls, "--view", "--speed", "0"), "--speed"),
                                ((fls, "--view", "--folder", "nowhere"), "nowhere")):
                with self.subTest(words):
                    self.assertIn(part, self.fails(*words, folder=folder))
            served = subprocess.run([INSONIFY, "serve", fls], cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertIn("insonify replay out/fls.h5 --view", served.stderr)
        finally:
            server.close()

    def test_without_its_world_names_stay(self):
        for ending in ("h5", "mcap"):
            server = replay("--folder", "out", files=(f"out/fls.{ending}",), before=((*RUN, "--record", ending),))
            try:
                page = Socket(server.port)
                page.open()
                self.assertIn("ball::l::v", page.text("hello")["objects"], ending)
                page.ping("fls")
                _, _, err, _ = server.end()
                self.assertEqual(err.count("\n"), 1)
                self.assertIn("the scene is shown without its objects", err)
            finally:
                server.close()

    def test_a_world_that_has_changed_is_not_shown(self):
        server = replay(before=((*RUN, "--record", "h5,mcap"),))
        try:
            server.end()
            (server.path / "world.sdf").write_text(WORLD.replace("<visual name=\"v\">", "<visual name=\"w\">"))
            for file in ("out/fls.h5", "out/fls.mcap"):
                done = subprocess.Popen([INSONIFY, "replay", file, "--view", "--port", "0"], cwd=server.path, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                done.stdout.readline()
                done.send_signal(signal.SIGTERM)
                self.assertIn("has other objects than the recording", done.communicate(timeout=120)[1], file)
        finally:
            server.close()

    def test_mcap_plays_too(self):
        server = replay("--speed", "3", files=("run.mcap",), before=(RUN, ("export", "out/fls.h5", "out/head.h5", "-o", "run.mcap")))
        try:
            page = Socket(server.port)
            page.open()
            hello = page.text("hello")
            self.assertEqual([sonar["name"] for sonar in hello["sonars"]], ["fls", "head"])
            page.say(op="watch", sonar="head", tables=["level"])
            numbers = []
            while not numbers or numbers[-1] < 29:
                numbers.append(page.ping("head")[0]["number"])
            self.assertEqual(numbers, sorted(numbers))
        finally:
            server.close()

    def test_of_an_unfinished_recording_it_says_so(self):
        server = replay(files=("run.mcap",), before=(RUN, ("export", "out/fls.h5", "-o", "run.mcap")))
        try:
            server.end()
            whole = (server.path / "run.mcap").read_bytes()
            (server.path / "run.mcap").write_bytes(whole[:-100])  # Of the summary at its end.
            done = subprocess.Popen([INSONIFY, "replay", "run.mcap", "--view", "--port", "0"], cwd=server.path, text=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            done.stdout.readline()
            done.send_signal(signal.SIGTERM)
            told = done.communicate(timeout=120)[1]
            self.assertIn("run.mcap is unfinished: the run that wrote it was killed", told)
            self.assertIn("it has 12 pings", told)
        finally:
            server.close()


if __name__ == "__main__":
    unittest.main()
