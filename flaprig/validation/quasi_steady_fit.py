"""The two numbers of HOVER_TANK, fitted again without each measured stroke in turn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray
from tyro.conf import arg

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.coefficients import Coefficients
from flaprig.aero.models import QuasiSteady
from flaprig.aero.simulate import simulate
from flaprig.fluid import WATER
from flaprig.validation.case import on_all_cores
from flaprig.validation.measured import SOURCE, WORDS
from flaprig.validation.measured_file import Measured, read
from flaprig.validation.measured_score import mean_cycle
from flaprig.validation.measuring_chain import OneCycle, reading
from flaprig.validation.outcome import Outcome, Row
from flaprig.validation.paper import LIFT, LIFT_TO_DRAG, SINUSOID
from flaprig.wing import RIG_WING

Array = NDArray[np.float64]

# C_L = lift sin 2a, C_D = FRICTION + drag (1 - cos 2a); of HOVER_TANK
LIFT_NUMBER, DRAG_NUMBER = 1.54, 1.34
# drag edge on: laminar skin friction of both sides at Re of some thousand, 2.66 / sqrt(Re)
FRICTION = 0.05


@dataclass(frozen=True)
class QuasiSteadyFit:
    """C_L = a sin 2 alpha, C_D = 0.05 + b (1 - cos 2 alpha): a and b by least squares, left out.

    The fit looks at the published means; rotation and added mass stay as they are.

    Attributes:
        cases: file of strokes; the 26 that come with flaprig when left out.
    """

    name: ClassVar[str] = "quasi-steady-fit"
    claim: ClassVar[str] = "cross-validation of the quasi-steady coefficients"

    cases: Annotated[Path | None, arg(metavar="FILE", help_behavior_hint="(optional)")] = None

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case.

        Raises:
            ValueError: a file that is no list of strokes.
            OSError: a file that cannot be read.
        """
        strokes = read(self.cases)
        if len(strokes) < 3:
            raise check.fail(self.name, "cases", "at least three strokes", len(strokes))
        jobs: list[Measured | None] = [None, *strokes]
        paper, *forces = on_all_cores(_linear, jobs, progress)
        everyone = list(range(len(forces)))
        whole = _fit(forces)
        left_out = [_fit([forces[k] for k in everyone if k != i]) for i in everyone]
        errors = np.array([f.errors(numbers) for f, numbers in zip(forces, left_out, strict=True)])
        return Outcome((*_rows(errors), *_fitted(whole, left_out, paper)))


@dataclass(frozen=True, eq=False)
class Linear:
    """C_L and C_D, published and measured alike, as constant + matrix (a, b).

    Attributes:
        constant: shape (4,).
        matrix: shape (4, 2).
        reference: the measured ones, shape (4,).
    """

    constant: Array
    matrix: Array
    reference: Array

    def errors(self, numbers: Array) -> Array:
        """C_L, C_D, L/D published, and the same measured alike, in percent. Shape (6,)."""
        r = (self.constant + self.matrix @ numbers) / self.reference
        return 100.0 * (np.array([r[0], r[1], r[0] / r[1], r[2], r[3], r[2] / r[3]]) - 1.0)


def _linear(case: Measured | None) -> Linear:
    """A measured stroke, or the paper's sinusoid, from three simulations."""
    means = np.array([_means(case, a, b) for a, b in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))])
    known = (LIFT, LIFT / LIFT_TO_DRAG) if case is None else (case.mean_lift, case.mean_drag)
    return Linear(means[0], (means[1:] - means[0]).T, np.tile(known, 2))


def _means(case: Measured | None, lift: float, drag: float) -> Array:
    alpha = np.linspace(0.0, np.pi, 181)
    table = Coefficients.from_table(
        alpha, lift * np.sin(2.0 * alpha), FRICTION + drag * (1.0 - np.cos(2.0 * alpha))
    )
    model = QuasiSteady(table)
    if case is None:
        result = simulate(RIG_WING, SINUSOID, model, WATER, cycles=1)
        return np.tile([result.cl, result.cd], 2)
    result = simulate(case.wing, case.stroke, model, case.fluid, cycles=1)
    truth = OneCycle(case.stroke, mean_cycle(result, result.lift), mean_cycle(result, result.drag))
    read_out = reading(case, truth)
    parts = (truth.lift, truth.drag, read_out.lift, read_out.drag)
    return np.array([part.mean() for part in parts]) / case.reference_force


def _fit(forces: Sequence[Linear]) -> Array:
    """a and b with the least squares of the published C_L and C_D."""
    rows = np.concatenate([f.matrix[:2] / f.reference[:2, None] for f in forces])
    left = np.concatenate([1.0 - f.constant[:2] / f.reference[:2] for f in forces])
    return np.asarray(np.linalg.lstsq(rows, left, rcond=None)[0])


def _rows(errors: Array) -> list[Row]:
    rows = []
    for first, words in ((0, "published"), (3, "measured alike")):
        for k, key in enumerate(WORDS):
            column = errors[:, first + k]
            rms, bias = float(np.sqrt(np.mean(column**2))), float(column.mean())
            rows.append(Row(f"left out, {words}, {key} rms [%]", rms, 0.0, SOURCE, None, False))
            rows.append(Row(f"left out, {words}, {key} bias [%]", bias, 0.0, SOURCE, None, False))
    return rows


def _fitted(whole: Array, left_out: Sequence[Array], paper: Linear) -> list[Row]:
    spread = np.std(left_out, axis=0)
    lift, _, ratio = paper.errors(whole)[:3]
    ours, table = "HOVER_TANK", "paper, table 1"
    return [
        Row("fitted lift number a", float(whole[0]), LIFT_NUMBER, ours, 0.5, spread=spread[0]),
        Row("fitted drag number b", float(whole[1]), DRAG_NUMBER, ours, 0.5, spread=spread[1]),
        Row("paper's sinusoid, C_L error [%]", float(lift), 0.0, table, None, False),
        Row("paper's sinusoid, L/D error [%]", float(ratio), 0.0, table, None, False),
    ]
