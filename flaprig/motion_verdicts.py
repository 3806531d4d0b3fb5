"""What a stroke's motion needs of the limits: angle, rate, acceleration and jerk of both joints.

Where a motion within the limits is nearer than the servo can tell, it is judged in the stroke's
place: piecewise strokes have accelerations that jump, no servo follows a jump, and none needs to.
Elsewhere the stroke asked for is judged, and the nearest one is told beside it.
"""

from __future__ import annotations

from flaprig.limits.limits import JOINTS, Bound, JointLimits, Limits
from flaprig.limits.peaks import JointPeaks, peaks
from flaprig.limits.projection import Projection
from flaprig.strokes.stroke import Stroke
from flaprig.verdict import Tolerances, Verdict, beside


def motion_verdicts(
    stroke: Stroke, projection: Projection, limits: Limits, tolerances: Tolerances
) -> list[Verdict]:
    """Verdicts on the motion of both joints.

    Args:
        stroke: the one asked for.
        projection: of the stroke onto the limits.
        limits: of the rig.
        tolerances: how near the projection must be to be judged in the stroke's place.
    """
    distances = {joint: getattr(projection, joint).distance_max for joint in JOINTS}
    near = {joint: distance <= tolerances.resolution for joint, distance in distances.items()}
    wanted = {} if all(near.values()) else peaks(stroke)
    nearest = peaks(projection.stroke)
    found = []
    for joint, distance in distances.items():
        allowed = getattr(limits, joint)
        verdicts = _joint_verdicts(joint, nearest[joint], allowed)
        if not near[joint]:
            asked = _joint_verdicts(joint, wanted[joint], allowed)
            verdicts = beside(asked, verdicts)
        found += verdicts
        args = ("nearest_motion", distance, tolerances.resolution, "rad")
        found.append(Verdict(joint, *args))
    return found


def _joint_verdicts(joint: str, need: JointPeaks, allowed: JointLimits) -> list[Verdict]:
    low, high = allowed.position
    middle = 0.5 * (low + high)
    ends = [
        Verdict(joint, Bound.POSITION, value, bound, Bound.POSITION.unit, zero=middle)
        for value, bound in zip(need.position, (low, high), strict=True)
    ]
    rest = [
        Verdict(joint, bound, getattr(need, bound), getattr(allowed, bound), bound.unit)
        for bound in list(Bound)[1:]
    ]
    return [min(ends, key=lambda end: end.margin or 0.0), *rest]
