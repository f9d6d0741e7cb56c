#!/usr/bin/env python3
"""Makes a point cloud from pings with the elevation of ground truth, and compares it with the true geometry.

    python3 point_cloud.py [FILE.ply]

A sonar measures range and azimuth; elevation is what it cannot tell. Ground truth has it, and so each bin in which a
surface echoed gives a point: what a perfect 3-D sonar would see, to train or to judge algorithms against. Where a bin
holds points above each other, such as the upper and the lower side of a ball, ground truth has their mean, which lies on
neither; its spread tells these bins, and they are left out.
"""

import sys

import numpy as np
import numpy.typing as npt

import insonify

FLOOR, RADIUS, CENTRE = -3.0, 1.2, np.array([0.0, 0.0, -2.2])  # [m]; the sphere is partly buried.


def sphere(radius: float, steps: int = 48) -> tuple[npt.NDArray[np.float64], list[list[int]]]:
    """Vertices and triangles of a sphere about the origin."""
    polar, around = np.meshgrid(np.linspace(0, np.pi, steps + 1), np.linspace(0, 2 * np.pi, 2 * steps + 1), indexing="ij")
    unit = np.stack([np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)], axis=-1)
    faces = []
    for i in range(steps):
        for j in range(2 * steps):
            a, b = i * (2 * steps + 1) + j, (i + 1) * (2 * steps + 1) + j
            faces += [[a, b, b + 1]] if i == 0 else [[a, b, a + 1]] if i == steps - 1 else [[a, b, b + 1], [a, b + 1, a + 1]]
    return radius * unit.reshape(-1, 3), faces


def points_of(ping: insonify.Ping) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.uint16]]:
    """World positions [n, 3] of the bins in which a surface echoed, and the instance of each."""
    bins, beams = np.nonzero((ping.instance != insonify.NO_LABEL) & (ping.elevation_spread < np.radians(0.5)))
    ranges, azimuths = ping.ranges[bins], ping.azimuths[beams]
    elevations = ping.elevation[bins, beams].astype(float)
    in_sonar = np.stack([ranges * np.cos(elevations) * np.cos(azimuths), ranges * np.cos(elevations) * np.sin(azimuths),
                         ranges * np.sin(elevations)], axis=1)
    matrix = ping.pose.matrix
    return in_sonar @ matrix[:3, :3].T + matrix[:3, 3], ping.instance[bins, beams]


def write_ply(path: str, points: npt.NDArray[np.float64], labels: npt.NDArray[np.uint16]) -> None:
    records = np.empty(len(points), dtype=[("xyz", "<f4", 3), ("instance", "<u2")])
    records["xyz"], records["instance"] = points, labels
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                   "property float z\nproperty ushort instance\nend_header\n".encode())
        file.write(records.tobytes())


def main(path: str) -> None:
    scene = insonify.Scene()
    scene.add("floor", [[-30, -30, FLOOR], [30, -30, FLOOR], [30, 30, FLOOR], [-30, 30, FLOOR]], [[0, 1, 2], [0, 2, 3]], "sand")
    scene.add("sphere", *sphere(RADIUS), "steel", insonify.Pose.rpy(tuple(CENTRE)))
    # No echoes by way of two surfaces: their range is not that of the surface they name. No side lobes in elevation: the
    # floor that they hear is at the range of the sphere.
    sonar = insonify.SonarConfig.preset("tritech-gemini-720i", max_range=10, elevation_pattern="top_hat")
    scenario = insonify.Scenario(sonars=[sonar], secondary="none", ground_truth="full", water=insonify.Water(sound_speed=1500))
    sim = insonify.Simulator(scenario, scene)

    clouds = []
    for bearing in range(0, 360, 45):  # From all sides.
        x, y = -5 * np.cos(np.radians(bearing)), -5 * np.sin(np.radians(bearing))
        clouds.append(points_of(sim.ping(pose=insonify.Pose.rpy((x, y, 0), (0, 25, bearing)))))
    points, labels = np.concatenate([one for one, _ in clouds]), np.concatenate([one for _, one in clouds])
    write_ply(path, points, labels)

    on_sphere = points[labels == sim.instance_names.index("sphere")]
    on_floor = points[labels == sim.instance_names.index("floor")]
    from_sphere = np.abs(np.linalg.norm(on_sphere - CENTRE, axis=1) - RADIUS)
    from_floor = np.abs(on_floor[:, 2] - FLOOR)
    print(f"{path}: {len(points)} points")
    for name, distance in (("sphere", from_sphere), ("floor", from_floor)):
        print(f"{name}: {len(distance)} points, half of them within {100 * np.median(distance):.1f} cm of the true surface, "
              f"95 % within {100 * np.quantile(distance, 0.95):.1f} cm")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "cloud.ply")
