"""Seconds against a size on logarithmic scales."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from flaprig.report import style

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Curve:
    """One line of the picture.

    Attributes:
        name: of the line.
        axis: what the sizes are.
        sizes: along the horizontal axis. Shape (n,).
        taken: seconds. Shape (n,).
    """

    name: str
    axis: str
    sizes: tuple[int, ...]
    taken: Array


def draw(path: Path, curves: Sequence[Curve]) -> None:
    """One panel for each kind of size; all have the same seconds."""
    kinds = list(dict.fromkeys(curve.axis for curve in curves))
    with style.figure(3.1 * len(kinds), 3.6) as drawing:
        panels = drawing.subplots(1, len(kinds), sharey=True, squeeze=False)[0]
        for axes, kind in zip(panels, kinds, strict=True):
            members = [curve for curve in curves if curve.axis == kind]
            for colour, curve in zip(style.SERIES, members, strict=False):
                axes.plot(curve.sizes, curve.taken, "o-", ms=4, color=colour, label=curve.name)
            sizes = members[0].sizes
            axes.set(xscale="log", yscale="log", xlabel=kind)
            axes.set_xticks(sizes, labels=[str(size) for size in sizes])
            axes.set_xticks([], minor=True)
            axes.legend(fontsize=7.5, loc="upper left")
        # room for the legends
        low, high = panels[0].get_ylim()
        panels[0].set(ylim=(low, 4.0 * high), ylabel="wall time [s]")
        panels[0].set_title("Cost of a run (exponent of the total)")
        style.save(drawing, path)
