"""What a person sees while it learns: a bar with the best C_L and L/D so far; quiet in a pipe."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

# steps done in the stage, and a few words
Told = Callable[[int, str], None]


@contextmanager
def bar(words: str, total: int, done: int) -> Iterator[Told]:
    """A bar of one stage on standard error.

    Args:
        words: before the bar.
        total: steps of the stage.
        done: steps already behind.
    """
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda steps, text: None
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=24),
        TextColumn("{task.completed:.0f}/{task.total:.0f}"),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[text]}"),
    )
    with Progress(*columns, console=console) as shown:
        task = shown.add_task(words, total=total, completed=done, text="")
        yield lambda steps, text: shown.update(task, completed=steps, text=text)
