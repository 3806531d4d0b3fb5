"""Learning curves: reward against simulations and against seconds, side by side."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from flaprig.report import style

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Learned:
    """One search.

    Attributes:
        name: what the legend calls it.
        simulations: strokes simulated so far. Shape (n,).
        seconds: wall time so far in [s]. Shape (n,).
        best: best reward so far. Shape (n,).
        mean: mean reward of the latest strokes; None: not drawn. Shape (n,).
    """

    name: str
    simulations: Array
    seconds: Array
    best: Array
    mean: Array | None = None


def read_learned(path: Path, name: str, stage: str | None = None) -> Learned:
    """The curve of a metrics file that training wrote.

    Args:
        path: the file.
        name: what the legend will call it.
        stage: only rows of this stage; None: all.
    """
    with open(path, newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["best_reward"]]
    rows = [row for row in rows if stage is None or row["stage"] == stage]
    count = "simulations" if "simulations" in rows[0] else "steps"
    numbers = {
        key: np.array([float(row[key]) for row in rows])
        for key in (count, "seconds", "best_reward", "reward_mean")
    }
    mean = None if count == "simulations" else numbers["reward_mean"]
    best = np.maximum.accumulate(numbers["best_reward"])
    return Learned(name, numbers[count], numbers["seconds"], best, mean)


def draw_learning(path: Path, curves: Sequence[Learned], title: str, start: float | None) -> None:
    """Picture of the best reward so far, and of the mean where there is one, in thin lines.

    Args:
        path: where to write; the ending chooses the format.
        curves: the searches.
        title: above the picture.
        start: reward of the stroke that all begin with; None: not drawn.
    """
    with style.figure(8.0, 3.6) as drawing:
        axes = drawing.subplots(1, 2, sharey=True)
        for panel, name in zip(axes, ("simulations", "seconds"), strict=True):
            for colour, curve in zip(style.SERIES, curves, strict=False):
                x = np.maximum(getattr(curve, name), 1e-2)
                panel.plot(x, curve.best, color=colour, label=curve.name)
                if curve.mean is not None:
                    panel.plot(x, curve.mean, color=colour, linewidth=0.8, alpha=0.6)
            if start is not None:
                panel.axhline(start, color=style.GREY, linewidth=0.8, linestyle=":")
            panel.set(xscale="log", xlabel=f"{name}{' [s]' if name == 'seconds' else ''}")
        axes[0].set_ylabel("reward of a stroke (eq. 12)")
        low = min(float(np.min(c.best)) for c in curves) if start is None else start
        high = max(float(np.max(c.best)) for c in curves)
        axes[0].set_ylim(low - 0.1 * (high - low), high + 0.1 * (high - low))
        # below both panels: inside there is no place that no curve crosses
        names = axes[0].get_legend_handles_labels()
        drawing.legend(*names, loc="outside lower center", ncols=len(curves))
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)
