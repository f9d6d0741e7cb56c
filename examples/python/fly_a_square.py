#!/usr/bin/env python3
"""Flies a square about a box on a sandy floor, and saves the recording and a picture of each side.

    python3 fly_a_square.py [FOLDER]    # writes square.h5 and square_0.png to square_3.png
"""

import pathlib
import sys
from typing import Iterator

import numpy as np

import insonify

SIDE = 12.0  # [m]
PINGS_A_SIDE = 8
SPEED = 0.75  # [m/s]


def box(length: float, width: float, height: float) -> tuple[list[list[float]], list[list[int]]]:
    """A box that stands on the origin: corners and triangles."""
    corners = [[x * length / 2, y * width / 2, z * height] for x in (-1, 1) for y in (-1, 1) for z in (0, 1)]
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
             [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return corners, faces


def make_scene() -> insonify.Scene:
    scene = insonify.Scene()
    scene.add("floor", [[-40, -40, -4], [40, -40, -4], [40, 40, -4], [-40, 40, -4]], [[0, 1, 2], [0, 2, 3]], "sand")
    corners, faces = box(3, 2, 1.5)
    scene.add("crate", corners, faces, "steel", insonify.Pose.rpy((0, 0, -4), (0, 0, 30)))
    return scene


def square() -> Iterator[tuple[float, insonify.Pose]]:
    """Times and poses along the sides, looking at the middle."""
    for number in range(4 * PINGS_A_SIDE):
        side, step = divmod(number, PINGS_A_SIDE)
        along = SIDE * (step / PINGS_A_SIDE - 0.5)
        corner = np.radians(90 * side)
        x = -SIDE / 2 * np.cos(corner) - along * np.sin(corner)
        y = -SIDE / 2 * np.sin(corner) + along * np.cos(corner)
        heading = np.degrees(np.arctan2(-y, -x))
        yield number * SIDE / PINGS_A_SIDE / SPEED, insonify.Pose.rpy((x, y, 0), (0, 25, heading))


def main(folder: pathlib.Path) -> None:
    sonar = insonify.SonarConfig.preset("tritech-gemini-720i", name="fls", max_range=15)
    sim = insonify.Simulator(sonar, make_scene())
    crate = sim.instance_names.index("crate")
    with insonify.Recording(folder / "square.h5", sim, "fls", replace=True) as recording:
        for time, pose in square():
            recording.add(sim.ping("fls", pose, time))

    # What was saved, read back; each ping only when it is asked for.
    recorded = insonify.open(folder / "square.h5")
    print(f"{len(recorded)} pings of {recorded.shape[1]} bins x {recorded.shape[2]} beams in {recorded.time[-1]:.0f} s")
    for side in range(4):
        ping = recorded[side * PINGS_A_SIDE + PINGS_A_SIDE // 2]
        seen = ping.instance == crate
        nearest = recorded.range[seen.any(axis=1)].min()
        print(f"Side {side}: the crate from {nearest:.2f} m on, {seen.sum()} bins of it")
        insonify.write_png(folder / f"square_{side}.png", insonify.fan(ping, levels=(-100, -40)))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
