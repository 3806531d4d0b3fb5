"""Every case that takes seconds: within its tolerances, and today's numbers."""

import dataclasses

import numpy as np
import pytest

from flaprig.validation.outcome import Verdict
from flaprig.validation.suite import CASES, case_named

# not here: those that take a minute, and the peer, which has a file of its own
SLOW = {"measured", "leave-one-out", "convergence", "paper", "peer"}
FAST = [name for name in CASES if name not in SLOW]


@pytest.mark.parametrize("name", FAST)
def test_within_tolerances(name):
    outcome = case_named(name)().run()
    assert not outcome.missed
    # a case without a demand would hold for nothing
    assert any(row.verdict is Verdict.WITHIN for row in outcome.rows)


@pytest.mark.parametrize("aspect_ratio", [4.0, 12.0])
def test_sudden_acceleration(aspect_ratio):
    outcome = case_named("katz-plotkin")(aspect_ratio=aspect_ratio).run()
    # the default shows every wing that has a reference
    assert len(outcome.rows) == (18 if aspect_ratio == 4.0 else 9) and not outcome.missed
    assert all(row.tolerance == 1.0 for row in outcome.rows)
    lift, passed = outcome.data["cl"], outcome.data["ut_over_c"]
    assert len(lift) == len(passed) == len(outcome.data["cd"]) == 160
    expected = {4.0: 0.271048, 12.0: 0.319473}[aspect_ratio]
    assert np.interp(0.25, passed, lift) == pytest.approx(expected, rel=1e-4)


def test_other_settings_have_no_reference():
    outcome = case_named("katz-plotkin")(aspect_ratio=6.0, distance=2.0).run()
    assert all(row.reference is None and row.verdict is Verdict.TOLD for row in outcome.rows)
    assert case_named("katz-plotkin")(chordwise=5, distance=1.0).run().rows[0].reference is None


def test_accurate_mode_against_the_papers():
    accurate, paper = (case_named("wagner")(mode=m).run().rows for m in ("accurate", "paper"))
    # Garrick's exact values follow Jones's
    assert abs(accurate[5].error) < 0.9 and paper[5].error > 8.0
    errors = {
        m: [abs(r.error) for r in case_named("theodorsen")(mode=m).run().rows[::2]]
        for m in ("accurate", "paper")
    }
    assert max(errors["accurate"][:2]) < 0.4
    assert all(a < p for a, p in zip(errors["accurate"], errors["paper"], strict=True))


@pytest.mark.parametrize("chordwise", [8, 16, 32])
def test_slow_convergence_of_the_third_rule_is_cured(chordwise):
    """With the 1/3 rule the error falls with the square root of the panels: 20, 11, 7 %."""

    def error(mode):
        return case_named("wagner")(chordwise=chordwise, mode=mode).run().rows[5].error

    assert 0.0 < error("accurate") < error("paper") / 10.0


def test_a_delta_wing_needs_the_length_of_its_edge():
    rows = {row.quantity: row for row in case_named("delta-wing")().run().rows}
    assert rows["all, rms error [%]"].value == pytest.approx(5.42, abs=0.02)
    # all of Polhamus's points are there
    assert sum("C_L" in name for name in rows) == 14


@pytest.mark.parametrize(
    ("name", "field", "value"),
    [
        ("katz-plotkin", "aspect_ratio", 0.0),
        ("katz-plotkin", "step", -1.0),
        ("added-mass", "aspect_ratio", -1.0),
        ("lift-slope", "aspect_ratio", float("nan")),
        ("wagner", "step", 0.0),
        ("wagner", "chordwise", 0),
        ("theodorsen", "chordwise", 0),
        ("suction", "panels", 0),
        ("theodorsen", "frequencies", (0.0,)),
        ("delta-wing", "aspect_ratios", (3.0,)),
        ("impulse", "steps_per_cycle", 2),
        ("kelvin", "cycles", 0.0),
        ("quasi-steady", "pitch_axis", 2.0),
        ("energy", "cycles", 0),
        ("plugin", "substeps", 0),
        ("paper", "cycles", 0),
        ("convergence", "cycles", 1),
        ("leave-one-out", "onset", 0.0),
        ("measured", "delay", 2.0),
    ],
)
def test_bad_parameters_are_refused_by_name(name, field, value):
    with pytest.raises(ValueError, match=f"{name}: {field} must be"):
        case_named(name)(**{field: value}).run()


def test_every_case_is_complete():
    for name, kind in CASES.items():
        assert kind.name == name and kind.claim and kind.__doc__
        assert dataclasses.is_dataclass(kind) and kind.__dataclass_params__.frozen
    with pytest.raises(ValueError, match="CASE must be one of added-mass, "):
        case_named("nothing")
