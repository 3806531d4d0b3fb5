"""The plate: box or mesh, its mass and inertia are the wing's."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pytest

from flaprig.rig import plate
from flaprig.wing import RIG_WING, Wing

WINGS = {
    "rectangle": RIG_WING,
    "beta": Wing.beta(span=0.24, mean_chord=0.06, r1=0.5, r2=0.559),
    "pointed tip": Wing.from_table([0.02, 0.1, 0.3], [0.05, 0.08, 0.0], [-0.01, -0.02, 0.03]),
    "pointed root": Wing.from_table([0.0, 0.1, 0.3], [0.0, 0.08, 0.03]),
    "swept": Wing.from_table([0.02, 0.3], [0.05, 0.05], [-0.01, 0.05]),
    "waist": Wing.from_table([0.02, 0.1, 0.2], [0.08, 0.01, 0.08], thickness=0.002),
}
# what the geom was before
OTHER = Wing.rectangular(0.1, 0.02, density=500.0)


@pytest.fixture(params=WINGS.values(), ids=WINGS.keys())
def wing(request: pytest.FixtureRequest) -> Wing:
    return request.param


def test_mass_and_inertia_are_the_wings(wing: Wing) -> None:
    root = ET.Element("mujoco")
    body = ET.SubElement(ET.SubElement(root, "worldbody"), "body")
    ET.SubElement(body, "geom", name="plate", size="1", euler="1 2 3", mass="7")
    plate.write(root, OTHER, wing)
    model = mujoco.MjModel.from_xml_string(ET.tostring(root, "unicode"))
    # what was written is what the fluid sees
    plate.require_same(model, wing)
    mass, centre, inertia = plate_properties(model)
    # meshes are stored in single precision
    assert mass == pytest.approx(wing.mass, rel=1e-6)
    np.testing.assert_allclose(centre, wing.centroid, atol=1e-6 * wing.tip_radius)
    np.testing.assert_allclose(inertia, wing.inertia, atol=1e-6 * wing.inertia.max())


def plate_properties(model: mujoco.MjModel) -> tuple[float, np.ndarray, np.ndarray]:
    """Mass, centre and inertia about the body's origin, of body 1."""
    mass, centre = model.body_mass[1], model.body_ipos[1]
    axes = np.zeros(9)
    mujoco.mju_quat2Mat(axes, model.body_iquat[1])
    axes = axes.reshape(3, 3)
    about_centre = axes @ np.diag(model.body_inertia[1]) @ axes.T
    shift = centre @ centre * np.eye(3) - np.outer(centre, centre)
    return mass, centre, about_centre + mass * shift


def test_mesh_is_closed_and_points_outwards(wing: Wing) -> None:
    """Every edge once each way; the divergence theorem gives plus the volume."""
    vertices, faces = plate.mesh(wing)
    edges = [edge for a, b, c in faces for edge in ((a, b), (b, c), (c, a))]
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)
    a, b, c = vertices[faces].transpose(1, 0, 2)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0
    assert volume == pytest.approx(wing.volume, rel=1e-12)


def test_only_rectangles_are_boxes() -> None:
    assert [name for name, wing in WINGS.items() if wing.is_rectangle] == ["rectangle"]
