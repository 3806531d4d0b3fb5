"""Energy balance of the twin: every joule of the motors is found again."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.strokes import SunTangStroke
from flaprig.validation.case import on_all_cores
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import RIG_WING

if TYPE_CHECKING:
    from flaprig.twin import TwinRun

STROKE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
# the acrylic plate, and one a tenth as dense: the added mass is 12 and 120 times its inertia
DENSITIES = (1180.0, 118.0)


@dataclass(frozen=True)
class Energy:
    """Motor work less fluid work, kinetic and potential energy and losses, per cycle.

    Attributes:
        time_steps: of MuJoCo [s].
        cycles: of the sinusoid.
    """

    name: ClassVar[str] = "energy"
    claim: ClassVar[str] = "conservation of energy in the twin"

    time_steps: tuple[float, ...] = (0.001, 0.005)
    cycles: int = 2

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        models = (UVLM(4, 6, 40), UVLM.extended(chordwise=4, spanwise=6), QuasiSteady())
        jobs = [(m, dt, rho) for m in models for dt in self.time_steps for rho in DENSITIES]
        runs = on_all_cores(lambda job: self._run(*job), jobs, progress)
        rows = [
            Row(
                f"{model.label}, {1e3 * dt:g} ms, plate {rho:g} kg/m³, lost share",
                float(np.abs(run.energy.relative_residual).max()),
                0.0,
                "conservation",
                # explicit steps of the pose leave 4e-4 of the work for each second of the step
                min(1e-4, 1e-3 * dt),
                relative=False,
            )
            for (model, dt, rho), run in zip(jobs, runs, strict=True)
        ]
        return Outcome(tuple(rows))

    def _run(self, model: UVLM | QuasiSteady, time_step: float, density: float) -> TwinRun:
        # MuJoCo is loaded late
        from flaprig.rig import Rig
        from flaprig.twin import Twin

        wing = replace(RIG_WING, density=density)
        rig = Rig.load().with_(wing=wing, model=model)
        return Twin(rig, time_step).run(STROKE, cycles=self.cycles)
