"""What tests of the Python package share: the command line and the source folder that they are given, a floor, a scenario."""

import pathlib
import sys

import numpy as np

import insonify

COMMAND_LINE, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])

FLOOR = {"vertices": [[-20, -20, -2], [20, -20, -2], [20, 20, -2], [-20, 20, -2]], "faces": [[0, 1, 2], [0, 2, 3]]}
TEXT = """
world: none
pings: 3
sonars:
  - {name: ahead, beam_count: 16, bin_count: 40, max_range: 12, orientation_deg: [0, 20, 0],
     sampling: {columns_per_beam: 2, rows: 20}}
trajectory:
  - {time: 0, position: [0, 0, 0]}
  - {time: 10, position: [5, 0, 0]}
"""


def floor_scene():
    scene = insonify.Scene()
    scene.add("floor", np.array(FLOOR["vertices"], dtype=float), np.array(FLOOR["faces"]), material="sand")
    return scene


def simulator(**changes):
    scenario = insonify.Scenario.from_text(TEXT)
    for name, value in changes.items():
        setattr(scenario, name, value)
    return insonify.Simulator(scenario, floor_scene())
