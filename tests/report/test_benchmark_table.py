"""Numbers of benchmarks as text."""

import math

import pytest

from flaprig.benchmark.outcome import row
from flaprig.report.benchmark_table import cells, number


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (12.345, "12.3"),
        (99.97, "100"),
        (0.01234, "0.0123"),
        (472_345.0, "472000"),
        (-3.14159, "-3.14"),
        (1.5e9, "1.50e+09"),
        (2e-6, "2.00e-06"),
        (math.nan, "nan"),
    ],
)
def test_three_digits(value, text):
    assert number(value) == text


def test_cells():
    assert cells(row("time", [1.0, 3.0], "s", at_most=1.5)) == (
        "2.00",
        "1.00 to 3.00",
        "s",
        "≤ 1.50",
    )
    assert cells(row("size", 4.0, "MB")) == ("4.00", "", "MB", "")
