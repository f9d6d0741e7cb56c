#!/usr/bin/python3
"""insonify serve against clients that are hostile, slow or gone, and how it starts and ends.

serve_test.py INSONIFY
"""

import json
import pathlib
import re
import signal
import socket
import struct
import subprocess
import time
import unittest

from serve_client import INSONIFY, VIEWER, Server, Socket

try:
    import h5py
except ImportError:
    h5py = None

class Serving(unittest.TestCase):
    """One server for many tests: what one client does must not harm the next."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server()

    @classmethod
    def tearDownClass(cls):
        status, _, err, _ = cls.server.end()
        cls.server.close()
        assert status == 0, status
        assert err == "", err

    def tearDown(self):
        """After whatever happened, a page gets pings."""
        page = self.page()
        page.ping()

    def socket(self):
        return Socket(self.server.port)

    def page(self, **options):
        page = self.socket()
        self.assertEqual(page.open(**options)[0], 101)
        return page

    # Plain HTTP.

    def test_page_is_served_with_its_types(self):
        page = self.socket()
        status, headers, body = page.request("/")
        self.assertEqual((status, headers["content-type"]), (200, "text/html; charset=utf-8"))
        self.assertIn(b"<html", body)
        self.assertIn("default-src 'none'", headers["content-security-policy"])
        status, _, again = page.request("/index.html?token=x")
        self.assertEqual((status, again), (200, body), "the same connection, by its whole name")
        page.send("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n")
        time.sleep(0.2)
        self.assertEqual(int(page.raw.recv(1 << 16).decode().lower().split("content-length: ")[1].split("\r")[0]), len(body))

    def test_nothing_but_the_page_is_served(self):
        for target in ("/../live.yaml", "/..%2flive.yaml", "/%2e%2e/live.yaml", "/live.yaml", "//etc/passwd", "/%00", "/%zz",
                       "/.git/config", "/etc/passwd", "*"):
            with self.subTest(target):
                self.assertEqual(self.socket().request(target)[0], 404)

    def test_other_methods_are_refused(self):
        status, headers, _ = self.socket().request("/", method="POST", headers=["Content-Length: 0"])
        self.assertEqual((status, headers["allow"]), (405, "GET, HEAD"))

    def test_what_is_no_http_is_answered_and_ended(self):
        page = self.socket()
        page.send("\x16\x03\x01 hello\r\n\r\n")
        self.assertEqual(page.response()[0], 400)
        self.assertTrue(page.is_closed())

    def test_long_headers_are_refused(self):
        page = self.socket()
        page.send("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + "x" * 40000 + "\r\n\r\n")
        self.assertEqual(page.response()[0], 431)

    # Who may connect.

    def test_names_of_other_sites_are_refused(self):
        for host in ("evil.example", "evil.example:8765", "127.0.0.1.evil.example", "localhost.evil.example"):
            with self.subTest(host):
                self.assertEqual(self.socket().request("/", host=host)[0], 403)
                self.assertEqual(self.socket().open(host=host)[0], 403)
        for host in ("localhost", f"127.0.0.1:{self.server.port}", "[::1]:99", "10.0.0.3"):
            with self.subTest(host):
                self.assertEqual(self.socket().request("/", host=host)[0], 200)

    def test_pages_of_other_origins_are_refused(self):
        host = f"localhost:{self.server.port}"
        for origin in ("http://evil.example", "null", f"http://evil.{host}", "http://localhost:1"):
            with self.subTest(origin):
                status, _, body = self.socket().open(host=host, headers=[f"Origin: {origin}"])
                self.assertEqual(status, 403)
                self.assertIn(b"--allow-origin", body)
        self.assertEqual(self.socket().open(host=host, headers=[f"Origin: http://{host}"])[0], 101)

    def test_subprotocol_must_be_known(self):
        for protocol in (None, "chat", "token.x"):
            status, _, body = self.socket().open(protocol=protocol)
            self.assertEqual(status, 400)
            self.assertIn(VIEWER.encode(), body)
        self.assertEqual(self.socket().open(protocol=f"chat, {VIEWER}")[1]["sec-websocket-protocol"], VIEWER)

    # What a page gets.

    def test_greeting_scene_state_and_pings(self):
        page = self.page()
        hello = page.text("hello")
        self.assertEqual([sonar["name"] for sonar in hello["sonars"]], ["fls", "side"])
        fls = hello["sonars"][0]
        self.assertEqual((fls["beams"], fls["bins"], fls["max_range"], len(fls["azimuths"])), (32, 80, 9, 32))
        self.assertEqual(hello["keys"]["sonars[0].max_range"]["value"], 9)
        self.assertEqual(hello["keys"]["model"]["choices"], ["paper", "calibrated"])
        header, tables = page.ping()
        self.assertEqual((header["sonar"], header["beams"], header["bins"]), ("fls", 32, 80))
        self.assertEqual(header["tables"], [{"name": "level", "type": "uint16", "offset": 0}])
        self.assertEqual(len(tables), 2 * 32 * 80)
        levels = struct.unpack(f"<{32 * 80}H", tables)
        loudest = max(range(len(levels)), key=levels.__getitem__)
        self.assertAlmostEqual((loudest // 32 + 0.5) * 8.8 / 80 + 0.2, 26 ** 0.5, delta=0.12)  # Of the point.
        self.assertGreater(fls["azimuths"][loudest % 32], 0)  # To port.
        state = page.text("state")
        self.assertFalse(state["paused"])
        page.say(op="watch", sonar="side", tables=["level", "instance"])
        header, tables = page.ping("side")
        self.assertEqual([table["name"] for table in header["tables"]], ["level", "instance"])
        self.assertEqual(len(tables), 6 * 16 * 40)

    def test_wrong_values_are_answered_and_change_nothing(self):
        page = self.page()
        for op, message, text in (
                ("set", {"settings": ["max_range=-2"]}, "--set max_range=-2: sonars[0].max_range = -2 m must be greater than 0, at most 100000 m"),
                ("set", {"settings": ["maxrange=3"]}, "--set maxrange=3: maxrange is not a known key; did you mean max_range?"),
                ("set", {"settings": ["seed=4", "world=/etc/passwd"]}, "world can name files, and cannot be set by a client"),
                ("set", {"settings": ["--materials.hull={relief: x.png}"]}, "materials can name files, and cannot be set by a client"),
                ("speed", {"factor": 0}, "speed = 0 must be from 0.01 to 100"),
                ("fly", {"linear": [99, 0, 0], "angular": [0, 0, 0]}, "fly.linear[0] = 99 m/s must be from -50 to 50 m/s"),
                ("watch", {"sonar": "aft"}, "there is no sonar aft"),
                ("record", {"on": True, "format": "wav"}, "format = \"wav\" must be h5 or mcap"),
                ("record", {"on": False}, "nothing is being recorded")):
            with self.subTest(message):
                page.say(op=op, **message)
                self.assertEqual(page.text("error"), {"op": "error", "text": text, "of": op})

    def test_malformed_messages_end_the_connection_with_a_reason(self):
        for data, reason in (("{", "the message is no JSON object"), ("[]", "the message is no JSON object"),
                             ("{}", "a message of this op must have \"op\""),
                             ('{"op": "dance"}', "dance: there is no such op"),
                             ('{"op": "pause", "on": 1}', "pause: \"on\" must be true or false"),
                             ('{"op": "fly", "linear": [1, 2], "angular": [0, 0, 0]}', "fly: \"linear\" must be a list of 3 numbers"),
                             ("[" * 100000, "the message is no JSON object")):
            with self.subTest(data[:20]):
                page = self.page()
                page.send_frame(data)
                self.assertEqual(page.text("closing"), {"op": "closing", "reason": reason})
                self.assertEqual(page.closing(), (1008, reason))

    def test_bytes_that_are_no_text_end_the_connection(self):
        page = self.page()
        page.send_frame(b'{"op": "\xff\xfe"}')
        self.assertEqual(page.closing()[0], 1007)
        page = self.page()
        page.send_frame(b"bytes", opcode=2)
        self.assertEqual(page.closing(), (1008, "messages to the server are texts"))

    def test_messages_over_a_megabyte_end_the_connection(self):
        reason = (1009, "messages are at most 1000000 bytes")
        page = self.page()
        page.send_frame(b" " * 1000001)
        self.assertEqual(page.closing(), reason)
        page = self.page()  # One that says it is endless.
        page.send_frame(b" " * 1000001, length=1 << 62)
        self.assertEqual(page.closing(), reason)
        page = self.page()  # Fragments are counted together.
        page.send_frame(b" " * 600000, fin=False)
        page.send_frame(b" " * 600000, opcode=0)
        self.assertEqual(page.closing(), reason)
        page = self.page()  # As much as there may be.
        page.send_frame(json.dumps({"op": "pause", "on": False}).ljust(1000000))
        page.text("state")

    def test_steering_saving_and_changing(self):
        page = self.page()
        page.say(op="fly", linear=[1, 0, 0], angular=[0, 0, 10])
        while page.text("state")["follow"]:
            pass
        while page.ping()[0]["vehicle"]["position"][0] < 0.05:
            pass
        page.say(op="save")
        yaml = page.text("saved")["yaml"]
        self.assertIn("trajectory:", yaml)
        page.say(op="set", settings=["sonars.fls.max_range=12"])
        self.assertEqual(page.text("hello")["sonars"][0]["max_range"], 12)
        page.say(op="set", settings=["sonars.fls.max_range=9"])
        page.say(op="follow", on=True)
        while not page.text("state")["follow"]:
            pass
        while page.ping()[0]["vehicle"]["position"][0] != 0:
            pass

    def test_a_second_recording_is_refused_with_the_name_of_the_first(self):
        one, other = self.page(), self.page()
        one.say(op="record", on=True, format="h5")
        while not (name := one.text("state")["recording"]):
            pass
        for format_ in ("mcap", "h5"):
            other.say(op="record", on=True, format=format_)
            self.assertEqual(other.text("error"), {"op": "error", "of": "record", "text": f"{name} is being recorded already"})
        one.say(op="record", on=False)
        while one.text("state")["recording"]:
            pass

    # One that flew and vanished would otherwise fly on for ever.
    def test_a_client_that_flew_and_vanishes_stops_the_vehicle(self):
        page, other = self.page(), self.page()
        page.say(op="fly", linear=[0, 1, 0], angular=[0, 0, 0])
        while other.ping()[0]["vehicle"]["position"][1] < 0.02:
            pass
        page.raw.close()
        places = [other.ping()[0]["vehicle"]["position"][1] for _ in range(40)]
        self.assertEqual(places[-1], places[-2])
        other.say(op="follow", on=True)

    def test_a_client_that_reads_nothing_slows_no_other(self):
        slow, quick = self.page(), self.page()
        slow.raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        start, pings = time.monotonic(), 0
        numbers = set()
        while time.monotonic() - start < 2:
            numbers.add(quick.ping()[0]["number"])
        self.assertGreater(len(numbers), 20, "of 66 at most")

    def test_half_requests_are_ended(self):
        page = self.socket()
        page.raw.settimeout(15)
        start = time.monotonic()
        page.send("GET / HTTP/1.1\r\nHost: local")
        self.assertTrue(page.is_closed())
        self.assertLess(time.monotonic() - start, 13)

    # 256 is the most there may be at a time.
    def test_connections_that_ask_for_nothing_keep_out_no_others(self):
        many = [self.socket() for _ in range(300)]
        page = self.page()
        page.ping()
        self.assertTrue(many[0].is_closed(), "the one that has waited longest")
        last = many[-1]
        self.assertEqual(last.request("/")[0], 200)
        for one in many:
            one.raw.close()
        time.sleep(0.3)

    def test_too_many_connections_are_refused(self):
        many = [self.socket() for _ in range(256)]
        for one in many:
            self.assertEqual(one.open()[0], 101)
        status, _, body = self.socket().response()
        self.assertEqual((status, body), (503, b"too many connections\n"))
        for one in many:
            one.raw.close()
        time.sleep(0.5)


class Slow(unittest.TestCase):
    """Clients that read little or nothing, of a sonar whose pings are 256 kB."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server(scenario="""
points: [{position: [5, 1, 0], target_strength_db: -20}]
sonars: [{name: fls, beam_count: 256, bin_count: 500, azimuth_aperture_deg: 80, max_range: 9, ping_period: 0.02,
          receiver: {noise: false, speckle: false}}]
""")

    @classmethod
    def tearDownClass(cls):
        status, _, err, _ = cls.server.end()
        cls.server.close()
        assert (status, err) == (0, ""), (status, err)

    def page(self):
        page = Socket(self.server.port)
        self.assertEqual(page.open()[0], 101)
        return page

    def memory(self):
        """Of the server [bytes]."""
        status = pathlib.Path(f"/proc/{self.server.process.pid}/status").read_text()
        return 1024 * int(status.split("VmRSS:")[1].split()[0])

    # 80 pings are 20 MB. What the system's buffers hold is sent; of what waits behind it the newest four stay.
    def test_a_slow_client_loses_its_oldest_pings_and_costs_no_memory(self):
        quick, slow = self.page(), self.page()
        first = slow.ping()[0]["number"]
        quick.ping()
        before, most = self.memory(), 0
        while True:
            newest = quick.ping()[0]["number"]
            most = max(most, self.memory())
            if newest > first + 80:
                break
        self.assertLess(most - before, 8_000_000)
        numbers = [slow.ping()[0]["number"]]
        while numbers[-1] < newest:
            numbers.append(slow.ping()[0]["number"])
        self.assertEqual(numbers, sorted(numbers))
        gaps = [b - a for a, b in zip(numbers, numbers[1:])]
        self.assertGreater(max(gaps), 10, "the oldest fell out")
        self.assertEqual(gaps[gaps.index(max(gaps)) + 1:][:2], [1, 1], "the newest stayed")
        while (dropped := slow.text("state")["dropped"]) == 0:
            pass
        self.assertGreaterEqual(dropped, max(gaps) - 1)

    # As one whose machine lost its power: the system knows the connection, and nobody answers.
    def test_a_client_that_gives_no_sign_of_life_is_ended(self):
        page = self.page()
        page.raw.settimeout(60)
        start = time.monotonic()
        asked = False
        try:
            while True:
                asked = page.frame()[0] == 9 or asked  # A ping of the protocol, which it does not answer.
        except (EOFError, ConnectionResetError):
            pass
        self.assertTrue(asked)
        self.assertTrue(25 < time.monotonic() - start < 50, f"{time.monotonic() - start} s")


class Starting(unittest.TestCase):
    """How it starts and ends."""

    def served(self, *options, **more):
        server = Server(*options, **more)
        self.addCleanup(server.close)
        return server

    def refused(self, *options):
        run = subprocess.run([INSONIFY, "serve", *options], text=True, capture_output=True, timeout=20, check=False)
        self.assertEqual(run.stdout, "")
        return run.returncode, run.stderr

    def test_port_in_use_is_one_line(self):
        server = self.served()
        status, err = self.refused(str(server.path / "live.yaml"), "--port", str(server.port))
        self.assertEqual((status, err), (1, f"insonify: cannot listen on port {server.port} of 127.0.0.1: Address already in use\n"))

    def test_bad_addresses_are_one_line(self):
        self.assertEqual(self.refused("x.yaml", "--address", "12.0.0", "--token", "t"),
                         (2, "insonify: --address 12.0.0 must be an IP address, such as 127.0.0.1 or ::1, or localhost\n"))
        self.assertEqual(self.refused("x.yaml", "--address", "0.0.0.0"),
                         (2, "insonify: --address 0.0.0.0 can be reached by others: it needs a --token, which they must tell\n"))
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
        self.assertEqual((status, body), (403, b"pages of another origin must be named by --allow-origin, or tell a token\n"))

    def test_origins_can_be_allowed(self):
        server = self.served("--allow-origin", "https://app.example")
        self.assertEqual(Socket(server.port).open(headers=["Origin: https://app.example"])[0], 101)
        self.assertEqual(Socket(server.port).open(headers=["Origin: https://app.examples"])[0], 403)

    def test_signals_end_it_within_a_second_with_the_recording_whole(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                server = self.served("--record", "dive.h5")
                page, idle, half = (Socket(server.port) for _ in range(3))
                self.assertEqual(page.open()[0], 101)
                self.assertEqual(idle.open()[0], 101)
                half.send("GET / HT")
                for _ in range(12):
                    page.ping()
                status, out, err, seconds = server.end(number)
                self.assertEqual((status, err), (0, ""))
                self.assertLess(seconds, 1)
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

    # 100 kB are some pings of these sonars.
    def test_a_full_disk_ends_the_recording_with_a_word_to_all_and_status_one(self):
        for ending in ("h5", "mcap"):
            with self.subTest(ending):
                server = self.served("--record", f"dive.{ending}", "--set", "beam_count=256", "--set", "bin_count=500",
                                     largest_file=2_000_000)
                page = Socket(server.port)
                page.open()
                note = page.text("note", 30)["text"]
                self.assertRegex(note, "^the recording ends here: dive.*: File too large; .*stay.* readable$")
                reason = "the recording ended early" + note.removeprefix("the recording ends here")
                later = Socket(server.port)  # A page that connects later is told too.
                later.open()
                self.assertEqual(later.text("note"), {"op": "note", "text": reason})
                while later.text("state")["recording"] is not None:
                    pass
                later.ping()  # Pings go on.
                status, _, err, _ = server.end()
                self.assertEqual((status, err.splitlines()[-1]), (1, f"insonify: {reason}"))
                self.assertTrue((server.path / "dive.yaml").exists())
                names = ["dive-fls.h5", "dive-side.h5"] if ending == "h5" else ["dive.mcap"]
                for name in names:
                    told = subprocess.run([INSONIFY, "info", name], cwd=server.path, text=True, capture_output=True, check=True)
                    self.assertRegex(told.stdout, r"\d pings? from")
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
                             text=True, capture_output=True, timeout=20, check=False)
        self.assertEqual((run.returncode, run.stdout, run.stderr),
                         (2, "", "insonify: --record dive.mcap: dive.mcap is there already; --force replaces it, or give another name\n"))
        (server.path / "dive.mcap").unlink()
        run = subprocess.run([INSONIFY, "serve", "live.yaml", "--port", "0", "--record", "dive.mcap"], cwd=server.path,
                             text=True, capture_output=True, timeout=20, check=False)
        self.assertEqual((run.returncode, run.stdout, run.stderr),
                         (2, "", "insonify: --record dive.mcap: dive.yaml is there already, where the scenario that repeats the "
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
                                 text=True, capture_output=True, timeout=20, check=False)
        self.assertEqual((refused.returncode, refused.stdout, refused.stderr),
                         (2, "", "insonify: --record dive.h5: the scenario that repeats the recording would replace dive.yaml, "
                                 "which is served; give another name\n"))
        self.assertEqual(first, ((server.path / "dive.h5").read_bytes(), (server.path / "dive.yaml").read_bytes()))
        again = subprocess.Popen([INSONIFY, "serve", "live.yaml", "--port", "0", "--record", "dive.h5", "--force",
                                  "--set", "sonars=[{name: two, max_range: 5}]"], cwd=server.path, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        Socket(int(again.stdout.readline().rstrip("/\n").rsplit(":", 1)[1])).open_for_ping()
        self.assertEqual(first[0], (server.path / "dive.h5").read_bytes(), "the earlier one stays until the end")
        again.send_signal(signal.SIGINT)
        out, err = again.communicate(timeout=20)
        self.assertEqual((again.returncode, err), (0, ""))
        self.assertIn("with dive.yaml", out)
        self.assertIn("two", (server.path / "dive.yaml").read_text())
        self.assertNotEqual(first[0], (server.path / "dive.h5").read_bytes())


def dataset_bytes(path):
    with h5py.File(path) as file:
        return file["time"][:].tobytes(), file["intensity"][:].tobytes()


if __name__ == "__main__":
    unittest.main(warnings="ignore")
