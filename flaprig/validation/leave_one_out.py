"""The extended lattice's two fitted numbers, fitted again without each measured stroke in turn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from tyro.conf import arg

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM, SuctionLaw
from flaprig.aero.uvlm import EXTENDED_SUCTION
from flaprig.validation.case import on_all_cores
from flaprig.validation.forces import Forces, Parts, measured_forces, paper_forces
from flaprig.validation.measured import BIAS, RMS, SOURCE, WORDS
from flaprig.validation.measured_file import Measured, read
from flaprig.validation.measured_score import KEYS
from flaprig.validation.outcome import Outcome, Row

Array = NDArray[np.float64]

# strokes that the paper's sinusoid counts for in the fit: it is to be kept
WEIGHT = 10.0
# steepest law that is tried
MOST_SLOPE = 3.0


@dataclass(frozen=True)
class LeaveOneOut:
    """Least squares of C_L and C_D over all strokes but one, judged on that one.

    The lag is taken from a list, the slope of the suction law is found; the tips' suction is
    theory's and the onset stays. The fit looks at the means after the measuring chain.

    Attributes:
        cases: file of strokes; the 26 that come with flaprig when left out.
        lags: values of the lag that are tried [chords].
        onset: Reynolds number where leading-edge suction begins.
        cycles: of each run; means are over the third to the last, at most three.
    """

    name: ClassVar[str] = "leave-one-out"
    claim: ClassVar[str] = "cross-validation of the extended lattice"

    cases: Annotated[Path | None, arg(metavar="FILE", help_behavior_hint="(optional)")] = None
    lags: tuple[float, ...] = (0.1, 0.125, 0.15, 0.175)
    onset: float = EXTENDED_SUCTION.onset
    cycles: int = 3

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case.

        Raises:
            ValueError: a parameter out of range, or a file that is no list of strokes.
            OSError: a file that cannot be read.
        """
        for lag in self.lags:
            check.in_range(self.name, "lags", lag, 0.0, 10.0, "chords")
        check.positive(self.name, "onset", self.onset)
        strokes = read(self.cases)
        if len(strokes) < 3:
            raise check.fail(self.name, "cases", "at least three strokes", len(strokes))
        forces = self._forces(strokes, progress)
        everyone = np.arange(len(strokes))
        whole = self._fit(forces, everyone)
        left_out = [self._fit(forces, np.delete(everyone, k)) for k in everyone]
        errors = np.array([forces[f.lag][1][k].errors(f.slope) for k, f in enumerate(left_out)])
        rows = [*_rows(errors), *_fitted(whole, left_out, forces)]
        return Outcome(tuple(rows), _data(strokes, errors, whole), None, NOTES)

    def _forces(
        self, strokes: Sequence[Measured], progress: Progress | None
    ) -> dict[float, tuple[Forces, list[Forces]]]:
        """The paper's sinusoid and the strokes, by lag."""
        jobs: list[tuple[float, Measured | None]] = [
            (lag, stroke) for lag in self.lags for stroke in (None, *strokes)
        ]
        found = on_all_cores(lambda job: self._simulated(*job), jobs, progress)
        count = len(strokes) + 1
        return {
            lag: (found[k * count], found[k * count + 1 : (k + 1) * count])
            for k, lag in enumerate(self.lags)
        }

    def _simulated(self, lag: float, stroke: Measured | None) -> Forces:
        law = SuctionLaw(1.0, self.onset)
        parts = Parts(UVLM.extended(circulation_lag=lag), law, self.cycles)
        return paper_forces(parts) if stroke is None else measured_forces(parts, stroke)

    def _fit(self, forces: dict[float, tuple[Forces, list[Forces]]], kept: NDArray[np.int_]) -> Fit:
        """The lag and the slope with the least squares."""

        def squares(slope: float, lag: float) -> float:
            paper, strokes = forces[lag]
            errors = np.array([strokes[k].errors(slope)[3:5] for k in kept])
            lift, _, ratio = paper.errors(slope)[:3]
            return float(np.sum(errors**2) + WEIGHT * (lift**2 + ratio**2))

        fits = []
        for lag in self.lags:
            best = minimize_scalar(squares, bounds=(0.0, MOST_SLOPE), args=(lag,), method="bounded")
            fits.append(Fit(lag, float(best.x), float(best.fun)))
        return min(fits, key=lambda fit: fit.squares)


@dataclass(frozen=True)
class Fit:
    """A fitted lattice.

    Attributes:
        lag: [chords].
        slope: of the suction law.
        squares: sum of squared errors, percent squared.
    """

    lag: float
    slope: float
    squares: float


NOTES = (
    "Published and measured alike as in the case `measured`; the paper's sinusoid counts as "
    f"{WEIGHT:g} strokes in every fit.",
)


def _rows(errors: Array) -> list[Row]:
    rows = []
    for first, words in ((0, "published"), (3, "measured alike")):
        for k, key in enumerate(WORDS):
            column = errors[:, first + k]
            rms, bias = float(np.sqrt(np.mean(column**2))), float(column.mean())
            line = f"left out, {words}, {key}"
            rows.append(Row(f"{line} rms [%]", rms, 0.0, SOURCE, RMS[k], False))
            rows.append(Row(f"{line} bias [%]", bias, 0.0, SOURCE, BIAS[k], False))
    return rows


def _fitted(
    whole: Fit, left_out: Sequence[Fit], forces: dict[float, tuple[Forces, list[Forces]]]
) -> list[Row]:
    default = UVLM.extended()
    law = default.suction_efficiency
    slope = law.slope if isinstance(law, SuctionLaw) else math.nan
    lift, _, ratio = forces[whole.lag][0].errors(whole.slope)[:3]
    lags, slopes = (float(np.std([getattr(f, n) for f in left_out])) for n in ("lag", "slope"))
    ours = "UVLM.extended()"
    return [
        Row(
            "fitted lag [chords]",
            whole.lag,
            default.circulation_lag,
            ours,
            spread=lags,
        ),
        Row("fitted slope of the law", whole.slope, slope, ours, spread=slopes),
        Row("paper's sinusoid, C_L error [%]", lift, 0.0, "paper, table 1", 3.0, False),
        Row("paper's sinusoid, L/D error [%]", ratio, 0.0, "paper, table 1", 4.0, False),
    ]


def _data(strokes: Sequence[Measured], errors: Array, whole: Fit) -> dict[str, Any]:
    def statistics(columns: Array) -> dict[str, dict[str, float]]:
        rms, bias = np.sqrt(np.mean(columns**2, axis=0)), columns.mean(axis=0)
        return {
            "rms_percent": dict(zip(KEYS, rms.tolist(), strict=True)),
            "bias_percent": dict(zip(KEYS, bias.tolist(), strict=True)),
        }

    return {
        **statistics(errors[:, :3]),
        "measured_alike": statistics(errors[:, 3:]),
        "lag_chords": whole.lag,
        "slope": whole.slope,
        "cases": [
            {"id": s.name, "error_percent": dict(zip(KEYS, e[:3].tolist(), strict=True))}
            for s, e in zip(strokes, errors, strict=True)
        ],
    }
