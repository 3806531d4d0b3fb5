"""From settings to what flies their strokes: prescribed motion, or the rig with its motors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flaprig.tasks.hover import Evaluator, Hover
from flaprig.tasks.hover_settings import HoverSettings

if TYPE_CHECKING:
    from flaprig.tasks.hover_rig import HoverRigSettings


def evaluator(settings: HoverSettings | HoverRigSettings) -> Evaluator:
    """The evaluator that goes with the settings."""
    if isinstance(settings, HoverSettings):
        return Hover(settings)
    # MuJoCo is imported for the rig only
    from flaprig.tasks.hover_rig import RigHover

    return RigHover(settings)
