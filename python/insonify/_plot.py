"""Plots of pings with matplotlib, which is imported by the first plot."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._insonify import Error, _usually_shown
from ._levels import to_db

if TYPE_CHECKING:
    from ._insonify import Ping


def _pyplot() -> Any:
    try:
        return importlib.import_module("matplotlib.pyplot")
    except ImportError as error:
        raise ImportError("Ping.plot() needs matplotlib (Debian: apt-get install python3-matplotlib); insonify.fan(ping) "
                          "gives a picture without it") from error


def _shown(ping: Ping, counts: bool) -> tuple[Any, tuple[float, float], str]:
    """Values to draw, their colour range and the label of the colour bar, as in insonify.fan()."""
    if counts:
        if ping.counts is None:
            raise Error(f"ping {ping.number} has no counts; receiver.counts: true adds them (calibrated)")
        return ping.counts, (0.0, 2.0**ping.sonar.bits - 1), f"counts of {ping.sonar.bits} bits"
    intensity, raised, full_scale, floor_db = _usually_shown(ping)
    if ping.model == "paper":
        return intensity, (0.0, 1.0), "echo intensity, 0 to 1"
    high = float(to_db(full_scale, -400))
    by_range = f", raised by {raised:g} dB per decade of range" if raised else ""
    return to_db(intensity, -400), (high + floor_db, high), "dB re source at 1 m" + by_range


def _widen(ax: Any, across: npt.NDArray[np.float64], along: npt.NDArray[np.float64]) -> None:
    """Makes the axes of a narrow fan, such as that of a single beam, half as wide as they are long: the labels of a sliver
    would lie on each other."""
    lengths = [float(np.ptp(values)) for values in (across, along)]
    for values, length, set_limits in ((across, lengths[0], ax.set_xlim), (along, lengths[1], ax.set_ylim)):
        if length < max(lengths) / 2:
            middle = float(np.max(values) + np.min(values)) / 2
            set_limits(middle - max(lengths) / 4, middle + max(lengths) / 4)


def plot(ping: Ping, kind: str = "fan", levels: tuple[float, float] | None = None, ax: Any = None,
         colour_map: str | None = None, *, color_map: str | None = None, counts: bool = False) -> Any:
    """Draws a ping with matplotlib. Returns the axes.

    kind: "fan", seen from above in metres, acoustic axis up and port to the left; or "polar", azimuth [deg] across, port
        to the left, and range [m] upwards.
    levels: colour range (low, high) in dB as on the colour bar (from 0 to 1 in the paper model); None: those
        of insonify.fan(), fitted to this ping. For a film use the same for all pings.
    ax: axes to draw in; None: those of a new figure.
    colour_map, or color_map: a matplotlib name; None: inferno.
    counts: draw the instrument's counts (receiver.counts), from 0 to the greatest; levels are then counts.

    Raises Error for an unknown kind, levels that do not increase and missing counts, ImportError without matplotlib.
    """
    pyplot = _pyplot()
    if kind not in ("fan", "polar"):
        raise Error(f"kind = {kind!r} must be fan or polar")
    if levels is not None and not levels[0] < levels[1]:
        raise Error(f"levels = {levels!r} must be two rising numbers, such as (-90, -40)")
    if colour_map is not None and color_map is not None:
        raise Error("colour_map is given twice: color_map is the same")
    if ax is not None and not hasattr(ax, "pcolormesh"):
        raise Error(f"ax = {ax!r} must be axes of matplotlib, such as those of figure.add_subplot(); not a {type(ax).__name__}")
    sonar = ping.sonar
    range_edges = np.linspace(sonar.min_range, sonar.max_range, sonar.bin_count + 1)
    azimuth_edges = sonar.azimuth_edges() + ping.head_angle
    values, fitting, label = _shown(ping, counts)
    low, high = fitting if levels is None else levels
    if ax is None:
        ax = pyplot.subplots(layout="constrained")[1]
    if kind == "fan":
        across = -range_edges[:, None] * np.sin(azimuth_edges)
        along = range_edges[:, None] * np.cos(azimuth_edges)
        ax.set_aspect("equal")
        ax.set_xlabel("port (−) to starboard (+) [m]")
        ax.set_ylabel("ahead [m]")
    else:
        across, along = np.broadcast_arrays(np.degrees(azimuth_edges)[None, :], range_edges[:, None])
        ax.set_xlabel("azimuth, positive to port [deg]")
        ax.set_ylabel("range [m]")
    mesh = ax.pcolormesh(across, along, values, vmin=low, vmax=high, cmap=colour_map or color_map or "inferno", rasterized=True)
    if kind == "fan":
        _widen(ax, across, along)
    else:
        ax.set_xlim(np.degrees(azimuth_edges[0]), np.degrees(azimuth_edges[-1]))  # Port to the left.
    ax.set_title(f"{sonar.name}, ping {ping.number}, {ping.time:.4g} s")
    ax.figure.colorbar(mesh, ax=ax, label=label)
    return ax
