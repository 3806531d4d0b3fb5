"""Validation on the terminal: the cases there are, and the rows that one found."""

from __future__ import annotations

import math
from collections.abc import Mapping

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from flaprig.validation.case import Case
from flaprig.validation.outcome import Outcome, Row, Verdict
from flaprig.validation.outcome import Table as Told

_STYLE = {Verdict.WITHIN: "green", Verdict.OUTSIDE: "bold red", Verdict.TOLD: ""}


def print_cases(console: Console, cases: Mapping[str, type[Case]]) -> None:
    """Names, and what each is held against."""
    table = Table(box=SIMPLE_HEAD, show_edge=False)
    table.add_column("case", no_wrap=True)
    table.add_column("held against")
    for name, case in cases.items():
        table.add_row(name, case.claim)
    console.print(table)
    console.print("flaprig validate CASE runs one, --all every one.", highlight=False)


def print_outcome(console: Console, case: Case, outcome: Outcome, seconds: float) -> None:
    """The rows of one case, its notes, and how long it took."""
    title = f"{case.name}: {case.claim} ({seconds:.1f} s)"
    table = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    table.add_column("quantity")
    for heading in ("ours", "reference", "error"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("source")
    table.add_column("", no_wrap=True)
    for row in outcome.rows:
        verdict = f"[{_STYLE[row.verdict]}]{row.verdict.value}[/]" if row.verdict.value else ""
        table.add_row(escape(row.quantity), *cells(row), escape(row.source), verdict)
    console.print(table)
    for more in outcome.tables:
        _print_table(console, more)
    for note in outcome.notes:
        console.print(note, highlight=False, markup=False, style="dim")


def _print_table(console: Console, told: Told) -> None:
    table = Table(title=escape(told.title), title_justify="left", box=SIMPLE_HEAD)
    for number, heading in enumerate(told.header):
        table.add_column(escape(heading), justify="right" if number else "left")
    for line in told.lines:
        table.add_row(*(escape(cell) for cell in line))
    console.print(table)


def cells(row: Row) -> tuple[str, str, str]:
    """Ours with its spread, the reference and the error, as text."""
    spread = f" ±{row.spread:.2g}" if math.isfinite(row.spread) else ""
    reference = "" if row.reference is None else f"{row.reference:.4g}"
    return f"{row.value:.4g}{spread}", reference, error(row)


def error(row: Row) -> str:
    """The error with its unit; nothing where the reference is zero and the value says it all."""
    if row.reference is None or (not row.relative and row.reference == 0.0):
        return ""
    return f"{row.error:+.2f}%" if row.relative else f"{row.error:+.3g}"
