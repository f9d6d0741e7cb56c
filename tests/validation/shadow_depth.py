"""What shadows hold: the median of all cells in shadow, relative to the median of the lit floor in the same beam.

    shadow_depth.py INSONIFY            # in the project's root, with its scenes built: prints the table of
                                        # docs/concepts/multipath.md, "Shadows"
    shadow_depth.py INSONIFY --check    # mean image alone; exit status 1 unless shadows are 15 to 26 dB deep

Real ones are 15 to 17 dB deep in pictures by an Oculus, and deeper where the sonar is better than its neighbourhood.
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
FEWEST_SHADOW, FEWEST_FLOOR = 3, 20  # Cells of a beam that count.
SHALLOWEST, DEEPEST = -15, -26  # [dB]


def shadow_depth(program, scene, settings):
    """[dB]"""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", f"scenes/{scene}_calibrated.yaml", "-o", folder + "/out", "--pings", "1",
                   "--no-pictures", "-q"]
        for setting in ["ground_truth=full", *settings]:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        with h5py.File(next(pathlib.Path(folder, "out").glob("*.h5"))) as recording:
            intensity, direct, shadow = (recording[name][0] for name in ("intensity", "direct_intensity", "shadow"))
    depths = []
    for beam in range(len(intensity)):
        dark, lit = shadow[beam] > 0, (direct[beam] > 0) & (shadow[beam] == 0)
        if dark.sum() >= FEWEST_SHADOW and lit.sum() >= FEWEST_FLOOR:
            depths.extend(intensity[beam][dark] / np.median(intensity[beam][lit]))
    return 10 * np.log10(np.median(depths))


def main(program, *options):
    if options == ("--check",):
        depths = {scene: shadow_depth(program, scene, MEAN_IMAGE) for scene in METALS}
        print(", ".join(f"{scene} {depth:.1f} dB" for scene, depth in depths.items()))
        sys.exit(any(not DEEPEST <= depth <= SHALLOWEST for depth in depths.values()))
    print("| Scene | With noise and speckle | Mean image | All metal clean and painted | No secondary echoes "
          "| 20 000 random walks |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for scene, metals in METALS.items():
        clean = [f"materials.{metal}=steel" for metal in metals]
        cases = [[], MEAN_IMAGE, MEAN_IMAGE + clean, [*MEAN_IMAGE, "secondary=none"], [*MEAN_IMAGE, "random_walks=20000"]]
        depths = " | ".join(f"{shadow_depth(program, scene, case):.1f}" for case in cases)
        print(f"| {scene} | {depths} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
