"""The pinhole camera against closed forms."""

from __future__ import annotations

import numpy as np

from flaprig.report.camera import Camera, faces, shading


def test_axes_are_right_handed_and_upright() -> None:
    for azimuth in np.linspace(-3, 3, 7):
        axes = Camera(azimuth=azimuth, elevation=0.4).axes
        np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
        np.testing.assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-12)
        assert axes[0, 2] == 0.0 and axes[1, 2] > 0.0


def test_target_is_the_centre_and_nearness_grows_towards_the_camera() -> None:
    camera = Camera(target=(1.0, 2.0, 3.0), azimuth=0.3, elevation=0.5, distance=2.0)
    flat, near = camera.project(np.array(camera.target))
    np.testing.assert_allclose([*flat, near], 0.0, atol=1e-12)
    closer = np.array(camera.target) + 0.5 * camera.axes[2]
    assert np.isclose(camera.project(closer)[1], 0.5)


def test_perspective_is_similar_triangles() -> None:
    camera = Camera(distance=2.0)
    right, _, towards = camera.axes
    flat, _ = camera.project(0.1 * right + 1.0 * towards)
    np.testing.assert_allclose(flat, [0.2, 0.0], atol=1e-12)


def test_faces_tile_a_grid() -> None:
    x, y = np.meshgrid(np.arange(4.0), np.arange(3.0), indexing="ij")
    quads = faces(np.stack([x, y, 0 * x], axis=-1))
    assert quads.shape == (6, 4, 3)
    diagonals = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    np.testing.assert_allclose(0.5 * np.abs(diagonals[:, 2]).sum(), 6.0)


def test_shading_stays_in_its_range() -> None:
    quads = np.random.default_rng(0).normal(size=(200, 4, 3))
    bright = shading(quads, least=0.6)
    assert bright.min() >= 0.6 and bright.max() <= 1.0 + 1e-12
    assert np.isfinite(shading(np.zeros((1, 4, 3)))).all()
