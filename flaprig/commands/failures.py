"""What a failure is called on a command line, and its exit code: one table for all programs."""

from __future__ import annotations

FAILED, BAD_INPUT, STOPPED = 1, 2, 130
# a failure where 1 is an answer
NO_ANSWER = 3

# failures that a user can meet; whatever else is raised is a fault of the program
EXPECTED = (ValueError, OSError, ArithmeticError, ImportError, RuntimeError, MemoryError)


def exit_code(error: BaseException, answers: bool = False) -> int:
    """The exit code of an expected failure.

    Args:
        error: what was raised.
        answers: whether 1 is one of the program's answers.
    """
    if isinstance(error, ValueError | OSError):
        return BAD_INPUT
    return NO_ANSWER if answers else FAILED


def sentence(error: BaseException) -> str:
    """What was wrong, on one line."""
    if isinstance(error, OSError) and error.strerror:
        where = f"{error.filename}: " if error.filename else ""
        return f"{where}{error.strerror}"
    words = " ".join(str(error).split())
    if isinstance(error, MemoryError):
        # numpy says how much was asked for, others say nothing
        asked = f" ({words})" if words else ""
        return f"the memory is too small for this run{asked}; fewer cycles or steps need less"
    return words or type(error).__name__
