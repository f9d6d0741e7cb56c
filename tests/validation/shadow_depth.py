"""What shadows hold: the median of all cells in shadow, relative to the median floor of the same beam.

    shadow_depth.py INSONIFY    # in the project's root, with its scenes built

Prints the table of docs/concepts/multipath.md, "Shadows". Needs numpy and h5py.
"""

import subprocess
import sys
import tempfile

import h5py
import numpy as np

SCENES = {
    "ssiv": ["yellow_steel", "steel", "stainless_steel", "aluminium"],
    "ferry": ["hull", "deck", "superstructure", "steel"],
    "cooler": ["yellow_steel", "steel", "stainless_steel", "aluminium"],
}
FEWEST_SHADOW, FEWEST_FLOOR = 3, 20  # Cells of a beam that count.


def shadow_depth(program, scene, settings):
    """Median of the cells in shadow [dB re the median of the lit floor in their beam]."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", f"scenes/{scene}_calibrated.yaml", "-o", folder + "/out", "--pings", "1",
                   "--no-pictures", "-q"]
        for setting in ["ground_truth=full", "receiver.noise=false", "receiver.speckle=false", *settings]:
            command += ["--set", setting]
        subprocess.run(command, check=True)
        with h5py.File(folder + "/out/fls.h5") as recording:
            intensity, direct, shadow = (recording[name][0] for name in ("intensity", "direct_intensity", "shadow"))
    depths = []
    for beam in range(len(intensity)):
        dark, lit = shadow[beam] > 0, (direct[beam] > 0) & (shadow[beam] == 0)
        if dark.sum() >= FEWEST_SHADOW and lit.sum() >= FEWEST_FLOOR:
            depths.extend(intensity[beam][dark] / np.median(direct[beam][lit]))
    return 10 * np.log10(np.median(depths))


def main(program):
    print("| Scene | As shipped | All metal clean and painted | No secondary echoes | 20 000 random walks |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for scene, metals in SCENES.items():
        clean = [f"materials.{metal}=steel" for metal in metals]
        cases = [[], clean, ["secondary=none"], ["random_walks=20000"]]
        depths = " | ".join(f"{shadow_depth(program, scene, case):.1f}" for case in cases)
        print(f"| {scene} | {depths} |")


if __name__ == "__main__":
    main(sys.argv[1])
