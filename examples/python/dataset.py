#!/usr/bin/env python3
"""Makes a labelled data set: pings of crates and pipes on a floor, with a mask and a box for each object.

    python3 dataset.py [FILE.npz] [PINGS]

The file has
    levels   float16 [pings, bins, beams]   dB re the source at 1 m, raised by 30 dB per decade of range
    masks    uint16 [pings, bins, beams]    object of each bin, an index into names; 65535 for none
    boxes    int32 [boxes, 6]               ping, object, first and last bin, first and last beam
    names    text [objects]
"""

import sys

import numpy as np
import numpy.typing as npt

import insonify

SMALLEST = 12  # Bins: objects with fewer visible bins get no box.


def make_scene(random: np.random.Generator) -> insonify.Scene:
    """A floor with ten crates of random size and place."""
    scene = insonify.Scene()
    scene.add("floor", [[-60, -60, 0], [60, -60, 0], [60, 60, 0], [-60, 60, 0]], [[0, 1, 2], [0, 2, 3]], "sand")
    cube = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (0, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
             [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    for number in range(10):
        place = (*random.uniform(-15, 15, 2), 0)
        scene.add(f"crate_{number}", cube * random.uniform(0.4, 2.5, 3), faces, str(random.choice(["steel", "wood", "rock"])),
                  insonify.Pose.rpy(place, (0, 0, random.uniform(0, 360))))
    return scene


def boxes_of(ping_number: int, mask: npt.NDArray[np.uint16], objects: range) -> list[tuple[int, ...]]:
    """(ping, object, first bin, last bin, first beam, last beam) of each object that is seen."""
    found: list[tuple[int, ...]] = []
    for label in objects:
        bins, beams = np.nonzero(mask == label)
        if len(bins) >= SMALLEST:
            found.append((ping_number, label, bins.min(), bins.max(), beams.min(), beams.max()))
    return found


def main(file: str, pings: int) -> None:
    random = np.random.default_rng(7)
    sonar = insonify.SonarConfig.preset("tritech-gemini-720i", max_range=20)
    sim = insonify.Simulator(insonify.Scenario(sonars=[sonar], seed=7), make_scene(random))

    # From random places at 3 m height, looking at the middle, 15 degrees down. All cores make them, a ping each.
    poses = []
    for _ in range(pings):
        bearing = random.uniform(0, 360)
        x, y = -12 * np.cos(np.radians(bearing)), -12 * np.sin(np.radians(bearing))
        poses.append(insonify.Pose.rpy((x, y, 3), (0, 15, bearing)))
    batch = sim.ping_batch(0, poses)

    gain = 30 * np.log10(sim.sonar().bin_ranges())
    levels = insonify.to_db(batch["intensity"]) + gain[None, :, None]
    masks = batch["instance"]
    objects = range(1, len(sim.instance_names))
    boxes = [box for number in range(pings) for box in boxes_of(number, masks[number], objects)]
    np.savez_compressed(file, levels=levels.astype(np.float16), masks=masks, boxes=np.array(boxes, dtype=np.int32),
                        names=np.array(sim.instance_names))
    print(f"{file}: {pings} pings of {levels.shape[1]} bins x {levels.shape[2]} beams, {len(boxes)} boxes, "
          f"{len({box[1] for box in boxes})} of {len(objects)} objects seen")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "dataset.npz", int(sys.argv[2]) if len(sys.argv) > 2 else 12)
