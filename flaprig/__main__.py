"""`flaprig` and `python -m flaprig`: loads the command line, so that Ctrl-C is heard meanwhile."""

from __future__ import annotations

import os
import sys

# as flaprig.commands.failures has them, which is not loaded yet
_FAILED, _STOPPED = 1, 130


def main() -> int:
    """Run the command line of the process and return its exit code."""
    _plug()
    try:
        from flaprig.cli import main as run

        return run()
    except KeyboardInterrupt:
        return _say("stopped; nothing was written", _STOPPED)
    except MemoryError:
        return _say("the memory is too small to load the program", _FAILED)
    except ImportError as error:
        return _say(" ".join(str(error).split()), _FAILED)


def _plug() -> None:
    """Closed standard streams become the null device: no file of a run may take their number."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            # the lowest free number: this one
            os.open(os.devnull, os.O_RDWR)


def _say(sentence: str, code: int) -> int:
    if sys.stderr is not None:
        print(f"flaprig: {sentence}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main())
