"""What is doubtful about the loads of a run, as sentences for whoever reads its numbers."""

from __future__ import annotations

from flaprig.strokes.stroke import Stroke

# size of a coefficient that no wing has: the sweep's speed is too small to divide by
MOST_COEFFICIENT = 20.0
# mean lift below minus this share of the mean drag's size points down
LEAST_LIFT = 0.02


def doubts_of_loads(stroke: Stroke, cl: float, cd: float) -> tuple[str, ...]:
    """Sentences on a stroke and its mean coefficients; none where nothing is odd.

    Args:
        stroke: that was asked for.
        cl: mean lift coefficient.
        cd: mean drag coefficient.
    """
    found = [*getattr(stroke, "notices", ())]
    if max(abs(cl), abs(cd)) > MOST_COEFFICIENT:
        found.append(
            f"C_L = {cl:.4g} and C_D = {cd:.4g} divide by the mean speed of the sweep, whose "
            f"amplitude is only {stroke.sweep_amplitude:.3g} rad at {stroke.frequency:.4g} Hz; "
            "read the forces instead"
        )
    elif cl < -LEAST_LIFT * abs(cd):
        found.append(
            f"the mean lift points down (C_L = {cl:.4g}): is the sign of the pitch the other one? "
            "Positive pitch leans the leading edge towards increasing sweep"
        )
    return tuple(found)
