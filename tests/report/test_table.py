"""Tables: means with their spread, differences in percent."""

from __future__ import annotations

import io

import pytest
from rich.console import Console

from flaprig.report.table import difference, print_comparison, print_run, with_spread

SUMMARY = {
    "cl": 1.9388,
    "cl_spread": 0.0071,
    "cd": 2.549,
    "cd_spread": float("nan"),
    "lift_to_drag": 0.7606,
    "lift_to_drag_spread": 0.0002,
    "averaged_cycles": [3, 5],
    "mean_lift_N": 0.29456,
}


def printed(show: object, *words: object) -> str:
    console = Console(file=io.StringIO(), width=80)
    show(console, *words)  # type: ignore[operator]
    return console.file.getvalue()  # type: ignore[attr-defined]


def test_spread() -> None:
    assert with_spread(SUMMARY, "cl") == "1.939 ±0.007"
    assert with_spread(SUMMARY, "cd") == "2.549"
    assert difference(1.94 * 1.1, 1.94) == pytest.approx(10.0)


def test_run_has_units() -> None:
    text = printed(print_run, "title", SUMMARY)
    assert "mean lift" in text and "0.2946" in text and "cycles 3 to 5" in text


def test_comparison_fits_eighty_columns() -> None:
    runs = {"quasi-steady, prescribed": SUMMARY | {"cd_spread": 0.0123, "cl": 2.1374}}
    text = printed(print_comparison, "title", runs, {"cl": 1.94, "lift_to_drag": 0.74}, "paper")
    assert "…" not in text
    assert "2.137 ±0.007" in text and "+10.2%" in text and "+2.8%" in text
    assert "1.94" in text.splitlines()[-1] and "0.74" in text.splitlines()[-1]
