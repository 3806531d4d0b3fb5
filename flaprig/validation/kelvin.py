"""Kelvin's theorem in the wake's bookkeeping: what leaves the wing is found in the wake."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Air, Progress
from flaprig.aero.models import UVLM
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER
from flaprig.strokes import SunTangStroke
from flaprig.validation.flight import ticks
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import RIG_WING

Array = NDArray[np.float64]

STROKE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)


@dataclass(frozen=True)
class Kelvin:
    """Circulation in hover: shed, frozen, kept; and the sum over every strip.

    Attributes:
        steps_per_cycle: wake rows in a cycle.
        cycles: length of the run.
    """

    name: ClassVar[str] = "kelvin"
    claim: ClassVar[str] = "conservation of circulation"

    steps_per_cycle: int = 20
    cycles: float = 1.5

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.in_range(self.name, "cycles", self.cycles, 0.2, 20.0)
        air, edge, strengths = self._histories()
        rows = self.steps_per_cycle
        worst = max(
            float(np.abs(rings - edge[:i][::-1][:rows]).max(initial=0.0))
            for i, rings in enumerate(strengths)
        )
        law = "Kelvin's theorem"
        bound = air.native.bound_circulation(air.state)
        column = np.vstack([bound, edge[-1:], strengths[-1]])
        edges = np.diff(np.vstack([0 * column[:1], column, 0 * column[:1]]), axis=0)
        size = float(np.abs(column).max())
        found = float(np.abs(edges.sum(axis=0)).max()) / size
        left = float(np.abs(edges[len(bound)]).max()) / size
        return Outcome(
            (
                Row("frozen rings less shed circulation [m²/s]", worst, 0.0, law, 0.0, False),
                Row("sum over a strip's edges, share", found, 0.0, law, 1e-12, False),
                Row("left on the trailing edge, share", left, 0.0, law, 0.0, False),
            )
        )

    def _histories(self) -> tuple[Air, Array, list[Array]]:
        """The air, trailing-edge circulation after each step, and the frozen rings after each."""
        model = UVLM(3, 5, self.steps_per_cycle)
        step = STROKE.period / self.steps_per_cycle
        count = round(self.cycles * self.steps_per_cycle)
        motion = RigidMotion.from_stroke(STROKE.motion(step * np.arange(count)))
        air = Air(RIG_WING, WATER, model, STROKE.frequency)
        edge, strengths = [], []
        for i in range(count):
            edge.append(ticks(air, motion.part(slice(i, i + 1)), step)[1][0, -1])
            strengths.append(air.wake()[1])
        return air, np.array(edge), strengths
