"""The smallest servo of the catalogue for a stroke."""

from __future__ import annotations

import json
import math

from flaprig import QuasiSteady, Rig, SunTangStroke
from flaprig.catalogue import CATALOGUE
from flaprig.limits import Accelerations, rig_limits
from flaprig.motors import RIG_MOTORS
from flaprig.servo_choice import smallest_servo

RIG = Rig.load().with_(model=QuasiSteady(steps_per_cycle=40))
SINUSOID = SunTangStroke(0.2, math.pi / 3.0, math.pi / 4.0)
# few cycles and long steps: the search is the matter here
QUICK = {"cycles": 2, "time_step": 0.02}


def test_smallest_servos_of_the_sinusoid() -> None:
    """18 g hold both joints if they are told the torque; if not, the sweep takes the next one."""
    assert smallest_servo(RIG, SINUSOID, **QUICK).both == "XL330-M288"
    found = smallest_servo(RIG, SINUSOID, feedforward=False, **QUICK)
    assert (found.pitch, found.sweep, found.both) == ("XL330-M288", "XL430-W250", "XL430-W250")
    assert found.pair is True
    assert [trial.name for trial in found.trials] == list(CATALOGUE)
    assert all(trial.report.feasible for trial in found.trials[1:])
    assert json.dumps(found.summary()["servos"]["XL330-M288"]["broken"])


def test_limits_go_with_the_servo() -> None:
    """With bounds that no servo changes, none of them holds the stroke."""
    tight = rig_limits(RIG_MOTORS).with_accelerations(Accelerations(1.0, 1.0))
    found = smallest_servo(RIG, SINUSOID, lambda motors: tight, **QUICK)
    assert (found.both, found.sweep, found.pitch, found.pair) == (None, None, None, None)
