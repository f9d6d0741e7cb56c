"""Reads a recording of recording_test.cpp as its users would, with h5py alone.

    read_recording.py FILE      # exit status 1 and a reason where something is not as documented
"""

import math
import sys

import h5py
import numpy as np


def check(condition, what):
    if not condition:
        sys.exit(f"{sys.argv[1]}: {what}")


def main():
    with h5py.File(sys.argv[1]) as file:
        scanning = "head_angle" in file
        pings, bins, beams = file["intensity"].shape
        check((pings, bins, beams) == (2, 4, 1 if scanning else 3), f"intensity has shape {file['intensity'].shape}")
        for name, kind in {"intensity": "<f4", "instance": "<u2", "material": "<u2", "elevation": "<f4"}.items():
            check(file[name].dtype == np.dtype(kind), f"{name} is {file[name].dtype}")
            check(file[name].shape == (pings, bins, beams), f"{name} has shape {file[name].shape}")
        ranked = {"strongest_instance": "<u2", "strongest_share": "<f4"}
        full = {"elevation_spread": "<f4", "path_order": "|u1", "shadow": "<f4", "direct_intensity": "<f4"}
        for name, kind in (ranked | full).items() if "shadow" in file else ():
            shape = (pings, bins, beams, 3) if name in ranked else (pings, bins, beams)
            check((file[name].dtype, file[name].shape) == (np.dtype(kind), shape), f"{name} is {file[name]}")
            check(file[name].attrs["description"] != "", f"{name} has no description")
        cells = np.arange(bins * beams).reshape(bins, beams)
        check(np.array_equal(file["intensity"][1], 100 + cells), "intensity differs")
        nothing = file["instance"][...] == file["instance"].attrs["none"]
        check(np.array_equal(nothing[0], cells % 2 == 0), "instance differs")
        check(np.array_equal(np.isnan(file["elevation"][...]), nothing), "elevation is not NaN where nothing echoed")
        check(file["range"].shape == (bins,) and file["azimuth"].shape == (beams,), "axes differ")
        check(file["azimuth_edges"].shape == (beams + 1,), "edges differ")
        check(file["time"][-1] == 0.5 and file["world_from_sonar"].shape == (pings, 7), "times or poses differ")
        check(math.isclose(np.linalg.norm(file["world_from_sonar"][1, 3:]), 1), "the quaternion is no unit quaternion")
        check(not scanning or file["head_angle"][1] == -0.125, "head_angle differs")
        check(file["instance_names"].asstr()[0] == "ship::hull", "instance_names differ")
        check(list(file["material_names"].asstr()) == ["steel"], "material_names differ")
        check(file.attrs["sonar_model"] == "Märzen 7", "sonar_model differs")
        check(file.attrs["scenario"].startswith("world: "), "scenario differs")
        check(file.attrs["seed"] == 2**64 - 1, "seed differs")
        check(file["settings/sonar/max_range"][()] == 9, "max_range differs")
        check(file["settings/sonar/max_range"].attrs["units"] == "m", "units differ")
        check(file["settings/receiver/noise"][()] == np.False_, "noise differs")
        check(file["settings/paper/sigmoid"].asstr()[()] == "authors", "sigmoid differs")


if __name__ == "__main__":
    main()
