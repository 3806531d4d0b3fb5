"""The protocol of a validation case: frozen parameters, and one function that runs them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import ClassVar, Protocol, TypeVar

from flaprig.aero.air import Progress
from flaprig.validation.outcome import Outcome

Job = TypeVar("Job")
Answer = TypeVar("Answer")


class Case(Protocol):
    """A validation case. Its fields are its parameters, in SI units; degrees on the command line.

    Attributes:
        name: on the command line.
        claim: what the case holds the code against, as half a sentence.
    """

    name: ClassVar[str]
    claim: ClassVar[str]

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case.

        Raises:
            ValueError: a parameter out of range.
        """
        ...


def on_all_cores(
    work: Callable[[Job], Answer], jobs: Iterable[Job], progress: Progress | None = None
) -> list[Answer]:
    """The answers in the order of the jobs; the native solver leaves Python free meanwhile."""
    listed: Sequence[Job] = list(jobs)
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        futures = [pool.submit(work, job) for job in listed]
        try:
            for done, future in enumerate(as_completed(futures), 1):
                # an error, or Ctrl-C, need not wait for the rest
                future.result()
                if progress is not None:
                    progress(done / len(listed))
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return [future.result() for future in futures]
