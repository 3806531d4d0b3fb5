"""noslip_iterations, which arenas and animals of others have on: exact with the added mass in M."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    BLADES,
    FREE,
    UPRIGHT,
    Array,
    document,
    full_mass,
    instance,
    load,
    random_state,
    two_hinges,
    wing,
)

AIRS = {"uvlm": FREE, "quasi_steady": BLADES}
NOSLIP = 'noslip_iterations="50" noslip_tolerance="0" gravity="0 0 -9.81"'
# a wing on a free body that stands on the floor, and a box on the floor beside it
STANDING = """<geom type="plane" size="2 2 1" contype="1" conaffinity="1"/>
<body name="beside" pos="1 0 0.0495"><freejoint/>
<geom type="box" size="0.05 0.05 0.05" contype="1" conaffinity="1"/></body>
<body name="stand" pos="0 0 0.0495"><freejoint/>
<geom type="box" size="0.05 0.05 0.05" pos="0.001 0 0" contype="1" conaffinity="1"/>"""


def standing(air: dict[str, str] | None, option: str = "") -> str:
    extension = "" if air is None else instance(air)
    pitch = '<joint name="pitch" axis="0 -1 0" frictionloss="0.01"/>'
    place = f'pos="0 0 0.1" {UPRIGHT}'
    body = wing(pitch, air="" if air is None else "air", place=place)
    return document(extension, STANDING + body + "</body>", f"{NOSLIP} {option}")


def dense(data: mujoco.MjData, model: mujoco.MjModel) -> tuple[Array, Array]:
    """Jacobian of the constraints, and what noslip works with."""
    n = data.nefc
    if not mujoco.mj_isSparse(model):
        return data.efc_J.reshape(n, model.nv).copy(), data.efc_AR.reshape(n, n).copy()
    jacobian, projection = np.zeros((n, model.nv)), np.zeros((n, n))
    mujoco.mju_sparse2dense(
        jacobian, data.efc_J, data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind
    )
    mujoco.mju_sparse2dense(
        projection, data.efc_AR, data.efc_AR_rownnz, data.efc_AR_rowadr, data.efc_AR_colind
    )
    return jacobian, projection


@pytest.mark.parametrize("jacobian", ["dense", "sparse"])
@pytest.mark.parametrize("cone", ["pyramidal", "elliptic"])
@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
def test_noslip_works_with_the_added_mass(air: dict[str, str], cone: str, jacobian: str) -> None:
    """AR = J inv(M) J^T + R with the M that has it; again and again, without more memory."""
    model = load(standing(air, f'cone="{cone}" jacobian="{jacobian}"'))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=5)
    mujoco.mj_forward(model, data)
    assert data.nefc > 20
    used = data.parena
    for _ in range(4):
        rows, found = dense(data, model)
        expected = rows @ np.linalg.inv(full_mass(model, data)) @ rows.T + np.diag(data.efc_R)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * np.abs(expected).max())
        mujoco.mj_fwdVelocity(model, data)
    assert data.parena == used
    without = mujoco.MjData(dry := load(standing(None, f'cone="{cone}" jacobian="{jacobian}"')))
    without.qpos[:], without.qvel[:] = data.qpos, data.qvel
    mujoco.mj_forward(dry, without)
    # and that is another one than without the fluid
    assert np.abs(dense(without, dry)[1] - dense(data, model)[1]).max() > 1e-3 * np.abs(found).max()


@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
def test_dry_friction_holds_a_wing_in_water(air: dict[str, str]) -> None:
    """noslip's promise: below the friction there is no creep at all."""
    model = load(two_hinges(air, NOSLIP, 'frictionloss="0.5"'))
    data = mujoco.MjData(model)
    data.qfrc_applied[:] = [0.3, -0.2]
    mujoco.mj_step(model, data, nstep=20)
    np.testing.assert_allclose(data.qvel, 0, atol=1e-9)
    data.qfrc_applied[:] = [0.7, -0.7]
    mujoco.mj_step(model, data, nstep=20)
    assert np.abs(data.qvel).max() > 1e-3


def test_wing_without_constraints_moves_as_without_noslip() -> None:
    """To the last bits: noslip has nothing to do in its tree."""
    xmls = [two_hinges(FREE, option) for option in (NOSLIP, 'gravity="0 0 -9.81"')]
    states = []
    for model in map(load, xmls):
        data = random_state(model, 0, 1.0)
        mujoco.mj_step(model, data, nstep=100)
        states.append(data.plugin_state.copy())
    np.testing.assert_array_equal(*states)


def test_finite_differences_have_room() -> None:
    """They evaluate the velocity stage often on one projection."""
    model = load(standing(FREE))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=5)
    size = 2 * model.nv + model.na
    change = np.zeros((size, size))
    mujoco.mjd_transitionFD(model, data, 1e-6, True, change, None, None, None)
    assert np.isfinite(change).all() and not data.warning.number.any()
