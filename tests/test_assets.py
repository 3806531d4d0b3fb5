"""The learned strokes that travel with the package keep what the results page says of them."""

from __future__ import annotations

import math

import pytest

from flaprig import RIG_WING, QuasiSteady, SunTangStroke, simulate
from flaprig._paths import assets_dir
from flaprig.limits import PAPER_KINEMATICS, SINUSOID, peaks
from flaprig.strokes import load

SINE = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
# bounds that each was found within, and its quasi-steady gains in C_L and L/D today
STROKES = {
    "case_a": (SINUSOID.times(2.0), 0.4886, 0.2730),
    "case_b": (SINUSOID.times(2.0), 0.5064, 0.2713),
    "rig_bounds": (PAPER_KINEMATICS, 0.7366, 0.2730),
}


@pytest.mark.parametrize("name", STROKES)
def test_learned_strokes_gain_within_their_bounds(name: str) -> None:
    stroke = load(assets_dir() / "strokes" / f"{name}.json")
    bounds, lift, ratio = STROKES[name]
    assert stroke.sweep_amplitude == pytest.approx(SINE.sweep_amplitude, rel=1e-9)
    assert stroke.pitch_amplitude == pytest.approx(SINE.pitch_amplitude, rel=1e-9)
    found = peaks(stroke)
    for joint in ("sweep", "pitch"):
        assert found[joint].acceleration <= getattr(bounds, joint) * (1 + 1e-6)
    ours = simulate(RIG_WING, stroke, QuasiSteady(), cycles=1)
    base = simulate(RIG_WING, SINE, QuasiSteady(), cycles=1)
    gains = ours.cl / base.cl - 1, ours.lift_to_drag / base.lift_to_drag - 1
    assert gains == pytest.approx((lift, ratio), abs=1e-4)
