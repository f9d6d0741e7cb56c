"""What can be loaded by a path or a name: scenarios, presets, materials."""

from __future__ import annotations

import os
import warnings
from typing import Any, Sequence

from ._insonify import Error, Material, Scenario, SonarConfig, Warning, material_library, preset_names

RECORDINGS = (".h5", ".hdf5", ".mcap", ".npz", ".npy", ".xtf", ".raw")
MESHES = (".obj", ".stl", ".dae", ".ply", ".gltf", ".glb")


def load(path: str | os.PathLike[str], settings: Sequence[str] | dict[str, Any] = ()) -> Scenario:
    """Reads a scenario: a YAML file, a Stonefish scenario (.scn), an SDF file with sonars, or the shipped scene of a name such
    as "ferry" (scene_names()); as Scenario.load().

    settings: {"sonars[0].max_range": 30}, or texts "key=value", as of `insonify run --set`.

    Raises Error with file and line for whatever is wrong.
    """
    ending = os.path.splitext(os.fspath(path))[1].lower() if isinstance(path, (str, os.PathLike)) else ""
    if ending in RECORDINGS + MESHES:
        which = "a recording; insonify.open()" if ending in RECORDINGS else "a mesh; insonify.Scene.load()"
        raise Error(f"{os.fspath(path)}: is not a scenario but {which} reads it")
    return Scenario.load(path, settings)


def _world_of(self: Scenario, path: str | os.PathLike[str] | None) -> None:
    _world.fset(self, "" if path is None or path == "none" else path)


# None and "none" are no world, as in files.
_world: Any = vars(Scenario)["world"]
setattr(Scenario, "world", property(_world.fget, _world_of, doc=_world.__doc__))


def presets() -> dict[str, SonarConfig]:
    """Every preset by its name, in alphabetical order, those of INSONIFY_PRESETS included: its sonar in its default mode,
    over its longest range.

        sorted(insonify.presets())                                      # names
        insonify.SonarConfig(preset="tritech-gemini-720i", max_range=12)
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Warning)
        return {name: SonarConfig.preset(name) for name in preset_names()}


def materials() -> dict[str, Material]:
    """Every material of the library by its name, in alphabetical order. Typical values, +-5 %; `source` says from where.

        insonify.materials()["steel"].density                           # [kg/m^3]
    """
    return {material.name: material for material in material_library()}
