"""Scenes built from shapes, heights and files: methods of Scene."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Iterable, Sequence

import numpy as np
import numpy.typing as npt

from ._insonify import Error, Material, Pose, Scene, _SimulatorsScene

if TYPE_CHECKING:
    from ._insonify import _PoseLike


def _named(scene: Scene, name: Any, value: Any, default: Any, kind: str) -> tuple[str, Any]:
    """The name and the first value of a shape: the name may be left out."""
    if value is None and name is not None and not isinstance(name, str):
        name, value = None, name
    if name is not None and not isinstance(name, str):
        raise Error(f"name = {name!r} must be text")
    taken = set(scene.instance_names)
    free = (kind if number == 1 else f"{kind}_{number}" for number in range(1, len(taken) + 2))
    return name or next(one for one in free if one not in taken), default if value is None else value


def _material_name(material: str | Material) -> str:
    name = material.name if isinstance(material, Material) else material
    if not isinstance(name, str):
        raise Error(f"material = {material!r} must be a name or a Material")
    if not name:
        raise Error("material has no name: one of your own is an entry of the scenario's `materials`, whose name is given here")
    return name


def _lengths(values: Any, count: int, name: str) -> dict[str, Any]:
    """Lengths by their names in messages; one number stands for all."""
    listed = [values] * count if np.ndim(values) == 0 else list(values)
    if len(listed) != count:
        raise Error(f"{name} = {values!r} must be {count} numbers, or one for all")
    return {f"{name}[{i}]": value for i, value in enumerate(listed)}


def box(self: Scene, name: str | Sequence[float] | float | None = None, size: Sequence[float] | float | None = None,
        material: str | Material = "sand", pose: _PoseLike | None = None) -> str:
    """Adds a box around its middle. Returns its name.

    name: may be left out: box((2, 1, 1)) is called box, box_2 ...
    size: full lengths along x, y and z [m], > 0, at most 1e6; or one for all; 1 m unless given.
    material: name of a library material or of one of the scenario's `materials`, or a Material of the library.
    pose: of its middle, as of Simulator.ping(); a position alone is enough.

    Raises Error for a name that exists already.
    """
    name, size = _named(self, name, size, 1, "box")
    self._add_shape(name, "box", _lengths(size, 3, "size"), _material_name(material), pose)
    return name


def sphere(self: Scene, name: str | float | None = None, radius: float | None = None, material: str | Material = "sand",
           pose: _PoseLike | None = None) -> str:
    """Adds a sphere. Returns its name.

    radius: [m], > 0, at most 1e6; 0.5 m unless given. Others: as of box().
    """
    name, radius = _named(self, name, radius, 0.5, "sphere")
    self._add_shape(name, "sphere", {"radius": radius}, _material_name(material), pose)
    return name


def cylinder(self: Scene, name: str | None = None, radius: float = 0.5, length: float = 1, material: str | Material = "sand",
             pose: _PoseLike | None = None) -> str:
    """Adds a closed cylinder around the z axis. Returns its name.

    radius, length: [m], > 0, at most 1e6. Others: as of box().
    """
    name, radius = _named(self, name, radius, radius, "cylinder")
    self._add_shape(name, "cylinder", {"radius": radius, "length": length}, _material_name(material), pose)
    return name


def plane(self: Scene, name: str | Sequence[float] | float | None = None, size: Sequence[float] | float | None = None,
          material: str | Material = "sand", pose: _PoseLike | None = None) -> str:
    """Adds a level rectangle, such as a floor. Returns its name.

    size: full lengths along x and y [m], > 0, at most 1e6; or one for both; 100 m unless given.
    pose: of its middle; a floor at a depth of 5 m is plane(pose=(0, 0, -5)). Others: as of box().
    """
    name, size = _named(self, name, size, 100, "plane")
    self._add_shape(name, "plane", _lengths(size, 2, "size"), _material_name(material), pose)
    return name


def heights(self: Scene, name: str | npt.ArrayLike | None = None, heights: npt.ArrayLike | None = None,
            spacing: float | Sequence[float] = 1.0, material: str | Material = "sand", pose: _PoseLike | None = None) -> str:
    """Adds a surface from a grid of heights, such as a surveyed or a random bed. Returns its name.

    heights: array [rows, columns] of z [m], at least 2 x 2; NaN where there is a hole. As in pictures and survey grids,
        columns run along +x and rows along -y: heights[0, 0] is the north-west corner. Depths are negative heights.
    spacing: of columns and of rows [m], > 0; or one for both. The grid's middle is at x = y = 0.
    Others: as of box(): the name may be left out, heights(array).
    """
    name, heights = _named(self, name, heights, (), "heights")
    grid = np.asarray(heights, dtype=np.float32)
    if grid.ndim != 2 or min(grid.shape) < 2:
        raise Error(f"heights must be an array [rows, columns] of at least 2 x 2, not {list(grid.shape)}")
    across, along = _lengths(spacing, 2, "spacing").values()
    self._add_heights(name, grid, across, along, _material_name(material), pose)
    return name


def _new_names(names: Iterable[str], name: str | None) -> dict[str, str]:
    """Names in another scene: `name` in place of the outermost one that all have, else before it."""
    old = list(names)
    outermost = {one.split("::")[0] for one in old}
    if name is None:
        return {one: one for one in old}
    if len(outermost) == 1:
        return {one: name + one[len(one.split("::")[0]):] for one in old}
    return {one: f"{name}::{one}" for one in old}


def merge(self: Scene, other: Scene, name: str | None = None, material: str | Material | None = None,
          pose: _PoseLike | None = None) -> list[str]:
    """Adds the objects of another scene, which stays as it is. Returns their names.

    name: new name of its only object or model, or else a scope before all names: "wreck" makes "wreck::mast".
    material: of all objects; None: their own.
    pose: of the other scene's origin in this one; None: the same.

    Raises Error for a name that exists already.
    """
    if not isinstance(other, Scene):
        raise Error(f"other = {other!r} must be a Scene; add_file() reads one")
    names = _new_names((one for one in other.instance_names if one), name)
    taken = set(self.instance_names)
    for one in names.values():
        if one in taken:
            raise Error(f"name = {one} exists already; give what is added another `name`")
    self._merge(other, names, "" if material is None else _material_name(material), Pose(pose))
    return list(names.values())


def add_file(self: Scene, path: str | os.PathLike[str], name: str | None = None, material: str | Material | None = None,
             pose: _PoseLike | None = None, **options: Any) -> list[str]:
    """Adds the objects of a file: a mesh (OBJ, STL, DAE, PLY, glTF), a height grid, an SDF world or model. Returns their
    names.

    name, material, pose: as of merge(); a mesh is called as its file, without the ending, unless given.
    options: those of Scene.load(), such as parts=True.

    Raises Error with the path for a file that cannot be read, and for a name that exists already.
    """
    return merge(self, Scene.load(path, **options), name, material, pose)


def _refuse(self: Scene, *args: Any, **kwargs: Any) -> None:
    """Refused: this is a copy of a simulator's scene."""
    raise AttributeError("this is a copy of a simulator's scene; Simulator.add() adds objects to the simulator's")


for _method in (box, sphere, cylinder, plane, heights, merge, add_file):
    setattr(Scene, _method.__name__, _method)
for _name in ("add", "set_material", "box", "sphere", "cylinder", "plane", "heights", "merge", "add_file"):
    setattr(_SimulatorsScene, _name, _refuse)
