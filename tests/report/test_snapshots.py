"""Snapshots: the wing where the stroke puts it, the wake joined to its trailing edge."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from flaprig import RIG_WING, UVLM, SunTangStroke, Wing
from flaprig.report.animation import animate
from flaprig.report.snapshots import Snapshot, snapshots
from flaprig.report.wake import draw_wake, largest_circulation

STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4)
COARSE = UVLM(chordwise=2, spanwise=4, steps_per_cycle=20)


@pytest.fixture(scope="module")
def shots() -> list[Snapshot]:
    return list(snapshots(RIG_WING, STROKE, COARSE, np.array([0.25, 0.5, 1.25])))


def test_wing_is_where_the_stroke_puts_it(shots: list[Snapshot]) -> None:
    """At mid-stroke the span lies along +x, and the leading edge leans towards the motion, +y."""
    leading, trailing = shots[0].wing[0], shots[0].wing[-1]
    np.testing.assert_allclose(leading[[0, -1], 0], [0.025, 0.275], atol=1e-12)
    lean = 0.0625 / np.sqrt(2.0)
    np.testing.assert_allclose(leading - trailing, [[0.0, lean, lean]] * 2, atol=1e-12)
    assert [round(shot.time, 9) for shot in shots] == [1.25, 2.5, 6.25]


def test_wake_begins_at_the_trailing_edge(shots: list[Snapshot]) -> None:
    for shot in shots:
        root, tip = shot.wing[-1, 0], shot.wing[-1, -1]
        along = (tip - root) / np.linalg.norm(tip - root)
        offset = shot.wake[0] - root
        beside = offset - np.outer(offset @ along, along)
        assert np.abs(beside).max() < 1e-12
        assert shot.wake.shape[0] == shot.circulation.shape[0] + 1


def test_same_wake_whatever_is_asked_before(shots: list[Snapshot]) -> None:
    alone = next(snapshots(RIG_WING, STROKE, COARSE, np.array([1.25])))
    np.testing.assert_array_equal(alone.wake, shots[-1].wake)


def test_colour_limit_ignores_an_outlier(shots: list[Snapshot]) -> None:
    assert largest_circulation(shots) > 0.0
    still = Snapshot(0.0, shots[0].wing, shots[0].wake, 0.0 * shots[0].circulation)
    assert largest_circulation([still]) == 1.0


def test_picture_and_animation(shots: list[Snapshot], tmp_path: Path) -> None:
    draw_wake(tmp_path / "wake.png", shots[-1], STROKE.sweep_amplitude, "title")
    pixels = np.asarray(Image.open(tmp_path / "wake.png").convert("RGB")).astype(int)
    red, blue = pixels[..., 0], pixels[..., 2]
    # both signs of circulation are in the picture
    assert (red - blue > 80).sum() > 1000 and (blue - red > 80).sum() > 1000
    frames = list(animate(shots, STROKE.sweep_amplitude, 160, 96))
    assert len(frames) == 3
    assert all(frame.shape == (96, 160, 3) and frame.std() > 10 for frame in frames)


def test_pointed_wing() -> None:
    wing = Wing.beta(0.24, 0.06, 0.5)
    shot = next(snapshots(wing, STROKE, COARSE, np.array([0.5])))
    assert np.isfinite(shot.wake).all() and np.isfinite(shot.wing).all()
