"""What shadows hold, relative to the lit floor, by four measures.

    shadow_depth.py INSONIFY            # in the project's root, with its scenes built: prints the table of
                                        # docs/concepts/shadows.md
    shadow_depth.py INSONIFY --check    # mean image alone; exit status 1 unless shadows are 15 to 26 dB deep
    shadow_depth.py INSONIFY --steel    # by surface of the metal, and behind a boulder: the table of
                                        # "Smooth steel, and arrays that are not perfect"

same range    median of all cells in shadow, each relative to the median of the lit cells in the same bin
same beam     each relative to the median of the lit cells in the same beam, most of which are nearer
as recorded   in windows of WINDOW bins, the mean of the darkest GROUP beams that are all in shadow, relative to the
              median of the groups that are all lit; the median over the windows. So oculus_statistics.py measures the
              shadow that an Oculus has recorded, 15 to 17 dB deep.
by rows       in each bin with more than 8 beams that are hidden to 98 % and more than 30 that are hidden to less than 2 %,
              the mean of the former relative to the median of the latter; the median over the bins. Bright cells in a
              shadow count here, and the edges of shadows, where beams receive from beside them.
within        as by rows, of the cells that are hidden to 90 % and so are two beams on either side of them, a beam's width:
              what fills shadows, without their edges.

The check is of `same range`; the table of --steel has `by rows` and `within`, medians over SEEDS where noise or speckle is on.
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
HIDDEN, OPEN = 0.98, 0.02  # Share of a beam; by rows.
MOSTLY, BESIDE = 0.9, 2  # Share of a beam, and beams on either side; within.
SEEDS = (5, 6, 7)
GROUP, WINDOW, FEWEST_LIT = 8, 10, 5  # Beams of a group, bins of a window; groups that are lit.
SHALLOWEST, DEEPEST = -15, -26  # [dB]

# A boulder on sand before an array of 216 elements, half a wavelength apart.
BOULDER = {
    "boulder.sdf": """
<sdf version="1.9" xmlns:insonify="https://insonify.org/sdf"><world name="boulder">
  <model name="floor"><static>true</static><link name="link"><visual name="floor">
    <geometry><plane><normal>0 0 1</normal><size>40 40</size></plane></geometry><insonify:material>sand</insonify:material>
  </visual></link></model>
  <model name="boulder"><static>true</static><pose>4 0 0.35 0 0 0</pose><link name="link"><visual name="boulder">
    <geometry><sphere><radius>0.7</radius></sphere></geometry><insonify:material>rock</insonify:material>
  </visual></link></model>
</world></sdf>
""",
    "boulder.yaml": """
world: boulder.sdf
sonars:
  - preset: blueprint-oculus-m1200d
    max_range: 8
    position: [0, 0, 1]
    orientation_deg: [0, 15, 0]
""",
}
ELEMENTS = {"ssiv": 130, "ssiv_calibrated": 216, "boulder": 216}  # Half a wavelength apart.


def tables(program, scenario, settings):
    """Intensity, direct intensity and shadow: each bins x beams."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", str(scenario), "-o", folder + "/out", "--pings", "1", "--no-pictures", "-q"]
        for setting in ["ground_truth=full", *settings]:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        with h5py.File(next(pathlib.Path(folder, "out").glob("*.h5"))) as recording:
            intensity, direct, shadow = (recording[name][0] for name in ("intensity", "direct_intensity", "shadow"))
            assert intensity.shape == (len(recording["range"]), len(recording["azimuth_edges"]) - 1)
    return intensity, direct, shadow


def ping(program, scene, settings):
    """Intensity, whether in shadow, whether lit: each bins x beams."""
    intensity, direct, shadow = tables(program, f"scenes/{scene}_calibrated.yaml", settings)
    return intensity, shadow > 0, (direct > 0) & (shadow == 0)


def mean_of_hidden(intensity, hidden_cells, shadow):
    """Mean of the cells that are hidden relative to the median of the open ones of their row."""
    depths = []
    for row, hidden, open_floor in zip(intensity, hidden_cells, shadow < OPEN):
        if hidden.sum() > 8 and open_floor.sum() > 30:
            depths.append(row[hidden].mean() / np.median(row[open_floor]))
    return np.median(depths)


def by_rows(intensity, shadow):
    return mean_of_hidden(intensity, shadow > HIDDEN, shadow)


def within(intensity, shadow):
    hidden = np.pad(shadow > MOSTLY, ((0, 0), (BESIDE, BESIDE)))
    return mean_of_hidden(intensity, np.lib.stride_tricks.sliding_window_view(hidden, 2 * BESIDE + 1, axis=1).all(axis=2), shadow)


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


def print_by_surface(program):
    print("| Scene | Surface | Everything on | Mean image | No secondary echoes | Neither noise nor these | Two surfaces at most "
          "| Element errors of 1 dB and 10° | No secondary echoes, element errors |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in BOULDER.items():
            pathlib.Path(folder, name).write_text(text, encoding="utf-8")
        scenes = {"ssiv": "scenes/ssiv.yaml", "ssiv_calibrated": "scenes/ssiv_calibrated.yaml",
                  "boulder": pathlib.Path(folder, "boulder.yaml")}
        for scene, scenario in scenes.items():
            for surface in ["rock"] if scene == "boulder" else ["steel", "corroded_steel", "fouled_steel"]:
                given = ["model=calibrated"]
                if surface != "rock":
                    given += [f"materials.{metal}={surface}" for metal in METALS["ssiv"] if metal != surface]
                errors = [f"receiver.elements={ELEMENTS[scene]}", "receiver.element_error_db=1",
                          "receiver.element_error_deg=10"]
                cases = [[], MEAN_IMAGE, ["secondary=none"], [*MEAN_IMAGE, "secondary=none"], [*MEAN_IMAGE, "max_surfaces=2"],
                         errors, [*errors, "secondary=none"]]
                depths = []
                for case in cases:
                    seeds = SEEDS[:1] if case[:2] == MEAN_IMAGE else SEEDS
                    pings = [tables(program, scenario, [*given, *case, f"seed={seed}"]) for seed in seeds]
                    depths.append(" / ".join(decibels(np.median([measure(intensity, shadow) for intensity, _, shadow in pings]))
                                             for measure in (by_rows, within)))
                print(f"| {scene} | {surface} | " + " | ".join(depths) + " |", flush=True)


def main(program, *options):
    if options == ("--steel",):
        print_by_surface(program)
        return
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
