"""The hovering problem flown by the motors: Twin.run, for many strokes at once."""

from __future__ import annotations

from dataclasses import replace
from math import radians
from typing import Any

import numpy as np
import pytest

from flaprig import UVLM, QuasiSteady
from flaprig.limits import SINUSOID, rig_limits
from flaprig.servo_link import ServoLink
from flaprig.tasks import SINUSOID_COEFFICIENTS, HoverSettings
from flaprig.tasks.evaluators import evaluator
from flaprig.tasks.hover_rig import HoverRigSettings, RigHover
from flaprig.twin import Own

STEADY = HoverSettings(
    model=QuasiSteady(strips=4, steps_per_cycle=50), bounds=SINUSOID.times(1000.0)
)
COARSE = replace(STEADY, model=UVLM(chordwise=3, spanwise=5, steps_per_cycle=30))
ROWS = np.array(SINUSOID_COEFFICIENTS) + 0.03 * np.random.default_rng(3).normal(size=(3, 12))


def settings(problem: HoverSettings = STEADY, **changes: Any) -> HoverRigSettings:
    return HoverRigSettings(problem, **({"time_step": 0.02, "limits": None} | changes))


@pytest.mark.parametrize(
    "chosen",
    [settings(), settings(limits=Own.RIG), settings(COARSE), settings(feedforward=True)],
    ids=["bare", "limits", "uvlm", "feedforward"],
)
def test_it_is_the_twin(chosen: HoverRigSettings) -> None:
    """Coefficients of the twin's own run of the stroke, over the last cycle."""
    hover = RigHover(chosen)
    found = hover.evaluate(ROWS[:2]).coefficients
    for k in range(2):
        run = hover.fly(ROWS[k])
        np.testing.assert_allclose([found.cl[k], found.cd[k]], [run.cl, run.cd], rtol=1e-10)


@pytest.mark.parametrize("problem", [STEADY, COARSE], ids=["quasi_steady", "uvlm"])
def test_rows_do_not_see_each_other(problem: HoverSettings) -> None:
    together = RigHover(settings(problem)).evaluate(ROWS)
    hover = RigHover(settings(replace(problem, threads=1)))
    for k in range(len(ROWS)):
        alone = hover.evaluate(ROWS[k : k + 1])
        assert alone.reward[0] == together.reward[k]


def test_motors_cost_little_and_something() -> None:
    """Tracking is close: loads within 2 % of the prescribed ones, and not the same."""
    rig, prescribed = RigHover(settings()), evaluator(STEADY)
    assert rig.reference_ratio == pytest.approx(prescribed.reference_ratio, rel=0.02)
    assert abs(rig.reference_ratio / prescribed.reference_ratio - 1.0) > 1e-5


def test_drag_does_not_jump_while_reversals_move_over_samples() -> None:
    """L/D bends 200 times as much where the sign of the rate makes drag."""
    moved = np.array(SINUSOID_COEFFICIENTS) + np.linspace(0.0, 0.02, 21)[:, None] * np.eye(12)[3]
    found = RigHover(settings(time_step=0.01)).evaluate(moved).coefficients
    assert np.abs(np.diff(found.cl / found.cd, 2)).max() < 3e-5


def test_stroke_that_the_rig_refuses_fails_alone() -> None:
    """Sweep stops are at 90 degrees; the link's rounding does not matter to the others."""
    hover = RigHover(settings(link=ServoLink(counts=4096)))
    stop = float(hover.model.joint("sweep").range[1])
    hover.model.joint("sweep").range[:] = [-stop, radians(60.0) + 1e-6]
    found = hover.evaluate(np.array([SINUSOID_COEFFICIENTS] * 2))
    assert not found.failures
    hover.model.joint("sweep").range[:] = [-stop, radians(59.0)]
    found = hover.evaluate(np.array([SINUSOID_COEFFICIENTS] * 2))
    assert set(found.failures) == {0, 1} and "sweep" in found.failures[0]
    assert (found.reward == -2.0).all()


def test_sinusoid_that_cannot_be_flown_is_told_at_once() -> None:
    far = replace(STEADY, sweep_amplitude=radians(100.0))
    with pytest.raises(FloatingPointError, match="RigHover: the sinusoid fails: .*sweep"):
        RigHover(settings(far))


def test_a_warning_of_mujoco_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    """A set point that is no number makes MuJoCo give up in that row alone."""
    hover = RigHover(settings())
    clean, commands = hover.evaluate(ROWS), hover._commands

    def broken(shape: Any, k: int) -> Any:
        start, control = commands(shape, k)
        if k == 1:
            control[80:, 0] = np.nan
        return start, control

    monkeypatch.setattr(hover, "_commands", broken)
    found = hover.evaluate(ROWS)
    assert list(found.failures) == [1] and found.reward[1] == -2.0
    np.testing.assert_array_equal(found.reward[[0, 2]], clean.reward[[0, 2]])


@pytest.mark.parametrize(
    ("name", "value"),
    [("problem", None), ("time_step", 1.0), ("feedforward", 1), ("limits", 3.0), ("motors", 0)],
)
def test_bad_settings(name: str, value: Any) -> None:
    with pytest.raises(ValueError, match="must be"):
        replace(settings(), **{name: value})


def test_odd_number_of_steps_is_refused() -> None:
    with pytest.raises(ValueError, match="time_step must be one that divides the half stroke"):
        settings(time_step=5.0 / 251)


def test_explicit_limits_are_used() -> None:
    """Limits below the sinusoid's accelerations change what is flown."""
    hover = RigHover(settings())
    rig = hover.twin.rig
    limits = rig_limits(rig.motors, rig.wing, rig.fluid)
    slow = limits.with_accelerations(SINUSOID.times(0.9))
    assert RigHover(settings(limits=slow)).sinusoid.cl[0] != pytest.approx(
        hover.sinusoid.cl[0], rel=1e-3
    )
