"""The hovering problem of the paper's section 3.1 as frozen settings.

The reading of equation 12, and what the paper leaves open, is in docs/learning.md.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from math import pi, radians

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import WATER, Fluid
from flaprig.limits.accelerations import SINUSOID, Accelerations
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.stroke import MOST_FREQUENCY
from flaprig.wing import RIG_WING, Wing

Array = NDArray[np.float64]

# harmonics of sweep and of pitch: equations 8 and 9
HARMONICS = 3
# coefficients of one stroke: a_phi 1-3, b_phi 1-3, a_theta 1-3, b_theta 1-3
COEFFICIENTS = 4 * HARMONICS
# the sinusoid, where an episode starts: -cos sweep, sin pitch
SINUSOID_COEFFICIENTS = (-1.0, *(0.0,) * 8, 1.0, 0.0, 0.0)
# samples of each angle in the state: paper, section 3.1
SAMPLES = 100


@dataclass(frozen=True)
class HoverReward:
    """Weights of equations 12 and 13.

    Attributes:
        lift: r1, of the mean lift coefficient.
        ratio: r2, of mean C_L over mean C_D minus that of the sinusoid.
        side: r3, against the size of the mean force coefficient along the stroke plane.
        asymmetry: r4, against the difference in mean lift of the two half strokes.
        penalty: r5, what a stroke beyond the bounds costs.

    Raises:
        ValueError: a weight that is not a finite number of at least 0.
    """

    lift: float = 0.1
    ratio: float = 12.0
    side: float = 10.0
    asymmetry: float = 2.5
    penalty: float = 2.0

    def __post_init__(self) -> None:
        for name in ("lift", "ratio", "side", "asymmetry", "penalty"):
            value = check.in_range("HoverReward", name, getattr(self, name), 0.0, 1e6)
            object.__setattr__(self, name, value)


@dataclass(frozen=True)
class HoverSettings:
    """The wing, the air, the bounds, the reward and the episode.

    Attributes:
        model: the air, UVLM or QuasiSteady.
        wing: the wing.
        fluid: the fluid.
        frequency: strokes per second in [Hz].
        sweep_amplitude: half of the peak-to-peak sweep in [rad].
        pitch_amplitude: half of the peak-to-peak pitch in [rad].
        cycles: simulated for one stroke with UVLM, 1 to 100. The quasi-steady air has no memory,
            one cycle is all there is.
        skipped_cycles: first cycles that the means leave out, fewer than cycles.
        bounds: on the accelerations, equation 13.
        reward: weights of equations 12 and 13.
        step_size: change of a coefficient by an action of 1; the largest of an angle's six
            coefficients is 1. From 1e-6 to 0.5.
        horizon: actions in an episode, which is truncated then.
        jitter: standard deviation of the coefficients at an episode's start, about the sinusoid.
        threads: strokes simulated at a time, one for each core when None; changes no result.

    Raises:
        ValueError: a setting of the wrong type or out of its range.
    """

    model: UVLM | QuasiSteady = QuasiSteady(strips=8, steps_per_cycle=SAMPLES)
    wing: Wing = RIG_WING
    fluid: Fluid = WATER
    frequency: float = 0.2
    sweep_amplitude: float = radians(60.0)
    pitch_amplitude: float = radians(45.0)
    cycles: int = 2
    skipped_cycles: int = 1
    bounds: Accelerations = SINUSOID.times(2.0)
    reward: HoverReward = HoverReward()
    step_size: float = 0.02
    horizon: int = 50
    jitter: float = 0.0
    threads: int | None = None

    def __post_init__(self) -> None:
        owner = "HoverSettings"
        kinds = {"wing": Wing, "fluid": Fluid, "bounds": Accelerations, "reward": HoverReward}
        for name, kind in kinds.items():
            if not isinstance(getattr(self, name), kind):
                raise check.fail(owner, name, f"a {kind.__name__}", getattr(self, name))
        self._check_model()
        fix = object.__setattr__
        frequency = check.positive(owner, "frequency", self.frequency, "Hz", MOST_FREQUENCY)
        fix(self, "frequency", frequency)
        for name in ("sweep_amplitude", "pitch_amplitude"):
            value = check.in_range(owner, name, getattr(self, name), 1e-6, pi, "rad")
            fix(self, name, value)
        for name, least, most in (("step_size", 1e-6, 0.5), ("jitter", 0.0, 0.2)):
            fix(self, name, check.in_range(owner, name, getattr(self, name), least, most))
        if self.threads is not None:
            check.whole(owner, "threads", self.threads, 1, 1024)
        for name, most in (("cycles", 100), ("horizon", 1_000_000)):
            fix(self, name, check.whole(owner, name, getattr(self, name), 1, most))
        skipped = check.whole(owner, "skipped_cycles", self.skipped_cycles, 0, self.cycles - 1)
        fix(self, "skipped_cycles", skipped)

    def _check_model(self) -> None:
        if not isinstance(self.model, UVLM | QuasiSteady):
            raise check.fail("HoverSettings", "model", "a UVLM or a QuasiSteady", self.model)
        if self.model.steps_per_cycle % 2:
            allowed = "even: lift of the two half strokes is compared"
            value = self.model.steps_per_cycle
            raise check.fail("HoverSettings", "model.steps_per_cycle", allowed, value)

    @property
    def workers(self) -> int:
        """Strokes simulated at a time."""
        return self.threads or os.cpu_count() or 1

    @property
    def reference_force(self) -> float:
        """0.5 rho U^2 S in [N], U the mean speed at R2: that of every stroke of this amplitude."""
        radius = self.wing.radius_of_second_moment
        speed = 4.0 * self.frequency * self.sweep_amplitude * radius
        return 0.5 * self.fluid.density * speed**2 * self.wing.area

    def stroke(self, coefficients: ArrayLike) -> FourierStroke:
        """The stroke of twelve coefficients, equations 8 to 11.

        Raises:
            ValueError: not twelve finite numbers, or an angle's six all zero.
        """
        owner = "HoverSettings.stroke"
        values = check.array(owner, "coefficients", coefficients, length=COEFFICIENTS)
        a_sweep, b_sweep, a_pitch, b_pitch = values.reshape(4, HARMONICS)
        return FourierStroke.normalized(
            frequency=self.frequency,
            a_sweep=a_sweep,
            b_sweep=b_sweep,
            a_pitch=a_pitch,
            b_pitch=b_pitch,
            sweep_amplitude=self.sweep_amplitude,
            pitch_amplitude=self.pitch_amplitude,
        )
