"""What `flaprig reproduce` shows: the paper's Table 1 beside ours, and the pictures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from flaprig.report.folder import Folder
from flaprig.report.kinematics import draw_profiles, draw_strokes
from flaprig.report.learning import draw_learning, read_learned
from flaprig.strokes import Stroke

# parts of a case: key, heading
_PARTS = (("paper", "paper, measured"), ("uvlm", "UVLM"), ("twin", "twin with motors"))


def draw_reproduction(folder: Folder, strokes: Mapping[str, Stroke]) -> None:
    """profiles.png, strokes.png and learning.png."""
    assert folder.path is not None
    first = next(iter(strokes.values()))
    folder.write("profiles.png", lambda draft: draw_profiles(draft, first))
    title = "The sinusoid and the learned strokes"
    folder.write("strokes.png", lambda draft: draw_strokes(draft, strokes, title))
    halves = {"first half": "first_half", "case A, second": "case_a", "case B, second": "case_b"}
    curves = [
        read_learned(folder.path / where / "metrics.csv", name) for name, where in halves.items()
    ]
    words = "Best reward so far (thick) and mean of each update (thin)"
    folder.write("learning.png", lambda draft: draw_learning(draft, curves, words, None))


def print_reproduction(
    console: Console, rows: Mapping[str, Mapping[str, Any]], summary: Mapping[str, Any]
) -> None:
    """Mean C_L and L/D of every case with gains over the sinusoid, and what it took."""
    bounds = summary["bounds"]
    title = (
        f"Table 1 of the paper, seed {summary['seed']}, accelerations up to "
        f"{bounds['sweep']:.4g}x / {bounds['pitch']:.4g}x of the sinusoid's"
    )
    table = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    table.add_column("case", no_wrap=True)
    table.add_column("by", no_wrap=True)
    for heading in ("C_L", "gain", "L/D", "gain"):
        table.add_column(heading, justify="right", no_wrap=True)
    for case, parts in rows.items():
        for number, (key, heading) in enumerate(_PARTS):
            part = parts[key]
            cells = []
            for name in ("cl", "lift_to_drag"):
                cells += [f"{part[name]:.3f}", f"{part[f'{name}_gain_percent']:+.1f}%"]
            table.add_row(case if number == 0 else "", heading, *cells)
        table.add_section()
    console.print(table)
    minutes = sum(summary["wall_time"].values()) / 60.0
    console.print(f"Wall time {minutes:.1f} min.", highlight=False)
