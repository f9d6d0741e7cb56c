#!/usr/bin/python3
"""serve_frames.py -- damaged HTTP requests, frames and messages to `insonify serve`, which must go on and end in time.

serve_frames.py INSONIFY [--seconds 2] [--seed 1]

After each connection the server must answer a whole request; at the end it has not grown by more than 64 MB, and ends within 5 s.
"""

import argparse
import json
import pathlib
import random
import socket
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "apps"))
from serve_client import VIEWER, Server, Socket  # noqa: E402 (it takes INSONIFY from the command line)

from damage import damaged  # noqa: E402

FOXGLOVE = "foxglove.websocket.v1"
MESSAGES = [
    {"op": "watch", "sonar": "side", "tables": ["levels", "instance"]}, {"op": "fly", "linear": [1, 0, 0], "angular": [0, 0, 10]},
    {"op": "place", "position": [0, 0, 1], "orientation": [1, 0, 0, 0]}, {"op": "follow", "on": False}, {"op": "pause", "on": False},
    {"op": "step", "back": True}, {"op": "seek", "time": 1}, {"op": "speed", "factor": 2}, {"op": "save"},
    {"op": "set", "settings": ["sonars[0].max_range=8", "seed=3"]}, {"op": "material", "object": "a", "material": "sand"},
    {"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 1}]}, {"op": "unsubscribe", "subscriptionIds": [1]},
    {"op": "getParameters", "parameterNames": ["a"]},
]


def request(chance):
    """A damaged request of a page or of a WebSocket."""
    whole = (b"GET /?token=a HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
             b"Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: insonify.viewer.v1\r\n\r\n")
    return damaged(whole, chance)[0]


def send_frames(page, chance):
    """Some frames, most with damaged messages, some themselves not as they should be."""
    for _ in range(chance.randint(1, 10)):
        text = json.dumps(chance.choice(MESSAGES)).encode()
        if chance.random() < 0.8:
            text = damaged(text, chance)[0]
        kind = chance.random()
        if kind < 0.8:
            page.send_frame(text[:200_000], opcode=chance.choice([1, 1, 1, 1, 2]))
        elif kind < 0.9:  # Continuations, reserved numbers, control frames, lengths that are not so.
            page.send_frame(text[:100], opcode=chance.randrange(16), fin=chance.random() < 0.5,
                            length=chance.choice([None, 0, 1 << 20, 1 << 40]))
        else:
            page.send(chance.randbytes(chance.randint(1, 200)))


def connection(port, chance):
    """One client, which is refused, is cut off, or leaves."""
    page = Socket(port)
    page.raw.settimeout(10)
    try:
        if chance.random() < 0.3:
            page.send(request(chance))
        elif page.open(chance.choice([VIEWER, FOXGLOVE]))[0] == 101:
            send_frames(page, chance)
        page.raw.settimeout(0.02)  # For an answer, which is not looked at.
        page.raw.recv(1 << 16)
    except (OSError, EOFError, UnicodeDecodeError):
        pass  # The server has ended the connection.
    page.raw.close()


def kilobytes(server):
    status = pathlib.Path(f"/proc/{server.process.pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=2)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    server = Server()
    try:
        for _ in range(20):
            connection(server.port, chance)
        before, count, end = kilobytes(server), 0, time.monotonic() + options.seconds
        while time.monotonic() < end:
            state = chance.getstate()
            connection(server.port, chance)
            count += 1
            try:
                answer = Socket(server.port)
                status = answer.request("/")[0]
                answer.raw.close()
            except (OSError, EOFError):
                status = None
            if status != 200 or server.process.poll() is not None:
                print(f"connection {count}, seed {options.seed}: the server has ended or answers {status}; "
                      f"chance was {hash(state)}: {server.process.poll()}")
                return 1
        grown = kilobytes(server) - before
        status, _, err, seconds = server.end()
        print(f"{count} connections, {grown / 1000:.1f} MB more, ended within {seconds:.1f} s")
        if status != 0 or grown > 64_000 or seconds > 5 or "terminate" in err:
            print(f"status {status}: {err[-500:]}")
            return 1
    finally:
        server.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
