"""The tables of an HDF5 recording as JSON: h5_json.py FILE."""

import json
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as file:
    tables = {name: np.where(np.isnan(file[name][()]), None, file[name][()].astype(object)).tolist()
              for name in ("intensity", "elevation", "time", "world_from_sonar", "range", "azimuth", "head_angle",
                           "sounding_range", "sounding_detection")
              if name in file}
    print(json.dumps({**tables, "scenario": file.attrs["scenario"], "sound_speed": file.attrs["sound_speed"]}))
