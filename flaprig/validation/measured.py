"""Measured hovering strokes: means as published, and histories through the measuring chain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from tyro.conf import arg

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.coefficients import HOVER_TANK
from flaprig.aero.models import UVLM, AirModel, QuasiSteady
from flaprig.validation.case import on_all_cores
from flaprig.validation.measured_file import Measured, read
from flaprig.validation.measured_picture import draw_measured
from flaprig.validation.measured_score import KEYS, Score, score
from flaprig.validation.measuring_chain import DELAY, MOST_DELAY, delay, towards_the_edge
from flaprig.validation.outcome import Outcome, Row, Table

Array = NDArray[np.float64]

Name = Literal[
    "uvlm-extended", "uvlm", "uvlm-no-suction", "quasi-steady", "hover-tank", "translation"
]
MODELS: dict[str, AirModel] = {
    "uvlm-extended": UVLM.extended(),
    "uvlm": UVLM(),
    "uvlm-no-suction": UVLM(suction_efficiency=0.0),
    "quasi-steady": QuasiSteady(),
    "hover-tank": QuasiSteady(HOVER_TANK),
    # what a rescaled quasi-steady model in the literature is
    "translation": QuasiSteady(rotation=False, added_mass=False),
}
SOURCE = "Li & Nabawy 2022"
WORDS = ("C_L", "C_D", "L/D")
# what is asked of the root mean square and of the bias of the means, in percent
RMS, BIAS = (11.0, 17.0, 12.0), (5.0, 8.0, 8.0)
# Reynolds numbers above this are told apart: the forces are larger there
LARGE_REYNOLDS = 4000.0


@dataclass(frozen=True)
class MeasuredStrokes:
    """Mean C_L, C_D and L/D of measured strokes, and their histories.

    Attributes:
        cases: file of strokes in the form of assets/validation; the 26 that come with flaprig when
            left out.
        model: of the air.
        beside: other models, only told.
        cycles: of each run; means are over the third to the last, at most three.
        delay: of the balance's clock behind the encoders', for the histories [s].
    """

    name: ClassVar[str] = "measured"
    claim: ClassVar[str] = "26 measured hovering strokes of another rig"

    cases: Annotated[Path | None, arg(metavar="FILE", help_behavior_hint="(optional)")] = None
    model: Name = "uvlm-extended"
    beside: tuple[Name, ...] = (
        "uvlm",
        "uvlm-no-suction",
        "quasi-steady",
        "hover-tank",
        "translation",
    )
    cycles: int = 5
    delay: float = DELAY

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case.

        Raises:
            ValueError: a parameter out of range, or a file that is no list of strokes.
            OSError: a file that cannot be read.
        """
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        check.in_range(self.name, "delay", self.delay, 0.0, MOST_DELAY, "s")
        strokes = read(self.cases)
        names: list[str] = list(dict.fromkeys([self.model, *self.beside]))
        jobs = [(name, stroke) for name in names for stroke in strokes]
        scores = on_all_cores(
            lambda job: score(job[1], MODELS[job[0]], self.cycles, self.delay), jobs, progress
        )
        table = {
            name: scores[k * len(strokes) : (k + 1) * len(strokes)] for k, name in enumerate(names)
        }
        chosen = table[self.model]
        rows = [*rows_of(self.model, chosen), *_balance(strokes)]
        data = summary(self.model, chosen) | {
            "beside": {name: summary(name, table[name]) for name in names[1:]}
        }
        return Outcome(
            tuple(rows),
            data,
            lambda path: draw_measured(path, self.model, table),
            (*NOTES, *(f"{s.name}: {notice}" for s in strokes for notice in s.notices)),
            (_models(table), _groups(self.model, chosen)),
        )


NOTES = (
    "Published: the model's means against the published ones. Measured alike: the model's forces "
    "through the balance's clock and filter first (flaprig/validation/measuring_chain.py).",
    "Histories are of the mean half-stroke, since the rig's half-strokes differ by its mounting: "
    "correlation, and rms of the difference about the means over the rms of the measured one.",
)


def rows_of(name: str, scores: Sequence[Score]) -> list[Row]:
    """The lines of the model that is judged."""
    rows = []
    for alike, words in ((False, "published"), (True, "measured alike")):
        errors = np.array([s.alike if alike else s.published for s in scores])
        for k, key in enumerate(WORDS):
            rms, bias = float(np.sqrt(np.mean(errors[:, k] ** 2))), float(errors[:, k].mean())
            line = f"{name}, {words}, {key}"
            rows.append(Row(f"{line} rms [%]", rms, 0.0, SOURCE, RMS[k], False))
            rows.append(Row(f"{line} bias [%]", bias, 0.0, SOURCE, BIAS[k], False))
    return rows


def _models(table: Mapping[str, Sequence[Score]]) -> Table:
    """Every model in a line."""
    header = ("model", *_HEADER, "C_L correlation, residual", "C_D correlation, residual")
    lines = []
    for name, scores in table.items():
        h = _histories(scores)
        lines.append(
            (
                name,
                *_cells(scores),
                f"{h['cl_correlation']:.3f}, {h['cl_residual']:.2f}",
                f"{h['cd_correlation']:.3f}, {h['cd_residual']:.2f}",
            )
        )
    return Table("All models, rms (bias) in %", header, tuple(lines))


def _groups(name: str, scores: Sequence[Score]) -> Table:
    """The judged model by Reynolds number."""
    lines = [
        (f"{words} {LARGE_REYNOLDS:g}, {len(group)} strokes", *_cells(group))
        for words, group in zip(("above", "up to"), _by_reynolds(scores), strict=True)
        if group
    ]
    return Table(f"{name} by Reynolds number, rms (bias) in %", ("Re", *_HEADER), tuple(lines))


_HEADER = (
    *("C_L", "C_D", "L/D"),
    *("C_L measured alike", "C_D measured alike", "L/D measured alike"),
)


def _cells(scores: Sequence[Score]) -> list[str]:
    errors = np.array([(*s.published, *s.alike) for s in scores])
    rms, bias = np.sqrt(np.mean(errors**2, axis=0)), errors.mean(axis=0)
    return [f"{r:.1f} ({b:+.1f})" for r, b in zip(rms, bias, strict=True)]


def _by_reynolds(scores: Sequence[Score]) -> tuple[list[Score], list[Score]]:
    """Above LARGE_REYNOLDS, and the rest."""
    large = [s for s in scores if s.case.reynolds > LARGE_REYNOLDS]
    return large, [s for s in scores if s.case.reynolds <= LARGE_REYNOLDS]


def _histories(scores: Sequence[Score]) -> dict[str, float]:
    """Means over all strokes."""
    return {
        f"{key}_{name}": float(np.mean([getattr(s, name)[k] for s in scores]))
        for k, key in enumerate(("cl", "cd"))
        for name in ("correlation", "residual")
    }


def summary(name: str, scores: Sequence[Score]) -> dict[str, Any]:
    """What JSON holds of one model."""
    large, small = _by_reynolds(scores)
    groups = {"re_above_4000": large, "re_up_to_4000": small}
    return {
        "model": name,
        **_statistics([s.published for s in scores]),
        "measured_alike": _statistics([s.alike for s in scores]),
        **{
            key: _statistics([s.published for s in group])
            | {"measured_alike": _statistics([s.alike for s in group]), "strokes": len(group)}
            for key, group in groups.items()
            if group
        },
        "histories": _histories(scores),
        "cases": [s.summary() for s in scores],
    }


def _statistics(errors: Sequence[Sequence[float]]) -> dict[str, dict[str, float]]:
    """Root mean square and mean of errors in percent, by coefficient."""
    table = np.array(errors)
    rms, bias = np.sqrt(np.mean(table**2, axis=0)), table.mean(axis=0)
    return {
        "rms_percent": dict(zip(KEYS, rms.tolist(), strict=True)),
        "bias_percent": dict(zip(KEYS, bias.tolist(), strict=True)),
    }


def _balance(strokes: Sequence[Measured]) -> list[Row]:
    """What the strokes tell of their balance, without a model of the air."""
    found = np.array([delay(stroke) for stroke in strokes])
    large = np.array([stroke.reynolds > LARGE_REYNOLDS for stroke in strokes])
    share = 100.0 * np.array([towards_the_edge(stroke) for stroke in strokes])
    words = "force towards the leading edge over the normal one"
    rows = [Row("balance's clock late, mean [s]", float(found.mean()), spread=float(found.std()))]
    for name, picked in (("up to", ~large), ("above", large)):
        if picked.any():
            part = share[picked]
            line = f"{words}, Re {name} {LARGE_REYNOLDS:g} [%]"
            rows.append(Row(line, float(part.mean()), spread=float(part.std())))
    return rows
