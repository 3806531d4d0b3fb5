"""The torque-speed picture: the folding, what it says, and a picture that is not empty."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from flaprig import QuasiSteady, Rig, SunTangStroke, check_feasibility
from flaprig.motors import XM430_W350
from flaprig.report import style
from flaprig.report.torque_speed import _is_small, _scale, _shortened, draw_torque_speed, folded
from flaprig.servo_verdicts import Work


def test_folding_keeps_the_power() -> None:
    """Speed without sign times torque along the motion is the power; breaks where it turns."""
    phase = 2.0 * np.pi * (np.arange(100) + 0.5) / 100
    torque, speed = np.cos(phase - 0.3), np.sin(phase)
    work = Work(torque, torque, speed, np.zeros(100))
    sizes, along = folded(work)
    kept = np.isfinite(sizes)
    np.testing.assert_allclose((sizes * along)[kept], work.power)
    assert (sizes[kept] >= 0.0).all()
    # one turn inside the cycle, the other where it closes
    assert np.isnan(sizes).sum() == np.isnan(along).sum() == 1


def test_a_large_loop_is_not_drawn_twice() -> None:
    with style.figure(3.0, 3.0) as drawing:
        axes = drawing.add_subplot()
        for size, small in ((0.1, True), (2.0, False)):
            torque = size * np.array([-1.0, 1.0])
            _scale(axes, XM430_W350, np.array([0.0, 1.0]), torque)
            assert _is_small(axes, torque) is small
        _scale(axes, XM430_W350, np.array([0.0, 9.0]), np.array([-3.0, 8.0]))
        assert axes.get_xlim()[1] > 9.0 and axes.get_ylim()[1] > 8.0 > -3.0 > axes.get_ylim()[0]


@pytest.mark.parametrize("frequency", [0.2, 0.7])
def test_picture(frequency: float, tmp_path: Path) -> None:
    stroke = SunTangStroke(frequency, math.pi / 3, math.pi / 4)
    report = check_feasibility(Rig.load().with_(model=QuasiSteady()), stroke, time_step=0.01)
    draw_torque_speed(tmp_path / "t.png", report, "title")
    image = np.asarray(Image.open(tmp_path / "t.png").convert("RGB")).astype(int)
    assert image.std() > 20
    for colour in (style.VERMILION, style.BLUE):
        wanted = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)])
        assert (np.abs(image - wanted).sum(axis=2) < 10).sum() > 200


def test_long_lists_are_shortened() -> None:
    assert _shortened("velocity") == "velocity"
    names = "velocity, acceleration, jerk"
    assert _shortened(f"{names}, position") == f"{names}, ..."
