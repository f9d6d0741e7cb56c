#!/usr/bin/env python3
"""Flies two side-scan lines past a container, makes a mosaic of them, and measures the container by its shadow.

    python3 mosaic.py [FOLDER]    # writes mosaic.png
"""

import math
import pathlib
import sys

import numpy as np

import insonify
from insonify import survey

ALTITUDE = 6.0  # [m]
HEIGHT = 2.6  # Of the container [m].
NEAR, FAR = 12.0, 14.4  # Ground ranges of its sides from the first line [m].


def make_scene() -> insonify.Scene:
    scene = insonify.Scene()
    scene.plane("bed", 160, material="sand")
    scene.box("container", (6, FAR - NEAR, HEIGHT), material="fouled_steel", pose=(0, (NEAR + FAR) / 2, HEIGHT / 2))
    return scene


def main(folder: pathlib.Path) -> None:
    sonar = insonify.SonarConfig.preset("marinesonic-arc-scout", max_range=30, bin_count=1000, ping_period=0.2)
    sim = insonify.Simulator(sonar, make_scene())

    # To and fro, the container to port of the first line and far to port of the second.
    out = sim.line(begin=(-12, 0, ALTITUDE), end=(12, 0, ALTITUDE))
    back = sim.line(begin=(12, 34, ALTITUDE), end=(-12, 34, ALTITUDE))
    print(f"2 lines of {len(out)} pings, {out.port.shape[1]} bins to a side, altitude {out.altitude.mean():.2f} m")

    mosaic = survey.make_mosaic([out, back], cell=0.1, altitudes=[out.altitude, back.altitude])
    seen = np.isfinite(mosaic.intensity)
    print(f"The mosaic has {seen.sum() * mosaic.cell**2:.0f} m2 of bed")

    # Levels as grey: from the darkest to the brightest hundredth, the rest black.
    levels = insonify.to_db(np.where(seen, mosaic.intensity, 1e-30))
    low, high = np.percentile(levels[seen], (1, 99))
    insonify.write_png(folder / "mosaic.png", (255 * np.clip((levels - low) / (high - low), 0, 1)).astype(np.uint8))

    # Abeam of the container, the shadow ends where port is as bright again as starboard, which has no container. The
    # container's far upper edge casts that end.
    middle = len(out) // 2
    abeam = slice(middle - 8, middle + 9)
    smooth = np.ones(21) / 21
    port, starboard = (np.convolve(side[abeam].mean(axis=0), smooth, "same") for side in (out.port, out.starboard))
    begin = int(np.searchsorted(out.ranges, math.hypot(FAR, ALTITUDE))) + len(smooth)
    end = out.ranges[begin + np.argmax(port[begin:] > 0.5 * starboard[begin:])]
    height = survey.height_from_shadow(ALTITUDE, math.hypot(FAR, ALTITUDE), end)
    print(f"The shadow ends at a slant range of {end:.2f} m: the container is {height:.2f} m high, in truth {HEIGHT} m")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
