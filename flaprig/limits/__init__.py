"""What the servos can follow: limits, the nearest stroke within them, set points.

The set points come from Ruckig, which is imported when they are asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from flaprig.limits.accelerations import PAPER_KINEMATICS, SINUSOID, Accelerations
from flaprig.limits.limits import Bound, JointLimits, Limits
from flaprig.limits.peaks import JointPeaks, Violation, peaks, violations
from flaprig.limits.projection import JointProjection, Projection, project
from flaprig.limits.reference import Mode, State
from flaprig.limits.servo import rig_limits, servo_limits

if TYPE_CHECKING:
    from flaprig.limits.ruckig_filter import RuckigFilter
    from flaprig.limits.trajectory import Trajectory, filtered

__all__ = [
    "Accelerations",
    "Bound",
    "JointLimits",
    "JointPeaks",
    "JointProjection",
    "Limits",
    "Mode",
    "PAPER_KINEMATICS",
    "Projection",
    "RuckigFilter",
    "SINUSOID",
    "State",
    "Trajectory",
    "Violation",
    "filtered",
    "peaks",
    "project",
    "rig_limits",
    "servo_limits",
    "violations",
]

_LATE = {
    "RuckigFilter": "ruckig_filter",
    "Trajectory": "trajectory",
    "filtered": "trajectory",
}


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'flaprig.limits' has no attribute {name!r}")
    return getattr(import_module(f"flaprig.limits.{_LATE[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
