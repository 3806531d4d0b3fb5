"""Vorticity in hover: impulse against force, and Kelvin's theorem in the wake's bookkeeping."""

from itertools import pairwise

import numpy as np
import pytest

from flaprig.aero.air import Air
from flaprig.aero.models import UVLM
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING
from tests.laws.motions import ticks

STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4)


def hover(model, cycles=1.0):
    count, step = round(cycles * model.steps_per_cycle), STROKE.period / model.steps_per_cycle
    air = Air(RIG_WING, WATER, model, STROKE.frequency)
    return air, RigidMotion.from_stroke(STROKE.motion(step * np.arange(count))), step


def ring_impulse(vertices, circulation):
    """Sum of circulation times area vector of the rings of a sheet. Shape (3,)."""
    first = vertices[1:, 1:] - vertices[:-1, :-1]
    second = vertices[1:, :-1] - vertices[:-1, 1:]
    return 0.5 * np.einsum("ij,ijk->k", circulation, np.cross(first, second))


def impulses(air, motion, step):
    """Normal force of each step, and the impulse of the fluid by all rings after it."""
    forces, impulse = [], []
    for i in range(len(motion)):
        loads, bound = ticks(air, motion.part(slice(i, i + 1)), step)
        wing = air.lattice @ motion.rotation[i].T
        free, frozen = air.wake()
        # the first wake ring carries the trailing edge's circulation (Kutta)
        wake = np.concatenate([wing[-1:], free]), np.concatenate([bound[0, -1:], frozen])
        impulse.append(WATER.density * (ring_impulse(wing, bound[0]) + ring_impulse(*wake)))
        forces.append(loads.total[0, 2])
    return np.array(forces), np.array(impulse)


def test_normal_force_is_minus_the_rate_of_the_impulse():
    model = UVLM(chordwise=4, spanwise=8, steps_per_cycle=200, suction_efficiency=0.0)
    air, motion, step = hover(model)
    force, impulse = impulses(air, motion, step)
    rate = -(impulse[2:] - impulse[:-2]) / (2 * step)
    expected = np.einsum("ni,ni->n", rate, motion.rotation[1:-1, :, 2])[3:]
    force = force[1:-1][3:]
    assert np.corrcoef(force, expected)[0, 1] > 0.99
    assert force @ expected / (expected @ expected) == pytest.approx(1.0, abs=0.02)
    assert np.abs(force).mean() / np.abs(expected).mean() == pytest.approx(1.0, abs=0.025)


@pytest.fixture(scope="module")
def aged():
    """Air, trailing-edge circulation after each step, and what the wake held after each."""
    model = UVLM(chordwise=3, spanwise=5, steps_per_cycle=20)
    air, motion, step = hover(model, 1.5)
    edge, strengths = [], []
    for i in range(len(motion)):
        bound = ticks(air, motion.part(slice(i, i + 1)), step)[1]
        edge.append(bound[0, -1])
        strengths.append(air.wake()[1])
    return air, np.array(edge), strengths


def test_wake_rings_are_the_shed_circulations_bit_for_bit(aged):
    _, edge, strengths = aged
    for i, rings in enumerate(strengths):
        # newest first: the step before this one, and so on back in time
        expected = edge[:i][::-1][:20]
        np.testing.assert_array_equal(rings, expected.reshape(-1, 5))
    assert np.ptp(edge) > 0


def test_wake_grows_by_a_row_a_step_and_drops_only_the_oldest(aged):
    _, _, strengths = aged
    assert [len(rings) for rings in strengths] == [min(i, 20) for i in range(30)]
    for before, after in pairwise(strengths[20:]):
        np.testing.assert_array_equal(after[1:], before[:-1])


def test_edges_of_a_strip_sum_to_zero(aged):
    air, edge, strengths = aged
    bound = air.native.bound_circulation(air.state)
    column = np.vstack([bound, edge[-1:], strengths[-1]])
    edges = np.diff(np.vstack([0 * column[:1], column, 0 * column[:1]]), axis=0)
    np.testing.assert_allclose(edges.sum(axis=0), 0, atol=1e-15 * np.abs(edges).sum())
    # nothing is left on the trailing edge, where the last bound and the first wake ring meet
    assert not edges[len(bound)].any()
