"""Films of the rig and its wake: rendered by MuJoCo, or drawn by matplotlib where no GL works."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.air import Progress
from flaprig.report.flight import Flight
from flaprig.report.painter import Painter

Picture = NDArray[np.uint8]


@dataclass(frozen=True)
class Format:
    """Size and pace of a film.

    Attributes:
        width: in pixels, a multiple of 16.
        height: in pixels, a multiple of 16.
        rate: pictures per second of the film.
    """

    width: int = 960
    height: int = 544
    rate: float = 25.0


def instants(first: float, last: float, rate: float) -> NDArray[np.float64]:
    """Instants of the pictures of a film that runs as fast as the world, in [s]."""
    return first + np.arange(max(1, round((last - first) * rate))) / rate


def close_view() -> mujoco.MjvCamera:
    """Wing and wake in the tank, from above the water and the front."""
    view = mujoco.MjvCamera()
    view.type = mujoco.mjtCamera.mjCAMERA_FREE
    view.lookat[:] = 0.06, 0.0, -0.02
    view.azimuth, view.elevation, view.distance = 143.0, -18.0, 0.95
    return view


def film(
    flight: Flight, when: NDArray[np.float64], backend: str, form: Format, progress: Progress | None
) -> Iterator[Picture]:
    """Pictures of the rig at increasing instants in [s], rendered by MuJoCo."""
    view = close_view()
    with Painter(flight.model, backend, form.width, form.height) as painter:
        for number, data in enumerate(flight.at(when), 1):
            yield painter.paint(data, view)
            if progress is not None:
                progress(number / len(when))
