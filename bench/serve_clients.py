#!/usr/bin/python3
"""How `insonify serve` bears many clients: pings a second, delay and memory.

    bench/serve_clients.py build/release/insonify [--clients 50] [--seconds 60] [--rate 20]

One program with one thread reads for all clients, so that the delay includes what it takes to read for the others.
"""

import argparse
import base64
import json
import os
import pathlib
import selectors
import socket
import statistics
import struct
import subprocess
import tempfile
import time

SCENARIO = """
points: [{position: [5, 1, 0], target_strength_db: -20}, {position: [20, -6, 1], target_strength_db: -20}]
receiver: {speckle: false}
sonars: [{name: fls, beam_count: 256, bin_count: 500, max_range: 30, ping_period: 0.05, sampling: {columns_per_beam: 1, rows: 20}}]
"""


class Client:
    """Reads frames without looking at more than their heads."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Protocol: insonify.viewer.v1\r\n\r\n".encode())
        self.head = b""
        while not self.head.endswith(b"\r\n\r\n"):
            self.head += self.socket.recv(1)
        self.head = b""
        self.skip = 0
        self.frame = 0  # Opcode of the frame that is read.
        self.delays, self.numbers, self.bytes, self.dropped = [], set(), 0, 0

    def read(self, buffer):
        count = self.socket.recv_into(buffer)
        self.bytes += count
        data = memoryview(buffer)[:count]
        while data:
            if self.skip:
                gone = min(self.skip, len(data))
                self.skip -= gone
                data = data[gone:]
                continue
            # The head of a frame, and of a ping its JSON.
            before = len(self.head)
            self.head += bytes(data[:2048])
            used = self.take_head(before)
            if used is None:
                return
            data = data[min(used, len(data)):]

    def take_head(self, before):
        """Bytes added after the first `before` that belong to the head; None where more are needed."""
        head = self.head
        if len(head) < 14:
            return None
        size, at = head[1] & 127, 2
        if size == 126:
            size, at = struct.unpack(">H", head[2:4])[0], 4
        elif size == 127:
            size, at = struct.unpack(">Q", head[2:10])[0], 10
        opcode = head[0] & 15
        wanted = min(size, 700)
        if len(head) < at + wanted:
            return None
        payload = head[at:at + wanted]
        if opcode == 2 and payload[:4] == b"\x01\0\0\0":
            length = struct.unpack("<I", payload[4:8])[0]
            header = json.loads(payload[8:8 + length])
            self.delays.append(time.time() - header["made_at"])
            self.numbers.add(header["number"])
        if opcode == 9:  # A ping of the protocol: an answer says that it is still here.
            self.socket.sendall(b"\x8a" + bytes([0x80 | size, 0, 0, 0, 0]) + payload)
        self.skip = size - wanted
        self.head = b""
        return at + wanted - before


def memory_of(process):
    status = pathlib.Path(f"/proc/{process}/status").read_text()
    return {name: int(status.split(name + ":")[1].split()[0]) / 1024 for name in ("VmRSS", "VmHWM")}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("insonify")
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--rate", type=float, default=20)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scenario = pathlib.Path(folder) / "points.yaml"
        scenario.write_text(SCENARIO)
        server = subprocess.Popen([options.insonify, "serve", scenario, "--port", "0", "--no-token", "--rate", str(options.rate)],
                                  stdout=subprocess.PIPE, text=True)
        port = int(server.stdout.readline().strip().rstrip("/").rsplit(":", 1)[1])
        time.sleep(1)
        alone = memory_of(server.pid)["VmRSS"]
        clients = [Client(port) for _ in range(options.clients)]
        selector = selectors.DefaultSelector()
        for client in clients:
            selector.register(client.socket, selectors.EVENT_READ, client)
        buffer = bytearray(1 << 20)
        start = time.monotonic()
        while time.monotonic() - start < options.seconds:
            for key, _ in selector.select(1):
                key.data.read(buffer)
        seconds = time.monotonic() - start
        memory = memory_of(server.pid)
        server.send_signal(2)
        server.communicate()
    made = max(max(client.numbers) for client in clients) - min(min(client.numbers) for client in clients) + 1
    delays = sorted(delay for client in clients for delay in client.delays)
    rates = [len(client.delays) / seconds for client in clients]
    print(f"{options.clients} clients for {seconds:.0f} s: {made / seconds:.1f} pings/s made; each client got "
          f"{min(rates):.1f} to {max(rates):.1f} (mean {statistics.mean(rates):.1f})")
    print(f"{sum(client.bytes for client in clients) / seconds / 1e6:.0f} MB/s; delay from ping to head of its frame: "
          f"median {1000 * statistics.median(delays):.1f} ms, 99 % {1000 * delays[int(0.99 * len(delays))]:.0f} ms, "
          f"most {1000 * delays[-1]:.0f} ms")
    print(f"memory of the server: {alone:.0f} MB before the clients, {memory['VmRSS']:.0f} MB with them, {memory['VmHWM']:.0f} MB at most")


if __name__ == "__main__":
    main()
