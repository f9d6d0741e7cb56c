"""Pictures of pings as arrays and in notebooks; ranges and azimuths of a ping."""

from __future__ import annotations

import pathlib
import tempfile
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

from . import _insonify
from ._insonify import Error, Line, Ping, RecordedPings, write_png
from ._insonify import draw_waterfall as draw_waterfall  # Given on.

LEAST_ANNOTATED = 240  # Height of pictures that letters fit in [pixels].
LEAST = 16


def _drawn(draw: Any, ping: Ping, height: int, annotations: bool | None, **looks: Any) -> npt.NDArray[np.uint8]:
    is_small = isinstance(height, (int, np.integer)) and height < LEAST_ANNOTATED
    large: npt.NDArray[np.uint8]
    if not is_small:
        large = draw(ping, height=height, annotations=annotations is None or annotations, **looks)
        return large
    if height < LEAST:
        raise Error(f"height = {height} pixels must be from {LEAST} to 8192 pixels")
    if annotations:
        raise Error(f"annotations need a height of at least {LEAST_ANNOTATED} pixels, not {height}")
    times = -(-LEAST_ANNOTATED // int(height))
    large = draw(ping, height=times * int(height), annotations=False, **looks)
    width = large.shape[1] // times
    cells = large[:, :width * times].reshape(int(height), times, width, times, 3)
    small: npt.NDArray[np.uint8] = np.rint(cells.mean(axis=(1, 3))).astype(np.uint8)
    return small


def draw_fan(ping: Ping, levels: Sequence[float] | None = None, colour_map: str | None = None, scale: str | None = None,
             height: int = 720, annotations: bool | None = None, *, color_map: str | None = None,
             counts: bool = False) -> npt.NDArray[np.uint8]:
    """The fan as seen from above, acoustic axis up, port to the left: an array uint8 [height, width, 3].

    levels: colour range (low, high) in dB as on the colour bar; None: what fits this ping. For a film give the same to all.
    colour_map, or color_map: inferno (which None stands for), copper, grey or blue.
    scale: linear or db; None: db in the calibrated model, in which intensities are raised by 30 dB per decade of range.
    height: [pixels], 16 to 8192; the width follows.
    annotations: axes, colour bar and title; None: in pictures of 240 pixels and more, which have room for them.
    counts: draw the counts instead, from 0 to the greatest, where the ping has any (receiver.counts).
    """
    return _drawn(_insonify.draw_fan, ping, height, annotations, levels=levels, colour_map=colour_map, scale=scale,
                  color_map=color_map, counts=counts)


def draw_polar(ping: Ping, levels: Sequence[float] | None = None, colour_map: str | None = None, scale: str | None = None,
               height: int = 720, annotations: bool | None = None, *, color_map: str | None = None,
               counts: bool = False) -> npt.NDArray[np.uint8]:
    """The table of beams x bins: beams across, range upwards; an array uint8 [height, width, 3].

    Arguments: as of draw_fan().
    """
    return _drawn(_insonify.draw_polar, ping, height, annotations, levels=levels, colour_map=colour_map, scale=scale,
                  color_map=color_map, counts=counts)


def _png(picture: npt.NDArray[np.uint8]) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "picture.png")
        write_png(path, picture)
        return path.read_bytes()


def _repr_png_(self: Ping) -> bytes:
    """The fan as a PNG, which notebooks show; of a side-scan sonar the row of a waterfall."""
    return _png(draw_waterfall([self], height=240) if self.sonar.type == "sss" else draw_fan(self, height=480))


def _line_repr_png_(self: Line) -> bytes:
    """As a PNG, which notebooks show: the waterfall of a side-scan sonar, of a multibeam the fan of the last ping."""
    return _png(draw_waterfall(self, height=480) if self.sonar.type == "sss" else draw_fan(self[-1], height=480))


def _ranges(self: Ping | RecordedPings | Line) -> npt.NDArray[np.float64]:
    """Range of the centre of each bin, float64 [bins], in metres."""
    return self.sonar.bin_ranges()


def _azimuths(self: Ping | RecordedPings | Line) -> npt.NDArray[np.float64]:
    """Azimuth of the centre of each beam in the frame of the head, float64 [beams], in radians, positive to port, falling."""
    return self.sonar.azimuths()


setattr(Ping, "_repr_png_", _repr_png_)
setattr(Line, "_repr_png_", _line_repr_png_)
for _name, _read in (("ranges", _ranges), ("azimuths", _azimuths)):
    for _owner in (Ping, RecordedPings, Line):
        setattr(_owner, _name, property(_read))
