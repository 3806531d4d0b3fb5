"""What the servos can follow: limits, the nearest stroke within them, set points, files of a rig.

The set points come from Ruckig, which is imported when they are asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from flaprig.limits.accelerations import PAPER_KINEMATICS, SINUSOID, Accelerations
from flaprig.limits.counts import XM430_RIG, JointCounts, PositionCounts
from flaprig.limits.limits import Bound, JointLimits, Limits
from flaprig.limits.log_file import RigLog, read_log
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
    "JointCounts",
    "JointLimits",
    "JointPeaks",
    "JointProjection",
    "Limits",
    "Mode",
    "PAPER_KINEMATICS",
    "PositionCounts",
    "Projection",
    "RigLog",
    "RuckigFilter",
    "SINUSOID",
    "State",
    "Trajectory",
    "Violation",
    "XM430_RIG",
    "filtered",
    "peaks",
    "project",
    "read_log",
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
