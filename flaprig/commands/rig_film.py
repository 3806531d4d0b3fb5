"""A video of the rig by the best means of this machine; used by `view` and `demo`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from flaprig.aero.models import UVLM
from flaprig.commands.progress import progress
from flaprig.render import gl
from flaprig.report import video
from flaprig.report.animation import animate
from flaprig.report.film import Format, film, instants
from flaprig.report.flight import Flight
from flaprig.report.folder import Folder
from flaprig.report.snapshots import snapshots
from flaprig.rig import Rig
from flaprig.strokes.stroke import Stroke
from flaprig.twin import Twin

# pictures per second of a wake drawn by matplotlib: each takes long
SLOW_RATE = 10.0


@dataclass(frozen=True)
class Filmed:
    """What was made.

    Attributes:
        path: the file.
        words: how it was made, and how to get a better one.
    """

    path: Path
    words: str


def film_rig(
    folder: Folder, name: str, rig: Rig, stroke: Stroke, cycles: tuple[float, float], form: Format
) -> Filmed:
    """Write a video of the rig between two instants, counted in cycles from still water.

    Args:
        folder: where to write.
        name: of the file, without ending; with ".mp4" or ".gif" it is kept.
        rig: the rig; its model's wake is drawn.
        stroke: the stroke.
        cycles: first and last instant.
        form: size and pace.

    Raises:
        ImportError: the plugin library is missing or does not fit MuJoCo.
        OSError: the file cannot be written.
        ValueError: an MP4 is asked for where none can be written.
    """
    best = video.ending()
    file = name if Path(name).suffix in (".mp4", ".gif") else name + best
    if file.endswith(".mp4") and best != ".mp4":
        raise ValueError(f"{file} cannot be written as MP4 here; {video.ADVICE}")
    advice = "" if best == ".mp4" else f"; {video.ADVICE}"
    backend = gl.backend()
    if backend is not None:
        _film(folder, file, rig, stroke, cycles, form, backend)
        return _filmed(folder, f"rendered by MuJoCo with {backend}{advice}")
    _draw(folder, file, rig, stroke, cycles, form)
    return _filmed(folder, f"drawn by matplotlib: no OpenGL works here; {gl.ADVICE}{advice}")


def _filmed(folder: Folder, words: str) -> Filmed:
    return Filmed(folder.written[-1], words)


def _film(
    folder: Folder,
    file: str,
    rig: Rig,
    stroke: Stroke,
    cycles: tuple[float, float],
    form: Format,
    backend: str,
) -> None:
    when = instants(cycles[0] * stroke.period, cycles[1] * stroke.period, form.rate)
    flight = Flight(Twin(rig), stroke)
    with progress("video") as told:
        pictures = film(flight, when, backend, form, told)
        folder.write(file, lambda draft: video.write_video(draft, pictures, form.rate))


def _draw(
    folder: Folder, file: str, rig: Rig, stroke: Stroke, cycles: tuple[float, float], form: Format
) -> None:
    model = rig.model if isinstance(rig.model, UVLM) else UVLM()
    when = instants(cycles[0] * stroke.period, cycles[1] * stroke.period, SLOW_RATE)
    with progress("wake") as told:
        source = snapshots(rig.wing, stroke, model, when / stroke.period, rig.fluid, told)
        shots = list(source)
    pictures = animate(shots, stroke.sweep_amplitude, form.width, form.height)
    folder.write(file, lambda draft: video.write_video(draft, pictures, SLOW_RATE))
