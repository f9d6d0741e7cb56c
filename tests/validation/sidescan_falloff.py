"""Compares how a simulated seabed falls off with the grazing angle with a side-scan sonar's recording.

    sidescan_falloff.py INSONIFY WORK_FOLDER    # exit status 77 where there is not a recording

A Marine Sonic side-scan of 600 kHz (INSONIFY_TEST_DATA/arrays), port side, plain seabed, flown 2.6 to 11.4 m above it.
Its gain is unknown, and so is its vertical beam pattern. Gain goes with the range alone, and so do spreading and absorption:
with the altitude, one range is seen at many grazing angles g. So what is fitted is

    level = gain(range) + 10 p log10 sin g

with a free gain for each metre of range and one power p. After Lambert's law it is 2. The simulation flies the same
altitudes over a flat sandy bed; the same fit must find its law. The recording's p also holds the pattern's flank.
"""

import os
import pathlib
import subprocess
import sys

import h5py
import numpy as np

LOWEST, HIGHEST = 2.6, 11.4  # Altitudes [m]
NEAR, FAR = 4, 29  # [m]
SATURATED = 32000  # Counts that the recording clips soon after.

SCENARIO = f"""
world: bed.obj
secondary: none
ground_truth: none
water: {{absorption: false}}
receiver: {{azimuth_pattern: top_hat, pulse: none, speckle: false, noise: false}}
materials: {{bed: {{lambert_db: -27, reflection: 0}}}}
trajectory:
  - {{time: 0, position: [0, 0, {LOWEST}]}}
  - {{time: 80, position: [0, 0, {HIGHEST}]}}
sonars:
  - name: port
    frequency: 600e3
    beam_count: 1
    bin_count: 1024
    azimuth_aperture_deg: 1
    elevation_aperture_deg: 80
    elevation_center_deg: -45
    min_range: 0
    max_range: 29.98
    ping_period: 1
    sampling: {{columns_per_beam: 4, rows: 2000}}
"""
BED = "v -50 -50 0\nv 50 -50 0\nv 50 50 0\nv -50 50 0\nusemtl bed\nf 1 2 3 4\n"


def cells(intensity, ranges, altitudes):
    """Mean levels [dB] over cells of 0.75 m of altitude and 1 m of range, with log10 sin g; NaN where there are few."""
    usable = (ranges > 1.3 * altitudes[:, None]) & (intensity > 0)
    heights, edges = np.arange(LOWEST, HIGHEST, 0.75), np.arange(NEAR, FAR + 0.1, 1.0)
    level = np.full((len(heights) - 1, len(edges) - 1), np.nan)
    grazing = level.copy()
    for i in range(len(heights) - 1):
        rows = (altitudes >= heights[i]) & (altitudes < heights[i + 1])
        for j in range(len(edges) - 1):
            columns = (ranges >= edges[j]) & (ranges < edges[j + 1])
            chosen = usable[np.ix_(rows, columns)]
            if rows.any() and chosen.mean() > 0.9:
                level[i, j] = 10 * np.log10(intensity[np.ix_(rows, columns)][chosen].mean())
                sine = altitudes[rows][:, None] / ranges[columns]
                grazing[i, j] = np.log10(sine[chosen].mean())
    return level, grazing


def spread(level, grazing, power):
    """Root mean square about the best gain of each range [dB]."""
    rest = level - 10 * power * grazing
    return np.sqrt(np.nanmean((rest - np.nanmean(rest, axis=0)) ** 2))


def fitted(level, grazing):
    """Best power and what it leaves."""
    powers = np.arange(-1, 6, 0.01)
    left = [spread(level, grazing, power) for power in powers]
    return powers[np.argmin(left)], min(left)


def recorded(path):
    data = np.load(path)
    counts = data["port"].astype(float)[:, ::-1]  # Near first.
    ranges = (np.arange(counts.shape[1]) + 0.5) * float(data["slant_range_m"]) / counts.shape[1]
    counts[counts > SATURATED] = 0
    return cells(counts**2, ranges, data["altitude_m"])


def simulated(insonify, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scenario.yaml").write_text(SCENARIO, encoding="utf-8")
    (folder / "bed.obj").write_text(BED, encoding="utf-8")
    command = [insonify, "run", "scenario.yaml", "-o", "out", "--no-pictures", "--force", "--pings", "80"]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    with h5py.File(folder / "out" / "port.h5") as file:
        altitudes = LOWEST + (HIGHEST - LOWEST) * np.arange(80) / 80
        return cells(file["intensity"][:, :, 0].astype(float), file["range"][:], altitudes)


def main():
    recording = pathlib.Path(os.environ.get("INSONIFY_TEST_DATA", ""), "arrays", "opensidescan_scotsman_sss.npz")
    if not recording.is_file():
        print(f"no recording: {recording} is not there (INSONIFY_TEST_DATA)")
        sys.exit(77)
    real = recorded(recording)
    power, least = fitted(*real)
    print(f"recorded: power {power:.2f} leaves {least:.2f} dB, Lambert's 2 {spread(*real, 2):.2f}, none {spread(*real, 0):.2f}")
    ours, rest = fitted(*simulated(sys.argv[1], pathlib.Path(sys.argv[2])))
    print(f"simulated: power {ours:.2f} leaves {rest:.2f} dB")
    lambert_fits = spread(*real, 2) < least + 0.3 and spread(*real, 0) > least + 0.6
    sys.exit(not (abs(ours - 2) < 0.05 and rest < 0.3 and lambert_fits))


if __name__ == "__main__":
    main()
