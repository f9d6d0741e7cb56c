#!/usr/bin/env python3
"""Measures what a ping from Python costs more than from C++, and ping_batch() against pings one by one.

    python3 speed.py [PINGS]     # 40 of each

All are made by one simulator in one process, in turn, so that what else the machine does falls on all alike; numbers are
medians. The C++ ping is timed within the library, into a Ping that is used again.
"""

import statistics
import sys
import time

import numpy as np

import insonify

SONARS = {
    "256 beams x 500 bins": insonify.SonarConfig(name="fls", beam_count=256, bin_count=500, max_range=30),
    "1 beam x 400 bins": insonify.SonarConfig(name="msis", type="msis", beam_count=1, bin_count=400, max_range=30,
                                             azimuth_aperture_deg=3, step_deg=3.6),
    "32 beams x 100 bins": insonify.SonarConfig(name="small", beam_count=32, bin_count=100, max_range=20),
}


def make_scene() -> insonify.Scene:
    """A wavy floor of 20 000 triangles."""
    x, y = np.meshgrid(np.linspace(-50, 50, 101), np.linspace(-50, 50, 101), indexing="ij")
    vertices = np.stack([x, y, -5 + 0.4 * np.sin(x) * np.cos(0.7 * y)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(100), np.arange(100), indexing="ij")
    a = (101 * i + j).ravel()
    faces = np.concatenate([np.stack([a, a + 101, a + 102], axis=1), np.stack([a, a + 102, a + 1], axis=1)])
    scene = insonify.Scene()
    scene.add("floor", vertices, faces, "sand")
    return scene


def seconds_of(action: object, *arguments: object) -> float:
    start = time.perf_counter()
    action(*arguments)  # type: ignore[operator]
    return time.perf_counter() - start


def main(count: int) -> None:
    print(f"{'':22} {'C++':>9} {'Python':>9} {'Python costs':>13} {'one by one':>11} {'batch':>9}   ms a ping, {count} pings")
    for title, sonar in SONARS.items():
        sim = insonify.Simulator(sonar, make_scene())
        poses = [insonify.Pose.rpy((0.1 * k, 0.05 * k, 0), (0, 15, 2 * k)) for k in range(count)]
        from_cpp: list[float] = []
        from_python: list[float] = []
        for number, pose in enumerate(poses):
            for times, timed in ((from_cpp, False), (from_python, True))[:: 1 if number % 2 else -1]:
                times.append(seconds_of(sim.ping, 0, pose, None, number) if timed else sim._time_ping(0, pose, number))
        added = statistics.median(p - c for p, c in zip(from_python, from_cpp))

        # The same pings by their numbers too, which decide where a scanning head looks: a batch goes on after the last.
        def one_by_one() -> list[insonify.Ping]:
            return [sim.ping(0, pose, number=number) for number, pose in enumerate(poses, start=1)]

        alone, batch = [], []
        for _ in range(5):
            sim.ping(0, poses[0], number=0)
            batch.append(seconds_of(sim.ping_batch, 0, poses))
            alone.append(seconds_of(one_by_one))
        cells = [statistics.median(from_cpp), statistics.median(from_python), added,
                 statistics.median(alone) / count, statistics.median(batch) / count]
        print(f"{title:22} " + " ".join(f"{1e3 * cell:{width}.3f}" for cell, width in zip(cells, (9, 9, 13, 11, 9))))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 40)
