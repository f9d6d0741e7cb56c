#!/usr/bin/python3
"""A vehicle follows a wall, and a client of an emulated instrument, or a node behind a bridge, measures how far away it is.

    bench/follow_wall.py oculus|ping360 build/release/insonify [--seconds 60] [--slowest HZ]
    bench/follow_wall.py dds build/dev/insonify --vehicle build/dev/tests/bridges/dds/wall_vehicle [--seconds 60]
    bench/follow_wall.py gazebo build/dev/insonify --vehicle build/dev/tests/bridges/gazebo/gazebo_wall_vehicle [--seconds 60]
    bench/follow_wall.py ros1 build/dev/insonify [--seconds 60]

Exit status 1 where a distance is wrong by more than a bin, where a ping is lost, where they come more slowly than `--slowest`
a second, or where they take longer from pose to message than a period and the time to compute them. With `--slowest 0` time
does not count, and distances may be wrong by 0.1 m more.
"""

import argparse
import os
import pathlib
import re
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/apps"))
import follow_wall_dds  # noqa: E402
import follow_wall_gazebo  # noqa: E402
import follow_wall_ros1  # noqa: E402
import oculus_client as oculus  # noqa: E402
import ping360_client as ping360  # noqa: E402

SO_TIMESTAMPNS = 35  # Linux: the time at which a datagram arrived.
WALL = -5.0  # y [m]
RATE = 20.0  # [Hz]
REACH = 10.0  # [m]
LATE = 0.5  # By which a pose may be late where time does not count [s].
SOUND_SPEED = 1500.0
WORLD = """
world: wall.obj
water: {sound_speed: 1500}
sonars:
"""
FLS = """\
  - {name: fls, beam_count: 256, bin_count: 400, max_range: 10, ping_period: 0.05, orientation_deg: [0, 0, -90],
     elevation_aperture_deg: 12, sampling: {columns_per_beam: 1, rows: 40}}
"""
HEAD = """\
  - {name: head, type: msis, beam_count: 1, bin_count: 400, azimuth_aperture_deg: 2, elevation_aperture_deg: 12,
     min_range: 0.75, max_range: 10, step_deg: -0.9, sampling: {columns_per_beam: 4, rows: 40},
     receiver: {speckle: false}}  # With it, the near edge of a single beam's echo fades in one ping of a hundred.
"""


def waypoint(i):
    """Time and y of a waypoint: it comes nearer and goes away again, by 0.2 m/s."""
    return 5.0 * i, 1.0 if i % 2 else 0.0


def distance_at(seconds):
    """Of the wall [m]."""
    i = max(0, int(seconds / 5.0))
    (begin, near), (end, far) = waypoint(i), waypoint(i + 1)
    return near + (far - near) * max(0.0, seconds - begin) / (end - begin) - WALL


def first_echo(profile, threshold):
    """The first sample that reaches a threshold."""
    return next(i for i, value in enumerate(profile) if value >= threshold)


def follow_with_oculus(address, seconds, _):
    """Distances measured and true, and how many pings were lost."""
    client = oculus.Client(address)
    flags = oculus.METRES | oculus.SIMPLE | oculus.BITS16
    client.send(oculus.fire(layout=2, flags=flags, rate=oculus.RATE_40, reach=REACH, speed=SOUND_SPEED, gain=50.0))
    found, last, lost = [], None, 0
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        ping = client.ping()
        lost += 0 if last is None else ping.number - last - 1
        last = ping.number
        ahead = [beam for beam, bearing in enumerate(ping.bearings) if abs(bearing) < 3]
        profile = [sum(row[beam] for beam in ahead) for row in map(ping.row, range(ping.rows))]
        found.append((ping.distance(first_echo(profile, max(profile) / 2)), distance_at(ping.start)))
    client.close()
    return found, ping.resolution, lost


def follow_with_ping360(address, seconds, start):
    """As follow_with_oculus; a Ping360 does not number its pings."""
    host, port = address.split(":")
    client = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    client.settimeout(10)
    client.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)  # A late reader shall not mistake the time.
    # 700 samples of 800 ticks of 25 ns: 14 ms of listening, and 34 ms of delay. The head stays at 100: starboard.
    client.sendto(ping360.auto_transmit(100, 100, 1, duration=20, period=800, count=700, delay=34), (host, int(port)))
    found = []
    bin_length = SOUND_SPEED / 2 * 800 * 25e-9
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        data, [(_, _, stamp)], _, _ = client.recvmsg(65536, 64)
        number, payload = ping360.parsed(data)
        assert number == ping360.AUTO_DATA, number
        seconds, nanoseconds = struct.unpack("@qq", stamp)
        heard = seconds + 1e-9 * nanoseconds - start
        _, samples = ping360.samples_of(payload, "<BBHHHHHHBBHH")
        edge = first_echo(samples, max(samples) - 6 / 60 * 255)  # 6 dB of the 60 dB that samples cover.
        found.append(((edge + 0.5) * bin_length, distance_at(heard - 0.014)))
    client.sendto(ping360.frame(2903), (host, int(port)))
    return found, bin_length, 0


def follow_emulated(path, insonify, instrument, seconds):
    """Distances measured and true, length of a bin, pings lost, and the report of `insonify emulate`."""
    own = f"127.{os.getpid() // 250 % 250 + 1}.{os.getpid() % 250 + 1}.200"
    words = ["--address", own] if instrument == "oculus" else ["--port", "0", "--fast"]
    with subprocess.Popen([insonify, "emulate", instrument, "follow.yaml", *words], cwd=path, text=True,
                          stdout=subprocess.PIPE) as program:
        line = program.stdout.readline()
        while line and not line.startswith(("Oculus", "Ping360")):
            line = program.stdout.readline()
        start = time.time()
        try:
            address = own if instrument == "oculus" else line.split()[-1]
            follow = follow_with_oculus if instrument == "oculus" else follow_with_ping360
            found, bin_length, lost = follow(address, seconds, start)
        finally:
            program.send_signal(signal.SIGINT)
            report = program.communicate(timeout=120)[0].splitlines()[-1]
    return found, bin_length, lost, report


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("transport", choices=("oculus", "ping360", "dds", "ros1", "gazebo"))
    parser.add_argument("insonify")
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--slowest", type=float, help="pings a second; 19.5 of 20, and 18 of a Ping360, which adds its delay "
                                                       "to the time that a ping takes; 0: time does not count, as "
                                                       "in tests on a busy machine")
    parser.add_argument("--vehicle", help="the program wall_vehicle, for dds; gazebo_wall_vehicle, for gazebo")
    options = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # In the background of a shell it is ignored, by children too.
    insonify = os.path.abspath(options.insonify)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "wall.obj").write_text(f"v -99 {WALL} -9\nv 199 {WALL} -9\nv 199 {WALL} 9\nv -99 {WALL} 9\nf 4 3 2 1\n")
        points = [waypoint(i) for i in range(int(options.seconds / 5) + 4)]
        sonars = FLS if options.transport in ("dds", "ros1", "gazebo") else FLS + HEAD
        (path / "follow.yaml").write_text(WORLD + sonars + "trajectory:\n" + "".join(
            f"  - {{time: {seconds}, position: [{0.5 * seconds}, {y}, 0]}}\n" for seconds, y in points))
        if options.transport in ("dds", "gazebo"):
            follow = follow_wall_dds.follow if options.transport == "dds" else follow_wall_gazebo.follow
            found, bin_length, lost, latencies, report = follow(
                path, insonify, os.path.abspath(options.vehicle), options.seconds, distance_at)
        elif options.transport == "ros1":
            found, bin_length, lost, latencies, report = follow_wall_ros1.follow(path, insonify, options.seconds, distance_at)
        else:
            found, bin_length, lost, report = follow_emulated(path, insonify, options.transport, options.seconds)
            latencies = []

    errors = [measured - true for measured, true in found]
    worst = max(map(abs, errors))
    rate, latency, computing = (float(re.search(pattern, report).group(1)) for pattern in (
        r"\(([\d.]+) Hz\)", r"([\d.]+) ms from transmission", r"([\d.]+) of them computing"))
    print(f"{options.transport}: {len(found)} distances from {min(t for _, t in found):.2f} to "
          f"{max(t for _, t in found):.2f} m; wrong by {statistics.mean(errors) * 1e3:.1f} mm on average and "
          f"{worst * 1e3:.1f} mm at most, bins of {bin_length * 1e3:.1f} mm; {lost} lost")
    print(report)
    if latencies:  # Measured by the one who reads, which is later than the report's.
        latency = 1e3 * statistics.mean(latencies)
        print(f"from pose to message {latency:.1f} ms on average, {1e3 * max(latencies):.1f} at most")
    slowest = options.slowest if options.slowest is not None else 18 if options.transport == "ping360" else 19.5
    # Until a newer pose comes the sonar stays where it was, and the wall comes nearer by 0.2 m/s.
    tolerance = bin_length + (0.2 * LATE if slowest == 0 else 0)
    in_time = slowest == 0 or latency <= 1000 / min(RATE, rate) + computing
    wrong = [text for text, failed in (
        (f"a distance is wrong by more than {tolerance * 1e3:.1f} mm", worst > tolerance), ("pings were lost", lost > 0),
        ("messages were dropped", "dropped" in report), ("too slow", rate < slowest),
        ("too late", not in_time)) if failed]
    print("; ".join(wrong) or "as it must be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
