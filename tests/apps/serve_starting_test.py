#!/usr/bin/python3
"""How insonify serve starts and ends, and what recordings it leaves.

serve_starting_test.py INSONIFY
"""

import json
import pathlib
import re
import signal
import socket
import struct
import subprocess
import unittest

try:
    import h5py
except ImportError:
    h5py = None

from serve_client import INSONIFY, PROMPT, VIEWER, Server, Socket


class Starting(unittest.TestCase):
    """How it starts and ends."""

    def served(self, *options, **more):
        server = Server(*options, **more)
        self.addCleanup(server.close)
        return server

    def refused(self, *options):
        run = subprocess.run([INSONIFY, "serve", *options], text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual(run.stdout, "")
        return run.returncode, run.stderr

    def test_port_in_use_is_one_line(self):
        server = self.served()
        status, err = self.refused(str(server.path / "live.yaml"), "--port", str(server.port))
        self.assertEqual((status, err), (1, f"insonify: cannot listen on port {server.port} of 127.0.0.1: Address already in use\n"))

    def test_bad_addresses_are_one_line(self):
        self.assertEqual(self.refused("x.yaml", "--address", "12.0.0", "--token", "t"),
                         (2, "insonify: --address 12.0.0 must be an IP address, such as 127.0.0.1 or ::1, or localhost\n"))
        self.assertEqual(self.refused("x.yaml", "--address", "0.0.0.0", "--no-token"),
                         (2, "insonify: --address 0.0.0.0 can be reached by others: --no-token is only for this machine\n"))
        status, err = self.refused("/nowhere/x.yaml", "--port", "0")
        self.assertEqual((status, err), (2, "insonify: /nowhere/x.yaml: no such file\n"))

    def test_the_address_of_this_machine_has_a_name(self):
        server = self.served("--address", "localhost")
        self.assertEqual(server.address, f"http://localhost:{server.port}/")
        self.assertEqual(Socket(server.port).open()[0], 101)

    def test_origins_must_be_origins(self):
        for origin in ("foo", "app.example", "https://", "https://app.example/", "https://app.example/page", "*", "https://*",
                       "://app.example", ""):
            with self.subTest(origin):
                self.assertEqual(self.refused("x.yaml", "--allow-origin", origin),
                                 (2, f"insonify: --allow-origin {origin} must be a scheme and a host, such as https://app.example "
                                     "or http://localhost:8080, without a path\n"))

    def test_options_that_contradict_a_token_are_one_line(self):
        self.assertEqual(self.refused("x.yaml", "--token", "t", "--no-token"),
                         (2, "insonify: --token and --no-token exclude each other\n"))
        self.assertEqual(self.refused("x.yaml", "--allow-origin", "https://app.example"),
                         (2, "insonify: --allow-origin has no effect without --no-token: pages of any origin may connect with the token\n"))

    def test_each_start_has_a_token_of_its_own(self):
        tokens = set()
        for _ in range(2):
            server = self.served(token=True)
            token = re.fullmatch(rf"http://127\.0\.0\.1:{server.port}/\?token=([0-9a-f]{{32}})", server.address)[1]
            self.assertEqual(Socket(server.port).open()[0], 401)
            self.assertEqual(Socket(server.port).open(target=f"/?token={token}")[0], 101)
            tokens.add(token)
        self.assertEqual(len(tokens), 2)

    # Characters that end a query, or that a browser would read as something else.
    def test_the_address_holds_any_token(self):
        token = "a&b#c d%41+e/\u00fc"
        server = self.served("--token", token)
        self.assertEqual(server.address, f"http://127.0.0.1:{server.port}/?token=a%26b%23c%20d%2541%2Be%2F%C3%BC")
        self.assertEqual(Socket(server.port).open(target="/" + server.address.split("/")[-1])[0], 101)
        self.assertEqual(Socket(server.port).open(target="/?token=" + token.split("#", maxsplit=1)[0])[0], 401)

    def test_token_is_told_as_header_query_or_subprotocol(self):
        server = self.served("--address", "0.0.0.0", "--token", "se.cr-et")
        def status(**how):
            return Socket(server.port).open(**how)[0]
        self.assertEqual(status(), 401)
        self.assertEqual(status(target="/?token=se.cr-eT"), 401)
        self.assertEqual(status(target="/?token=se.cr-e"), 401)
        self.assertEqual(status(target="/?token="), 401)
        self.assertEqual(status(headers=["Authorization: Bearer wrong"]), 401)
        self.assertEqual(status(headers=["Authorization: Bearer se.cr-et"]), 101)
        self.assertEqual(status(target="/?a=b&token=se.cr%2det"), 101)
        self.assertEqual(status(protocol=f"token.se.cr-et, {VIEWER}"), 101)
        self.assertEqual(status(target="/?token=se.cr-et", headers=["Origin: http://else.where"], host="my.boat"), 101)

    def test_of_all_addresses_it_tells_one_that_others_can_use(self):
        server = self.served("--address", "0.0.0.0", "--token", "se.cr-et", "-q")
        host = server.address.removeprefix("http://").split(":")[0]
        self.assertEqual(server.address, f"http://{host}:{server.port}/?token=se.cr-et")
        if re.fullmatch(r"[\d.]+", host):
            self.assertFalse(host.startswith("127.") or host == "0.0.0.0", host)
            self.assertEqual(Socket(server.port, host).open(target="/?token=se.cr-et", host=f"{host}:{server.port}")[0], 101)
        else:  # A machine with no network.
            self.assertEqual(host, socket.gethostname())

    # A browser does not tell a page why a WebSocket could not be opened.
    def test_a_page_can_ask_whether_it_may_connect(self):
        server = self.served("--token", "right")
        for target, status, body in (("/access", 401, b"the token is missing or wrong\n"),
                                     ("/access?token=wrong", 401, b"the token is missing or wrong\n"),
                                     ("/access?token=right", 200, b"a WebSocket may be opened\n")):
            answer = Socket(server.port).request(target)
            self.assertEqual((answer[0], answer[2]), (status, body), target)
        server = self.served()
        self.assertEqual(Socket(server.port).request("/access")[0], 200)
        status, _, body = Socket(server.port).request("/access", headers=["Origin: http://evil.example"])
        self.assertEqual((status, body), (403, b"pages of another origin must be named by --allow-origin, or send a token\n"))

    def test_origins_can_be_allowed(self):
        server = self.served("--allow-origin", "https://app.example")
        self.assertEqual(Socket(server.port).open(headers=["Origin: https://app.example"])[0], 101)
        self.assertEqual(Socket(server.port).open(headers=["Origin: https://app.examples"])[0], 403)

    def test_signals_end_it_at_once_with_the_recording_whole(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                server = self.served("--record", "dive.h5")
                self.assertRegex(server.process.stdout.readline(), r"^engine: [cg]pu, ")
                page, idle, half = (Socket(server.port) for _ in range(3))
                self.assertEqual(page.open()[0], 101)
                self.assertEqual(idle.open()[0], 101)
                half.send("GET / HT")
                for _ in range(12):
                    page.ping()
                status, out, err, seconds = server.end(number)
                self.assertEqual((status, err), (0, ""))
                self.assertLess(seconds, PROMPT)
                told = re.fullmatch(r"recorded (\d+) pings, ([\d.]+) ([kM])B: dive-fls.h5, dive-side.h5, with dive.yaml, in (.*)\n"
                                    r"\d+ pings in \d+\.\d s\n", out)
                self.assertTrue(told, out)
                self.assertEqual(pathlib.Path(told[4]).resolve(), server.path.resolve())
                size = sum((server.path / f"dive-{sonar}.h5").stat().st_size for sonar in ("fls", "side"))
                self.assertEqual(told[2], f"{size / 1e3:.0f}" if told[3] == "k" else f"{size / 1e6:.1f}")
                self.assertEqual(page.closing(), (1001, "the server ends"))
                # The scenario beside it repeats it byte for byte.
                if h5py is None:
                    self.skipTest("there is no python3-h5py")
                subprocess.run([INSONIFY, "run", "dive.yaml", "-o", "again", "--no-pictures", "-q"], cwd=server.path, check=True)
                for sonar in ("fls", "side"):
                    self.assertEqual(*(dataset_bytes(server.path / file) for file in (f"dive-{sonar}.h5", f"again/{sonar}.h5")))

    def test_values_that_a_recording_cuts_are_told_to_pages_and_on_the_terminal(self):
        server = self.served("--record", "dive.mcap", "--levels=-200:-150")
        page = Socket(server.port)
        page.open()
        for _ in range(3):
            page.ping()
        page.say(op="record", on=False)
        told = page.text("note")["text"]
        cut = (r"warning: dive(_2)?\.mcap: \d+ of \d+ values of fls are above the highest level, -150 dB, and are clipped; "
               r"the loudest has -[\d.]+ dB")
        self.assertRegex(told, f"^{cut}$")
        page.say(op="record", on=True, format="mcap")  # A second one, which Ctrl-C ends.
        while not page.text("state")["recording"]:
            pass
        for _ in range(3):
            page.ping()
        status, _, err, _ = server.end()
        self.assertEqual(status, 0)
        self.assertEqual(len(re.findall(cut, err)), 2, err)

    # 100 kB are some pings of these sonars.
    def test_a_full_disk_ends_the_recording_with_a_word_to_all_and_status_one(self):
        for ending in ("h5", "mcap"):
            with self.subTest(ending):
                server = self.served("--record", f"dive.{ending}", "--set", "beam_count=256", "--set", "bin_count=500", "--paused",
                                     largest_file=2_000_000)
                page = Socket(server.port)
                page.open()
                page.say(op="pause", on=False)
                note = page.text("note", 30)["text"]
                self.assertRegex(note, "^the recording ends here: dive.*: File too large; .*stay.* readable$")
                reason = "the recording ended early" + note.removeprefix("the recording ends here")
                later = Socket(server.port)  # A page that connects later is told too.
                later.open()
                self.assertEqual(later.text("note"), {"op": "note", "text": reason})
                while later.text("state")["recording"] is not None:
                    pass
                later.ping()  # Pings go on.
                status, out, err, _ = server.end()
                self.assertEqual((status, err.splitlines()[-1]), (1, f"insonify: {reason}"))
                self.assertTrue((server.path / "dive.yaml").exists())
                names = ["dive-fls.h5", "dive-side.h5"] if ending == "h5" else ["dive.mcap"]
                pings = 0
                for name in names:
                    told = subprocess.run([INSONIFY, "info", name], cwd=server.path, text=True, capture_output=True, check=True)
                    self.assertRegex(told.stdout, r"\d pings? from")
                    pings += sum(map(int, re.findall(r"(\d+) pings? from", told.stdout)))
                self.assertIn(f"recorded {pings} pings, ", out)
                subprocess.run([INSONIFY, "run", "dive.yaml", "-o", "again", "--pings", "2", "--no-pictures", "-q"],
                               cwd=server.path, check=True)

    # Its first pings hear noise only: levels that fit them would make the noise bright.
    def test_levels_of_a_scanning_head_follow_its_first_turn(self):
        server = self.served(scenario="""
points: [{position: [0, 5, 0], target_strength_db: -10}]
sonars: [{name: head, type: msis, beam_count: 1, azimuth_aperture_deg: 4, step_deg: 6, bin_count: 100, max_range: 12, ping_period: 0.02}]
""")
        page = Socket(server.port)
        page.open()
        first = page.text("hello")["sonars"][0]["levels"]
        self.assertEqual(first[1] - first[0], 50)
        while True:
            levels = page.text("levels")
            self.assertEqual(levels["sonar"], "head")
            if levels["levels"][1] > first[1] + 20:
                break
        while page.ping()[0]["number"] < 130:  # Two turns of 60 pings, and more.
            pass
        later = Socket(server.port)
        later.open()
        last = later.text("hello")["sonars"][0]["levels"]
        # The point: -10 - 40 lg 5 - 2 alpha 5, raised by 30 lg 5, is between -20 and -15 dB, of which the brightest level lies 25 dB
        # below at most, and is a multiple of 5.
        self.assertIn(last[1], (-45, -40))
        self.assertEqual(last[1] - last[0], 50)

    def test_the_scene_holds_point_targets(self):
        page = Socket(self.served().port)
        page.open()
        while True:
            opcode, data = page.frame()
            if opcode == 2 and struct.unpack("<I", data[:4])[0] == 2:
                break
        header = json.loads(data[8:8 + struct.unpack("<I", data[4:8])[0]])
        self.assertEqual(header["points"], [[5, 1, 0]])

    def test_recordings_that_are_there_are_kept(self):
        server = self.served("--record", "dive.mcap")
        page = Socket(server.port)
        page.open()
        for _ in range(3):
            page.ping()
        server.end()
        self.assertTrue((server.path / "dive.mcap").exists())
        run = subprocess.run([INSONIFY, "serve", "live.yaml", "--port", "0", "--record", "dive.mcap"], cwd=server.path,
                             text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual((run.returncode, run.stdout, run.stderr),
                         (2, "", "insonify: --record dive.mcap: dive.mcap exists already; --force replaces it, or give another name\n"))
        (server.path / "dive.mcap").unlink()
        run = subprocess.run([INSONIFY, "serve", "live.yaml", "--port", "0", "--record", "dive.mcap"], cwd=server.path,
                             text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual((run.returncode, run.stdout, run.stderr),
                         (2, "", "insonify: --record dive.mcap: dive.yaml exists already, where the scenario that repeats the "
                                 "recording is to be written; --force replaces it, or give another name\n"))

    def test_a_recording_is_told_to_the_pages_when_it_ends(self):
        server = self.served()
        page = Socket(server.port)
        page.open()
        page.ping()
        page.say(op="record", on=True)
        while page.text("state")["recorded_pings"] <= 3:
            pass
        page.say(op="record", on=False)
        note = page.text("note")["text"]
        # live.yaml is the scenario, which the recording's does not replace.
        told = re.fullmatch(r"recorded (\d+) pings, [\d.]+ [kM]B: live_2-fls.h5, live_2-side.h5, with live_2.yaml, in (.*)", note)
        self.assertTrue(told, note)
        self.assertEqual(pathlib.Path(told[2]).resolve(), server.path.resolve())
        self.assertIn(note + "\n", server.end()[1])

    def test_with_force_a_recording_replaces_another_but_never_the_scenario(self):
        server = self.served("--record", "dive.h5", "-f", "--set", "sonars=[{name: one, max_range: 5}]")
        Socket(server.port).open_for_ping()
        server.end()
        first = (server.path / "dive.h5").read_bytes(), (server.path / "dive.yaml").read_bytes()
        refused = subprocess.run([INSONIFY, "serve", "dive.yaml", "--port", "0", "--record", "dive.h5", "-f"], cwd=server.path,
                                 text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual((refused.returncode, refused.stdout, refused.stderr),
                         (2, "", "insonify: --record dive.h5: the scenario that repeats the recording would replace dive.yaml, "
                                 "which is served; give another name\n"))
        self.assertEqual(first, ((server.path / "dive.h5").read_bytes(), (server.path / "dive.yaml").read_bytes()))
        again = subprocess.Popen([INSONIFY, "serve", "live.yaml", "--port", "0", "--record", "dive.h5", "--force", "--no-token",
                                  "--set", "sonars=[{name: two, max_range: 5}]"], cwd=server.path, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(again.kill)
        Socket(int(again.stdout.readline().rstrip("/\n").rsplit(":", 1)[1])).open_for_ping()
        self.assertEqual(first[0], (server.path / "dive.h5").read_bytes(), "the earlier one stays until the end")
        again.send_signal(signal.SIGINT)
        out, err = again.communicate(timeout=120)
        self.assertEqual((again.returncode, err), (0, ""))
        self.assertIn("with dive.yaml", out)
        self.assertIn("two", (server.path / "dive.yaml").read_text())
        self.assertNotEqual(first[0], (server.path / "dive.h5").read_bytes())


def dataset_bytes(path):
    with h5py.File(path) as file:
        return file["time"][:].tobytes(), file["intensity"][:].tobytes()


if __name__ == "__main__":
    unittest.main(warnings="ignore")
