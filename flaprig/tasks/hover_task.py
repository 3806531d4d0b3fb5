"""The hovering problem as dm_control tasks: hover kinematics and hover rig.

An action is a new stroke, not a motor command: one step of these environments is a whole flight of
some cycles, prescribed or by the motors.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import ClassVar

import mujoco
import numpy as np
from dm_control.rl import control
from dm_env import specs
from numpy.typing import NDArray

from flaprig.aero.result import Result
from flaprig.rig import Rig
from flaprig.strokes.fourier import FourierStroke
from flaprig.tasks.actions import checked_actions
from flaprig.tasks.copies import Copied
from flaprig.tasks.hover_batch import HoverBatch, Step
from flaprig.tasks.hover_rig import HoverRigSettings, RigHover
from flaprig.tasks.hover_settings import COEFFICIENTS, HoverSettings
from flaprig.tasks.rig_physics import RigPhysics

Array = NDArray[np.float64]


class HoverPhysics(RigPhysics):
    """The rig where the last stroke left it, or in the middle of its prescribed stroke.

    Loads are means over the averaged cycles of the last stroke, torques the fluid's peaks; they are
    computed when they are asked for.
    """

    # the evaluator's flight and the coefficients of the last stroke
    batch: HoverBatch | None = None
    _flight: Result | None = None
    _kept: ClassVar[tuple[str, ...]] = (*RigPhysics._kept, "batch", "_flight")

    @classmethod
    def make(cls, settings: HoverSettings | HoverRigSettings) -> HoverPhysics:
        """Physics and episode of one hovering problem."""
        return cls.of_batch(HoverBatch(settings, 1))

    @classmethod
    def of_batch(cls, batch: HoverBatch) -> HoverPhysics:
        """Physics that shows the first episode of a batch."""
        physics = cls.of(_model(batch))
        physics.batch = batch
        return physics

    def step(self, nstep: int = 1) -> None:
        """The task has flown the stroke already: nothing is left to be stepped."""

    def show(self) -> None:
        """Stand as the present stroke does."""
        assert self.batch is not None
        self._flight = None
        hover = self.batch.hover
        state = hover.states.get(0) if isinstance(hover, RigHover) else None
        if state is None:
            motion = self.stroke.motion(0.25 * self.stroke.period)
            self.set_motion((motion.sweep, motion.pitch), (motion.sweep_rate, motion.pitch_rate))
            self.data.time = self.batch.elapsed[0] * hover.settings.cycles * self.stroke.period
        else:
            kind = mujoco.mjtState.mjSTATE_INTEGRATION
            mujoco.mj_setState(self.model.ptr, self.data.ptr, state, kind)
        self.forward()

    @property
    def stroke(self) -> FourierStroke:
        """The present stroke."""
        assert self.batch is not None
        return self.batch.settings.stroke(self.batch.coefficients[0])

    @property
    def flight(self) -> Result:
        """All histories of the present stroke's flight."""
        assert self.batch is not None
        if self._flight is None:
            self._flight = self.batch.hover.fly(self.batch.coefficients[0])
        return self._flight

    def lift(self) -> float:
        """Mean in [N]."""
        return float(self.flight.averaged(self.flight.lift).mean())

    def drag(self) -> float:
        """Mean in [N]."""
        return float(self.flight.averaged(self.flight.drag).mean())

    def power(self) -> float:
        """Mean, given to the fluid, in [W]."""
        return float(self.flight.averaged(self.flight.power).mean())

    def torques(self) -> Array:
        """Peak size of the fluid's about the sweep and the pitch axis in [N m]. Shape (2,)."""
        histories = (self.flight.sweep_torque, self.flight.pitch_torque)
        return np.array([np.abs(self.flight.averaged(torque)).max() for torque in histories])


def _model(batch: HoverBatch) -> mujoco.MjModel:
    if isinstance(batch.hover, RigHover):
        return batch.hover.model
    s = batch.settings
    return Rig(wing=s.wing, fluid=s.fluid, model=s.model, frequency=s.frequency).compile()


class HoverTask(Copied, control.Task):
    """Equations 8 to 13 as a task; settings are those of its physics.

    Args:
        random: seed, generator or None, for the starting strokes.
    """

    def __init__(self, random: int | np.random.Generator | None = None) -> None:
        self.random = np.random.default_rng(random)
        self._observation: Array = np.zeros(0)
        self.last: Step | None = None

    def initialize_episode(self, physics: HoverPhysics) -> None:
        """Start from the sinusoid, jittered."""
        assert physics.batch is not None
        self.last = None
        self._observation = physics.batch.reset([0], [self.random])[0]
        if isinstance(physics.batch.hover, RigHover):
            physics.batch.hover.states.clear()
        physics.show()

    def before_step(self, action: Array, physics: HoverPhysics) -> None:
        """Change the stroke and fly it.

        Raises:
            ValueError: an action of another shape.
        """
        assert physics.batch is not None
        checked_actions("HoverTask", action, (COEFFICIENTS,))
        self.last = physics.batch.step(np.asarray(action)[None])
        self._observation = self.last.observation[0]
        physics.show()

    def action_spec(self, physics: HoverPhysics) -> specs.BoundedArray:
        """Changes of the coefficients, in steps of step_size."""
        return specs.BoundedArray((COEFFICIENTS,), np.float64, -1.0, 1.0, name="change")

    def get_observation(self, physics: HoverPhysics) -> OrderedDict[str, Array]:
        """The normalised stroke. Shape (200,)."""
        return OrderedDict(stroke=self._observation.copy())

    def get_reward(self, physics: HoverPhysics) -> float:
        """Equation 12, or minus the penalty."""
        return float(self.last.reward[0]) if self.last else 0.0

    def get_termination(self, physics: HoverPhysics) -> float | None:
        """Discount 0 beyond the bounds and after a failure, 1 at the horizon."""
        if self.last is not None and self.last.terminated[0]:
            return 0.0
        return 1.0 if self.last is not None and self.last.truncated[0] else None
