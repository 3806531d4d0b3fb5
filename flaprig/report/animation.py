"""The wake in motion, drawn by matplotlib: what is shown where no graphics library works."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from flaprig.report import style
from flaprig.report.snapshots import Snapshot
from flaprig.report.wake import VIEW, draw_scene, largest_circulation

# dots per inch of the screen
SCREEN = 100
# free room around the wake, over its size
MARGIN = 0.04


def animate(
    shots: Sequence[Snapshot], sweep_amplitude: float, width: int, height: int
) -> Iterator[NDArray[np.uint8]]:
    """Pictures (height, width, 3) of the snapshots, all in one scale and one set of colours."""
    limit = largest_circulation(list(shots))
    low, high = _extent(shots)
    for shot in shots:
        with style.figure(width / SCREEN, height / SCREEN, arranged=False) as drawing:
            drawing.set_dpi(SCREEN)
            axes = drawing.add_axes((0.0, 0.0, 1.0, 1.0))
            draw_scene(axes, shot, sweep_amplitude, limit)
            axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
            axes.axis("off")
            drawing.canvas.draw()
            yield np.asarray(drawing.canvas.buffer_rgba())[..., :3].copy()  # type: ignore[attr-defined]


def _extent(shots: Sequence[Snapshot]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Corners of the part of the picture plane in which all the scenes lie."""
    points = [VIEW.project(part)[0].reshape(-1, 2) for s in shots for part in (s.wing, s.wake)]
    low, high = np.min(np.concatenate(points), 0), np.max(np.concatenate(points), 0)
    room = MARGIN * (high - low)
    return low - room, high + room
