"""What the servos do on a stroke: in the twin's run, and as the stroke is asked for."""

from __future__ import annotations

import numpy as np

from flaprig.aero.result import Result
from flaprig.as_asked import asked_torques
from flaprig.rig import Axis, Rig
from flaprig.servo_verdicts import Work
from flaprig.strokes.stroke import Stroke
from flaprig.twin_run import TwinRun


def servo_work(run: TwinRun, stroke: Stroke, axis: Axis) -> Work:
    """What one servo did in the averaged cycles; the error is against the stroke asked for."""
    motors, histories, part = run.motors, run.result.histories, run.result.averaged
    speed = part(getattr(histories, f"{axis}_rate"))
    asked = getattr(stroke.motion(part(histories.time)), axis)
    return Work(
        torque=part(getattr(motors, f"{axis}_motor_torque")),
        demand=part(getattr(motors, f"{axis}_demand")),
        # mean of each step; the last one of a cycle leads into the first again
        speed=0.5 * (speed + np.roll(speed, -1)),
        error=part(getattr(motors, axis)) - asked,
    )


def asked_work(rig: Rig, stroke: Stroke, prescribed: Result, run: TwinRun) -> dict[str, Work]:
    """What both servos would do on the stroke itself; the errors are the twin's own."""
    torque = asked_torques(rig, stroke, prescribed)
    motion = stroke.motion(prescribed.averaged(prescribed.time))
    return {
        axis.value: Work(
            torque=torque[:, i],
            demand=torque[:, i],
            speed=getattr(motion, f"{axis}_rate"),
            error=servo_work(run, stroke, axis).error,
        )
        for i, axis in enumerate(Axis)
    }
