"""Rows and verdicts: what counts as within, and what never does."""

import math

import pytest

from flaprig.validation.outcome import Outcome, Row, Verdict


def test_errors_are_relative_or_in_the_unit():
    assert Row("a", 1.1, 1.0).error == pytest.approx(10.0)
    assert Row("a", -1.1, -1.0).error == pytest.approx(-10.0)
    assert Row("a", 1.5, 1.0, relative=False).error == pytest.approx(0.5)
    assert math.isnan(Row("a", 1.0).error)


@pytest.mark.parametrize(
    ("value", "verdict"),
    [(1.019, Verdict.WITHIN), (1.021, Verdict.OUTSIDE), (math.nan, Verdict.OUTSIDE)],
)
def test_verdicts(value, verdict):
    assert Row("a", value, 1.0, tolerance=2.0).verdict is verdict
    assert Row("a", value, 1.0).verdict is Verdict.TOLD


def test_missed_rows_are_the_outside_ones():
    rows = (
        Row("a", 2.0, 1.0, tolerance=1.0),
        Row("b", 1.0, 1.0, tolerance=1.0),
        Row("c", 9.0, 1.0),
    )
    assert [row.quantity for row in Outcome(rows).missed] == ["a"]
