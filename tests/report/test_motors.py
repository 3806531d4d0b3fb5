"""The picture of the servos."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
from PIL import Image

from flaprig.report import style
from flaprig.report.motors import _scale, draw_motors
from flaprig.strokes import SunTangStroke

ASKED = SunTangStroke(0.2, 1.0, 0.8)


def test_picture(tmp_path: Path) -> None:
    time = np.linspace(0.0, 10.0, 200)
    names = ("sweep", "pitch")
    wave = np.sin(time)
    arrays = {f"{n}{end}": wave for n in names for end in ("", "_command")}
    arrays |= {f"{n}_{end}": wave for n in names for end in ("motor_torque", "current")}
    draw_motors(tmp_path / "m.png", SimpleNamespace(time=time, **arrays), ASKED, "title")  # type: ignore[arg-type]
    assert np.asarray(Image.open(tmp_path / "m.png").convert("L")).std() > 10


def test_start_up_does_not_set_the_scale() -> None:
    cycles = np.linspace(0.0, 3.0, 301)
    torque = np.sin(cycles)
    torque[0] = 50.0
    with style.figure(3.0, 3.0) as drawing:
        axes = drawing.add_subplot()
        axes.plot(cycles, torque)
        _scale(axes, cycles)
        assert axes.get_ylim()[1] < 1.2
        assert axes.get_title(loc="right") == "start-up reaches 50"
