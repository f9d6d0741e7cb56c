"""Flies a real side-scan line over a hull of our own, and compares what both recordings hold in one table.

    PYTHONPATH=build/release/python tests/validation/wreck_line.py [--recording FILE] [--save FOLDER]
                                                # exit status 77 where there is not a recording

The recording (INSONIFY_TEST_DATA/opensidescan_xtf_wreck, 600 kHz, 461 pings of 2 x 1024 bins to 29.98 m) is a line of an
AUV that dives from 11.4 to 2.6 m above the bed, past a wreck to starboard. Its positions, attitudes and altitudes are
flown over a level bed of sand, with a hull where the wreck lies, whose shape is made up. Of both recordings are measured,
by the same functions, from counts as amplitudes:

  first return   track_bottom(), less the altitude that the vehicle has stored
  bed            median level of port at slant ranges of 9 to 11 m, where gain and spreading are the same for all
                 altitudes, against the grazing angle
  water column   median level from 0.3 to 0.8 of the first return, re that of the bed from 1.5 to 2 times of it
  contrast       of port, without the wreck: standard deviation over mean of amplitudes, each divided by the mean about it
  speckle        autocorrelation of the same: with the next bin and ping, and where it has fallen to 1 / e
  shadow         runs of starboard bins below a fifth of the bed's amplitude at that range, the longest of each ping
"""

import argparse
import math
import os
import pathlib
import sys

import numpy as np

import insonify
from insonify import survey

RECORDING = "opensidescan_xtf_wreck/scotsman-iver2.xtf"
PLAIN = slice(40, 140)  # Pings of plain bed on both sides.
PLAIN_RANGES = (13, 20)  # [m]
WRECK = slice(190, 380)  # Pings that the wreck is in.
MIDDLE = 240  # Ping that passes the middle of the hull: its nose down, the vehicle's beams meet the bed ahead of it.
GRAZING = (15, 20, 30, 45, 60)  # [deg]

# The instrument, a Marine Sonic of 600 kHz, says its range and frequency. The rest is assumed, and four numbers are
# fitted: the pulse to the contrast of the bed (bins of 29 mm, in which 21 mm are resolved, hold two looks), the beam's
# height and depression to the bed's level by angle, the volume backscatter to the water column below 4 m of altitude.
SONAR = {
    "name": "fish", "type": "sss", "beam_count": 2, "bin_count": 1024, "min_range": 0, "dead_range": 0.3,
    "frequency": 600e3, "source_level_db": 205, "pulse": "cw", "pulse_duration": 28e-6,
    "azimuth_aperture_deg": 0.6, "azimuth_resolution_deg": 0.6, "focus_range": 1e6, "crosstalk_db": -60,
    "elevation_aperture_deg": 40, "elevation_pattern": "hann", "depression_deg": 15,
    "bits": 16, "mapping": "gamma", "mapping_exponent": 1,
}
SCENARIO = {
    "world": "none", "secondary": "none", "ground_truth": "none", "water": {"volume_backscatter_db": -66},
    "receiver": {"decimation": "mean", "time_varied_gain": 30, "counts": True, "full_scale_db": -57},
}


# The hull.

def box(size, middle, yaw):
    """Vertices and faces of a box that stands upright."""
    corners = np.array([(x, y, z) for x in (-.5, .5) for y in (-.5, .5) for z in (-.5, .5)]) * size
    turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    corners[:, :2] = corners[:, :2] @ turn.T
    corners_of_sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    faces = [each for a, b, c, d in corners_of_sides for each in ((a, b, c), (a, c, d))]
    return corners + middle, np.array(faces)


def hull(length=22.0, breadth=8.0, seed=1):
    """A wooden hull without a deck along x: sides with gaps, frames, fallen beams, a post at one end."""
    rng = np.random.default_rng(seed)
    parts = []
    stations = np.linspace(-0.5, 0.5, 41)
    half = 0.5 * breadth * np.sqrt(np.clip(1 - np.abs(2 * stations) ** 2.5, 0, 1))
    for side in (-1, 1):
        heights = (1.1 if side < 0 else 0.6) + 0.8 * np.convolve(rng.random(46) - 0.5, np.ones(6) / 6, "valid")
        outline = np.column_stack([length * stations, side * half])
        for begin, end, height in zip(outline[:-1], outline[1:], heights):
            step = end - begin
            if rng.random() < 0.95:
                middle, yaw = (begin + end) / 2, math.atan2(step[1], step[0])
                parts.append(box((np.hypot(*step) + 0.05, 0.12, height), (*middle, height / 2), yaw))
                inside = middle * (1, 1 - 0.15 / max(abs(middle[1]), 0.5))
                parts.append(box((0.15, 0.3, height + 0.2), (*inside, height / 2 + 0.1), 0))
    for _ in range(8):
        place = rng.uniform((-0.35 * length, -0.25 * breadth), (0.3 * length, 0.25 * breadth))
        parts.append(box((rng.uniform(1, 4), 0.25, 0.25), (*place, 0.125), rng.uniform(0, math.pi)))
    parts.append(box((0.9, 0.9, 3.0), (0.46 * length, 0, 1.5), 0))
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in parts[:-1]])
    faces = [faces + start for (_, faces), start in zip(parts, starts)]
    return np.vstack([vertices for vertices, _ in parts]), np.vstack(faces)


# The line.

def smooth(values, reach=10):
    """Running mean over pings; positions come once in four pings."""
    padded = np.pad(values, reach, mode="reflect", reflect_type="odd")
    return np.convolve(padded, np.ones(2 * reach + 1) / (2 * reach + 1), mode="valid")


def flown(recording, altitudes):
    """Poses [ping, 7] over a bed at z = 0."""
    poses = recording.world_from_sonar.copy()
    poses[:, 0], poses[:, 1], poses[:, 2] = smooth(poses[:, 0]), smooth(poses[:, 1]), smooth(altitudes)
    return poses


def simulated(recording, poses):
    scene = insonify.Scene()
    reach = np.array([[-100, -100, 0], [100, -100, 0], [100, 100, 0], [-100, 100, 0]], dtype=float)
    scene.add("bed", reach + (*poses[len(poses) // 2, :2], 0), np.array([[0, 1, 2], [0, 2, 3]]), material="sand")
    vertices, faces = hull()
    along = poses[WRECK.stop, :2] - poses[WRECK.start, :2]
    course = math.atan2(along[1], along[0])
    turn = np.array([[math.cos(course), -math.sin(course)], [math.sin(course), math.cos(course)]])
    vertices[:, :2] = vertices[:, :2] @ turn.T + poses[MIDDLE, :2] + turn @ (0, -7.3)
    scene.add("hull", vertices, faces, material="wood")
    sonar = SONAR | {"max_range": recording.sonar.max_range}
    simulator = insonify.Simulator({**SCENARIO, "sonars": [sonar]}, scene)
    return simulator, [simulator.ping(pose=(pose[:3], pose[3:]), time=time, number=number)
                       for number, (pose, time) in enumerate(zip(poses, recording.time))]


# Measures, of amplitudes [ping, bin, side].

def decibels(ratio):
    return 20 * np.log10(np.maximum(ratio, 1e-30))


def box_mean(values, width):
    """Mean over width x width; the margin of width // 2 is left out."""
    sums = np.cumsum(np.cumsum(np.pad(values, ((1, 0), (1, 0))), 0), 1)
    return (sums[width:, width:] - sums[:-width, width:] - sums[width:, :-width] + sums[:-width, :-width]) / width**2


def evened(amplitude, width=21):
    margin = width // 2
    return amplitude[margin:-margin, margin:-margin] / box_mean(amplitude, width)


def correlation_length(texture, axis):
    """Correlation with the next along an axis, and where it has fallen to 1 / e, straight lines between."""
    rest, values = texture - texture.mean(), [1.0]
    while values[-1] > math.exp(-1):
        lag = len(values)
        end = rest.shape[axis]
        pairs = np.take(rest, range(end - lag), axis) * np.take(rest, range(lag, end), axis)
        values.append(pairs.mean() / rest.var())
    return values[1], len(values) - 2 + (values[-2] - math.exp(-1)) / (values[-2] - values[-1])


def bed_by_angle(amplitude, ranges, altitudes):
    near = amplitude[:, (ranges > 9) & (ranges < 11), 0]
    grazing = np.degrees(np.arcsin(np.minimum(altitudes / 10, 1)))
    levels = [decibels(np.median(near[np.abs(grazing - angle) < 2])) for angle in GRAZING]
    return np.array(levels) - levels[GRAZING.index(30)]


def column_level(amplitude, ranges, first):
    water, bed = [], []
    for ping, edge in zip(amplitude, first):
        water.append(np.median(ping[(ranges > 0.3 * edge) & (ranges < 0.8 * edge)]))
        bed.append(np.median(ping[(ranges > 1.5 * edge) & (ranges < 2 * edge), 0]))
    return decibels(np.array(water) / bed)


def shadows(amplitude, ranges, first):
    """Lengths in slant range [m], and levels under the bed [dB], of the longest dark run of each ping."""
    width = 5
    margin = width // 2
    smoothed = [np.pad(box_mean(amplitude[:, :, side], width), margin, mode="edge") for side in (0, 1)]
    lengths, levels = [], []
    for ping in range(WRECK.start, WRECK.stop):
        bed = np.convolve(np.pad(smoothed[0][ping], 20, mode="edge"), np.ones(41) / 41, mode="valid")
        dark = (smoothed[1][ping] < 0.2 * bed) & (ranges > 1.1 * first[ping])
        edges = np.flatnonzero(np.diff(np.pad(dark.astype(int), 1)))
        runs = edges.reshape(-1, 2)
        begin, end = max(runs, key=lambda run: run[1] - run[0]) if len(runs) else (0, 0)
        if end - begin > 10:
            lengths.append(ranges[end - 1] - ranges[begin])
            levels.append(decibels(np.median(amplitude[ping, begin:end, 1] / bed[begin:end])))
    return np.array(lengths), np.array(levels)


def measured(pings, amplitude, ranges, altitudes):
    """Names, texts and numbers of the table's rows."""
    track = survey.track_bottom(pings)
    known = slice(1, None)  # The recording's first ping has neither place nor altitude.
    errors = track.altitude[known] - altitudes[known]
    chosen = (ranges > PLAIN_RANGES[0]) & (ranges < PLAIN_RANGES[1])
    texture = evened(amplitude[PLAIN][:, chosen, 0])
    across, along = correlation_length(texture, 1), correlation_length(texture, 0)
    column = column_level(amplitude, ranges, track.range)
    lengths, levels = shadows(amplitude, ranges, track.range)
    return [("first return less altitude: median, 95 % within", "m",
             [np.median(errors), np.percentile(np.abs(errors), 95)], 2),
            (f"bed at {', '.join(map(str, GRAZING))}°, re 30°", "dB", bed_by_angle(amplitude, ranges, altitudes), 1),
            ("water column re bed: altitudes above 8 m, below 4 m", "dB",
             [np.median(column[altitudes > 8]), np.median(column[altitudes < 4])], 1),
            ("contrast of amplitudes, std / mean", "1", [texture.std()], 3),
            ("correlation with the next bin", "1", [across[0]], 2),
            ("correlation with the next ping", "1", [along[0]], 2),
            ("correlation length across", "cm", [100 * across[1] * (ranges[1] - ranges[0])], 1),
            ("correlation length along", "pings", [along[1]], 2),
            ("shadows: pings, median length, longest", "1, m, m", [len(lengths), np.median(lengths), lengths.max()], 1),
            ("level in the shadow re bed: median, darkest tenth", "dB", [np.median(levels), np.percentile(levels, 10)], 1)]


def print_table(real, ours):
    print("| | Unit | Recorded | Simulated |\n| --- | --- | --- | --- |")
    for (name, unit, values, digits), (_, _, others, _) in zip(real, ours):
        texts = ["; ".join(f"{value:.{0 if isinstance(value, int) else digits}f}" for value in row)
                 for row in (values, others)]
        print(f"| {name} | {unit} | {texts[0]} | {texts[1]} |")


def differences(real, ours):
    """What has to agree and does not: names of rows. Levels of the bed and lengths of shadows are not checked: the bed of
    the recording is not of one kind, and its wreck is another."""
    within = {"first return": 0.4, "water column": 9, "contrast": 0.03, "correlation with the next ping": 0.1,
              "level in the shadow": 4}
    return [name for (name, _, values, _), (_, _, others, _) in zip(real, ours) for start, limit in within.items()
            if name.startswith(start) and np.abs(np.subtract(values, others)).max() > limit]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--recording", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get("INSONIFY_TEST_DATA", ""), RECORDING))
    parser.add_argument("--save", type=pathlib.Path, help="file for the simulated line, .h5")
    options = parser.parse_args()
    if not options.recording.is_file():
        print(f"no recording: {options.recording} is not there (INSONIFY_TEST_DATA)")
        sys.exit(77)
    recording = insonify.open(options.recording)
    stored = recording.altitude
    altitudes = np.where(stored > 0, stored, stored[np.argmax(stored > 0)])
    simulator, pings = simulated(recording, flown(recording, altitudes))
    real = measured(recording, np.asarray(recording.intensity, dtype=float), recording.range, altitudes)
    ours = measured(pings, np.array([ping.counts for ping in pings], dtype=float), pings[0].ranges, altitudes)
    print_table(real, ours)
    if options.save:
        with insonify.Recording(options.save, simulator, replace=True) as line:
            for ping in pings:
                line.add(ping)
    wrong = differences(real, ours)
    print("too different: " + ", ".join(wrong) if wrong else "what is checked agrees")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
