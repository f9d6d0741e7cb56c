"""Imaging-sonar simulator: pings of forward-looking and scanning sonars in 3-D scenes, as NumPy arrays.

    import insonify
    sim = insonify.Simulator("first.yaml")
    ping = sim.ping("sonar")                    # or sim.ping("sonar", pose=T, time=t)
    ping.intensity                              # float32 [bins, beams], raw and linear
    insonify.write_png("first.png", insonify.fan(ping))
    ping.plot()                                 # with matplotlib
"""

from __future__ import annotations

import os
import warnings

from . import _calls as _calls  # First: it replaces functions of the compiled module.
from ._compare import compare
from ._insonify import (
    NO_LABEL,
    Error,
    Interferer,
    Line,
    Material,
    MaterialOverride,
    Motion,
    MotionNoise,
    PaperModel,
    Ping,
    PingSpan,
    PointTarget,
    ProfilePoint,
    Pose,
    ReceiverConfig,
    RecordedPings,
    Recording,
    Sampling,
    Scenario,
    Scene,
    SeaSurface,
    PingRequest,
    Simulator,
    SonarConfig,
    SurveyLines,
    SurveyPattern,
    Thruster,
    ViewConfig,
    Warning,
    Water,
    Waypoint,
    __version__,
    acoustics,
    export,
    load_trajectory,
    material_library,
    preset_names,
    scene_names,
    similarity,
    survey,
    write_png,
)
from . import _scene as _scene
from ._catalogue import load, materials, presets
from ._layers import RecordedLayer
from ._levels import to_db
from ._pictures import draw_fan, draw_polar, draw_waterfall
from ._pose import look_at

fan = draw_fan


def open(path: str | os.PathLike[str], sonar: str | None = None) -> RecordedPings:
    """Opens a recording (HDF5, MCAP): a RecordedPings, whose pings and layers are read on demand.

    Also opens files of instruments (Oculus .raw, Ping360 .bin, XTF) and NumPy's arrays (.npy, .npz): `intensity` is what
    the file stores, mostly counts of 8 bits, and `notes` says what was left out or assumed.

    sonar: name of the sonar in a file with several.

    Warns (insonify.Warning) of a recording that ends before its run did, because that was killed or the disk was full;
    the recording's `state` says so too.

    Raises Error with the path for a file that is missing or not a recording, and for an unknown sonar.
    """
    recorded = RecordedPings(path, sonar)
    if text := recorded._unfinished_text():
        warnings.warn(text, Warning, stacklevel=2)
    return recorded


__all__ = [
    "__version__",
    "acoustics",
    "compare",
    "draw_fan",
    "draw_polar",
    "draw_waterfall",
    "Error",
    "export",
    "fan",
    "Interferer",
    "Line",
    "load",
    "load_trajectory",
    "look_at",
    "Material",
    "material_library",
    "MaterialOverride",
    "materials",
    "Motion",
    "MotionNoise",
    "NO_LABEL",
    "open",
    "PaperModel",
    "Ping",
    "PingSpan",
    "PointTarget",
    "ProfilePoint",
    "Pose",
    "preset_names",
    "presets",
    "scene_names",
    "ReceiverConfig",
    "RecordedLayer",
    "RecordedPings",
    "Recording",
    "Sampling",
    "Scenario",
    "Scene",
    "SeaSurface",
    "similarity",
    "survey",
    "PingRequest",
    "Simulator",
    "SonarConfig",
    "SurveyLines",
    "SurveyPattern",
    "Thruster",
    "to_db",
    "ViewConfig",
    "Warning",
    "Water",
    "Waypoint",
    "write_png",
]
