"""`flaprig validate`: the model of the air beside things that know the answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from rich.console import Console
from tyro.conf import Positional, arg

from flaprig import _checks as check
from flaprig.commands.suites import Page, docs, hand_out, one_alone, run_each, with_parameters
from flaprig.report.folder import Folder
from flaprig.report.validation_page import page
from flaprig.report.validation_table import print_cases, print_outcome
from flaprig.validation.case import Case
from flaprig.validation.outcome import Outcome
from flaprig.validation.suite import CASES, case_named

# exit codes
WITHIN, OUTSIDE = 0, 1
PAGE = Page("validation.md", "images/validation")

_OUT = arg(metavar="DIR", help_behavior_hint="(optional)")


@dataclass(frozen=True)
class Validate:
    """Hold the model of the air against things that know the answer.

    Without a name the cases are listed. One name alone takes the case's own options: `flaprig
    validate katz-plotkin --help` shows them. Exit status: 0 every row is within its tolerance, 1
    some are not, 2 bad input, 3 a case failed.

    Attributes:
        case: names of cases.
        all: every case; writes the page validation.md with its pictures into --out, or into docs/
            of a clone.
        json: print exactly one JSON object and nothing else.
        out: folder for a picture per case and summary.json.
    """

    case: Positional[tuple[str, ...]] = ()
    all: bool = False
    json: bool = False
    out: Annotated[Path | None, _OUT] = None


@dataclass(frozen=True)
class OneCase:
    """One case with its own options.

    Attributes:
        json: print exactly one JSON object and nothing else.
        out: folder for its picture and summary.json.
    """

    json: bool = False
    out: Annotated[Path | None, _OUT] = None

    @property
    def chosen(self) -> Case:
        """The case with its parameters."""
        return getattr(self, "parameters")  # noqa: B009  # the field of the subclass


def parse(words: Sequence[str], ask: Callable[[type, str, list[str]], Any]) -> Any:
    """Validate, or OneCase where one name comes first and no other.

    Args:
        words: after `validate`.
        ask: reads arguments into a type: type, program, words.

    Raises:
        ValueError: wrong arguments.
    """
    name = one_alone(words)
    if name is None:
        return ask(Validate, "flaprig validate", list(words))
    kind = with_parameters(case_named(name), OneCase)
    return ask(kind, f"flaprig validate {name}", list(words[1:]))


def run(args: Validate | OneCase, folder: Folder) -> int:
    """Run the cases, write, tell; 0 when every row is within its tolerance.

    Raises:
        ValueError: bad input.
        OSError: a file cannot be written.
    """
    if isinstance(args, OneCase):
        return _run([args.chosen], args.json, folder)
    if args.all and args.case:
        raise check.fail("validate", "--all", "given without names", " ".join(args.case))
    names = list(CASES) if args.all else list(dict.fromkeys(args.case))
    cases = [case_named(name)() for name in names]
    if not cases:
        print_cases(Console(), CASES)
        return WITHIN
    if args.all and not folder:
        folder.share(docs("validate"))
    return _run(cases, args.json, folder, PAGE if args.all else None)


def _run(cases: Sequence[Case], as_object: bool, folder: Folder, whole: Page | None = None) -> int:
    console = Console()

    def show(case: Case, outcome: Outcome, seconds: float) -> None:
        if not as_object:
            print_outcome(console, case, outcome, seconds)

    found = run_each(cases, folder, whole, show)
    hand_out(folder, _summary(found), as_object, whole, page(found, PAGE.pictures) if whole else "")
    return OUTSIDE if any(outcome.missed for _, outcome, _ in found) else WITHIN


def _summary(found: Sequence[tuple[Case, Outcome, float]]) -> dict[str, Any]:
    """One case's numbers on top; a list of several."""
    parts = [
        {
            "case": case.name,
            **outcome.data,
            "rows": [row.summary() for row in outcome.rows],
            "notes": list(outcome.notes),
            "wall_time_s": spent,
        }
        for case, outcome, spent in found
    ]
    return {"command": "validate", **(parts[0] if len(parts) == 1 else {"cases": parts})}
