"""Poses from a position and angles, and poses that look at a point."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

from ._insonify import Error, Pose

if TYPE_CHECKING:
    from ._insonify import _PoseLike

_of_one_value, _product = Pose.__init__, Pose.__mul__


def _init(self: Pose, pose: _PoseLike | None = None, orientation: Sequence[float] | None = None, *,
          position: Sequence[float] | None = None, angles_deg: Sequence[float] | None = None) -> None:
    """Pose(pose=None, orientation=None, *, position=None, angles_deg=None)

    pose, or position: (x, y, z) [m]; None: the origin. Without an orientation `pose` may also be a Pose, a 4 x 4 matrix, a
        pair (position, quaternion) or these seven numbers in a row.
    orientation: unit quaternion w x y z; None: along the axes.
    angles_deg: roll, pitch and yaw instead, as for Pose.rpy() [deg].
    """
    if pose is not None and position is not None:
        raise Error("position is given twice: as the first argument, and by its name")
    if orientation is not None and angles_deg is not None:
        raise Error("orientation is given twice: as a quaternion, and in degrees as angles_deg")
    place: Any = pose if position is None else position
    origin: Any = (0, 0, 0) if place is None else place
    if angles_deg is not None:
        place = Pose.rpy(origin, angles_deg)
    elif orientation is not None:
        place = (origin, orientation)
    _of_one_value(self, place)


def look_at(position: Sequence[float], target: Sequence[float]) -> Pose:
    """The pose at `position` whose x axis, the acoustic axis of a sonar without a mounting of its own, points to `target`.

    position, target: (x, y, z) in the world [m]. It does not roll: y stays horizontal; straight up or down, it has a yaw
    of 0. Raises Error if the two are the same point.
    """
    start, end = Pose(position).position, Pose(target).position
    x, y, z = (b - a for a, b in zip(start, end))
    if x == y == z == 0:
        raise Error(f"target = {target!r} must be another point than position")
    return Pose.rpy(start, (0, math.degrees(math.atan2(0.0 - z, math.hypot(x, y))), math.degrees(math.atan2(y, x))))


def _times(self: Pose, other: Any) -> Any:
    """The product with another Pose, or points [3] or [n, 3] of this pose's frame in the frame that it is named after."""
    if isinstance(other, Pose):
        return _product(self, other)
    points = np.asarray(other, dtype=np.float64)
    if points.ndim == 0 or points.shape[-1] != 3:
        raise Error(f"a Pose times an array {list(points.shape)}: must be a Pose, or points [3] or [n, 3]")
    matrix = self.matrix
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def _array(self: Pose, dtype: Any = None) -> Any:
    """The 4 x 4 matrix, for np.asarray()."""
    return np.asarray(self.matrix, dtype=dtype)


_init.__qualname__ = "Pose"
for _name, _member in (("__init__", _init), ("__mul__", _times), ("__matmul__", _times), ("__array__", _array), ("look_at", staticmethod(look_at))):
    setattr(Pose, _name, _member)
