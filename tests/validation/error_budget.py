"""Sounds real sea floors with a multibeam, and compares the errors of its soundings with a model of errors and with what
IHO S-44 allows, in tables by the angle of the beams.

    PYTHONPATH=build/release/python tests/validation/error_budget.py [--pings N]
                                                # exit status 77 where the sea floors are not there

The floors (INSONIFY_TEST_DATA) are surfaces of triangles, which the simulator meets and the errors are taken from, so
that they are exact: a sounding's error is its height less that of the floor below or above it. The sonar is the preset
r2sonic-2024 at 400 kHz, held level, with speckle, noise and its pulses; its pose and the speed of sound are known.

The model is that of Hare, Godin and Mayer, Accuracy estimation of Canadian swath and sweep sounding systems (Canadian
Hydrographic Service, 1995), without its terms of motion sensors, positions, tides and sound speed, which have no error
here. With the beam width w, the angle a, the range R, bins of length b and a pulse of duration t:

  range   s_R^2 = (b / 2)^2 + (c t / 4)^2
  angle   by amplitude w / 12; by phase .2 w / sqrt(n), n the footprint's length along range over the longer of bin and pulse
  depth   s_z^2 = (s_R cos a)^2 + (R sin a s_a)^2 + (R cos a (1 - cos(w_along / 2)))^2

S-44 (6th edition, 2022) allows 95 % of errors up to sqrt(A^2 + (B depth)^2): exclusive order .15 m and .0075, special order
.25 m and .0075, order 1a .5 m and .013.
"""

import argparse
import math
import os
import pathlib
import sys

import h5py
import numpy as np

import insonify

BANDS = ((0, 15), (15, 30), (30, 45), (45, 60))  # Angles of beams from straight down [deg].
ORDERS = {"exclusive": (0.15, 0.0075), "special": (0.25, 0.0075), "1a": (0.5, 0.013)}
SPACING = 0.14  # Of pings along the line, re the altitude: each meets another piece of the floor.
SCENARIO = {"secondary": "none", "ground_truth": "none", "receiver": {"time_varied_gain": 30}}


# Floors: scenes, and how high the sonar is above each [m].

def grid_scene(heights, spacing_x, spacing_y):
    """A grid [row, column], rows along y."""
    scene = insonify.Scene()
    scene.heights("floor", heights.astype(np.float32), spacing=(spacing_x, spacing_y), material="sand")
    return scene


def survey_grid(data):
    """A launch at the surface over a multibeam's grid of 2 m, 52 m deep, on which nodes are missing at the margins."""
    with h5py.File(data / "bathymetry_bag/JD211_public_Release_1-4_UTM.bag") as file:
        heights = file["BAG_root/elevation"][:]
    known = (heights < 1e5).astype(np.int64)
    side = 300
    sums = np.pad(known, ((1, 0), (1, 0))).cumsum(0).cumsum(1)
    counts = sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]
    row, column = np.unravel_index(np.argmax(counts), counts.shape)
    cut = heights[row:row + side, column:column + side]
    assert (cut < 1e5).all()
    return grid_scene(cut, 2, 2), 51.0


def plateau(data):
    """A vehicle over the Blake Plateau, cells of 3 seconds of arc."""
    path = data / "bathymetry_asc/small_crm.asc"
    heights = np.loadtxt(path, skiprows=6)[::-1]
    degree = 111195.0
    step = 3 / 3600 * degree
    return grid_scene(heights, step * math.cos(math.radians(29.5)), step), 40.0


def mesh(name, altitude, scale=(1, 1, 1)):
    def load(data):
        source = insonify.Scene.load(data / "bathymetry_meshes" / name)
        scene = insonify.Scene()
        for instance in source.instance_names:
            corners = source.triangles(instance) * scale
            scene.add(instance, corners.reshape(-1, 3), np.arange(corners.size // 3).reshape(-1, 3), material="sand")
        return scene, altitude
    return load


FLOORS = {
    "JD211 survey, 52 m deep": survey_grid,
    "Blake Plateau": plateau,
    "Munkholmen": mesh("uuv__munkholmen_seabed__seabed.dae", 35),
    "Mangalia": mesh("uuv__mangalia__MangaliaTerrain.dae", 20, (1, 1, 2)),
    "Herkules": mesh("uuv__herkules_seabed__herkules_seabed.dae", 30, (4, 4, 1)),
    "lake": mesh("uuv__lake__LakeBottom.dae", 2.7),
}


def height_at(triangles, places):
    """Heights of the highest triangle at places [n, 2]; NaN beside all."""
    low, high = places.min(0), places.max(0)
    corners = triangles[:, :, :2]
    near = triangles[((corners.max(1) >= low) & (corners.min(1) <= high)).all(1)]
    a, b, c = (near[:, i, :2] for i in range(3))
    area = np.cross(b - a, c - a)
    near, a, b, c, area = (each[np.abs(area) > 1e-9] for each in (near, a, b, c, area))
    from_a = places[:, None] - a
    v, w = np.cross(from_a, c - a) / area, np.cross(b - a, from_a) / area
    inside = (v >= -1e-9) & (w >= -1e-9) & (v + w <= 1 + 1e-9)
    heights = (1 - v - w) * near[:, 0, 2] + v * near[:, 1, 2] + w * near[:, 2, 2]
    return np.where(inside, heights, -np.inf).max(1, initial=-np.inf)


def middle_of(triangles, length):
    """The place nearest to the middle around which a swath has a floor everywhere."""
    low, high = triangles.min((0, 1))[:2], triangles.max((0, 1))[:2]
    across = np.linspace(-1, 1, 5)
    swath = np.stack(np.meshgrid(0.5 * length * across, 0.5 * length * across), -1).reshape(-1, 2)
    grid = np.stack(np.meshgrid(*(np.linspace(a, b, 21) for a, b in zip(low, high))), -1).reshape(-1, 2)
    for place in sorted(grid, key=lambda place: np.linalg.norm(place - (low + high) / 2)):
        if np.isfinite(height_at(triangles, place + swath)).all():
            return place
    raise ValueError("no place for a line")


# The line, and what its soundings are off.

def sound(scene, altitude, count):
    """Errors, angles, altitudes, ranges and detections of all soundings, 1-D each; beams without a sounding have NaN."""
    triangles = np.concatenate([scene.triangles(name) for name in scene.instance_names])
    middle = middle_of(triangles, count * SPACING * altitude + altitude)
    sonar = {"preset": "r2sonic-2024", "mode": "400khz", "max_range": 2.6 * altitude, "bin_count": 2000,
             "min_range": 0.3 * altitude, "name": "head"}
    simulator = insonify.Simulator({**SCENARIO, "sonars": [sonar]}, scene)
    head = simulator.sonar(0)
    rows = []
    for number in range(count):
        place = middle + ((number - count / 2) * SPACING * altitude, 0.007 * altitude * number)
        height = height_at(triangles, place[None])[0] + altitude
        ping = simulator.ping(pose=((*place, height), (0, 0, 0, 1)), number=number, time=10.0 * number)
        at = ping.sounding_positions()
        found = np.isfinite(at[:, 0])
        floor = np.full(len(at), np.nan)
        floor[found] = height_at(triangles, at[found, :2])
        error = np.where(np.isfinite(floor), at[:, 2] - floor, np.nan)
        s = ping.soundings
        rows.append(np.column_stack([error, s["azimuth"], np.full(len(at), height) - floor, s["range"], s["detection"],
                                     s["uncertainty"]]))
    return head, np.concatenate(rows)


def modelled(head, angle, range_, detection):
    """Standard deviations of depths [m] after Hare, Godin and Mayer."""
    sound_speed = 1500.0
    bin_length = (head.max_range - head.min_range) / head.bin_count
    pulse = head.pulse_duration * sound_speed / 2
    width = head.azimuth_resolution
    of_range = math.hypot(bin_length / 2, pulse / 2)
    samples = np.maximum(1, range_ * np.tan(np.abs(angle)) * width / max(bin_length, pulse))
    of_angle = np.where(detection == 2, 0.2 * width / np.sqrt(samples), width / 12)
    along = range_ * np.cos(angle) * (1 - math.cos(head.transmit_elevation_aperture / 2))
    return np.sqrt((of_range * np.cos(angle))**2 + (range_ * np.sin(angle) * of_angle)**2 + along**2)


def allowed(order, depth):
    fixed, relative = ORDERS[order]
    return np.hypot(fixed, relative * depth)


def rows_of(name, head, table):
    """Texts of the table's rows of a floor, and what is wrong in them."""
    texts, wrong, label = [], [], name
    for low, high in BANDS:
        angle = np.degrees(np.abs(table[:, 1]))
        band = table[(angle >= low) & (angle < high)]
        known = band[np.isfinite(band[:, 0])]
        error, depth = known[:, 0], known[:, 2]
        model = np.sqrt(np.mean(modelled(head, known[:, 1], known[:, 3], known[:, 4])**2))
        stated = np.sqrt(np.mean((known[:, 5] * np.cos(known[:, 1]))**2))
        share = {order: np.mean(np.abs(error) < allowed(order, depth)) for order in ORDERS}
        within = np.percentile(np.abs(error), 95)
        of_model, of_stated = within / (1.96 * model), within / (1.96 * stated)
        found = len(known) / len(band)
        texts.append(f"| {label} | {low} to {high} | {100 * found:.0f} | {np.mean(known[:, 4] == 2) * 100:.0f} | "
                     f"{100 * error.mean():+.1f} | {100 * within:.1f} | {196 * stated:.1f} | {196 * model:.1f} | "
                     f"{100 * allowed('exclusive', depth.mean()):.0f} | {100 * share['exclusive']:.1f} |")
        if found < 0.98:
            wrong.append(f"{name}, {low} deg: {100 * found:.0f} % found")
        if share["exclusive"] < 0.95:
            wrong.append(f"{name}, {low} deg: {100 * share['exclusive']:.1f} % within the exclusive order")
        if not 1 / 6 < of_model < 1.2:
            wrong.append(f"{name}, {low} deg: {of_model:.2f} times the model")
        if not 1 / 2 < of_stated < 2:
            wrong.append(f"{name}, {low} deg: {of_stated:.2f} times what soundings state")
        label = ""
    return texts, wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pings", type=int, default=30, help="of each line")
    parser.add_argument("--floor", help="the only one, by the start of its name")
    options = parser.parse_args()
    data = pathlib.Path(os.environ.get("INSONIFY_TEST_DATA", ""))
    if not (data / "bathymetry_meshes").is_dir():
        print("no sea floors: bathymetry_meshes is not there (INSONIFY_TEST_DATA)")
        sys.exit(77)
    print("| Floor | Angle, ° | Found, % | By phase, % | Mean, cm | 95 % within, cm | As stated, cm | Model, cm | "
          "Exclusive order, cm | Within it, % |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    wrong = []
    for name, load in FLOORS.items():
        if options.floor and not name.startswith(options.floor):
            continue
        head, table = sound(*load(data), options.pings)
        texts, of_floor = rows_of(name, head, table)
        print("\n".join(texts), flush=True)
        wrong += of_floor
    print("\n".join(wrong) if wrong else "within S-44's exclusive order, a sixth to 1.2 of the model, half to twice of what is stated")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
