"""Named bounds on the two accelerations, from the paper's kinematics.

The paper bounds the accelerations of its learned strokes and prints no numbers. Its own strokes
tell what its rig has done; learning is bounded by multiples of the sinusoid's.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians

from flaprig import _checks as check


@dataclass(frozen=True)
class Accelerations:
    """Bounds on the accelerations of both joints.

    Attributes:
        sweep: in [rad/s2].
        pitch: in [rad/s2].

    Raises:
        ValueError: a value that is not a positive finite number.
    """

    sweep: float
    pitch: float

    def __post_init__(self) -> None:
        for name in ("sweep", "pitch"):
            value = check.positive("Accelerations", name, getattr(self, name), "rad/s2")
            object.__setattr__(self, name, value)

    def times(self, sweep: float, pitch: float | None = None) -> Accelerations:
        """The bounds times a factor for each joint; one factor serves both.

        Raises:
            ValueError: a factor that is not a positive finite number.
        """
        owner = "Accelerations.times"
        sweep = check.positive(owner, "sweep", sweep)
        pitch = sweep if pitch is None else check.positive(owner, "pitch", pitch)
        return Accelerations(self.sweep * sweep, self.pitch * pitch)


# sinusoid of the paper: frequency [Hz] and half amplitudes [rad], section 2.2; the pitch amplitude
# is not printed, 45 deg is the one that gives the measured forces
_FREQUENCY, _SWEEP, _PITCH = 0.2, radians(60.0), radians(45.0)
# shortest reversals of the paper's nine kinematics [cycles]: section 2.2
_SHORTEST = 0.16

# peaks of the sinusoid, amplitude (2 pi f)^2: 1.654 and 1.240 rad/s2. A sinusoid reaches its bound
# at two instants a cycle and so is allowed by it
SINUSOID = Accelerations(
    sweep=_SWEEP * (2.0 * pi * _FREQUENCY) ** 2, pitch=_PITCH * (2.0 * pi * _FREQUENCY) ** 2
)

# peaks of the nine measured kinematics, reached by the reversals of 0.16 cycles: 3.72 and 12.1
# rad/s2. Sweep: plateau rate 2 phi0 f/(0.5 - D (1 - 2/pi)) times pi f/D; pitch: theta0 (pi f/D)^2.
# The rig can do at least these; the motions are those of flaprig.SunTangStroke
PAPER_KINEMATICS = Accelerations(
    sweep=2.0
    * _SWEEP
    * _FREQUENCY
    / (0.5 - _SHORTEST * (1.0 - 2.0 / pi))
    * (pi * _FREQUENCY / _SHORTEST),
    pitch=_PITCH * (pi * _FREQUENCY / _SHORTEST) ** 2,
)
