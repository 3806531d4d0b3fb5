"""The command line: reads the arguments, runs one subcommand, turns errors into one sentence.

Exit codes: 0 fine, 1 the run failed, 2 bad input, 130 stopped with Ctrl-C. `flaprig check` and
`flaprig validate` answer with their code, 0 or 1; there a run that failed is 3.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr
from importlib.metadata import PackageNotFoundError, version
from typing import Annotated, Any

import tyro
from tyro.conf import FlagCreatePairsOff, OmitArgPrefixes, OmitSubcommandPrefixes, subcommand

from flaprig.commands import bench, check, demo, export, reproduce, simulate, twin, validate, view
from flaprig.report.folder import Folder

FAILED, BAD_INPUT, STOPPED = 1, 2, 130
# a failure where 1 is an answer
NO_ANSWER = 3

Command = (
    Annotated[simulate.Simulate, subcommand("simulate")]
    | Annotated[twin.Twin, subcommand("twin")]
    | Annotated[check.Check, subcommand("check")]
    | Annotated[export.Export, subcommand("export")]
    | Annotated[reproduce.Reproduce, subcommand("reproduce")]
    | Annotated[validate.Validate, subcommand("validate")]
    | Annotated[bench.Bench, subcommand("bench")]
    | Annotated[view.View, subcommand("view")]
    | Annotated[demo.Demo, subcommand("demo")]
)
_RUN: dict[type, Callable[[Any, Folder], int | None]] = {
    simulate.Simulate: simulate.run,
    twin.Twin: twin.run,
    check.Check: check.run,
    export.Export: export.run,
    reproduce.Reproduce: reproduce.run,
    validate.Validate: validate.run,
    validate.OneCase: validate.run,
    bench.Bench: bench.run,
    bench.OneBenchmark: bench.run,
    view.View: view.run,
    demo.Demo: demo.run,
}
# commands whose exit code is an answer
_ANSWERS = (check.Check, validate.Validate, validate.OneCase)
# commands whose parts have options of their own
_PARSE = {"validate": validate.parse, "bench": bench.parse}
_CONFIG = (OmitArgPrefixes, OmitSubcommandPrefixes, FlagCreatePairsOff)
_ABOUT = "The digital twin of a robotic flapping wing. Angles are in degrees, all else in SI units."


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code.

    Args:
        argv: arguments without the program's name; those of the process when None.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # a terminal of few letters gets a question mark for ±
            stream.reconfigure(errors="replace")
    if words == ["--version"]:
        print(_version())
        return 0
    try:
        args = _parse(words)
    except ValueError as error:
        return _say(str(error), BAD_INPUT)
    folder = Folder(getattr(args, "out", None))
    try:
        return _run(args, folder)
    except KeyboardInterrupt:
        return _say(f"stopped; {_kept(folder)}", STOPPED)
    except BrokenPipeError:
        # the reader went away: not even the flush at exit may complain
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED


def _run(args: Any, folder: Folder) -> int:
    """Run the subcommand; expected errors become a sentence and an exit code."""
    try:
        code = next(f for kind, f in _RUN.items() if isinstance(args, kind))(args, folder)
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except (ValueError, OSError) as error:
        return _say(_sentence(error), BAD_INPUT)
    except (ArithmeticError, ImportError, RuntimeError) as error:
        return _say(_sentence(error), NO_ANSWER if isinstance(args, _ANSWERS) else FAILED)
    return code or 0


def _parse(argv: list[str]) -> Any:
    """The arguments of one subcommand; parts of some commands have options of their own.

    Raises:
        ValueError: what tyro says about wrong arguments, as one sentence.
        SystemExit: help was asked for and has been printed.
    """
    if argv and argv[0] in _PARSE:
        return _PARSE[argv[0]](argv[1:], _ask)
    return _ask(Command, "flaprig", argv, _ABOUT)


def _ask(kind: Any, program: str, argv: list[str], about: str | None = None) -> Any:
    complaint = io.StringIO()
    try:
        with redirect_stderr(complaint):
            return tyro.cli(kind, prog=program, description=about, args=argv, config=_CONFIG)
    except SystemExit as stop:
        if stop.code in (0, None):
            raise
        words = _first_paragraph(complaint.getvalue()).rstrip(".")
        raise ValueError(f"{words} (flaprig --help says what is possible)") from None


def _first_paragraph(box: str) -> str:
    """The words of tyro's error box, without frame, title and advice."""
    lines = [line.strip(" │") for line in box.splitlines()]
    blocks: list[list[str]] = [[]]
    for line in lines:
        if line.startswith(("╭", "╰")) or (line and set(line) <= set("─-")):
            blocks.append([])
        elif line:
            blocks[-1].append(line)
    found = [" ".join(block) for block in blocks if block]
    # with plain ASCII the title is a block of its own
    title = 0 if box.startswith("╭") else 1
    return found[title] if len(found) > title else " ".join(box.split())


def _sentence(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        where = f"{error.filename}: " if error.filename else ""
        return f"{where}{error.strerror}"
    return " ".join(str(error).split()) or type(error).__name__


def _kept(folder: Folder) -> str:
    if not folder.written:
        return "nothing was written"
    return f"complete in {folder.path}: {', '.join(path.name for path in folder.written)}"


def _say(sentence: str, code: int) -> int:
    print(f"flaprig: {sentence}", file=sys.stderr)
    return code


def _version() -> str:
    try:
        return version("flaprig")
    except PackageNotFoundError:
        return "not installed"
