"""The wing's plate as a MuJoCo geom: a box for a rectangle, else a solid mesh of the planform."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.wing import Wing

Array = NDArray[np.float64]

# name of the mesh of a plate that is not a rectangle
MESH = "plate"


def mount(spec: mujoco.MjSpec, plate: mujoco.MjsGeom, wing: Wing) -> None:
    """Give the geom `plate`, whose body has the wing frame, the shape and density of the wing.

    Its mass and inertia are then those of `wing.mass` and `wing.inertia`.
    """
    plate.density = wing.density
    if is_rectangle(wing):
        plate.type = mujoco.mjtGeom.mjGEOM_BOX
        plate.size = np.array([wing.chord[0], wing.span, wing.thickness]) / 2.0
        plate.pos = wing.centroid
    else:
        _hang_mesh(spec, plate, wing)


def is_rectangle(wing: Wing) -> bool:
    """Whether chord and leading edge are the same at every station."""
    return len(set(wing.chord)) == 1 and len(set(wing.leading_edge)) == 1


def outline(wing: Wing) -> Array:
    """Corners of the planform in the wing frame in [m]: leading edge out, trailing edge back.

    A station of no chord is one corner. Shape (n, 2), columns x and y.
    """
    radius, chord, leading = wing.stations.T
    ahead = np.column_stack([leading, radius])
    behind = np.column_stack([leading + chord, radius])[chord > 0.0]
    return np.vstack([ahead, behind[::-1]])


def mesh(wing: Wing) -> tuple[Array, NDArray[np.int64]]:
    """Vertices in the wing frame in [m] and outward triangles of the solid plate.

    Shapes (2 n, 3) and (m, 3): the n corners of the outline below, then above.
    """
    corners = outline(wing)
    n = len(corners)
    half = np.full((n, 1), wing.thickness / 2.0)
    vertices = np.vstack([np.hstack([corners, -half]), np.hstack([corners, half])])
    flat = _triangles(wing, n)
    ring = np.arange(n)
    ahead = np.roll(ring, -1)
    # the outline runs clockwise seen from +z (out along the leading edge, which lies at less x)
    sides = np.vstack(
        [np.column_stack([ring, ring + n, ahead]), np.column_stack([ahead, ring + n, ahead + n])]
    )
    return vertices, np.vstack([flat[:, ::-1] + n, flat, sides])


def _triangles(wing: Wing, n: int) -> NDArray[np.int64]:
    """Triangles of the outline, clockwise seen from +z: one strip between two stations."""
    chord = np.asarray(wing.chord)
    count = len(chord)
    # corner behind each station; a pointed station is its own
    full = np.flatnonzero(chord > 0.0)
    behind = np.arange(count)
    behind[full] = n - 1 - np.arange(len(full))
    found = []
    for i in range(count - 1):
        if behind[i] != i:
            found.append((i, i + 1, behind[i]))
        if behind[i + 1] != i + 1:
            found.append((i + 1, behind[i + 1], behind[i]))
    return np.array(found)


def _hang_mesh(spec: mujoco.MjSpec, plate: mujoco.MjsGeom, wing: Wing) -> None:
    vertices, faces = mesh(wing)
    solid = spec.add_mesh(name=MESH)
    solid.uservert = vertices.ravel()
    solid.userface = faces.ravel().astype(np.int32)
    solid.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_EXACT
    # the vertices are in the wing frame already
    plate.type = mujoco.mjtGeom.mjGEOM_MESH
    plate.meshname = MESH
    plate.pos = np.zeros(3)
