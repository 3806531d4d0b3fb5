"""The command line: reads the arguments, runs one subcommand, turns errors into one sentence.

Exit codes: 0 fine, 1 the run failed, 2 bad input, 130 stopped with Ctrl-C. `flaprig check` and
`flaprig validate` answer with their code, 0 or 1; there a run that failed is 3.
"""

from __future__ import annotations

import difflib
import io
import os
import sys
from collections.abc import Callable, Sequence
from functools import partial, reduce
from importlib.metadata import PackageNotFoundError, version
from operator import or_
from typing import Annotated, Any

from tyro.conf import FlagCreatePairsOff, OmitArgPrefixes, OmitSubcommandPrefixes, subcommand

from flaprig.commands import bench, check, demo, export, reproduce, simulate, twin, validate, view
from flaprig.commands.arguments import parse
from flaprig.commands.failures import (
    BAD_INPUT,
    EXPECTED,
    FAILED,
    NO_ANSWER,
    STOPPED,
    exit_code,
    sentence,
)
from flaprig.report.folder import Folder

__all__ = ["BAD_INPUT", "FAILED", "NO_ANSWER", "STOPPED", "main"]

# the commands by name, in the order of the help
_KIND: dict[str, type] = {
    "simulate": simulate.Simulate,
    "twin": twin.Twin,
    "check": check.Check,
    "export": export.Export,
    "reproduce": reproduce.Reproduce,
    "validate": validate.Validate,
    "bench": bench.Bench,
    "view": view.View,
    "demo": demo.Demo,
}
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
_CLOSED = "standard output is closed"
_ABOUT = "The digital twin of a robotic flapping wing. Angles are in degrees, all else in SI units."


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code.

    Args:
        argv: arguments without the program's name; those of the process when None.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    unheard = _open_streams()
    folder = Folder(None)
    try:
        if words == ["--version"]:
            print(_version())
            return _say(_CLOSED, BAD_INPUT) if unheard else 0
        args = _parse(words)
        if unheard and not _leaves_files(args):
            return _say(f"{_CLOSED}; --out DIR would keep the result", BAD_INPUT)
        folder.path = getattr(args, "out", None)
        return _run(args, folder)
    except KeyboardInterrupt:
        return _say(f"stopped; {_kept(folder)}", STOPPED)
    except BrokenPipeError:
        # the reader went away: not even the flush at exit may complain
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except SystemExit:
        # help was printed
        if unheard:
            return _say(_CLOSED, BAD_INPUT)
        raise
    except ValueError as error:
        return _say(str(error), BAD_INPUT)
    finally:
        folder.release()


def _open_streams() -> bool:
    """Make standard output and error usable; whether the output was closed, as for a daemon."""
    unheard = sys.stdout is None
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115
        elif isinstance(stream, io.TextIOWrapper):
            # a terminal of few letters gets a question mark for ±
            stream.reconfigure(errors="replace")
    return unheard


def _leaves_files(args: Any) -> bool:
    """Whether a command leaves its result in files, and not on standard output alone."""
    wanted = getattr(args, "out", None), getattr(args, "all", False)
    return any(wanted) or isinstance(args, view.View)


def _run(args: Any, folder: Folder) -> int:
    """Run the subcommand; expected errors become a sentence and an exit code."""
    try:
        code = next(f for kind, f in _RUN.items() if isinstance(args, kind))(args, folder)
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except EXPECTED as error:
        return _say(sentence(error), exit_code(error, isinstance(args, _ANSWERS)))
    return code or 0


def _parse(argv: list[str]) -> Any:
    """The arguments of one subcommand; parts of some commands have options of their own.

    Raises:
        ValueError: wrong arguments, as one sentence.
        SystemExit: help was asked for and has been printed.
    """
    name = argv[0] if argv else ""
    if name in _PARSE:
        return _PARSE[name](argv[1:], partial(parse, config=_CONFIG))
    if name in _KIND:
        return parse(_KIND[name], f"flaprig {name}", argv[1:], config=_CONFIG)
    if name and not name.startswith("-"):
        close = difflib.get_close_matches(name, _KIND, 2)
        meant = f"perhaps you meant {' or '.join(close)}" if close else f"one of {', '.join(_KIND)}"
        raise ValueError(f"there is no command {name}; {meant} (flaprig --help tells them)")
    # nothing or an option: the help of all commands, or what is missing
    commands = [Annotated[kind, subcommand(word)] for word, kind in _KIND.items()]
    return parse(reduce(or_, commands), "flaprig", argv, _ABOUT, _CONFIG)


def _kept(folder: Folder) -> str:
    if not folder.written:
        return "nothing was written"
    return f"complete in {folder.path}: {', '.join(path.name for path in folder.written)}"


def _say(words: str, code: int) -> int:
    print(f"flaprig: {words}", file=sys.stderr)
    return code


def _version() -> str:
    try:
        return version("flaprig")
    except PackageNotFoundError:
        return "not installed"
