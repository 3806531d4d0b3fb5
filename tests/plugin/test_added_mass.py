"""Added mass is mass: against MuJoCo's own armature, in M, and under finite differences."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    BLADES,
    LATTICE,
    ONLY_ADDED_MASS,
    PLATE,
    SITES,
    Array,
    added_mass,
    document,
    full_mass,
    instance,
    kind_of,
    load,
    random_state,
    reading,
    site_jacobian,
    two_hinges,
    wing,
)

INTEGRATORS = ("Euler", "implicitfast", "implicit", "discrete")


def pitching(integrator: str, water: bool, joint: str = "", rest: str = "") -> str:
    """A wing that only pitches, in water, or dry with the water's inertia as armature."""
    inertia = "" if water else f'armature="{float(added_mass(ONLY_ADDED_MASS)[2, 2])!r}"'
    hinge = f'<joint name="pitch" axis="0 -1 0" {inertia} {joint}/>'
    extension = instance(ONLY_ADDED_MASS) if water else ""
    body = wing(hinge, air="air" if water else "")
    option = f'gravity="0 0 -9.81" integrator="{integrator}" timestep="0.005"'
    return document(extension, body, option, rest)


def swing(model: mujoco.MjModel, steps: int = 400) -> Array:
    """Angle and rate along the way. Shape (steps, 2)."""
    data, path = mujoco.MjData(model), np.zeros((steps, 2))
    data.qpos[:], data.qvel[:] = 0.7, -2.0
    for i in range(steps):
        mujoco.mj_step(model, data)
        path[i] = data.qpos[0], data.qvel[0]
    return path


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize(
    ("joint", "rest"),
    [
        ("", ""),
        ('stiffness="0.01" damping="2e-4"', ""),
        ("", '<actuator><position joint="pitch" kp="2" kv="0.02"/></actuator>'),
        ('range="-0.5 0.5"', ""),
    ],
    ids=["free", "spring", "servo", "stop"],
)
def test_added_mass_is_armature(integrator: str, joint: str, rest: str) -> None:
    """About one axis J^T A J is a constant, which MuJoCo knows as armature."""
    water = load(pitching(integrator, True, joint, rest))
    armature = load(pitching(integrator, False, joint, rest))
    # the stop's weight is not the plugin's business (test_stops.py)
    water.dof_invweight0[:] = armature.dof_invweight0
    ours, theirs = swing(water), swing(armature)
    dry = load(pitching(integrator, False, joint, rest))
    dry.dof_armature[:] = 0.0
    assert np.abs(swing(dry) - theirs).max() > 0.05
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max())


def two_wings(left: dict[str, str] | None, right: dict[str, str] | None) -> str:
    """A body in the air, on a free joint, with two wings on their own hinges."""
    wings, extension = "", ""
    for name, side, air in (("left", 1, left), ("right", -1, right)):
        joints = (
            f'<joint name="{name}_sweep" axis="1 0 0"/><joint name="{name}_pitch" axis="0 1 0"/>'
        )
        content = PLATE + SITES.replace("wing_frame", name).replace("load_cell", f"{name}_cell")
        place = f'pos="0 {0.05 * side} 0.02" euler="0 0 {1.5707963 - 1.5707963 * side}"'
        body = wing(joints, content, name if air else "", place)
        wings += body.replace('name="wing"', f'name="{name}_wing"')
        extension += instance(air | {"site": name}, name) if air else ""
    sensors = "".join(
        f'<plugin name="{name}" plugin="{kind_of(air)}" instance="{name}" objtype="body" '
        f'objname="{name}_wing"/>'
        for name, air in (("left", left), ("right", right))
        if air
    )
    trunk = f'<body name="trunk"><freejoint/><geom type="box" size=".1 .04 .03"/>{wings}</body>'
    return document(extension, trunk, rest=f"<sensor>{sensors}</sensor>")


AIR = {"density": "1.2"}
THIN_BLADES, THIN_LATTICE = BLADES | AIR, LATTICE | AIR
PAIRS = {
    "blades": (THIN_BLADES, THIN_BLADES),
    "lattices": (THIN_LATTICE, THIN_LATTICE),
    "mixed": (THIN_BLADES, LATTICE),
    "mixed the other way": (LATTICE, THIN_BLADES),
}


def widened(air: dict[str, str]) -> Array:
    """The added mass as a matrix on the whole twist. Shape (6, 6)."""
    whole = np.zeros((6, 6))
    whole[2:5, 2:5] = added_mass(air)
    return whole


@pytest.mark.parametrize("name", PAIRS)
def test_mass_of_both_wings_is_in_m(name: str) -> None:
    """M = M without air + J^T A J of each wing, on a body that is not ours."""
    left, right = PAIRS[name]
    wet, dry = load(two_wings(left, right)), load(two_wings(None, None))
    for seed in range(3):
        data, without = random_state(wet, seed), random_state(dry, seed)
        mujoco.mj_forward(wet, data)
        mujoco.mj_forward(dry, without)
        expected = full_mass(dry, without)
        for side, air in (("left", left), ("right", right)):
            jacobian = site_jacobian(wet, data, side)
            expected += jacobian.T @ widened(air) @ jacobian
        mass = full_mass(wet, data)
        np.testing.assert_allclose(mass, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
        assert np.abs(mass - full_mass(dry, without)).max() > 1e-6
        solved = np.zeros_like(mass)
        mujoco.mj_solveM(wet, data, solved, np.eye(wet.nv))
        np.testing.assert_allclose(solved @ mass, np.eye(wet.nv), atol=1e-8)


def test_mass_is_added_once_however_often_it_is_asked_for() -> None:
    model = load(two_wings(THIN_BLADES, LATTICE))
    data = random_state(model, 1)
    mujoco.mj_forward(model, data)
    mass, acceleration = data.M.copy(), data.qacc.copy()
    mujoco.mj_forward(model, data)
    mujoco.mj_forwardSkip(model, data, mujoco.mjtStage.mjSTAGE_POS, 0)
    mujoco.mj_forwardSkip(model, data, mujoco.mjtStage.mjSTAGE_POS, 0)
    mujoco.mj_inverse(model, data)
    np.testing.assert_array_equal(data.M, mass)
    np.testing.assert_allclose(data.qacc, acceleration, rtol=1e-9)


def test_wings_do_not_disturb_each_other() -> None:
    """The instances have no common memory: a wing reads the same with and without the other."""
    both = load(two_wings(LATTICE, THIN_BLADES))
    alone = load(two_wings(LATTICE, None))
    together, single = random_state(both, 3), random_state(alone, 3)
    for _ in range(40):
        # the trunk would feel the other wing: all joints are moved by hand
        qpos, qvel = together.qpos.copy(), together.qvel.copy()
        mujoco.mj_forward(both, together)
        mujoco.mj_forward(alone, single)
        mujoco.mj_step(both, together)
        mujoco.mj_step(alone, single)
        start = slice(both.plugin_stateadr[0] + 16, None)
        n = alone.plugin_statenum[0] - 16
        np.testing.assert_array_equal(
            together.plugin_state[start][:n], single.plugin_state[16 : 16 + n]
        )
        mujoco.mj_integratePos(both, qpos, qvel, both.opt.timestep)
        for data in (together, single):
            data.qpos[:], data.qvel[:] = qpos, qvel
    assert np.abs(reading(single, "left")).max() > 0


def finite_differences(model: mujoco.MjModel, data: mujoco.MjData, eps: float) -> Array:
    """Centred differences of one step over (q, v). Shape (2 nv, 2 nv)."""
    nv, columns = model.nv, []
    for i in range(2 * nv):
        ends = []
        for sign in (1.0, -1.0):
            moved = mujoco.MjData(model)
            mujoco.mj_copyData(moved, model, data)
            change = np.zeros(nv)
            if i < nv:
                change[i] = 1.0
                mujoco.mj_integratePos(model, moved.qpos, change, sign * eps)
            else:
                moved.qvel[i - nv] += sign * eps
            mujoco.mj_step(model, moved)
            ends.append(moved)
        turn = np.zeros(nv)
        mujoco.mj_differentiatePos(model, turn, 2 * eps, ends[1].qpos, ends[0].qpos)
        columns.append(np.concatenate([turn, (ends[0].qvel - ends[1].qvel) / (2 * eps)]))
    return np.array(columns).T


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "implicit"])
def test_transition_matrix_is_the_finite_difference(integrator: str) -> None:
    """`mjd_transitionFD` skips the position stage; M must still be right, for both wings."""
    model = load(two_wings(THIN_BLADES, THIN_BLADES).replace("implicitfast", integrator))
    data = random_state(model, 2)
    mujoco.mj_forward(model, data)
    size, eps = 2 * model.nv, 1e-6
    ours = np.zeros((size, size))
    mujoco.mjd_transitionFD(model, data, eps, True, ours, None, None, None)
    expected = finite_differences(model, data, eps)
    np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-7 * np.abs(expected).max())


@pytest.mark.parametrize("air", [BLADES, LATTICE], ids=["blades", "lattice"])
def test_inverse_undoes_forward(air: dict[str, str]) -> None:
    """`mj_inverse` uses d->M: the added mass is in there already, once."""
    model = load(two_hinges(air, 'integrator="Euler"'))
    data = random_state(model, 4, 1.0)
    mujoco.mj_step(model, data, nstep=50)
    data.qfrc_applied[:] = 0.02, -0.001
    mujoco.mj_forward(model, data)
    mujoco.mj_inverse(model, data)
    np.testing.assert_allclose(data.qfrc_inverse, data.qfrc_applied, rtol=1e-10, atol=1e-15)


@pytest.mark.parametrize("air", [BLADES, LATTICE], ids=["blades", "lattice"])
def test_sleeping_wing_keeps_its_mass(air: dict[str, str]) -> None:
    """MuJoCo rebuilds M only of what is awake."""
    model = load(two_hinges(air))
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    mass = data.M.copy()
    mujoco.mj_step(model, data, nstep=200)
    assert not data.tree_awake.any()
    np.testing.assert_array_equal(data.M, mass)
    data.qfrc_applied[0] = 0.01
    mujoco.mj_step(model, data)
    assert data.tree_awake.all()
    np.testing.assert_allclose(data.M, mass, rtol=1e-9)
    assert data.qvel[0] == pytest.approx(
        0.01 * model.opt.timestep * np.linalg.inv(full_mass(model, data))[0, 0], rel=1e-9
    )
