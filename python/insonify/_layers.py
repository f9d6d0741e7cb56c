"""Layers of recordings: tables of which only the indexed part is read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._insonify import RecordedPings

Slices = list[tuple[int, int, int]]  # (start, count, step) of each axis.


class RecordedLayer(np.lib.mixins.NDArrayOperatorsMixin):
    """A table [pings, bins, beams ...] of a recording, made by RecordedPings: rec.intensity, rec.instance ...

    Indexing with whole numbers, slices and `...` reads only that part, into a new array. Other indices (masks, lists),
    arithmetic, NumPy's functions and methods such as max() read the whole layer.

    name, unit, description: as in the file. shape, ndim, size, dtype: as for an array.
    """

    def __init__(self, recording: RecordedPings, name: str) -> None:
        self.name = name
        self._recording = recording
        dtype, shape, self.unit, self.description = recording._facts(name)
        self._is_complex = name == "field" and len(shape) == 4
        self.dtype: np.dtype[Any] = np.dtype(np.complex64) if self._is_complex else dtype
        self.shape: tuple[int, ...] = shape[:3] if self._is_complex else shape

    @property
    def ndim(self) -> int:
        return len(self.shape)

    @property
    def size(self) -> int:
        """Number of values."""
        return int(np.prod(self.shape, dtype=np.int64))

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, index: Any) -> Any:
        indices = list(index) if isinstance(index, tuple) else [index]
        if not all(one is Ellipsis or isinstance(one, (slice, int, np.integer)) for one in indices) or any(
                isinstance(one, (bool, np.bool_)) for one in indices):
            return np.asarray(self)[index]
        slices, left, backwards = self._slices(indices)
        block = self._read(slices)
        return block[backwards][left]

    def _slices(self, indices: list[Any]) -> tuple[Slices, tuple[Any, ...], tuple[slice, ...]]:
        """The slice to read of each axis, then how to reverse and drop axes of the result."""
        dots = [i for i, one in enumerate(indices) if one is Ellipsis]
        if len(dots) > 1 or len(indices) - len(dots) > self.ndim:
            raise IndexError(f"{self.name} has {self.ndim} axes; too many indices")
        at = dots[0] if dots else len(indices)
        missing = self.ndim - (len(indices) - len(dots))
        full = indices[:at] + [slice(None)] * missing + indices[at + len(dots):]
        slices: Slices = []
        left: list[Any] = []
        backwards: list[slice] = []
        for axis, (one, length) in enumerate(zip(full, self.shape)):
            if isinstance(one, slice):
                steps = range(*one.indices(length))
                rising = steps if steps.step > 0 else steps[::-1]
                slices.append((rising.start if len(steps) else 0, len(steps), rising.step))
                left.append(slice(None))
                backwards.append(slice(None, None, 1 if steps.step > 0 else -1))
                continue
            number = int(one)
            if not -length <= number < length:
                raise IndexError(f"index {number} is not in axis {axis} of {self.name}, which has {length} values")
            slices.append((number % length, 1, 1))
            left.append(0)
            backwards.append(slice(None))
        return slices, tuple(left), tuple(backwards)

    def _read(self, slices: Slices) -> npt.NDArray[Any]:
        if not self._is_complex:
            return self._recording._read(self.name, slices)
        parts = np.ascontiguousarray(self._recording._read(self.name, [*slices, (0, 2, 1)]))
        return parts.view(np.complex64)[..., 0]

    def __array__(self, dtype: Any = None) -> npt.NDArray[Any]:
        whole = self._read([(0, length, 1) for length in self.shape])
        return whole if dtype is None else whole.astype(dtype)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        arrays = [np.asarray(one) if isinstance(one, RecordedLayer) else one for one in inputs]
        return getattr(ufunc, method)(*arrays, **options)

    def __getattr__(self, name: str) -> Any:
        """Methods and attributes of arrays, of the whole layer."""
        if name.startswith("_") or not hasattr(np.ndarray, name):
            raise AttributeError(f"RecordedLayer has no attribute {name!r}")
        return getattr(np.asarray(self), name)

    def __repr__(self) -> str:
        return f"<RecordedLayer {self.name}: {self.dtype} {list(self.shape)}>"
