"""What shadows hold, relative to the lit floor, by three measures.

    shadow_depth.py INSONIFY            # in the project's root, with its scenes built: prints the table of
                                        # docs/concepts/multipath.md, "Shadows"
    shadow_depth.py INSONIFY --check    # mean image alone; exit status 1 unless shadows are 15 to 26 dB deep

same range    median of all cells in shadow, each relative to the median of the lit cells in the same bin
same beam     each relative to the median of the lit cells in the same beam, most of which are nearer
as recorded   in windows of WINDOW bins, the mean of the darkest GROUP beams that are all in shadow, relative to the
              median of the groups that are all lit; the median over the windows. So oculus_statistics.py measures the
              shadow that an Oculus has recorded, 15 to 17 dB deep.

The check is of `same range`.
"""

import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

METALS = {
    "ssiv": ["yellow_steel", "steel", "stainless_steel", "aluminium"],
    "ferry": ["hull", "deck", "superstructure", "steel"],
    "cooler": ["yellow_steel", "steel", "stainless_steel", "aluminium"],
}
MEAN_IMAGE = ["receiver.noise=false", "receiver.speckle=false"]
NO_LOBES = "receiver.side_lobe_db=-60"
FEWEST_SHADOW, FEWEST_FLOOR = 3, 20  # Cells of a bin, or of a beam, that count.
GROUP, WINDOW, FEWEST_LIT = 8, 10, 5  # Beams of a group, bins of a window; groups that are lit.
SHALLOWEST, DEEPEST = -15, -26  # [dB]


def ping(program, scene, settings):
    """Intensity, whether in shadow, whether lit: each bins x beams."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", f"scenes/{scene}_calibrated.yaml", "-o", folder + "/out", "--pings", "1",
                   "--no-pictures", "-q"]
        for setting in ["ground_truth=full", *settings]:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        with h5py.File(next(pathlib.Path(folder, "out").glob("*.h5"))) as recording:
            intensity, direct, shadow = (recording[name][0] for name in ("intensity", "direct_intensity", "shadow"))
            assert intensity.shape == (len(recording["range"]), len(recording["azimuth_edges"]) - 1)
    return intensity, shadow > 0, (direct > 0) & (shadow == 0)


def cells(intensity, dark, lit):
    """Cells in shadow relative to the lit ones of their row: rows are bins, or beams where all is transposed."""
    depths = []
    for row, in_shadow, on_floor in zip(intensity, dark, lit):
        if in_shadow.sum() >= FEWEST_SHADOW and on_floor.sum() >= FEWEST_FLOOR:
            depths.extend(row[in_shadow] / np.median(row[on_floor]))
    return np.median(depths)


def groups(intensity, dark, lit):
    """Darkest groups of beams relative to lit ones."""
    bins, beams = (n // size for n, size in zip(intensity.shape, (WINDOW, GROUP)))

    def grouped(values):
        return values[: bins * WINDOW, : beams * GROUP].reshape(bins, WINDOW, beams, GROUP)

    level, in_shadow, on_floor = grouped(intensity).mean((1, 3)), grouped(dark).all((1, 3)), grouped(lit).all((1, 3))
    windows = [i for i in range(bins) if in_shadow[i].any() and on_floor[i].sum() >= FEWEST_LIT]
    return np.median([level[i][in_shadow[i]].min() / np.median(level[i][on_floor[i]]) for i in windows])


def decibels(depth):
    return f"{10 * np.log10(depth):.1f}" if depth > 0 else "nothing"


MEASURES = {
    "same range": cells,
    "same beam": lambda intensity, dark, lit: cells(intensity.T, dark.T, lit.T),
    "as recorded": groups,
}


def main(program, *options):
    if options == ("--check",):
        depths = {scene: 10 * np.log10(cells(*ping(program, scene, MEAN_IMAGE))) for scene in METALS}
        print(", ".join(f"{scene} {depth:.1f} dB" for scene, depth in depths.items()))
        sys.exit(any(not DEEPEST <= depth <= SHALLOWEST for depth in depths.values()))
    print("| Scene | Measure | Everything on | Mean image | No secondary echoes | Side lobes of -60 dB | Neither "
          "| All metal clean and painted | 20 000 random walks |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for scene, metals in METALS.items():
        clean = [f"materials.{metal}=steel" for metal in metals]
        cases = [["secondary=none"], [NO_LOBES], ["secondary=none", NO_LOBES], clean, ["random_walks=20000"]]
        pings = [ping(program, scene, case) for case in [[], MEAN_IMAGE, *(MEAN_IMAGE + case for case in cases)]]
        for name, measure in MEASURES.items():
            print(f"| {scene} | {name} | " + " | ".join(decibels(measure(*one)) for one in pings) + " |")


if __name__ == "__main__":
    main(*sys.argv[1:])
