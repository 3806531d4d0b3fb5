"""Gains of lift and of lift over drag at several bounds on the accelerations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from flaprig.report import style


@dataclass(frozen=True)
class Gain:
    """The best stroke found at one pair of bounds.

    Attributes:
        name: of the bounds, written beside the point.
        lift: gain of the mean lift coefficient over the sinusoid in [%].
        lift_to_drag: gain of the mean lift over mean drag in [%].
        series: what was searched with; points of a series share a colour.
    """

    name: str
    lift: float
    lift_to_drag: float
    series: str


def draw_pareto(path: Path, gains: Sequence[Gain], published: Sequence[Gain], title: str) -> None:
    """Picture of both gains, and of the published ones as crosses.

    Args:
        path: where to write; the ending chooses the format.
        gains: what was found, in the order of the bounds.
        published: what others found.
        title: above the picture.
    """
    with style.figure(6.4, 4.6) as drawing:
        axes = drawing.subplots()
        names = list(dict.fromkeys(gain.series for gain in gains))
        for colour, name in zip(style.SERIES, names, strict=False):
            chosen = [gain for gain in gains if gain.series == name]
            x, y = [g.lift for g in chosen], [g.lift_to_drag for g in chosen]
            axes.plot(x, y, "o", color=colour, markersize=5, label=name)
            for k, gain in enumerate(chosen):
                axes.annotate(
                    gain.name,
                    (gain.lift, gain.lift_to_drag),
                    textcoords="offset points",
                    # on both sides in turn: neighbours come close where bounds stop to matter
                    xytext=(6, 6) if k % 2 else (-6, -11),
                    ha="left" if k % 2 else "right",
                    fontsize=8.0,
                    color=colour,
                )
        for gain in published:
            axes.plot(gain.lift, gain.lift_to_drag, "x", color=style.INK, markersize=8)
            axes.annotate(
                gain.name,
                (gain.lift, gain.lift_to_drag),
                textcoords="offset points",
                xytext=(-7, 5),
                ha="right",
                fontsize=8.0,
            )
        axes.margins(0.2)
        axes.set(xlabel="gain of $C_L$ over the sinusoid [%]", ylabel="gain of $L/D$ [%]")
        axes.legend(loc="lower right")
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)
