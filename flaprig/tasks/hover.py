"""What a stroke is worth: loads of many strokes at once, and equations 12 and 13.

N(.) of equation 12 is the ratio of cycle means, mean C_L over mean C_D, minus the sinusoid's by the
same model; C_D(k) there is the force along the stroke plane with its sign, so r3 weighs the size of
its mean, the side force (docs/learning.md).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.loads import side_force, sweep_direction, upward
from flaprig.aero.models import QuasiSteady
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.native import _native
from flaprig.tasks.hover_motion import (
    Motions,
    Shapes,
    has_shape,
    motions,
    rigid_motion,
    shapes,
)
from flaprig.tasks.hover_settings import SINUSOID_COEFFICIENTS, HoverSettings
from flaprig.tasks.series import waves

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# why a stroke has no loads: the usual reason
LOADS_FAILED = "the loads are not finite"


@dataclass(frozen=True, eq=False)
class Coefficients:
    """Means over the averaged cycles; NaN in a row that was not simulated. Shape (rows,) each.

    Attributes:
        cl: mean lift coefficient.
        cd: mean drag coefficient, positive against the sweep.
        side: mean force coefficient along the stroke plane, positive against increasing sweep: a
            hovering stroke has none.
        asymmetry: mean lift coefficient of the first half strokes minus that of the second.
    """

    cl: Array
    cd: Array
    side: Array
    asymmetry: Array


@dataclass(frozen=True, eq=False)
class Evaluation:
    """What came out for each row.

    Attributes:
        shapes: the normalised strokes, with observations.
        coefficients: means of the loads.
        reward: equation 12, or minus the penalty. Shape (rows,).
        terms: of equation 12: lift, ratio, side, asymmetry. Shape (rows, 4).
        exceeded: rows beyond a bound, equation 13. Shape (rows,).
        failures: why a simulation gave no finite loads, by row.
    """

    shapes: Shapes
    coefficients: Coefficients
    reward: Array
    terms: Array
    exceeded: Flags
    failures: dict[int, str]

    @property
    def failed(self) -> Flags:
        """Rows whose simulation gave no finite loads. Shape (rows,)."""
        flags = np.zeros(len(self.reward), dtype=np.bool_)
        flags[list(self.failures)] = True
        return flags


class Evaluator(ABC):
    """Judges strokes by equations 12 and 13; how they are flown is its subclasses' part.

    Attributes:
        settings: the problem.
        reference_ratio: C_Ref of equation 12, mean C_L over mean C_D of the sinusoid flown alike.
        sinusoid: coefficients of the sinusoid's loads, one row.

    Raises:
        FloatingPointError: the sinusoid itself gives no finite loads.
    """

    def __init__(self, settings: HoverSettings) -> None:
        self.settings = settings
        self.sinusoid, failures = self.simulate(
            shapes(settings, np.array([SINUSOID_COEFFICIENTS])), np.arange(1)
        )
        self.reference_ratio = float(self.sinusoid.cl[0] / self.sinusoid.cd[0])
        if failures or not np.isfinite(self.reference_ratio):
            reason = failures.get(0, LOADS_FAILED)
            raise FloatingPointError(f"{type(self).__name__}: the sinusoid fails: {reason}")

    @abstractmethod
    def simulate(
        self, shape: Shapes, rows: NDArray[np.int64]
    ) -> tuple[Coefficients, dict[int, str]]:
        """Mean coefficients of the rows asked for, NaN in the others; and failures by row."""

    @abstractmethod
    def fly(self, coefficients: Array) -> Result:
        """One stroke with all its histories, flown as `simulate` does. Shape (12,)."""

    def evaluate(self, coefficients: Array) -> Evaluation:
        """Strokes of coefficients, shape (rows, 12); those beyond the bounds are not simulated.

        Raises:
            ValueError: a row that is no stroke: not finite, or an angle without coefficients.
        """
        if not has_shape(coefficients).all():
            owner = type(self).__name__
            raise ValueError(f"{owner}: coefficients must be finite and no angle's all zero")
        shape = shapes(self.settings, coefficients)
        bounds = self.settings.bounds
        # a hair of room: the sinusoid is allowed by its own bounds
        limit = np.array([bounds.sweep, bounds.pitch]) * (1.0 + 1e-9)
        exceeded = np.any(shape.peak_acceleration > limit, axis=1)
        found, failures = self.simulate(shape, np.flatnonzero(~exceeded))
        terms = self.terms(found)
        reward = terms.sum(axis=1)
        for k in np.flatnonzero(~exceeded & ~np.isfinite(reward)).tolist():
            failures.setdefault(k, LOADS_FAILED)
        reward[exceeded] = -self.settings.reward.penalty
        reward[list(failures)] = -self.settings.reward.penalty
        return Evaluation(shape, found, reward, terms, exceeded, failures)

    def terms(self, found: Coefficients) -> Array:
        """The four terms of equation 12. Shape (rows, 4)."""
        r = self.settings.reward
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = found.cl / found.cd - self.reference_ratio
        parts = (
            r.lift * found.cl,
            r.ratio * ratio,
            -r.side * np.abs(found.side),
            -r.asymmetry * np.abs(found.asymmetry),
        )
        return np.stack(parts, axis=1)

    def means(self, force: Array, pitch: Array, direction: Array) -> Array:
        """Rows of Coefficients from forces. Shape (4, rows).

        Args:
            force: of the fluid in wing axes in [N]. Shape (rows, cycles, count, 3), the half stroke
                half of the count.
            pitch: in [rad]. Broadcasts against (rows, cycles, count).
            direction: of the sweep, -1 to 1: makes drag of the side force. Broadcasts as pitch.
        """
        lift, across = upward(force, pitch), side_force(force, pitch)
        half = lift.shape[-1] // 2
        first, second = lift[..., :half].mean(axis=2), lift[..., half:].mean(axis=2)
        parts = (
            0.5 * (first + second),
            (across * direction).mean(axis=2),
            across.mean(axis=2),
            first - second,
        )
        return np.stack([part.mean(axis=1) for part in parts]) / self.settings.reference_force


class Hover(Evaluator):
    """Prescribed motion: many strokes in one call of the native air."""

    def __init__(self, settings: HoverSettings) -> None:
        model = settings.model
        self._native = _air(settings)
        self._waves = waves(model.steps_per_cycle)
        # air without a memory repeats itself
        steady = isinstance(model, QuasiSteady)
        self._cycles = 1 if steady else settings.cycles
        self._skipped = 0 if steady else settings.skipped_cycles
        super().__init__(settings)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != "_native"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        # it holds settings and no state
        self._native = _air(self.settings)

    def simulate(
        self, shape: Shapes, rows: NDArray[np.int64]
    ) -> tuple[Coefficients, dict[int, str]]:
        """Mean coefficients of the rows asked for, NaN in the others; no failures of its own."""
        table = np.full((4, len(shape.series)), np.nan)
        if rows.size:
            motion = motions(shape.rows(rows), self.settings.frequency, self._waves)
            step = 1.0 / (self.settings.frequency * motion.sweep.shape[1])
            direction = sweep_direction(motion.sweep_rate, motion.sweep_acceleration, step)
            force = self.wrenches(motion)[..., :3]
            table[:, rows] = self.means(force, motion.pitch[:, None], direction[:, None])
        return Coefficients(*table), {}

    def fly(self, coefficients: Array) -> Result:
        """One stroke with all its histories, by flaprig.simulate."""
        s = self.settings
        return simulate(s.wing, s.stroke(coefficients), s.model, s.fluid, self._cycles)

    def wrenches(self, motion: Motions) -> Array:
        """Load on the wing in wing axes, after the skipped cycles. Shape (rows, cycles, count, 6).

        Force in [N], torque about the wing frame's origin in [N m].
        """
        rows, count = motion.sweep.shape
        rigid = rigid_motion(motion.repeated(self._cycles))
        parts = self._native.run_batch(
            np.zeros(rows * self._native.state_size),
            rows,
            1.0 / (count * self.settings.frequency),
            rigid.position,
            rigid.rotation,
            rigid.twist,
            rigid.twist_rate,
            self.settings.workers,
        )
        load = parts[0] + parts[1]
        load += parts[2]
        return load.reshape(rows, self._cycles, count, 6)[:, self._skipped :]


def _air(settings: HoverSettings) -> _native.Air:
    model, wing, fluid = settings.model, settings.wing, settings.fluid
    attributes = model.attributes(wing, fluid, settings.frequency, settings.sweep_amplitude)
    return _native.Air(model.plugin, attributes)
