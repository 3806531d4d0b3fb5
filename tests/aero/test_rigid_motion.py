"""Pose, twist and its rate of the wing frame, against derivatives of the pose itself."""

import numpy as np

from flaprig.aero.rigid_motion import RigidMotion, wing_axes
from flaprig.strokes import SunTangStroke
from tests.laws.motions import flight

STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4)


def spin_of(motion, step):
    """Angular velocity in wing axes, from central differences of the rotation."""
    rate = (motion.rotation[2:] - motion.rotation[:-2]) / (2 * step)
    skew = np.einsum("nji,njk->nik", motion.rotation[1:-1], rate)
    return np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=-1)


def test_axes_are_those_of_the_paper():
    axes = wing_axes(np.array([0.0]), np.array([0.0]))[0]
    # leading edge up, span along x, and so the normal along +y
    np.testing.assert_array_equal(axes.T, [[0, 0, -1], [1, 0, 0], [0, -1, 0]])
    any_axes = wing_axes(np.linspace(-2, 2, 9), np.linspace(1, -1, 9))
    np.testing.assert_allclose(np.linalg.det(any_axes), 1, atol=1e-14)


def test_leading_edge_leads():
    motion = STROKE.motion(np.array([0.25, 0.75]) / 0.2)
    forward = wing_axes(motion.sweep, motion.pitch)
    along = np.stack([-np.sin(motion.sweep), np.cos(motion.sweep), 0 * motion.sweep], -1)
    towards_edge = -np.einsum("ni,ni->n", forward[:, :, 0], along)
    assert np.all(towards_edge * motion.sweep_rate > 0)


def test_twist_is_the_rate_of_the_pose():
    step = 1e-4
    motion = RigidMotion.from_stroke(STROKE.motion(1.1 + step * np.arange(2000)))
    np.testing.assert_allclose(motion.twist[1:-1, 3:], spin_of(motion, step), atol=1e-7)
    rate = (motion.twist[2:] - motion.twist[:-2]) / (2 * step)
    np.testing.assert_allclose(motion.twist_rate[1:-1], rate, atol=1e-6)
    assert not motion.twist[:, :3].any() and not motion.position.any()


def test_flight_of_the_tests_is_consistent_too():
    step, time = 1e-4, 1e-4 * np.arange(500)
    s, c = np.sin(3 * time), np.cos(3 * time)
    motion = flight(time, 2.0, (s, 3 * c, -9 * s), (0.5 * c, -1.5 * s, -4.5 * c))
    np.testing.assert_allclose(motion.twist[1:-1, 3:], spin_of(motion, step), atol=1e-6)
    velocity = (motion.position[2:] - motion.position[:-2]) / (2 * step)
    ours = np.einsum("nij,nj->ni", motion.rotation, motion.twist[:, :3])[1:-1]
    np.testing.assert_allclose(ours, velocity, atol=1e-6)
    rate = (motion.twist[2:] - motion.twist[:-2]) / (2 * step)
    np.testing.assert_allclose(motion.twist_rate[1:-1], rate, atol=1e-5)


def test_parts_are_views_of_the_same_instants():
    motion = RigidMotion.from_stroke(STROKE.sample(20))
    part = motion.part(slice(5, 9))
    assert len(motion) == 20 and len(part) == 4
    np.testing.assert_array_equal(part.twist, motion.twist[5:9])
