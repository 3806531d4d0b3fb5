"""The page docs/validation.md: what is calibrated, what is validated, and every row."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from importlib.metadata import version

from flaprig.report.validation_table import cells
from flaprig.validation.case import Case
from flaprig.validation.outcome import Outcome, Row, Table, Verdict

Found = Sequence[tuple[Case, Outcome, float]]

HEAD = """# Validation

Every part of the model of the air beside something that knows the answer: closed forms, other
programs, measurements, conservation laws. Made by

```sh
flaprig validate --all        # this page
flaprig validate CASE --help  # one case, with parameters of its own
```

A row with a tolerance says whether it is met; the tests of the repository hold the same functions
to the same tolerances. ± is the standard deviation from cycle to cycle (of the strokes, where a
row speaks of strokes). [model.md](model.md) says how the models work, what was fitted to what, and
where they are known to be wrong.
"""


def page(found: Found, pictures: str) -> str:
    """The page as Markdown.

    Args:
        found: cases, what they found, and the seconds they took.
        pictures: folder of the pictures, beside the page.
    """
    return "\n".join([HEAD, _overview(found), *(_section(*part, pictures) for part in found)])


def _overview(found: Found) -> str:
    lines = ["| case | held against | rows with a tolerance | outside |", "|---|---|---|---|"]
    for case, outcome, _ in found:
        judged = sum(row.verdict is not Verdict.TOLD for row in outcome.rows)
        lines.append(
            f"| [{case.name}](#{case.name}) | {case.claim} | {judged} | {len(outcome.missed)} |"
        )
    seconds = sum(part[2] for part in found)
    made = f"flaprig {version('flaprig')}, Python {platform.python_version()}"
    lines.append(f"\nTook {seconds / 60.0:.1f} minutes ({made}, {platform.machine()}).\n")
    return "\n".join(lines)


def _section(case: Case, outcome: Outcome, seconds: float, pictures: str) -> str:
    lines = [f"## {case.name}\n", f"{_first_sentence(case)}\n"]
    if outcome.rows:
        lines += [
            "| quantity | ours | reference | error | source | tolerance | |",
            "|---|---|---|---|---|---|---|",
            *(_row(row) for row in outcome.rows),
            "",
        ]
    for told in outcome.tables:
        lines += _table(told)
    lines += [f"{note}\n" for note in outcome.notes]
    if outcome.draw is not None:
        lines.append(f"![{case.name}]({pictures}/{case.name}.png)\n")
    lines.append(f"`flaprig validate {case.name}`, {seconds:.1f} s.\n")
    return "\n".join(lines)


def _table(told: Table) -> list[str]:
    rule = ["---"] * len(told.header)
    cells = [told.header, rule, *told.lines]
    return [f"{told.title}:\n", *(f"| {' | '.join(line)} |" for line in cells), ""]


def _row(row: Row) -> str:
    tolerance = ""
    if row.tolerance is not None:
        tolerance = f"{row.tolerance:g}" + (" %" if row.relative else "")
    verdict = f"**{row.verdict.value}**" if row.verdict is Verdict.OUTSIDE else row.verdict.value
    return f"| {row.quantity} | {' | '.join(cells(row))} | {row.source} | {tolerance} | {verdict} |"


def _first_sentence(case: Case) -> str:
    return " ".join((type(case).__doc__ or "").split("\n\n")[0].split())
