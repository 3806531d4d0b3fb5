"""One judgement: margins, what holds, and names with units."""

from __future__ import annotations

import math
from dataclasses import fields

import pytest

from flaprig.verdict import Tolerances, Verdict, narrowest


def test_margin_is_the_share_of_the_bound_that_is_left() -> None:
    assert Verdict("sweep", "peak_torque", 1.0, 4.0, "N m").margin == 0.75
    assert Verdict("sweep", "peak_torque", 5.0, 4.0, "N m").margin == -0.25
    # below zero: the bound has the value's sign
    assert Verdict("", "cl_change", -0.01, -0.05, "").margin == pytest.approx(0.8)


def test_margin_counts_from_where_nothing_is_used() -> None:
    warm = Verdict("pitch", "winding_temperature", 52.5, 80.0, "degC", zero=25.0)
    assert warm.margin == pytest.approx(0.5)
    low = Verdict("pitch", "position", -0.9, -1.0, "rad", zero=-0.5)
    assert low.margin == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("value", "bound", "holds"),
    [
        (4.0, 4.0, True),
        (4.0 * (1.0 + 1e-12), 4.0, True),
        (4.0 * (1.0 + 1e-6), 4.0, False),
        (math.inf, 4.0, False),
        (math.nan, 4.0, False),
        (9.9, None, True),
        (0.1, 0.0, False),
        (0.0, 0.0, True),
    ],
)
def test_what_holds(value: float, bound: float | None, holds: bool) -> None:
    assert Verdict("sweep", "rms_torque", value, bound, "N m").holds is holds


def test_names() -> None:
    verdict = Verdict("sweep", "jerk", 1.0, 2.0, "rad/s3")
    assert (verdict.key, verdict.words) == ("sweep_jerk_rad_per_s3", "sweep jerk")
    assert Verdict("", "cl_change", 0.0, 0.1, "").key == "cl_change"
    assert verdict.summary() == {"value": 1.0, "bound": 2.0, "margin": 0.5, "holds": True}


def test_narrowest_leaves_out_what_is_not_judged() -> None:
    wide, narrow = (Verdict("sweep", "jerk", x, 4.0, "rad/s3") for x in (1.0, 3.0))
    told = Verdict("sweep", "mean_power", 99.0, None, "W")
    assert narrowest([wide, told, narrow]) is narrow
    lost = Verdict("sweep", "jerk", math.nan, 4.0, "rad/s3")
    assert narrowest([wide, lost, narrow]) is lost


@pytest.mark.parametrize("name", [field.name for field in fields(Tolerances)])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf, None, "1"])
def test_bad_tolerance_is_named(name: str, value: object) -> None:
    with pytest.raises(ValueError, match=f"Tolerances: {name} must be"):
        Tolerances(**{name: value})
