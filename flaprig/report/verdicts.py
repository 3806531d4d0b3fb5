"""Tables of verdicts on the terminal: every limit of a stroke, and how far it can be scaled.

Angles are shown in degrees, as everywhere on the command line; files and JSON keep radians.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from flaprig.report.table import with_grey_brackets

if TYPE_CHECKING:
    from flaprig.feasibility import FeasibilityReport, Verdict
    from flaprig.scaling import FrequencyRange
    from flaprig.servo_choice import ServoChoice

# a margin below this share is worth a second look
NARROW = 0.1


def print_verdicts(console: Console, title: str, report: FeasibilityReport) -> None:
    """One row a limit, and the whole verdict in a sentence.

    A stroke that the rig cannot make has two columns of values: what it would need as asked, which
    is judged, and what the nearest stroke needs, in grey.
    """
    two = any(verdict.nearest is not None for verdict in report.verdicts)
    columns = ("as asked", "nearest") if two else ("value",)
    table = _table(title, ("quantity", *columns, "bound", "unit", "margin"))
    before = ""
    for verdict in report.verdicts:
        if verdict.joint != before and before:
            table.add_section()
        before = verdict.joint
        table.add_row(*_cells(verdict, two))
    console.print(table)
    console.print(conclusion(report), highlight=False, soft_wrap=True)


def print_scale(console: Console, found: FrequencyRange, choice: ServoChoice) -> None:
    """The highest frequency, and the servos of the catalogue."""
    console.print(frequency_sentence(found), highlight=False, soft_wrap=True)
    table = _table("Servos of the catalogue", ("servo", "mass [g]", "sweep", "pitch", "broken"))
    for trial in choice.trials:
        broken = ", ".join(verdict.words for verdict in trial.report.broken)
        marks = ("yes" if held else "no" for held in (trial.sweep, trial.pitch))
        table.add_row(trial.name, f"{1e3 * trial.mass:.3g}", *marks, broken)
    console.print(table)
    console.print(servo_sentence(choice), highlight=False, soft_wrap=True)


def conclusion(report: FeasibilityReport) -> str:
    """The whole verdict, and of an infeasible stroke the nearest one."""
    if report.feasible:
        worst = report.worst
        return f"Feasible. Smallest margin: {worst.words}, {percent(worst.margin)}."
    broken = ", ".join(verdict.words for verdict in report.broken)
    sentence = f"Not feasible: {broken}."
    if report.projection.changed:
        sweep, pitch = report.projection.sweep, report.projection.pitch
        sentence += (
            f" Nearest stroke within the limits: {math.degrees(report.projection.distance_rms):.3g}"
            f"° away (rms), sweep amplitude x {sweep.amplitude_ratio:.3f}, "
            f"pitch x {pitch.amplitude_ratio:.3f}."
        )
    return sentence


def frequency_sentence(found: FrequencyRange) -> str:
    """The highest frequency and what ends it."""
    if found.highest is None:
        return f"No feasible frequency was found down to {found.above:.4g} Hz."
    if found.above is None:
        return f"Feasible up to {found.highest:.4g} Hz, where the scan ends."
    names = ", ".join(found.limited_by)
    sentence = f"Feasible up to {found.highest:.4g} Hz; at {found.above:.4g} Hz: {names}."
    if found.islands:
        sentence += " Feasible again at " + ", ".join(f"{f:.4g}" for f in found.islands) + " Hz."
    return sentence


def servo_sentence(choice: ServoChoice) -> str:
    """The smallest servos."""
    if choice.sweep is None or choice.pitch is None:
        joint = "sweep" if choice.sweep is None else "pitch"
        return f"No servo of the catalogue keeps the limits of the {joint}."
    if choice.both is None:
        return f"Smallest: {choice.sweep} for the sweep, {choice.pitch} for the pitch."
    sentence = f"Smallest on both joints: {choice.both}."
    if choice.pair:
        sentence += f" {choice.sweep} on the sweep with {choice.pitch} on the pitch holds too."
    return sentence


def percent(margin: float | None) -> str:
    """A margin as people read it; nothing where nothing is judged."""
    return "" if margin is None else f"{100.0 * margin:.0f} %"


def number(value: float) -> str:
    """Four digits, without an exponent where the number is large."""
    return f"{value:.0f}" if 1e3 <= abs(value) < 1e7 else f"{value:.4g}"


def _table(title: str, columns: tuple[str, ...]) -> Table:
    table = Table(
        title=with_grey_brackets(title),
        title_justify="left",
        title_style="",
        box=SIMPLE_HEAD,
        show_edge=False,
    )
    for name in columns:
        numeric = name in ("value", "as asked", "nearest", "bound", "margin", "mass [g]")
        # where the terminal is narrow, words wrap and numbers stay whole
        table.add_column(
            name,
            justify="right" if numeric else "left",
            no_wrap=name not in ("quantity", "broken"),
            min_width=8 if numeric and name != "mass [g]" else None,
        )
    return table


def _cells(verdict: Verdict, two: bool) -> tuple[str | Text, ...]:
    factor, unit = 1.0, verdict.unit
    if unit.startswith("rad"):
        factor, unit = 180.0 / math.pi, "deg" + unit[3:]
    bound = "" if verdict.bound is None else number(factor * verdict.bound)
    style = "red bold" if not verdict.holds else "yellow"
    narrow = verdict.margin is not None and not verdict.margin >= NARROW
    margin = Text(percent(verdict.margin), style=style if narrow else "")
    words = Text(verdict.words, style="" if verdict.holds else "red bold")
    values: list[str | Text] = [number(factor * verdict.value)]
    if two:
        near = "" if verdict.nearest is None else number(factor * verdict.nearest)
        values.append(Text(near, style="grey50"))
        if near == "":
            # of the nearest stroke alone: its distance, and what it costs
            values.reverse()
    return words, *values, bound, unit, margin
