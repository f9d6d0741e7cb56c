"""Similarity of two recordings, pings or pictures, as `insonify compare` computes it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._insonify import Error, Ping, RecordedPings, similarity

if TYPE_CHECKING:
    from ._insonify.similarity import Similarity

PICTURES = (".png", ".jpg", ".jpeg", ".pgm")

Side = Union[RecordedPings, Ping, npt.ArrayLike, "str | os.PathLike[str]"]


def compare(a: Side, b: Side, pings: Sequence[int] | None = None, scale: str | None = None, floor_db: float = -50.0,
            full_scale: float | None = None, ms_ssim: bool = True) -> Similarity:
    """Similarity of b to a: a Similarity, each measure averaged over the compared pings.

    a, b: a recording (RecordedPings, or the path of one: insonify.open has the formats), a Ping, an array [rows, columns]
        of levels from 0 to 1, or the path of a grey picture (PNG, JPEG, PGM). A single picture is compared with every
        ping of a recording. Pings of one or two beams are compared side by side, as one picture. Counts of 8 or 16 bits are
        divided by the greatest.
    pings: numbers of the pings to compare; None: all that are in both recordings.
    scale: "db" or "linear"; None: db if both are of the calibrated model.
    floor_db: level that counts as 0 on a decibel scale [dB re full scale], < 0.
    full_scale: intensity that counts as 1; None: the largest of both if both are calibrated, else 1.
    ms_ssim: False to skip that measure (NaN). Pictures of fewer than 176 x 176 pixels have fewer than five scales.

    Raises Error for pictures of unequal shape, for constant ones, and for intensities beyond full scale.
    """
    left, right = _open(a), _open(b)
    wanted = _common_pings(left, right, pings)
    calibrated = all(isinstance(one, (RecordedPings, Ping)) and one.model == "calibrated" for one in (left, right))
    if scale not in (None, "db", "linear"):
        raise Error(f"scale = {scale!r} must be db or linear")
    if not floor_db < 0:
        raise Error(f"floor_db = {floor_db:g} dB must be less than 0")
    loudest = max(_loudest(left, wanted), _loudest(right, wanted)) if calibrated and full_scale is None else 1.0
    of_one: float = full_scale if full_scale is not None else loudest or 1.0
    if not of_one > 0:
        raise Error(f"full_scale = {of_one:g} must be greater than 0")
    in_db = scale == "db" or (scale is None and calibrated)

    def levels(intensity: npt.ArrayLike) -> npt.NDArray[np.float64]:
        ratio: npt.NDArray[np.float64] = np.divide(np.asarray(intensity, dtype=np.float64), of_one)
        if not (np.all(ratio >= 0) and np.all(ratio <= 1)):
            raise Error(f"an intensity is not from 0 to full scale, {of_one:.6g}")
        if not in_db:
            return ratio
        with np.errstate(divide="ignore"):
            shown: npt.NDArray[np.float64] = np.clip(1 - 10 * np.log10(ratio) / floor_db, 0, 1)
        return shown

    pictures = [_pictures(one, wanted, levels) for one in (left, right)]
    count = max(len(each) for each in pictures)
    found = [similarity.compare_pictures(pictures[0][i if len(pictures[0]) > 1 else 0],
                                         pictures[1][i if len(pictures[1]) > 1 else 0], ms_ssim) for i in range(count)]
    return similarity._mean(found)


def _open(side: Any) -> Any:
    if not isinstance(side, (str, os.PathLike)):
        return side if isinstance(side, (RecordedPings, Ping)) else np.asarray(side, dtype=np.float64)
    path = os.fspath(side)
    return similarity.load_grey_picture(path) if path.lower().endswith(PICTURES) else RecordedPings(path)


def _common_pings(left: Any, right: Any, wanted: Sequence[int] | None) -> list[int]:
    counts = [len(one) for one in (left, right) if isinstance(one, RecordedPings)]
    common = min(counts, default=1)
    if common == 0:
        raise Error("a recording has no pings to compare")
    for number in wanted or []:
        if not 0 <= number < common:
            raise Error(f"there is no ping {number} in both; they have {common}, counted from 0")
    return list(range(common)) if wanted is None else list(wanted)


def _loudest(side: Any, wanted: list[int]) -> float:
    if isinstance(side, Ping):
        return float(np.max(side.intensity))
    return max(float(np.max(side.intensity[number])) for number in wanted)


def _pictures(side: Any, wanted: list[int], levels: Any) -> list[npt.NDArray[np.float64]]:
    if isinstance(side, Ping):
        return [levels(side.intensity)]
    if not isinstance(side, RecordedPings):
        return [side]
    if side.shape[2] <= 2:  # All of port, then all of starboard.
        return [levels(np.stack([_fractions(side, number) for number in wanted], axis=2).reshape(side.shape[1], -1))]
    return [levels(_fractions(side, number)) for number in wanted]


def _fractions(recording: RecordedPings, number: int) -> npt.NDArray[np.float64]:
    fractions: npt.NDArray[np.float64] = np.divide(np.asarray(recording.intensity[number], dtype=np.float64),
                                                   recording.full_scale)
    return fractions
