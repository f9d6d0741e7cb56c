"""Decibels of raw intensities."""

import numpy as np


def to_db(intensity, floor=-200.0):
    """10 log10 of intensities, at least `floor`: an array of the same shape, float32.

    In the calibrated model these are decibels relative to the source's intensity at 1 m: with a source level added they
    are echo levels. Zeros and NaN become `floor`.
    """
    intensity = np.asarray(intensity)
    with np.errstate(divide="ignore", invalid="ignore"):
        levels = 10 * np.log10(intensity)
    return np.where(levels > floor, levels, floor).astype(np.float32)
