"""A pinhole camera for pictures of surfaces without a graphics library: project, sort, shade."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# direction towards the light [world frame]: high, from the viewer's left
LIGHT = np.array([0.35, -0.55, 0.76])


@dataclass(frozen=True)
class Camera:
    """A pinhole camera that looks at a target, z upward in the picture.

    Attributes:
        target: what it looks at [m]. Length 3.
        azimuth: of the camera around the target, from +x towards +y [rad].
        elevation: of the camera above the target [rad], inside -pi/2 to pi/2.
        distance: to the target [m]; a small one gives a strong perspective.
    """

    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    azimuth: float = 0.0
    elevation: float = 0.3
    distance: float = 1.5

    @property
    def axes(self) -> Array:
        """Rows: right, up and towards the camera, in the world frame. Shape (3, 3)."""
        ca, sa = np.cos(self.azimuth), np.sin(self.azimuth)
        ce, se = np.cos(self.elevation), np.sin(self.elevation)
        return np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])

    def project(self, points: Array) -> tuple[Array, Array]:
        """Picture coordinates [m at the target] and nearness [m] of points. Shapes (..., 2), (...).

        Larger nearness is closer to the camera.
        """
        seen = (points - np.asarray(self.target)) @ self.axes.T
        scale = self.distance / (self.distance - seen[..., 2])
        return seen[..., :2] * scale[..., None], seen[..., 2]


def faces(grid: Array) -> Array:
    """Quadrilaterals of a grid of vertices (m, n, 3), row by row. Shape ((m-1)(n-1), 4, 3)."""
    corners = (grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:])
    return np.stack(corners, axis=2).reshape(-1, 4, grid.shape[-1])


def shading(quads: Array, least: float = 0.7) -> Array:
    """Brightness of two-sided faces, least (edge on to the light) to 1 (facing it). Shape (n,)."""
    normals = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    lengths = np.linalg.norm(normals, axis=1)
    facing = np.abs(normals @ LIGHT) / np.maximum(lengths * np.linalg.norm(LIGHT), 1e-300)
    return least + (1.0 - least) * facing
