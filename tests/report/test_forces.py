"""Cycles in a picture, and the picture itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from flaprig import RIG_WING, QuasiSteady, SunTangStroke, simulate
from flaprig.report.forces import Curve, cycles_of, draw_forces


def test_cycles_are_closed_and_averaged_ones_only() -> None:
    stroke = SunTangStroke(0.2, 1.0, 0.7)
    result = simulate(RIG_WING, stroke, QuasiSteady(steps_per_cycle=20), cycles=5)
    phase, rows = cycles_of(result, np.arange(100.0))
    assert phase[0] == 0.0 and phase[-1] == 1.0 and rows.shape == (3, 21)
    np.testing.assert_array_equal(rows[0], np.arange(40.0, 61.0))
    # nothing follows the last cycle: it is closed with its own begin
    assert rows[-1, -1] == rows[-1, 0] == 80.0


def test_picture_has_both_curves(tmp_path: Path) -> None:
    stroke = SunTangStroke(0.2, 1.0, 0.7)
    model = QuasiSteady(steps_per_cycle=20)
    result = simulate(RIG_WING, stroke, model, cycles=1)
    curves = [Curve("a", result, "#D55E00"), Curve("b", result, "#0072B2", "--")]
    draw_forces(tmp_path / "forces.png", curves, "title")
    pixels = np.asarray(Image.open(tmp_path / "forces.png").convert("RGB")).reshape(-1, 3)
    for colour in ((213, 94, 0), (0, 114, 178)):
        assert np.any(np.all(pixels == colour, axis=1))
