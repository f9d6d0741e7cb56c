#!/usr/bin/python3
"""insonify serve against clients that are hostile or gone, and what it answers to messages.

serve_test.py INSONIFY
"""

import json
import socket
import struct
import subprocess
import time
import unittest

from serve_client import INSONIFY, VIEWER, Server, Socket


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

    def close_all(self, sockets):
        """Closes them, and waits until the server has seen it and answers others."""
        for one in sockets:
            one.raw.close()
        begin = time.monotonic()
        while not self.answers():
            self.assertLess(time.monotonic() - begin, 120)

    def answers(self):
        try:
            return self.socket().request("/")[0] == 200
        except (EOFError, ConnectionError):  # Refused, as one too many.
            return False

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
        self.assertAlmostEqual((loudest // 32 + 0.5) * 8.8 / 80 + 0.2, 26 ** 0.5, delta=0.12)  # The range of the point.
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
        for data, reason in (("{", "the message is not a JSON object"), ("[]", "the message is not a JSON object"),
                             ("{}", "a message of this op must have \"op\""),
                             ('{"op": "dance"}', "dance: unknown op"),
                             ('{"op": "pause", "on": 1}', "pause: \"on\" must be true or false"),
                             ('{"op": "fly", "linear": [1, 2], "angular": [0, 0, 0]}', "fly: \"linear\" must be a list of 3 numbers"),
                             ("[" * 33, "the message is more than 32 brackets deep"),
                             ("[" * 32, "the message is not a JSON object"),
                             ('{"op": ' * 33, "the message is more than 32 brackets deep")):
            with self.subTest(data[:20]):
                page = self.page()
                page.send_frame(data)
                self.assertEqual(page.text("closing"), {"op": "closing", "reason": reason})
                self.assertEqual(page.closing(), (1008, reason))

    def test_a_megabyte_of_brackets_ends_the_connection(self):
        for op, key in (("set", "settings"), ("watch", "tables"), ("fly", "linear"), ("place", "position"), ("pause", "on"),
                        ("seek", "time"), ("material", "object"), ("record", "format"), ("save", "more")):
            for opening, closing in (("[", "]"), ('{"a":', "}")):
                start, middle, end = f'{{"op":"{op}","{key}":', "1" if closing == "}" else "", "}"
                depth = (1000000 - len(start + middle + end)) // len(opening + closing)
                with self.subTest(op=op, opening=opening):
                    page = self.page()
                    page.send_frame(start + opening * depth + middle + closing * depth + end)
                    self.assertEqual(page.closing(), (1008, "the message is more than 32 brackets deep"))

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

    def test_markers_reach_all_pages_and_are_kept_beside_a_recording(self):
        one, other = self.page(), self.page()
        marker = {"name": "wreck", "position": [1, 2, -3.5], "time": 4.5, "sonar": "fls", "ping": 9}
        one.say(op="mark", markers=[marker])
        self.assertEqual(other.text("markers")["markers"], [marker])
        self.assertEqual(self.page().text("markers")["markers"], [marker])  # Of one that comes later, too.
        aside = {**marker, "range": 8.5, "side": "starboard"}
        one.say(op="mark", markers=[aside])
        self.assertEqual(other.text("markers")["markers"], [aside])
        one.say(op="mark", markers=[marker])
        for markers, text in (([{**marker, "side": "left"}], "the side of a marker must be port or starboard"),
                              ([marker] * 1001, "1001 markers are too many; the most are 1000"),
                              ([{**marker, "name": "x" * 201}], "the name of a marker has 201 bytes; the most are 200")):
            one.say(op="mark", markers=markers)
            self.assertEqual(one.text("error")["text"], text)
        one.say(op="record", on=True, format="h5")
        while not one.text("state")["recorded_pings"]:
            pass
        one.say(op="record", on=False)
        while "; markers: " not in (note := one.text("note")["text"]):
            pass
        beside = self.server.path / note.split("; markers: ")[1]
        kept = json.loads(beside.read_text())
        recording = beside.with_name(beside.name.replace("-markers.geojson", "-fls.h5"))
        info = subprocess.run([INSONIFY, "info", recording], capture_output=True, text=True, check=True).stdout
        self.assertIn("\n  1 marker: wreck\n", info)
        info = json.loads(subprocess.run([INSONIFY, "info", "--json", recording], capture_output=True, check=True).stdout)
        self.assertEqual(info[0]["markers"], [marker])
        position = marker.pop("position")
        self.assertEqual(kept["features"], [{"type": "Feature", "geometry": {"type": "Point", "coordinates": position}, "properties": marker}])
        one.say(op="mark", markers=[])
        while other.text("markers")["markers"]:
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
        self.close_all(many)

    def test_too_many_connections_are_refused(self):
        many = [self.socket() for _ in range(256)]
        for one in many:
            self.assertEqual(one.open()[0], 101)
        status, _, body = self.socket().response()
        self.assertEqual((status, body), (503, b"too many connections\n"))
        self.close_all(many)


if __name__ == "__main__":
    unittest.main(warnings="ignore")
