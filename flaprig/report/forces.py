"""The force histories of one cycle: lift and drag coefficient against t/T, and the stroke."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.result import Result
from flaprig.report import style
from flaprig.strokes.stroke import Stroke

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

# difference of angles that a picture shows [degrees]
LEAST_DIFFERENCE = 0.5


@dataclass(frozen=True, eq=False)
class Curve:
    """One run in the picture.

    Attributes:
        name: what the legend calls it.
        result: its histories.
        colour: of the line, as matplotlib writes colours.
        line: "-" or "--".
    """

    name: str
    result: Result
    colour: str = style.VERMILION
    line: str = "-"


def cycles_of(result: Result, history: Array) -> tuple[Array, Array]:
    """The averaged cycles of a history, each a row closed to t/T = 1, and their t/T.

    The end of a cycle is the begin of the next one in time, or of the same where there is none.
    """
    first, last = result.averaged_cycles
    n = result.steps_per_cycle
    rows = history.reshape(-1, n)
    following = np.roll(rows[:, 0], -1)
    following[-1] = rows[-1, 0]
    closed = np.column_stack([rows, following])
    return np.linspace(0.0, 1.0, n + 1), closed[first - 1 : last]


def draw_forces(
    path: Path, curves: Sequence[Curve], title: str, asked: Stroke | None = None
) -> None:
    """Picture of lift and drag coefficients over one cycle.

    The line is the mean of the averaged cycles at each t/T, the band their smallest and largest.

    Args:
        path: where to write; the ending chooses the format.
        curves: the runs; the first one's motion is shown.
        title: above the picture.
        asked: the stroke that was asked for, drawn in grey behind the angles.
    """
    with style.figure(7.0, 6.4) as drawing:
        lift, drag, angles = drawing.subplots(
            3, 1, sharex=True, gridspec_kw={"height_ratios": [3, 3, 1.25]}
        )
        for curve in curves:
            _draw(lift, curve, curve.result.lift, curve.result.cl)
            _draw(drag, curve, curve.result.drag, curve.result.cd)
        lift.set_ylabel("lift coefficient $C_L$")
        drag.set_ylabel("drag coefficient $C_D$")
        for axes in (lift, drag):
            axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
            axes.margins(y=0.06)
            _legend(axes, 2)
        _draw_angles(angles, curves[0].result, asked)
        first, last = curves[0].result.averaged_cycles
        if first < last:
            note = f"lines: mean of cycles {first} to {last}; bands: their smallest and largest"
            drawing.supxlabel(note, fontsize=8.0, color=style.GREY, x=0.98, ha="right")
        drawing.align_ylabels()
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)


def _draw(axes: Axes, curve: Curve, history: Array, mean: float) -> None:
    phase, rows = cycles_of(curve.result, history / curve.result.reference_force)
    low, high = rows.min(axis=0), rows.max(axis=0)
    axes.fill_between(phase, low, high, color=curve.colour, alpha=0.2, linewidth=0.0)
    label = f"{curve.name}, mean {mean:.2f}"
    axes.plot(phase, rows.mean(axis=0), curve.line, color=curve.colour, label=label)


def _draw_angles(axes: Axes, result: Result, asked: Stroke | None) -> None:
    """Sweep and pitch, and behind them what was asked for where it is another motion."""
    largest = 0.0
    for name, line in (("sweep", "-"), ("pitch", "--")):
        phase, rows = cycles_of(result, np.degrees(getattr(result.histories, name)))
        made = rows.mean(axis=0)
        largest = max(largest, float(np.abs(made).max()))
        if asked is not None:
            wanted = np.degrees(getattr(asked.motion(phase * asked.period), name))
            if np.abs(wanted - made).max() > LEAST_DIFFERENCE:
                axes.plot(phase, wanted, line, color=style.GREY, lw=1.3, label=f"{name} asked")
                largest = max(largest, float(np.abs(wanted).max()))
        axes.plot(phase, made, line, color=style.INK, linewidth=1.3, label=name)
    most = 30.0 * np.ceil(largest / 30.0 + 1e-9)
    axes.set(xlim=(0.0, 1.0), xticks=np.linspace(0.0, 1.0, 5), ylim=(-most, most))
    axes.set_yticks([-most, 0.0, most])
    axes.set(xlabel="time over period $t/T$", ylabel="angle [°]")
    axes.xaxis.set_major_formatter("{x:g}")
    _legend(axes)


def _legend(axes: Axes, columns: int = 4) -> None:
    """Above the axes, so that it hides no line."""
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, borderaxespad=0.2)
