"""Decibels of raw intensities."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ._insonify import Ping


def to_db(intensity: npt.ArrayLike | Ping, floor: float = -200.0) -> npt.NDArray[np.float32]:
    """10 log10 of intensities, or of those of a ping, at least `floor` [dB]: an array of the same shape, float32.

    In the calibrated model these are decibels relative to the source's intensity at 1 m: with a source level added they
    are echo levels. Zeros become `floor`; NaN and negative values become NaN.
    """
    linear = np.asarray(intensity.intensity if isinstance(intensity, Ping) else intensity)
    with np.errstate(divide="ignore", invalid="ignore"):
        levels = 10 * np.log10(linear)
    return np.where(levels < floor, floor, levels).astype(np.float32)
