"""Imaging-sonar simulator: pings of forward-looking and scanning sonars in 3-D scenes, as NumPy arrays.

    import insonify
    sim = insonify.Simulator(insonify.Scenario.load("first.yaml"))
    ping = sim.ping("sonar")                    # or sim.ping("sonar", pose=T, time=t)
    ping.intensity                              # float32 [bins, beams], raw and linear
    insonify.write_png("first.png", insonify.fan(ping))
"""

from ._insonify import (
    NO_LABEL,
    Error,
    Interferer,
    MaterialOverride,
    Motion,
    PaperModel,
    Ping,
    PointTarget,
    Pose,
    ReceiverConfig,
    RecordedPings,
    Recording,
    Sampling,
    Scenario,
    Scene,
    SeaSurface,
    Simulator,
    SonarConfig,
    ViewConfig,
    Warning,
    Water,
    Waypoint,
    __version__,
    acoustics,
    draw_fan,
    draw_polar,
    load_trajectory,
    preset_names,
    write_png,
)
from ._levels import to_db

fan = draw_fan


def open(path):
    """Opens a recording (HDF5): a RecordedPings, whose pings are read when they are asked for."""
    return RecordedPings(path)


__all__ = [
    "draw_fan",
    "draw_polar",
    "Error",
    "fan",
    "Interferer",
    "load_trajectory",
    "MaterialOverride",
    "Motion",
    "open",
    "PaperModel",
    "Ping",
    "PointTarget",
    "Pose",
    "preset_names",
    "ReceiverConfig",
    "RecordedPings",
    "Recording",
    "Sampling",
    "Scenario",
    "Scene",
    "SeaSurface",
    "Simulator",
    "SonarConfig",
    "to_db",
    "ViewConfig",
    "Warning",
    "Water",
    "Waypoint",
    "write_png",
]
