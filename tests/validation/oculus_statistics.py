"""Compares the speckle of a simulated rough bottom with that of a recorded one.

    oculus_statistics.py INSONIFY WORK_FOLDER    # exit status 77 where there are no recordings

Three raw pings of a Blueprint Oculus M1200d at 2.1 MHz (INSONIFY_TEST_DATA/arrays), eight bits with a display gamma of
0.5: far from the sonar, 1.70 to 1.95 m, the bottom is evenly rough. The simulation has the same sonar, pulse, counts, gamma
and range over a rough floor. Of both, counts are squared to amplitudes and divided by the root mean square about them,
which takes away what beams, range and the bottom's shape make of the level.

A fully developed speckle's amplitude is Rayleigh: its coefficient of variation is 0.5227.

Behind something at 1.0 m lies a shadow in the recording. Its depth is the mean intensity of the cells from 1.05 to 1.15 m in
the darkest eight beams, relative to the median of all groups of eight beams. The simulation has a stone on sand, before a
perfect array, and before one whose elements differ by 1 dB and 10 degrees, as the preset's transducer does across elevations
(docs/concepts/array-and-pulse.md): this one leaves a shadow as deep as the recorded one. Crosstalk between channels would be
the same in all beams of a shadow, so the recording is searched for it: beams 16 apart do not correlate.

Between the first echo of the bottom, 0.5 m straight below, and the main lobe from 0.7 m on, side lobes draw arcs with dark
bands between them. The darkest of these, in profiles of eight beams and four bins, is compared with that over a flat floor
seen from as high: nulls of the preset's transducer must not be darker than the recorded bands. Without errors of its parts
they would be 15 dB darker.
"""

import math
import os
import pathlib
import subprocess
import sys

import h5py
import numpy as np

RAYLEIGH = math.sqrt(4 / math.pi - 1)
NEAR, FAR = 1.70, 1.95  # [m]
NEIGHBOURS = 21  # Beams and bins that the local level is of.
CORRELATIONS = (("next bin", 0.08), ("bin after that", 0.03), ("next beam", 0.03), ("beam after that", 0.04))

SCENARIO = """
world: floor.obj
model: calibrated
secondary: none
ground_truth: none
materials: {sand: {roughness_height: 0.004}}
receiver: {counts: true, full_scale_db: -62, azimuth_pattern: hann}
sonars:
  - preset: blueprint-oculus-m1200d
    mode: high
    beam_count: 256
    bin_count: 703
    min_range: 0
    max_range: 1.998
    position: [0, 0, 0.5]
    orientation_deg: [0, 16, 0]
"""
SHADOW = (1.05, 1.15)  # [m]
GROUP = 8  # Beams.
APART = 16  # Beams.
STONE = """
world: stone.sdf
model: calibrated
ground_truth: none
materials: {sand: {roughness_height: 0.004}}
receiver: RECEIVER
sonars:
  - preset: blueprint-oculus-m1200d
    mode: high
    beam_count: 256
    bin_count: 677
    min_range: 0.1
    max_range: 1.998
    position: [0, 0, 0.5]
    orientation_deg: [0, 30, 0]
"""
PERFECT = "{}"
UNEVEN = "{elements: 322, element_error_db: 1, element_error_deg: 10}"  # Half a wavelength apart.
STONE_WORLD = """
<sdf version="1.9" xmlns:insonify="https://insonify.org/sdf"><world name="stone">
  <model name="floor"><static>true</static><link name="link"><visual name="floor">
    <geometry><plane><normal>0 0 1</normal><size>8 8</size></plane></geometry><insonify:material>sand</insonify:material>
  </visual></link></model>
  <model name="stone"><static>true</static><pose>0.87 0 0.03 0 0 0</pose><link name="link"><visual name="stone">
    <geometry><sphere><radius>0.08</radius></sphere></geometry><insonify:material>rock</insonify:material>
  </visual></link></model>
</world></sdf>
"""
NULLS = (SCENARIO.replace("orientation_deg: [0, 16, 0]", "orientation_deg: [0, 34, 0]")
         .replace("azimuth_pattern: hann", "azimuth_pattern: hann, noise: false"))
WATER, SEARCHED = (0.2, 0.4), (0.45, 1.3)  # [m] Where there is no bottom yet, and from there to beyond the main lobe.
LOBE, BAND = 30, 4  # Bins of the mean level of the main lobe, and of a dark band.
FLOOR = "v -1 -4 0\nv 4 -4 0\nv 4 4 0\nv -1 4 0\nusemtl sand\nf 1 2 3 4\n"


def local_mean(values):
    """Mean over NEIGHBOURS x NEIGHBOURS cells, mirrored at the edges."""
    for axis in (0, 1):
        half = NEIGHBOURS // 2
        padded = np.pad(values, [(half, half) if a == axis else (0, 0) for a in (0, 1)], mode="reflect")
        windows = np.lib.stride_tricks.sliding_window_view(padded, NEIGHBOURS, axis=axis)
        values = windows.mean(axis=-1)
    return values


def relative_amplitudes(counts):
    """Of beams x bins, whatever their level."""
    amplitude = counts.astype(float) ** 2
    return amplitude / np.sqrt(local_mean(amplitude**2))


def correlations(amplitude):
    """Of intensities, with the first and second neighbour along range, then across beams."""
    intensity = amplitude**2 - np.mean(amplitude**2)
    variance = np.mean(intensity**2)
    along = [np.mean(intensity[:, k:] * intensity[:, :-k]) / variance for k in (1, 2)]
    return along + [np.mean(intensity[k:] * intensity[:-k]) / variance for k in (1, 2)]


def distance(sample, distribution):
    """Kolmogorov and Smirnov's, of a sample from a distribution or from another sample."""
    sample = np.sort(sample)
    if callable(distribution):
        below = distribution(sample)
        steps = np.arange(len(sample) + 1) / len(sample)
        return max(np.max(steps[1:] - below), np.max(below - steps[:-1]))
    both = np.concatenate([sample, distribution])
    other = np.sort(distribution)
    shares = [np.searchsorted(s, both, side="right") / len(s) for s in (sample, other)]
    return np.max(np.abs(shares[0] - shares[1]))


def shadow_depth(intensity, ranges):
    """Of beams x bins [dB]."""
    cells = intensity[:, (ranges > SHADOW[0]) & (ranges < SHADOW[1])]
    groups = cells.reshape(len(cells) // GROUP, -1).mean(axis=1)
    return 10 * np.log10(groups.min() / np.median(groups))


def run(insonify, folder, files):
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    command = [insonify, "run", "scenario.yaml", "-o", "out", "--no-pictures", "--force"]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)


def correlation_in_shadow(intensity, ranges):
    """Mean correlation along range between beams APART, of the darkest group and those around it."""
    cells = intensity[:, (ranges > SHADOW[0]) & (ranges < SHADOW[1] + 0.05)]
    groups = cells.reshape(len(cells) // GROUP, -1).mean(axis=1)
    middle = GROUP * int(groups.argmin()) + GROUP // 2
    dark = cells[middle - APART - 4 : middle + APART - 4]
    fluctuation = np.array([row / np.convolve(row, np.ones(9) / 9, "same") for row in dark]) - 1
    return np.mean([np.corrcoef(fluctuation[i], fluctuation[i + APART])[0, 1] for i in range(len(dark) - APART)])


def darkest_bands(intensity, ranges):
    """By GROUP beams, the least level between the first echo of the bottom and the main lobe, re the latter [dB]."""
    levels = []
    searched = (ranges > SEARCHED[0]) & (ranges < SEARCHED[1])
    for group in intensity[GROUP:-GROUP].reshape(-1, GROUP, len(ranges)).mean(axis=1):
        water = group[(ranges > WATER[0]) & (ranges < WATER[1])].mean()
        profile = np.convolve(group, np.ones(BAND) / BAND, "same")[searched]
        smooth = np.convolve(profile, np.ones(LOBE) / LOBE, "same")
        main = smooth.max()
        first = int(np.argmax(profile > max(8 * water, main * 10**-3.6)))
        rise = int(smooth.argmax())
        while rise > 0 and profile[rise] > main / 20:
            rise -= 1
        if rise > first + BAND:
            levels.append(10 * np.log10(profile[first : rise + 1].min() / main))
    return np.array(levels)


def simulated_bands(insonify, folder):
    run(insonify, folder, {"scenario.yaml": NULLS, "floor.obj": FLOOR})
    with h5py.File(next((folder / "out").glob("*.h5"))) as file:
        return np.median(darkest_bands(file["intensity"][0].T, file["range"][:]))


def simulated_shadow(insonify, folder, receiver):
    run(insonify, folder, {"scenario.yaml": STONE.replace("RECEIVER", receiver), "stone.sdf": STONE_WORLD})
    with h5py.File(next((folder / "out").glob("*.h5"))) as file:
        return shadow_depth(file["intensity"][0].T, file["range"][:])


def simulated(insonify, folder):
    run(insonify, folder, {"scenario.yaml": SCENARIO, "floor.obj": FLOOR})
    with h5py.File(next((folder / "out").glob("*.h5"))) as file:
        bins = (file["range"][:] > NEAR) & (file["range"][:] < FAR)
        return file["counts"][0][bins].T


def main():
    recordings = pathlib.Path(os.environ.get("INSONIFY_TEST_DATA", ""), "arrays", "liboculus_oculus_3pings.npz")
    if not recordings.is_file():
        print(f"no recordings: {recordings} is not there (INSONIFY_TEST_DATA)")
        sys.exit(77)
    data = np.load(recordings)
    bins = (data["range_m"] > NEAR) & (data["range_m"] < FAR)
    real = relative_amplitudes(data["polar"][0][:, bins])
    ours = relative_amplitudes(simulated(sys.argv[1], pathlib.Path(sys.argv[2])))
    both = list(zip(correlations(ours), correlations(real)))
    real, ours = real.ravel(), ours.ravel()

    def rayleigh(sample):
        return lambda x: 1 - np.exp(-(x**2) / np.mean(sample**2))

    variation = np.std(ours) / np.mean(ours)
    figures = {
        "coefficient of variation, off Rayleigh's": (abs(variation - RAYLEIGH), 0.02),
        "distance from Rayleigh": (distance(ours, rayleigh(ours)), 0.02),
        "distance from the recording": (distance(ours, real), 0.02),
    }
    # Along range 0.06 is recorded and 0.00 simulated: scatterers of a bin are drawn in its middle, which loses the
    # correlation of bins that are about as long as the pulse. The number of independent cells is some 10 000.
    for (name, most), (of_ours, of_real) in zip(CORRELATIONS, both):
        figures[f"correlation with the {name} {of_ours:.3f}, recorded {of_real:.3f}, off by"] = (abs(of_ours - of_real), most)
    print(f"recorded: coefficient of variation {np.std(real) / np.mean(real):.3f}, distance {distance(real, rayleigh(real)):.4f}")
    pings = [ping.astype(float) ** 4 for ping in data["polar"]]
    depths = [shadow_depth(ping, data["range_m"]) for ping in pings]
    alike = [correlation_in_shadow(ping, data["range_m"]) for ping in pings]
    perfect, uneven = (simulated_shadow(sys.argv[1], pathlib.Path(sys.argv[2]) / "stone", receiver)
                       for receiver in (PERFECT, UNEVEN))
    print(f"shadow: recorded {', '.join(f'{depth:.1f}' for depth in depths)} dB, correlation {APART} beams apart "
          f"{', '.join(f'{one:.2f}' for one in alike)}; simulated {perfect:.1f} dB, with uneven elements {uneven:.1f} dB")
    figures["correlation in the recorded shadow"] = (np.mean(alike), 0.15)  # Of 70 bins: 0.12 by chance.
    figures["depth with a perfect array, above the recorded one"] = (max(perfect - np.mean(depths), 0), 0)
    figures["depth with uneven elements, off the recorded one"] = (abs(uneven - np.mean(depths)), 2)  # Few speckles.
    bands = np.median(darkest_bands(np.mean(pings, axis=0), data["range_m"]))
    nulls = simulated_bands(sys.argv[1], pathlib.Path(sys.argv[2]) / "nulls")
    print(f"darkest band before the main lobe: recorded {bands:.1f} dB, simulated {nulls:.1f} dB")
    figures["darkest band, below the recorded one"] = (max(bands - nulls, 0), 0)
    for name, (value, most) in figures.items():
        print(f"simulated: {name} {value:.4f}, at most {most}")
    sys.exit(any(value > most for value, most in figures.values()))


if __name__ == "__main__":
    main()
