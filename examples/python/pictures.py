#!/usr/bin/env python3
"""Draws a ping with matplotlib: fan, polar, what gave each echo, and one beam. Needs python3-matplotlib.

    python3 pictures.py [FILE.png]
"""

import sys

import matplotlib  # type: ignore[import]

matplotlib.use("Agg")  # Into files; leave it out for a window.
import matplotlib.pyplot as plt  # type: ignore[import]  # noqa: E402
import numpy as np  # noqa: E402

import insonify  # noqa: E402


def make_ping() -> tuple[insonify.Ping, list[str]]:
    """A harbour wall with a ladder of pillars before it, on mud."""
    scene = insonify.Scene()
    square = [[0, 1, 2], [0, 2, 3]]
    scene.add("mud", [[-1, -30, -3], [30, -30, -3], [30, 30, -3], [-1, 30, -3]], square, "mud")
    scene.add("quay", [[14, -30, -3], [14, 30, -3], [14, 30, 2], [14, -30, 2]], square, "concrete",
              insonify.Pose.rpy((0, 0, 0), (0, 0, 12)))
    turns = np.radians(np.arange(0, 360, 15))
    ring = [[0.4 * np.cos(t), 0.4 * np.sin(t), z] for z in (-3, 2) for t in turns]
    n = len(turns)
    faces = [face for i in range(n) for face in ([i, (i + 1) % n, n + i], [(i + 1) % n, n + (i + 1) % n, n + i])]
    for number, y in enumerate((-6, -2, 2, 6)):
        scene.add(f"pillar_{number}", ring, faces, "steel", insonify.Pose.rpy((9, y, 0)))
    sonar = insonify.SonarConfig.preset("tritech-gemini-720i", name="harbour", max_range=18)
    sim = insonify.Simulator(sonar, scene)
    return sim.ping(pose=insonify.Pose.rpy((0, 0, 0), (0, 10, 0))), sim.instance_names


def main(file: str) -> None:
    ping, names = make_ping()
    figure, axes = plt.subplots(2, 2, figsize=(13, 9), layout="constrained")
    ping.plot(ax=axes[0, 0])
    ping.plot("polar", ax=axes[0, 1], colour_map="copper")

    # What gave each echo.
    azimuths, ranges = np.degrees(ping.azimuths), ping.ranges
    labels = np.where(ping.instance == insonify.NO_LABEL, np.nan, ping.instance.astype(float))
    mesh = axes[1, 0].pcolormesh(azimuths, ranges, labels, cmap=plt.get_cmap("tab10", len(names)), vmin=-0.5, vmax=len(names) - 0.5, shading="nearest")
    axes[1, 0].set(xlabel="azimuth, positive to port [deg]", ylabel="range [m]", title="strongest instance")
    axes[1, 0].invert_xaxis()
    figure.colorbar(mesh, ax=axes[1, 0], ticks=range(len(names))).ax.set_yticklabels(names)

    # One beam over range.
    beam = int(np.argmin(np.abs(azimuths - 12)))
    axes[1, 1].plot(ranges, insonify.to_db(ping.intensity[:, beam]), linewidth=0.8)
    axes[1, 1].set(xlabel="range [m]", ylabel="dB re source at 1 m", title=f"beam at {azimuths[beam]:.1f} deg")
    axes[1, 1].grid(alpha=0.4)
    figure.savefig(file, dpi=90)
    print(f"{file}: ping {ping.number} of {ping.sonar.name}, {len(names)} instances")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "pictures.png")
