"""A server of the viewer's page in a folder of its own, and connections to it that read and write bytes, HTTP and frames.

The program is the first argument of the test that imports this.
"""

import base64
import hashlib
import json
import os
import pathlib
import resource
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

INSONIFY = os.path.abspath(sys.argv.pop(1))
VIEWER = "insonify.viewer.v1"

# For the end of a program that waits for nothing, on a machine with much else to do [s].
PROMPT = 10

SCENARIO = """
points: [{position: [5, 1, 0], target_strength_db: -20}]
sonars:
  - {name: fls, beam_count: 32, bin_count: 80, azimuth_aperture_deg: 80, max_range: 9, ping_period: 0.03}
  - {name: side, beam_count: 16, bin_count: 40, azimuth_aperture_deg: 40, max_range: 7, ping_period: 0.05}
"""


class Server:
    """insonify serve, or another command, in a folder of its own, with the scenario and the texts `others` by their
    names, where the command lines `before` were run; `port` is what it told. Without `token`, and where no option names one, it wants none."""

    def __init__(self, *options, command=("serve", "live.yaml"), before=(), scenario=SCENARIO, others=(), largest_file=None,
                 token=False):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        for name, text in {"live.yaml": scenario, **dict(others)}.items():
            (self.path / name).write_text(text)
        for line in before:
            subprocess.run([INSONIFY, *line], cwd=self.path, check=True, capture_output=True)
        if not token and "--token" not in options:
            options += ("--no-token",)
        limit = None
        if largest_file:  # Stands for the end of a disk.
            def limit():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))
        self.process = subprocess.Popen([INSONIFY, *command, "--port", "0", *options], cwd=self.path,
                                        text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            raise AssertionError(self.process.stderr.read())
        self.port = int(self.address.split("/?")[0].rstrip("/").rsplit(":", 1)[1])

    def end(self, number=signal.SIGINT):
        """Returns the exit status, what it said and how long it took."""
        start = time.monotonic()
        self.process.send_signal(number)
        out, err = self.process.communicate(timeout=120)
        return self.process.returncode, out, err, time.monotonic() - start

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()
        self.folder.cleanup()


class Socket:
    """A connection that reads and writes bytes, HTTP and frames."""

    def __init__(self, port, host="127.0.0.1"):
        self.raw = socket.create_connection((host, port), timeout=60)
        self.rest = b""

    def send(self, data):
        self.raw.sendall(data if isinstance(data, bytes) else data.encode())

    def read(self, count):
        while len(self.rest) < count:
            data = self.raw.recv(1 << 16)
            if not data:
                raise EOFError
            self.rest += data
        data, self.rest = self.rest[:count], self.rest[count:]
        return data

    def is_closed(self):
        try:
            while self.raw.recv(1 << 16):
                pass
        except ConnectionResetError:
            pass
        return True

    def response(self):
        """Status, headers and body."""
        while b"\r\n\r\n" not in self.rest:
            data = self.raw.recv(1 << 16)
            if not data:
                raise EOFError
            self.rest += data
        head, self.rest = self.rest.split(b"\r\n\r\n", 1)
        lines = head.decode().split("\r\n")
        headers = {line.split(":", 1)[0].lower(): line.split(":", 1)[1].strip() for line in lines[1:]}
        status = int(lines[0].split()[1])
        body = b"" if status == 101 else self.read(int(headers.get("content-length", 0)))
        return status, headers, body

    def request(self, target, method="GET", headers=(), host="127.0.0.1"):
        self.send("\r\n".join([f"{method} {target} HTTP/1.1", f"Host: {host}", *headers, "", ""]))
        return self.response()

    def open(self, protocol=VIEWER, target="/", headers=(), host="127.0.0.1"):
        """Opens a WebSocket; returns status, headers and body."""
        key = base64.b64encode(os.urandom(16)).decode()
        answer = self.request(target, headers=["Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                                               f"Sec-WebSocket-Key: {key}", *([f"Sec-WebSocket-Protocol: {protocol}"] if protocol else []),
                                               *headers], host=host)
        if answer[0] == 101:
            wanted = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
            assert answer[1]["sec-websocket-accept"] == base64.b64encode(wanted).decode()
        return answer

    def send_frame(self, data, opcode=1, length=None, fin=True):
        data = data if isinstance(data, bytes) else data.encode()
        mask = os.urandom(4)
        size = len(data) if length is None else length
        head = bytes([(0x80 if fin else 0) | opcode])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 1 << 16:
            head += bytes([0x80 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", size)
        self.send(head + mask + bytes(byte ^ mask[i % 4] for i, byte in enumerate(data)))

    def say(self, **message):
        self.send_frame(json.dumps(message))

    def open_for_ping(self):
        """Opens a WebSocket and waits for a ping, which is recorded before the next one is made."""
        self.open()
        self.ping()
        self.ping()

    def frame(self):
        """Opcode and payload. It answers no pings: a client that lives longer than 30 s has to."""
        first, second = self.read(2)
        size = second & 0x7F
        if size == 126:
            size = struct.unpack(">H", self.read(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", self.read(8))[0]
        return first & 15, self.read(size)

    def text(self, op=None, seconds=10):
        """The next text message, or the next of an op."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            opcode, data = self.frame()
            if opcode == 8:
                raise AssertionError(f"closed: {data}")
            if opcode == 1:
                message = json.loads(data)
                if op is None or message["op"] == op:
                    return message
        raise AssertionError(f"no {op} came")

    def ping(self, sonar=None):
        """Header and tables of the next ping."""
        while True:
            opcode, data = self.frame()
            if opcode == 8:
                raise AssertionError(f"closed: {data}")
            if opcode == 2 and struct.unpack("<I", data[:4])[0] == 1:
                size = struct.unpack("<I", data[4:8])[0]
                assert size % 4 == 0
                header = json.loads(data[8:8 + size])
                if sonar in (None, header["sonar"]):
                    return header, data[8 + size:]

    def closing(self):
        """Close code and reason; what came before is dropped."""
        while True:
            opcode, data = self.frame()
            if opcode == 8:
                return struct.unpack(">H", data[:2])[0], data[2:].decode()
