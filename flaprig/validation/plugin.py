"""The MuJoCo plugin on a wing moved by hand against the same solver without MuJoCo."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.simulate import simulate
from flaprig.fluid import WATER, Fluid
from flaprig.strokes import SunTangStroke
from flaprig.validation.case import on_all_cores
from flaprig.validation.outcome import Outcome, Row
from flaprig.wing import RIG_WING

if TYPE_CHECKING:
    import mujoco

Array = NDArray[np.float64]

STROKE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
# so thin that its forces are lost in rounding: the rig without a fluid [kg/m3]
NOTHING = Fluid(density=1e-9, kinematic_viscosity=1e-6)


@dataclass(frozen=True)
class Plugin:
    """Torques of the air in MuJoCo along the sinusoid, every cycle, against `flaprig.simulate`.

    Attributes:
        substeps: MuJoCo steps in a wake step.
        cycles: of the sinusoid.
    """

    name: ClassVar[str] = "plugin"
    claim: ClassVar[str] = "prescribed motion against the MuJoCo plugins"

    substeps: int = 2
    cycles: int = 3

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "substeps", self.substeps, 1, 100)
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        models: tuple[UVLM | QuasiSteady, ...] = (
            UVLM(3, 4, 40),
            UVLM.extended(chordwise=3, spanwise=4, steps_per_cycle=40),
            QuasiSteady(steps_per_cycle=40),
        )
        errors = on_all_cores(self._error, models, progress)
        rows = [
            Row(f"{m.label}, largest difference, share", e, 0.0, "simulate", 1e-9, False)
            for m, e in zip(models, errors, strict=True)
        ]
        return Outcome(tuple(rows))

    def _error(self, model: UVLM | QuasiSteady) -> float:
        """Largest difference of both torques over their peaks."""
        h = simulate(RIG_WING, STROKE, model, cycles=self.cycles, substeps=self.substeps).histories
        theirs = np.column_stack([h.sweep_torque, h.pitch_torque])
        return float((np.abs(self._torques(model) - theirs) / np.abs(theirs).max(axis=0)).max())

    def _torques(self, model: UVLM | QuasiSteady) -> Array:
        """Torques of the air about the sweep and the pitch axis. Shape (n, 2)."""
        import mujoco

        steps = model.steps_per_cycle * self.substeps
        wet, dry = _rig(model, WATER, steps), _rig(QuasiSteady(), NOTHING, steps)
        motion = STROKE.motion(np.arange(self.cycles * steps) * wet.opt.timestep)
        pairs = [(m, mujoco.MjData(m)) for m in (wet, dry)]
        torques = np.zeros((motion.time.size, 2))
        for i in range(motion.time.size):
            for sign, (rig, data) in zip((-1.0, 1.0), pairs, strict=True):
                data.qpos[:] = motion.sweep[i], motion.pitch[i]
                data.qvel[:] = motion.sweep_rate[i], motion.pitch_rate[i]
                data.qacc[:] = motion.sweep_acceleration[i], motion.pitch_acceleration[i]
                mujoco.mj_inverse(rig, data)
                torques[i] += sign * data.qfrc_inverse
            # moves the wake on
            mujoco.mj_step(*pairs[0])
        return torques


def _rig(model: UVLM | QuasiSteady, fluid: Fluid, steps: int) -> mujoco.MjModel:
    """The rig's two joints in a fluid, without plate buoyancy or servos."""
    from flaprig.rig import Rig

    compiled = Rig.load().with_(model=model, fluid=fluid, buoyancy=False).spec().compile()
    compiled.opt.timestep = 1.0 / (STROKE.frequency * steps)
    return compiled
