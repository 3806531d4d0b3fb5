"""Vortex impulse in hover: the normal force is minus the rate of all rings' impulse."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Air, Progress
from flaprig.aero.models import UVLM
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER
from flaprig.report import style
from flaprig.strokes import SunTangStroke
from flaprig.validation.flight import ticks
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import RIG_WING

Array = NDArray[np.float64]

STROKE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
# steps after the impulsive start that the ramped rate needs
SETTLED = 4


@dataclass(frozen=True)
class Impulse:
    """The first cycle of the rig's sinusoid: force against the impulse of bound and free rings.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: wake rows in a cycle.
    """

    name: ClassVar[str] = "impulse"
    claim: ClassVar[str] = "conservation of vortex impulse in hover"

    chordwise: int = 4
    spanwise: int = 8
    steps_per_cycle: int = 200

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "steps_per_cycle", self.steps_per_cycle, 8, 2000)
        phase, force, expected = self._histories()
        correlation = float(np.corrcoef(force, expected)[0, 1])
        slope = float(force @ expected / (expected @ expected))
        size = float(np.abs(force).mean() / np.abs(expected).mean())
        law = "conservation"
        rows = (
            Row("correlation of force and impulse rate", correlation, 1.0, law, 0.01, False),
            Row("slope of force over impulse rate", slope, 1.0, law, 2.0),
            Row("mean size, force over impulse rate", size, 1.0, law, 2.0),
        )
        data = {"t_over_T": phase, "normal_force_N": force, "impulse_rate_N": expected}
        return Outcome(rows, data, lambda path: _draw(path, phase, force, expected))

    def _histories(self) -> tuple[Array, Array, Array]:
        """t/T, normal force [N], and minus the rate of the impulse along the normal [N]."""
        model = UVLM(
            self.chordwise,
            self.spanwise,
            self.steps_per_cycle,
            suction_efficiency=0.0,
            wake_detail=0.0,
            wake_fade=0.0,
        )
        step = STROKE.period / self.steps_per_cycle
        motion = RigidMotion.from_stroke(STROKE.motion(step * np.arange(self.steps_per_cycle)))
        air = Air(RIG_WING, WATER, model, STROKE.frequency)
        forces, impulses = _impulses(air, motion, step)
        rate = -(impulses[2:] - impulses[:-2]) / (2.0 * step)
        along = np.einsum("ni,ni->n", rate, motion.rotation[1:-1, :, 2])
        phase = np.arange(1, self.steps_per_cycle - 1) / self.steps_per_cycle
        return phase[SETTLED:], forces[1:-1][SETTLED:], along[SETTLED:]


def ring_impulse(vertices: Array, circulation: Array) -> Array:
    """Sum of circulation times area vector of the rings of a sheet [m4/s]. Shape (3,)."""
    first = vertices[1:, 1:] - vertices[:-1, :-1]
    second = vertices[1:, :-1] - vertices[:-1, 1:]
    return 0.5 * np.einsum("ij,ijk->k", circulation, np.cross(first, second))


def _impulses(air: Air, motion: RigidMotion, step: float) -> tuple[Array, Array]:
    """Normal force of each step, and the impulse of the fluid by all rings after it."""
    forces, impulses = [], []
    for i in range(len(motion)):
        loads, bound = ticks(air, motion.part(slice(i, i + 1)), step)
        wing = air.lattice @ motion.rotation[i].T
        free, frozen = air.wake()
        # the first wake ring carries the trailing edge's circulation (Kutta)
        wake = np.concatenate([wing[-1:], free]), np.concatenate([bound[0, -1:], frozen])
        total = ring_impulse(wing, bound[0]) + ring_impulse(*wake)
        forces.append(loads.total[0, 2])
        impulses.append(WATER.density * total)
    return np.array(forces), np.array(impulses)


def _draw(path: Path, phase: Array, force: Array, expected: Array) -> None:
    with style.figure(6.2, 3.4) as drawing:
        axes = drawing.subplots()
        axes.plot(phase, expected, color=style.INK, linewidth=1.0, label="minus the impulse's rate")
        axes.plot(phase, force, "--", color=style.VERMILION, label="normal force")
        axes.set(xlabel="$t/T$", ylabel="[N]", title="Vortex impulse, first cycle in hover")
        axes.legend()
        style.save(drawing, path)
