"""The picture of wing and wake: rings coloured by circulation, over the stroke plane."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from flaprig.report import style
from flaprig.report.camera import Camera, faces, shading
from flaprig.report.snapshots import Snapshot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

# where the wake is looked at from: before the stroke's middle, a little above it
VIEW = Camera(target=(0.10, 0.0, -0.09), azimuth=np.radians(-38.0), elevation=0.42, distance=1.6)
# opacity of the newest ring; it fades with age, because old rings fold into each other
OPAQUE, FADING = 0.96, 1.4


def largest_circulation(shots: list[Snapshot]) -> float:
    """Colour limit in [m2/s]: nearly the strongest ring, so that one outlier fades nothing."""
    sizes = np.concatenate([np.abs(shot.circulation).ravel() for shot in shots])
    return float(np.percentile(sizes[sizes > 0.0], 99.5)) if np.any(sizes > 0.0) else 1.0


def draw_scene(axes: Axes, shot: Snapshot, sweep_amplitude: float, limit: float) -> None:
    """Stroke plane, wake and wing, far things first."""
    from matplotlib.collections import PolyCollection

    _draw_stroke_plane(axes, shot, sweep_amplitude)
    quads, colours, edges = _sheet(shot, limit)
    plate, tint = _plate(shot)
    flat, near = VIEW.project(np.concatenate([quads, plate]))
    order = np.argsort(near.mean(axis=1))
    face = np.concatenate([colours, tint])[order]
    edge = np.concatenate([edges, tint])[order]
    outlines = list(flat[order])
    axes.add_collection(PolyCollection(outlines, facecolors=face, edgecolors=edge, lw=0.35))


def _sheet(shot: Snapshot, limit: float) -> tuple[Array, Array, Array]:
    """Quads of the wake with face and edge colours; rings never shed are left out."""
    rows, strips = shot.circulation.shape
    strength = shot.circulation.ravel()
    quads = faces(shot.wake)
    shed = np.any(shot.circulation != 0.0, axis=1).repeat(strips)
    age = np.repeat(np.linspace(0.0, 1.0, rows), strips)
    colours = style.circulation_colours()(0.5 + 0.5 * np.clip(strength / limit, -1.0, 1.0))
    colours[:, :3] *= shading(quads)[:, None]
    colours[:, 3] = OPAQUE * (1.0 - age) ** FADING + 0.02
    edges = colours.copy()
    edges[:, :3] *= 0.8
    edges[:, 3] *= 1.0 - 0.7 * age
    return quads[shed], colours[shed], edges[shed]


def _plate(shot: Snapshot) -> tuple[Array, Array]:
    """Quads of the wing, dark so that it stands out of the wake."""
    quads = faces(shot.wing)
    colours = np.tile([0.16, 0.17, 0.19, 1.0], (len(quads), 1))
    colours[:, :3] *= shading(quads)[:, None]
    return quads, colours


def _draw_stroke_plane(axes: Axes, shot: Snapshot, amplitude: float) -> None:
    """The sector that the wing sweeps, the axis, and the ends of the stroke."""
    from matplotlib.patches import Polygon

    radii = np.linalg.norm(shot.wing[:, :, :2], axis=-1)
    tip, root = radii.max(), radii.min()
    arc = np.linspace(-amplitude, amplitude, 81)
    outer, inner = _circle(arc, tip), _circle(arc[::-1], root)
    sector, _ = VIEW.project(np.concatenate([outer, inner]))
    axes.add_patch(Polygon(sector, facecolor="#EEF1F3", edgecolor="none", zorder=0))
    rim, _ = VIEW.project(outer)
    axes.plot(*rim.T, color=style.GREY, lw=0.9, ls=(0, (4, 3)), zorder=0.5)
    for end in (-amplitude, amplitude):
        ray, _ = VIEW.project(_circle(np.array([end, end]), np.array([0.0, tip])))
        axes.plot(*ray.T, color=style.GREY, lw=0.9, ls=(0, (4, 3)), zorder=0.5)
    label, _ = VIEW.project(_circle(np.array([amplitude]), 1.04 * tip))
    x, y = label[0]
    axes.text(x, y, "stroke plane", color=style.GREY, fontsize=8.5, ha="left", va="bottom")


def _circle(angle: Array, radius: float | Array) -> Array:
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.0 * angle], axis=-1)


def draw_wake(path: Path, shot: Snapshot, sweep_amplitude: float, title: str) -> None:
    """Picture of wing and wake.

    Args:
        path: where to write; the ending chooses the format.
        shot: wing and wake.
        sweep_amplitude: half angle of the stroke plane's sector in [rad].
        title: above the picture.
    """
    limit = largest_circulation([shot])
    with style.figure(7.0, 5.6) as drawing:
        axes = drawing.add_subplot()
        draw_scene(axes, shot, sweep_amplitude, limit)
        axes.set_aspect("equal")
        axes.autoscale_view()
        axes.axis("off")
        _colour_bar(axes, limit)
        drawing.suptitle(title, x=0.01, ha="left", fontsize=11.5)
        style.save(drawing, path)


def _colour_bar(axes: Axes, limit: float) -> None:
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    # [cm2/s]: numbers of a rig in water are then of order one to a hundred
    mappable = ScalarMappable(Normalize(-1e4 * limit, 1e4 * limit), style.circulation_colours())
    bar = axes.figure.colorbar(mappable, ax=axes, shrink=0.5, aspect=22, pad=0.01)
    bar.set_label("ring circulation [cm²/s]")
    bar.outline.set_visible(False)
