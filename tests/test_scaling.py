"""How far a stroke scales: the edge where it is known, islands, never and always."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace

import numpy as np
import pytest

from flaprig import FourierStroke, QuasiSteady, Rig, SampledStroke, SunTangStroke, scaling
from flaprig.limits import Accelerations, rig_limits
from flaprig.motors import RIG_MOTORS
from flaprig.scaling import at_frequency, highest_frequency
from flaprig.strokes.stroke import PeriodicStroke

RIG = Rig.load().with_(model=QuasiSteady(steps_per_cycle=40))
SINUSOID = SunTangStroke(0.2, math.pi / 3.0, math.pi / 4.0)
# few cycles and long steps: the search is the matter here
QUICK = {"cycles": 2, "time_step": 0.02}


class Other(PeriodicStroke):
    """A stroke that is not one of ours."""

    frequency, sweep_amplitude, pitch_amplitude = 0.2, 1.0, 0.5

    def motion(self, time: object) -> object:
        return SINUSOID.motion(time)  # type: ignore[arg-type]

    def save(self, path: object) -> None:
        """Not needed."""


@pytest.mark.parametrize(
    "stroke",
    [
        SINUSOID,
        FourierStroke.normalized(0.21, [-1, 0.1], [0, 0.3], [0, 0.2], [1, 0], 1.0, 0.7),
        SampledStroke(
            tuple(np.arange(20) / 20 * 1.7),
            tuple(np.sin(2 * np.pi * np.arange(20) / 20)),
            tuple(np.cos(2 * np.pi * np.arange(20) / 20)),
        ),
        Other(),
    ],
    ids=lambda s: type(s).__name__,
)
def test_the_same_motion_faster(stroke: SunTangStroke) -> None:
    faster = at_frequency(stroke, 3.0 * stroke.frequency)
    assert faster.frequency == pytest.approx(3.0 * stroke.frequency)
    time = np.linspace(0.0, stroke.period, 37)
    before, after = stroke.motion(time), faster.motion(time / 3.0)
    np.testing.assert_allclose(after.sweep, before.sweep, atol=1e-7)
    np.testing.assert_allclose(after.pitch_rate, 3.0 * before.pitch_rate, atol=1e-6)


def test_edge_where_an_acceleration_ends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A (2 pi f)^2 = 4 rad/s2 at 0.3111 Hz; one count of forgiveness moves it by 2 %."""
    monkeypatch.setattr(scaling, "GIVE_UP", 1)
    limits = rig_limits(RIG_MOTORS).with_accelerations(Accelerations(4.0, 20.0))
    found = highest_frequency(RIG, SINUSOID, limits, **QUICK)
    exact = math.sqrt(4.0 / SINUSOID.sweep_amplitude) / (2.0 * math.pi)
    assert exact < found.highest < 1.03 * exact
    assert found.highest < found.above <= 1.01 * found.highest * (1.0 + 1e-9)
    assert "sweep_acceleration_rad_per_s2" in found.limited_by
    assert found.islands == ()
    # the scan was the screen's, the rest the rig's own
    assert [trial.screen for trial in found.trials] == sorted(
        (trial.screen for trial in found.trials), reverse=True
    )


def judged(feasible: object) -> object:
    """A check_feasibility that only looks at the frequency and the model."""

    def check(rig: Rig, stroke: SunTangStroke, **_: object) -> SimpleNamespace:
        good = feasible(rig, stroke.frequency)  # type: ignore[operator]
        return SimpleNamespace(feasible=good, broken=() if good else (SimpleNamespace(key="x"),))

    return check


def test_an_island_is_told_and_not_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    def feasible(_: Rig, f: float) -> bool:
        return f < 0.5 or 0.9 < f < 1.3

    monkeypatch.setattr(scaling, "check_feasibility", judged(feasible))
    found = highest_frequency(RIG, SINUSOID)
    assert found.highest == pytest.approx(0.5, rel=0.01) and found.highest < 0.5 <= found.above
    assert found.islands and all(0.9 < f < 1.3 for f in found.islands)


@pytest.mark.parametrize("edge", [0.05, 0.3, 0.9, 2.0])
@pytest.mark.parametrize("screen", [0.5, 1.0, 2.0])
def test_the_rigs_own_model_has_the_last_word(
    edge: float, screen: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Wherever the screen puts the edge."""

    def feasible(rig: Rig, f: float) -> bool:
        return f < (edge if rig is RIG else screen * edge)

    monkeypatch.setattr(scaling, "check_feasibility", judged(feasible))
    found = highest_frequency(RIG, SINUSOID)
    assert found.highest < edge <= found.above <= 1.0101 * found.highest
    assert found.limited_by == ("x",)


def test_never_and_always(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[float] = []
    monkeypatch.setattr(scaling, "check_feasibility", judged(lambda rig, f: False))
    never = highest_frequency(RIG, SINUSOID, progress=told.append)
    assert never.highest is None and never.above == pytest.approx(0.2 / 32.0)
    assert told == sorted(told) and told[-1] <= 1.0
    monkeypatch.setattr(scaling, "check_feasibility", judged(lambda rig, f: True))
    always = highest_frequency(RIG, SINUSOID)
    assert always.highest == pytest.approx(6.4) and always.above is None
    assert json.dumps(always.summary()) and json.dumps(never.summary())
