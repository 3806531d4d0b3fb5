"""The measured strokes in one picture: means against means, and four histories."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from flaprig.report import style
from flaprig.validation.measured_score import Score, half_stroke

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LABELS = ("$C_L$", "$C_D$", "$L/D$")


def draw_measured(path: Path, model: str, table: Mapping[str, Sequence[Score]]) -> None:
    """Means of the model against the measured ones, and histories of four strokes.

    Args:
        path: where to write.
        model: the one that leads.
        table: scores by the name of the model.
    """
    with style.figure(9.0, 7.2) as drawing:
        axes = drawing.subplots(3, 3, gridspec_kw={"height_ratios": [1.25, 1, 1]})
        for k, label in enumerate(LABELS):
            _means(axes[0, k], k, label, model, table)
        chosen = _spread_out(table[model])
        for column, score in enumerate(chosen):
            _history(axes[1, column], score, 0, model, table)
            _history(axes[2, column], score, 1, model, table)
        axes[0, 0].legend(loc="upper left", fontsize=7.5)
        axes[1, 0].legend(fontsize=7.5)
        style.save(drawing, path)


def _spread_out(scores: Sequence[Score]) -> list[Score]:
    """Three strokes: where the drag's history fits best, in the middle, and worst."""
    ranked = sorted(scores, key=lambda s: s.residual[1])
    return [ranked[0], ranked[len(ranked) // 2], ranked[-1]]


def _means(
    axes: Axes, k: int, label: str, model: str, table: Mapping[str, Sequence[Score]]
) -> None:
    order = [*(n for n in table if n != model), model]
    for name in order:
        case = [s.case for s in table[name]]
        theirs = np.array([(c.mean_lift, c.mean_drag, c.lift_to_drag)[k] for c in case])
        leads = name == model
        axes.plot(
            theirs,
            [s.means[k] for s in table[name]],
            "o",
            ms=4.5 if leads else 3.0,
            color=_colour(name, model, table),
            alpha=1.0 if leads else 0.55,
            label=name,
        )
    low, high = axes.get_xlim()
    axes.plot([low, high], [low, high], color=style.INK, linewidth=0.8)
    axes.fill_between(
        [low, high], [0.9 * low, 0.9 * high], [1.1 * low, 1.1 * high], color=style.PALE
    )
    axes.set(xlabel=f"measured {label}", ylabel=f"computed {label}", xlim=(low, high))


def _colour(name: str, model: str, table: Mapping[str, Sequence[Score]]) -> str:
    others = [n for n in table if n != model]
    return style.VERMILION if name == model else style.SERIES[1 + others.index(name) % 4]


def _history(
    axes: Axes, score: Score, row: int, model: str, table: Mapping[str, Sequence[Score]]
) -> None:
    theirs, ours = half_stroke(score.measured)[row], half_stroke(score.computed)[row]
    phase = np.arange(theirs.size) / (2.0 * theirs.size)
    axes.plot(phase, theirs, color=style.INK, label="measured")
    axes.plot(phase, ours, color=style.VERMILION, label=f"{model}, measured alike")
    if row == 0:
        axes.set_title(score.case.name, fontsize=8.5)
    axes.set(xlabel="$t/T$" if row else "", ylabel=LABELS[row])
