"""The wing's plate as a MuJoCo geom: a box for a rectangle, else a solid mesh of the planform."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check
from flaprig.rig.document import add, section
from flaprig.rig.names import Geom
from flaprig.wing import Wing

Array = NDArray[np.float64]

# name of the mesh of a plate that is not a rectangle
MESH = "plate"
# by how much geom and plugin may differ, of the mean chord, and across of the thickness
SAME = 1e-3
_OWNER = "rig's file"
# attributes of a geom that say its shape, place and weight
_PLACED = (
    *("type", "size", "mesh", "fitscale", "fromto", "pos", "shellinertia"),
    *("quat", "axisangle", "xyaxes", "zaxis", "euler"),
)


def density(plate: mujoco.MjsGeom, wing: Wing) -> float:
    """Of the geom in [kg/m3], from its mass where it is given that."""
    mass = float(plate.mass)
    return mass / wing.volume if math.isfinite(mass) else float(plate.density)


def require_same(model: mujoco.MjModel, wing: Wing) -> None:
    """Refuse a plate that is not the wing that the fluid sees.

    Raises:
        ValueError: names what differs, in the geom and in the plugin.
    """
    geom = model.geom(Geom.PLATE)
    shape = mujoco.mjtGeom(int(geom.type[0]))
    if shape not in (mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_MESH):
        kind = shape.name.removeprefix("mjGEOM_").lower()
        raise check.fail(_OWNER, f"geom {Geom.PLATE}", "a box or a mesh", kind)
    if shape is mujoco.mjtGeom.mjGEOM_BOX and not wing.is_rectangle:
        allowed = "a mesh: the plugin's stations are no rectangle"
        raise check.fail(_OWNER, f"geom {Geom.PLATE}", allowed, "a box")
    low, high = _extent(model, geom)
    half = wing.thickness / 2.0
    corners = outline(wing)
    wanted = np.array([[*corners.min(axis=0), -half], [*corners.max(axis=0), half]])
    slack = SAME * np.array([wing.mean_chord, wing.mean_chord, wing.thickness])
    # written so that NaN counts as outside
    same = (np.abs(np.array([low, high]) - wanted) <= slack).all(axis=0)
    for k in np.flatnonzero(~same):
        (first, last), axis = wanted[:, k], "xyz"[k]
        allowed = f"from {first:.6g} to {last:.6g} m, where the plugin's wing is"
        got = f"{low[k]:.6g} to {high[k]:.6g}"
        raise check.fail(_OWNER, f"{axis} of geom {Geom.PLATE}", allowed, got)
    mass = float(model.body_mass[geom.bodyid[0]])
    if mass < (1.0 - 10.0 * SAME) * wing.mass:
        allowed = f"at least that of its plate, {wing.mass:.6g} kg"
        raise check.fail(_OWNER, "mass of the wing's body", allowed, mass)


def _extent(model: mujoco.MjModel, geom: Any) -> tuple[Array, Array]:
    """Least and largest x, y, z of the geom in its body's frame, in [m]. Two of shape (3,)."""
    if int(geom.type[0]) == int(mujoco.mjtGeom.mjGEOM_BOX):
        signs = np.array(np.meshgrid(*[[-1.0, 1.0]] * 3)).reshape(3, -1).T
        points = signs * geom.size
    else:
        start, count = (field[geom.dataid[0]] for field in (model.mesh_vertadr, model.mesh_vertnum))
        points = model.mesh_vert[start : start + count].astype(float)
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, geom.quat)
    points = points @ turn.reshape(3, 3).T + geom.pos
    return points.min(axis=0), points.max(axis=0)


def write(root: ET.Element, old: Wing, new: Wing) -> None:
    """Give the geom `plate`, whose body has the wing frame, another wing's shape and density.

    Its mass and inertia are then those of the new wing. Numbers that are the same in both stay as
    they are written.
    """
    geom = next(g for g in root.iterfind(".//worldbody//geom") if g.get("name") == Geom.PLATE)
    if new.density != old.density or geom.attrib.pop("mass", None) is not None:
        geom.attrib.pop("mass", None)
        geom.set("density", repr(new.density))
    if replace(new, density=old.density) == old:
        return
    if old.is_rectangle and new.is_rectangle and geom.get("size") and geom.get("pos"):
        before, after = _box(old), _box(new)
        for name, values in after.items():
            given = map(float, geom.get(name, "").split())
            rows = zip(given, before[name], values, strict=False)
            geom.set(name, _text([g if b == v else v for g, b, v in rows]))
        return
    for name in _PLACED:
        geom.attrib.pop(name, None)
    for asset in root.findall("asset"):
        for former in asset.findall(f"mesh[@name='{MESH}']"):
            asset.remove(former)
    if new.is_rectangle:
        geom.set("type", "box")
        for name, values in _box(new).items():
            geom.set(name, _text(values))
        return
    # the vertices are in the wing frame already
    geom.set("type", "mesh")
    geom.set("mesh", MESH)
    vertices, faces = mesh(new)
    add(
        section(root, "asset"),
        "mesh",
        name=MESH,
        inertia="exact",
        vertex=_text(vertices.ravel()),
        face=" ".join(map(str, faces.ravel().tolist())),
    )


def _box(wing: Wing) -> dict[str, Array]:
    """Half sizes and centre of a rectangle in [m]."""
    return {
        "size": np.array([wing.chord[0], wing.span, wing.thickness]) / 2.0,
        "pos": wing.centroid,
    }


def _text(values: ArrayLike) -> str:
    return " ".join(map(repr, np.asarray(values, dtype=float).tolist()))


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
