"""Benchmarks on the terminal: the machine, and the numbers that each found."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from flaprig.benchmark.benchmark import Benchmark
from flaprig.benchmark.outcome import Outcome, Row

_STYLE = {True: "green", False: "bold red", None: ""}


def print_machine(console: Console, here: Mapping[str, Any]) -> None:
    """One line."""
    console.print(machine_line(here), highlight=False, markup=False, style="dim")


def machine_line(here: Mapping[str, Any]) -> str:
    """The machine, the versions and the date."""
    named = ("python", "flaprig", "numpy", "mujoco", "pterasoftware", "numba")
    versions = ", ".join(f"{name} {here[name]}" for name in named)
    where = f"{here['processor']}, {here['cores']} cores, {here['system']}"
    return f"{where}; load {here['load_average']} before; {versions}; {here['date']}"


def print_outcome(console: Console, benchmark: Benchmark, outcome: Outcome, seconds: float) -> None:
    """The rows of one benchmark, its notes, and how long it took."""
    title = f"{benchmark.name}: {benchmark.claim} ({seconds:.0f} s)"
    table = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    table.add_column("quantity")
    for heading in ("median", "turns", "unit", "aim"):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in outcome.rows:
        value, turns, unit, aim = cells(row)
        style = _STYLE[row.reached]
        shown = f"[{style}]{value}[/]" if style else value
        table.add_row(escape(row.quantity), shown, turns, escape(unit), aim)
    console.print(table)
    for note in outcome.notes:
        console.print(note, highlight=False, markup=False, style="dim")


def cells(row: Row) -> tuple[str, str, str, str]:
    """Median, range of the turns, unit and aim, as text."""
    turns = f"{number(row.low)} to {number(row.high)}" if len(row.turns) > 1 else ""
    return number(row.value), turns, row.unit, aim(row)


def aim(row: Row) -> str:
    """What the median should be; nothing without an aim."""
    parts = []
    if row.at_least is not None:
        parts.append(f"≥ {number(row.at_least)}")
    if row.at_most is not None:
        parts.append(f"≤ {number(row.at_most)}")
    return " ".join(parts)


def number(value: float) -> str:
    """Three digits, without an exponent where one can do without."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    # of the rounded value: 99.97 is 100
    size = math.floor(math.log10(abs(float(f"{value:.2e}"))))
    if not -4 <= size <= 6:
        return f"{value:.2e}"
    return f"{round(value, 2 - size):.{max(0, 2 - size)}f}"
