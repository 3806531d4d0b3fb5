"""A row: the median of its turns, their range, and whether the aim is reached."""

import numpy as np
import pytest

from flaprig.benchmark.outcome import Row, row


def test_median_and_range():
    found = row("time", np.array([3.0, 1.0, 2.0]), "s")
    assert (found.value, found.low, found.high) == (2.0, 1.0, 3.0)
    assert row("size", 4, "MB").turns == (4.0,)


@pytest.mark.parametrize(
    ("aims", "reached"),
    [
        ({}, None),
        ({"at_least": 2.0}, True),
        ({"at_least": 2.1}, False),
        ({"at_most": 2.0}, True),
        ({"at_most": 1.9}, False),
        ({"at_least": 1.0, "at_most": 3.0}, True),
    ],
)
def test_aims(aims, reached):
    assert row("ratio", [2.0], "x", **aims).reached is reached


def test_every_number_names_its_command():
    assert row("time", 1.0, "s").summary("flaprig bench x")["command"] == "flaprig bench x"
    own = Row("time", (1.0, 3.0), "s", command="python -c pass").summary("flaprig bench x")
    assert own["command"] == "python -c pass"
    assert own["value"] == 2.0 and own["spread"] == 2.0 and own["turns"] == [1.0, 3.0]
