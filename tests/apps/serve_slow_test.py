#!/usr/bin/python3
"""insonify serve against clients that are slow, or give no sign of life.

serve_slow_test.py INSONIFY
"""

import json
import pathlib
import struct
import time
import unittest

from serve_client import Server, Socket


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

    # 200 pings are 50 MB. What the system's buffers hold is sent; of what waits behind it the newest four stay.
    def test_a_slow_client_loses_its_oldest_pings_and_costs_no_memory(self):
        quick, slow = self.page(), self.page()
        first = slow.ping()[0]["number"]
        quick.ping()
        before, most, newest = self.memory(), 0, 0
        while newest <= first + 200:
            newest = quick.ping()[0]["number"]
            most = max(most, self.memory())
        self.assertLess(most - before, 20_000_000)
        # No more come while the slow one reads, so that the last ones it gets are those that were kept for it.
        quick.say(op="pause", on=True)
        newest = last_ping(quick, newest)
        numbers = [slow.ping()[0]["number"]]
        while numbers[-1] < newest:
            numbers.append(slow.ping()[0]["number"])
        self.assertEqual(numbers, sorted(numbers))
        gaps = [b - a for a, b in zip(numbers, numbers[1:])]
        self.assertGreater(max(gaps), 10, "the oldest fell out")
        # The first of the four may be an older one, whose sending had begun.
        self.assertEqual(gaps[-2:], [1, 1], "the newest stayed")
        # States from before the end say less, and a gap has pings too that a busy server sent to no page.
        while slow.text("state")["dropped"] <= 10:
            pass
        quick.say(op="pause", on=False)

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


def last_ping(page, number):
    """The number of the last ping before a pause, after `number`: between two states that say so none came."""
    last, paused = None, False
    while not paused or last != number:
        last = number
        while True:
            opcode, data = page.frame()
            if opcode == 2 and struct.unpack("<I", data[:4])[0] == 1:
                number = json.loads(data[8:8 + struct.unpack("<I", data[4:8])[0]])["number"]
            elif opcode == 1 and json.loads(data)["op"] == "state":
                paused = json.loads(data)["paused"]
                break
    return number


if __name__ == "__main__":
    unittest.main(warnings="ignore")
