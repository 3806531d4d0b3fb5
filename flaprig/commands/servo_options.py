"""Options of how the servos are driven, shared by the commands that fly the rig."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from tyro.conf import arg

if TYPE_CHECKING:
    from flaprig.rig import Rig
    from flaprig.twin import Twin

_COUNTS = "(default: not rounded; a DYNAMIXEL X has 4096)"


@dataclass(frozen=True)
class ServoOptions:
    """How the servos are told the stroke.

    Attributes:
        raw: send the stroke as it is, without projecting it onto the servos' limits and without
            a start by Ruckig.
        no_feedforward: leave out the torque that quasi-steady air says the stroke needs.
        no_velocity: send angles only; the servo then brakes on its rate.
        update_interval: between messages to the servos [s]; 0: every step.
        delay: of a message [s].
        counts: of one turn, to which angles are rounded.
    """

    raw: bool = False
    no_feedforward: bool = False
    no_velocity: bool = False
    update_interval: float = 0.0
    delay: float = 0.0
    counts: Annotated[int | None, arg(metavar="INT", help_behavior_hint=_COUNTS)] = None

    def twin(self, rig: Rig, time_step: float) -> Twin:
        """The rig, driven so. ValueError for a value out of range."""
        # mujoco takes half a second to import: not for --help
        from flaprig.servo_link import ServoLink
        from flaprig.set_points import Own
        from flaprig.twin import Twin

        return Twin(
            rig,
            time_step=time_step,
            feedforward=not self.no_feedforward,
            limits=None if self.raw else Own.RIG,
            link=ServoLink(self.update_interval, self.delay, self.counts, not self.no_velocity),
        )
