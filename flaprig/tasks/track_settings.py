"""Following a stroke against disturbances, as frozen settings."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi

from flaprig import _checks as check
from flaprig.aero.models import QuasiSteady
from flaprig.rig import RIG_FREQUENCY, Rig
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.stroke import Stroke

# the paper's sinusoid
SINUSOID_STROKE = FourierStroke(RIG_FREQUENCY, (-pi / 3,), (0.0,), (0.0,), (pi / 4,))
# blade elements, few and fast
QUICK = QuasiSteady(strips=8, steps_per_cycle=100)


@dataclass(frozen=True)
class TrackSettings:
    """The rig, the stroke that it is to follow, and what disturbs it.

    Attributes:
        rig: the rig; its frequency is replaced by the stroke's. Quasi-steady air by default, for
            speed.
        stroke: the reference.
        control_interval: between two actions in [s], a whole number of time steps.
        time_step: of MuJoCo in [s], 1e-5 to 0.02.
        cycles: length of an episode in cycles of the stroke; it is truncated then.
        angle_range: correction of a position set point by an action of 1 in [rad].
        torque_range: torque feedforward of an action of 1 in [N m].
        disturbance: standard deviation of the torques that push the sweep and the pitch joint in
            [N m].
        correlation_time: of the pushes in [s].
        random_phase: whether an episode begins anywhere in the cycle, or at time 0.
        close: size of an error that is as good as none in [rad].
        margin: size of an error at which a joint's reward is a tenth in [rad].
        lost: size of an error that ends the episode in [rad].

    Raises:
        ValueError: a setting of the wrong type or out of its range.
    """

    rig: Rig = field(default_factory=lambda: Rig(model=QUICK))
    stroke: Stroke = SINUSOID_STROKE
    control_interval: float = 0.02
    time_step: float = 0.004
    cycles: float = 2.0
    angle_range: float = 0.1
    torque_range: float = 1.0
    disturbance: tuple[float, float] = (0.3, 0.1)
    correlation_time: float = 0.2
    random_phase: bool = True
    close: float = 0.001
    margin: float = 0.02
    lost: float = 0.5

    def __post_init__(self) -> None:
        owner = "TrackSettings"
        if not isinstance(self.rig, Rig):
            raise check.fail(owner, "rig", "a Rig", self.rig)
        if not isinstance(self.stroke, Stroke):
            raise check.fail(owner, "stroke", "a stroke", self.stroke)
        if not isinstance(self.random_phase, bool):
            raise check.fail(owner, "random_phase", "True or False", self.random_phase)
        ranges = {
            "time_step": (1e-5, 0.02, "s"),
            "control_interval": (1e-5, 1.0, "s"),
            "cycles": (1e-6, 1e5, "cycles"),
            "correlation_time": (1e-4, 1e4, "s"),
            "angle_range": (0.0, pi, "rad"),
            "torque_range": (0.0, 1e3, "N m"),
            "close": (0.0, pi, "rad"),
            "margin": (1e-6, pi, "rad"),
            "lost": (1e-3, pi, "rad"),
        }
        for name, (least, most, unit) in ranges.items():
            value = check.in_range(owner, name, getattr(self, name), least, most, unit)
            object.__setattr__(self, name, value)
        pushes = check.array(owner, "disturbance", self.disturbance, "N m", length=2, most=1e3)
        if (pushes < 0.0).any():
            raise check.fail(owner, "disturbance", "two numbers of at least 0", self.disturbance)
        object.__setattr__(self, "disturbance", tuple(pushes.tolist()))
        steps = self.control_interval / self.time_step
        if steps < 0.5 or abs(steps - round(steps)) > 1e-6:
            allowed = f"a whole number of time steps of {self.time_step:g} s"
            raise check.fail(owner, "control_interval", allowed, self.control_interval)

    @property
    def substeps(self) -> int:
        """Time steps between two actions."""
        return round(self.control_interval / self.time_step)

    @property
    def horizon(self) -> int:
        """Actions in an episode."""
        return max(1, round(self.cycles / (self.stroke.frequency * self.control_interval)))
