"""The look of every picture: one place for fonts, colours and sizes; matplotlib is loaded late."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flaprig.files import run_mark

if TYPE_CHECKING:
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure

# colours that all kinds of colour vision tell apart: M. Okabe & K. Ito, Color universal design
# (2008); vermilion leads, since the rig's wing has that colour
VERMILION, BLUE, GREEN, PURPLE, SKY = "#D55E00", "#0072B2", "#009E73", "#CC79A7", "#56B4E9"
SERIES = (VERMILION, BLUE, GREEN, PURPLE, SKY)
INK, GREY, PALE = "#222222", "#767676", "#D9DDE0"
# dots per inch: sharp in print at the width of a page
RESOLUTION = 200

_SETTINGS: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10.5,
    "axes.titlelocation": "left",
    "axes.grid": True,
    "grid.color": PALE,
    "grid.linewidth": 0.6,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "lines.linewidth": 1.8,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 9.0,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "savefig.dpi": RESOLUTION,
}


@contextmanager
def figure(width: float, height: float, arranged: bool = True) -> Iterator[Figure]:
    """An empty figure of that size in [inch] in the house style; no window is ever opened.

    Args:
        width: in [inch].
        height: in [inch].
        arranged: whether matplotlib places the axes so that nothing overlaps.
    """
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with mpl.rc_context(_SETTINGS):
        drawing = Figure(figsize=(width, height), layout="constrained" if arranged else None)
        FigureCanvasAgg(drawing)
        yield drawing


def save(drawing: Figure, path: Path) -> None:
    """Write the figure; the ending chooses the format."""
    mark = run_mark() if path.suffix == ".png" else {}
    drawing.savefig(path, metadata=mark)


def circulation_colours() -> Colormap:
    """Blue through light grey to vermilion: the sign of a circulation, for all colour vision."""
    from matplotlib.colors import LinearSegmentedColormap

    stops = ["#053B6B", BLUE, "#7FB9DE", "#E9ECEE", "#F2B27F", VERMILION, "#7A2E00"]
    return LinearSegmentedColormap.from_list("circulation", stops)
