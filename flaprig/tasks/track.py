"""Following a stroke with the rig's servos while something pushes the joints: a dm_control task.

The servos get the reference's angle and rate in the middle of the interval to come; an action
corrects the angles and adds torques. An action of zeros is the servos' own tracking.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

import mujoco
import numpy as np
from dm_control.rl import control
from dm_control.utils import rewards
from dm_env import specs
from numpy.typing import NDArray

from flaprig.rig import Rig
from flaprig.set_points import check_stops
from flaprig.strokes.stroke import Motion
from flaprig.tasks.actions import ACTION_FAILED, checked_actions
from flaprig.tasks.copies import Copied
from flaprig.tasks.rig_physics import RigPhysics
from flaprig.tasks.track_settings import TrackSettings

Array = NDArray[np.float64]

# corrections of sweep and pitch, then torques of sweep and pitch
ACTIONS = 4
# instants of the reference in the observation: now and after 1 to 3 intervals
PREVIEW = 4


def track_physics(settings: TrackSettings) -> RigPhysics:
    """The rig with the wake's clock and the time step of the task.

    Raises:
        ValueError: the stroke leaves the joints' stops.
    """
    rig: Rig = settings.rig.running(settings.stroke)
    model = rig.compile()
    model.opt.timestep = settings.time_step
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    check_stops(model, settings.stroke.sample(400))
    return RigPhysics.of(model)


class Track(Copied, control.Task):
    """Keep both joints on the stroke.

    Args:
        settings: the problem.
        random: seed, generator or None, for the starting phase and the pushes.
    """

    def __init__(
        self,
        settings: TrackSettings | None = None,
        random: int | np.random.Generator | None = None,
    ) -> None:
        self.settings = settings or TrackSettings()
        self.random = np.random.default_rng(random)
        self.elapsed = 0
        self._start = 0.0
        self._push: Array = np.zeros(2)

    def initialize_episode(self, physics: RigPhysics) -> None:
        """On the stroke, moving with it, in still fluid."""
        phase = self.random.random() if self.settings.random_phase else 0.0
        self._start = phase * self.settings.stroke.period
        self.elapsed = 0
        self._push = self._noise()
        now = self.reference(0.0)
        physics.set_motion(_angles(now), _rates(now))
        physics.data.ctrl[physics.controls.position] = _angles(now)

    def before_step(self, action: Array, physics: RigPhysics) -> None:
        """Tell the servos, and push; an action that is not finite ends the episode.

        Raises:
            ValueError: an action of another shape.
        """
        s, where = self.settings, physics.controls
        action, broken = checked_actions("Track", action, (ACTIONS,))
        if broken:
            physics.failure = ACTION_FAILED
        coming = self.reference(0.5)
        physics.data.ctrl[where.position] = _angles(coming) + s.angle_range * action[:2]
        physics.data.ctrl[where.velocity] = _rates(coming)
        physics.data.ctrl[where.torque] = s.torque_range * action[2:]
        physics.push(self._push)
        kept = np.exp(-s.control_interval / s.correlation_time)
        self._push = kept * self._push + np.sqrt(1.0 - kept**2) * self._noise()

    def after_step(self, physics: RigPhysics) -> None:
        """Count."""
        self.elapsed += 1

    def reference(self, ahead: float | Array) -> Motion:
        """The stroke some intervals ahead of now."""
        count = self.elapsed + np.asarray(ahead)
        return self.settings.stroke.motion(self._start + count * self.settings.control_interval)

    def error(self, physics: RigPhysics) -> Array:
        """Angles reached minus those of the stroke in [rad]. Shape (2,)."""
        return physics.angles() - _angles(self.reference(0.0))

    def action_spec(self, physics: RigPhysics) -> specs.BoundedArray:
        """Corrections of both angles, then torques of both servos, over their ranges."""
        return specs.BoundedArray((ACTIONS,), np.float64, -1.0, 1.0, name="correction")

    def get_observation(self, physics: RigPhysics) -> OrderedDict[str, Array]:
        """Errors in ten milliradians, angles, rates, the reference to come, torques, loads."""
        ahead = self.reference(np.arange(float(PREVIEW)))
        parts = OrderedDict(
            error=self.error(physics) / 0.01,
            angles=physics.angles(),
            rates=physics.rates(),
            reference_angles=_angles(ahead).T.ravel(),
            reference_rates=_rates(ahead).T.ravel(),
            torques=physics.torques(),
            loads=np.array([physics.lift(), physics.drag(), physics.power()]),
        )
        # after a failure MuJoCo may have left numbers that are none
        return OrderedDict((name, np.nan_to_num(part)) for name, part in parts.items())

    def get_reward(self, physics: RigPhysics) -> float:
        """From 0 to 1, the product of both joints'; 0 after a failure."""
        if physics.failure is not None:
            return 0.0
        size = np.abs(self.error(physics))
        near = (0.0, self.settings.close)
        each: Any = rewards.tolerance(size, bounds=near, margin=self.settings.margin)
        return float(np.prod(each))

    def lost(self, physics: RigPhysics) -> bool:
        """Whether MuJoCo gave up, the action was not finite or the stroke is out of reach."""
        if physics.failure is not None:
            return True
        return not bool((np.abs(self.error(physics)) < self.settings.lost).all())

    def get_termination(self, physics: RigPhysics) -> float | None:
        """Discount 0 when the stroke is lost, 1 at the end of the last cycle."""
        if self.lost(physics):
            return 0.0
        return 1.0 if self.elapsed >= self.settings.horizon else None

    def _noise(self) -> Array:
        return np.array(self.settings.disturbance) * self.random.standard_normal(2)


def _angles(motion: Motion) -> Array:
    return np.array([motion.sweep, motion.pitch])


def _rates(motion: Motion) -> Array:
    return np.array([motion.sweep_rate, motion.pitch_rate])
