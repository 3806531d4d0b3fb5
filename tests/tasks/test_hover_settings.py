"""What the settings of the hovering problem accept, and what follows from them."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, replace
from typing import Any

import numpy as np
import pytest

from flaprig import UVLM, QuasiSteady
from flaprig.aero.simulate import reference_force
from flaprig.tasks import SINUSOID_COEFFICIENTS, HoverReward, HoverSettings

BAD: list[tuple[str, Any]] = [
    ("model", "uvlm"),
    ("model", UVLM(steps_per_cycle=25)),
    ("wing", 1.0),
    ("fluid", None),
    ("bounds", (1.0, 2.0)),
    ("reward", {}),
    ("frequency", 0.0),
    ("frequency", float("nan")),
    ("sweep_amplitude", 60.0),
    ("pitch_amplitude", 0.0),
    ("cycles", 0),
    ("cycles", 1.5),
    ("skipped_cycles", 2),
    ("skipped_cycles", -1),
    ("step_size", 0.0),
    ("step_size", 0.6),
    ("horizon", 0),
    ("jitter", -0.1),
    ("jitter", float("inf")),
    ("threads", 0),
]


@pytest.mark.parametrize(("name", "value"), BAD)
def test_bad_settings_are_one_sentence(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"HoverSettings: {name}.* must be .*, got "):
        replace(HoverSettings(), **{name: value})


@pytest.mark.parametrize("name", ["lift", "ratio", "side", "asymmetry", "penalty"])
@pytest.mark.parametrize("value", [-1.0, float("nan"), "2"])
def test_bad_weights(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match=f"HoverReward: {name} must be"):
        replace(HoverReward(), **{name: value})


def test_weights_are_the_papers() -> None:
    """Section 3.1 prints r1 to r5."""
    r = HoverReward()
    assert (r.lift, r.ratio, r.side, r.asymmetry, r.penalty) == (0.1, 12.0, 10.0, 2.5, 2.0)


def test_settings_are_frozen() -> None:
    with pytest.raises(FrozenInstanceError):
        HoverSettings().cycles = 3  # type: ignore[misc]


def test_reference_force_is_that_of_simulate() -> None:
    s = HoverSettings()
    expected = reference_force(s.wing, s.stroke(SINUSOID_COEFFICIENTS), s.fluid)
    assert s.reference_force == pytest.approx(expected, rel=1e-14)


def test_stroke_of_the_sinusoid() -> None:
    s = replace(HoverSettings(), model=QuasiSteady())
    stroke = s.stroke(SINUSOID_COEFFICIENTS)
    motion = stroke.motion(np.array([0.0, 1.25, 2.5]))
    np.testing.assert_allclose(motion.sweep, s.sweep_amplitude * np.array([-1, 0, 1]), atol=1e-14)
    np.testing.assert_allclose(motion.pitch, s.pitch_amplitude * np.array([0, 1, 0]), atol=1e-14)


@pytest.mark.parametrize("bad", [[1.0] * 11, [0.0] * 12, [float("nan")] * 12, "twelve"])
def test_bad_coefficients(bad: Any) -> None:
    with pytest.raises(ValueError, match="must be"):
        HoverSettings().stroke(bad)
