"""Tables on the terminal: one run, or several runs beside published values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

# columns of coefficients: key of a summary, heading
COEFFICIENTS = (("cl", "C_L"), ("cd", "C_D"), ("lift_to_drag", "L/D"))
# rows of a single run: key of a summary, words, unit
_LOADS = (
    ("mean_lift_N", "mean lift", "N"),
    ("mean_drag_N", "mean drag", "N"),
    ("p99_sweep_torque_Nm", "sweep torque, 99th percentile", "N m"),
    ("peak_sweep_torque_Nm", "sweep torque, peak", "N m"),
    ("p99_pitch_torque_Nm", "pitch torque, 99th percentile", "N m"),
    ("peak_pitch_torque_Nm", "pitch torque, peak", "N m"),
    ("mean_power_W", "mean power given to the fluid", "W"),
    ("peak_power_W", "peak power given to the fluid", "W"),
)


def with_grey_brackets(title: str) -> Text:
    """A title in bold, with what was asked for, which stands in brackets, in grey."""
    text = Text(title, style="bold")
    text.highlight_regex(r"\(asked [^)]*\)", "not bold grey50")
    return text


def with_spread(summary: Mapping[str, Any], key: str) -> str:
    """A mean and its spread from cycle to cycle, as «1.939 ±0.007»."""
    spread = summary.get(f"{key}_spread")
    text = f"{summary[key]:.3f}"
    known = isinstance(spread, float) and math.isfinite(spread)
    return f"{text} ±{spread:.3f}" if known else text


def print_run(console: Console, title: str, summary: Mapping[str, Any]) -> None:
    """One run: coefficients with their spread, loads with their unit."""
    table = Table(
        title=with_grey_brackets(title),
        title_justify="left",
        title_style="",
        box=None,
        pad_edge=False,
    )
    table.add_column("quantity")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for key, heading in COEFFICIENTS:
        table.add_row(heading, with_spread(summary, key), "")
    for key, words, unit in _LOADS:
        if key in summary:
            table.add_row(words, f"{summary[key]:.4g}", unit)
    for joint in ("sweep", "pitch"):
        flown = summary.get(f"flown_{joint}_amplitude_rad")
        if flown is not None:
            table.add_row(f"{joint} amplitude flown", f"{math.degrees(flown):.4g}", "deg")
    console.print(table)
    console.print(averaging(summary))


def print_notices(console: Console, notices: Iterable[str]) -> None:
    """What was changed or is doubtful, a line each, under a table."""
    for notice in notices:
        text = Text.assemble(("Notice: ", "bold yellow"), notice)
        console.print(text, soft_wrap=True, highlight=False)


def named_notices(summaries: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Notices of several runs, each with the names of the runs that it is of."""
    names: dict[str, list[str]] = {}
    for name, summary in summaries.items():
        for notice in summary.get("notices", ()):
            names.setdefault(notice, []).append(name)
    return [f"{' and '.join(runs)}: {notice}" for notice, runs in names.items()]


def averaging(summary: Mapping[str, Any]) -> str:
    """What the means are over, as a sentence."""
    first, last = summary["averaged_cycles"]
    if first == last:
        return f"Means over cycle {first}."
    return f"Means over cycles {first} to {last}; ± is the spread from cycle to cycle."


def print_comparison(
    console: Console,
    title: str,
    runs: Mapping[str, Mapping[str, Any]],
    published: Mapping[str, float],
    source: str,
) -> None:
    """Several runs and the published values, with the difference from these in percent.

    Args:
        console: where to print.
        title: above the table.
        runs: summaries by the name of the run.
        published: values by key of a summary.
        source: who published them.
    """
    table = Table(
        title=title,
        title_justify="left",
        title_style="bold",
        box=SIMPLE_HEAD,
        show_edge=False,
        padding=0,
    )
    table.add_column("run", no_wrap=True)
    for key, heading in COEFFICIENTS:
        # with these widths the table fits 80 columns
        table.add_column(heading, justify="right", no_wrap=True, min_width=13)
        if key in published:
            table.add_column("diff.", justify="right", no_wrap=True)
    for name, summary in runs.items():
        table.add_row(name, *_cells(summary, published))
    table.add_section()
    table.add_row(source, *_published_cells(published), style="bold")
    console.print(table)


def _cells(summary: Mapping[str, Any], published: Mapping[str, float]) -> list[str]:
    """One run; a difference stands beside every key that was published."""
    cells = []
    for key, _ in COEFFICIENTS:
        cells.append(with_spread(summary, key))
        if key in published:
            cells.append(f"{difference(summary[key], published[key]):+.1f}%")
    return cells


def _published_cells(published: Mapping[str, float]) -> list[str]:
    cells = []
    for key, _ in COEFFICIENTS:
        cells += [f"{published[key]:.2f}", ""] if key in published else ["–"]
    return cells


def difference(value: float, published: float) -> float:
    """Difference from a published value in percent of it."""
    return 100.0 * (value / published - 1.0)
