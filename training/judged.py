"""The verdict on strokes: the vortex lattice at full resolution, means over cycles 3 to 5."""

from __future__ import annotations

from collections.abc import Sequence

from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM
from flaprig.strokes import FourierStroke
from flaprig.tasks.hover_settings import SINUSOID_COEFFICIENTS, HoverSettings
from flaprig.wing import RIG_WING


def gains_by_lattice(strokes: Sequence[FourierStroke]) -> list[tuple[float, float]]:
    """Gains of mean C_L and of L/D over the sinusoid in [%], one pair a stroke."""
    sinusoid = HoverSettings().stroke(SINUSOID_COEFFICIENTS)
    first, *found = simulate_batch(RIG_WING, [sinusoid, *strokes], UVLM())
    return [
        (
            100.0 * (result.cl / first.cl - 1.0),
            100.0 * (result.lift_to_drag / first.lift_to_drag - 1.0),
        )
        for result in found
    ]
