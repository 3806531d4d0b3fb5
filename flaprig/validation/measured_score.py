"""How near a model of the air comes to one measured stroke."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.models import AirModel
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.validation.measured_file import Measured, history
from flaprig.validation.measuring_chain import OneCycle, reading

Array = NDArray[np.float64]

# the coefficients, as they stand in JSON
KEYS = ("cl", "cd", "lift_to_drag")


@dataclass(frozen=True, eq=False)
class Score:
    """One stroke, one model.

    Attributes:
        case: the measured stroke.
        means: the model's C_L, C_D and L/D.
        spread: from cycle to cycle, of the same.
        published: errors of the means in percent.
        alike: the same after the measuring chain.
        measured: C_L and C_D over t/T, as published. Shape (2, n).
        computed: C_L and C_D over t/T after the measuring chain. Shape (2, n).
    """

    case: Measured
    means: tuple[float, float, float]
    spread: tuple[float, float, float]
    published: tuple[float, float, float]
    alike: tuple[float, float, float]
    measured: Array
    computed: Array

    @property
    def correlation(self) -> tuple[float, float]:
        """Of C_L and C_D over the mean half-stroke."""
        theirs, ours = half_stroke(self.measured), half_stroke(self.computed)
        return (
            float(np.corrcoef(theirs[0], ours[0])[0, 1]),
            float(np.corrcoef(theirs[1], ours[1])[0, 1]),
        )

    @property
    def residual(self) -> tuple[float, float]:
        """Rms of the difference of C_L and C_D about their means, over that of the measured one."""
        theirs, ours = half_stroke(self.measured), half_stroke(self.computed)
        left, size = np.std(ours - theirs, axis=1), np.std(theirs, axis=1)
        return float(left[0] / size[0]), float(left[1] / size[1])

    def summary(self) -> dict[str, Any]:
        """What JSON holds of it."""
        case = self.case
        theirs = (case.mean_lift, case.mean_drag, case.lift_to_drag)
        return {
            "id": case.name,
            "reynolds": case.reynolds,
            **dict(zip(KEYS, self.means, strict=True)),
            **{f"{key}_spread": s for key, s in zip(KEYS, self.spread, strict=True)},
            **{f"measured_{key}": m for key, m in zip(KEYS, theirs, strict=True)},
            "error_percent": dict(zip(KEYS, self.published, strict=True)),
            "error_percent_measured_alike": dict(zip(KEYS, self.alike, strict=True)),
            "correlation": dict(zip(("cl", "cd"), self.correlation, strict=True)),
        }


def half_stroke(histories: Array) -> Array:
    """Mean of the two half-strokes of each row. Shape (k, n // 2)."""
    half = histories.shape[1] // 2
    return 0.5 * (histories[:, :half] + histories[:, half : 2 * half])


def score(case: Measured, model: AirModel, cycles: int, late: float) -> Score:
    """Run a stroke and compare.

    Args:
        case: the measured stroke.
        model: of the air.
        cycles: of the run.
        late: the balance's time stamps behind the encoders' [s].
    """
    result = simulate(case.wing, case.stroke, model, case.fluid, cycles)
    # theirs divides by the nominal sweep's speed
    scale = result.reference_force / case.reference_force
    truth = OneCycle(case.stroke, mean_cycle(result, result.lift), mean_cycle(result, result.drag))
    read = reading(case, truth, late)
    force = case.reference_force
    phase = np.arange(truth.lift.size) / truth.lift.size
    return Score(
        case,
        (result.cl * scale, result.cd * scale, result.lift_to_drag),
        (result.cl_spread * scale, result.cd_spread * scale, result.lift_to_drag_spread),
        _errors(case, result.cl * scale, result.cd * scale),
        _errors(case, float(read.lift.mean() / force), float(read.drag.mean() / force)),
        np.stack([history(case.lift, phase), history(case.drag, phase)]),
        np.stack([read.lift, read.drag]) / force,
    )


def mean_cycle(result: Result, values: Array) -> Array:
    """Mean over the averaged cycles at each phase. Shape (steps,)."""
    return result.averaged(values).reshape(-1, result.steps_per_cycle).mean(axis=0)


def _errors(case: Measured, lift: float, drag: float) -> tuple[float, float, float]:
    """Of C_L, C_D and L/D in percent."""
    return (
        100.0 * (lift / case.mean_lift - 1.0),
        100.0 * (drag / case.mean_drag - 1.0),
        100.0 * (lift / drag / case.lift_to_drag - 1.0),
    )
