"""The plugins' sensors: the load of the step that was taken, a load cell, energy."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    BLADES,
    FREE,
    PLATE,
    SENSORS,
    SITES,
    Array,
    document,
    full_mass,
    instance,
    load,
    native,
    random_state,
    reading,
    site_jacobian,
    two_hinges,
    wing,
)

AIRS = {"uvlm": FREE, "quasi_steady": BLADES}
GRAVITY = 'gravity="0 0 -9.81"'
# the acrylic plate's mass [kg]: 0.25 x 0.0625 x 0.003 m of 1180 kg/m3
MASS = 0.25 * 0.0625 * 0.003 * 1180.0


@pytest.mark.parametrize("timestep", [0.001, 0.005])
@pytest.mark.parametrize("air", AIRS)
def test_wrench_is_the_one_that_moved_the_wing(air: str, timestep: float) -> None:
    """M dv/dt + bias = damping + J^T w with the step's true dv/dt; with qacc it is not so.

    Under implicitfast the damping acts with the new velocity.
    """
    damping, option = 0.02, f'timestep="{timestep}"'
    wet = load(two_hinges(AIRS[air], option, f'damping="{damping}"'))
    dry = load(two_hinges(None, option))
    data, without = random_state(wet, 3, 1.0), mujoco.MjData(dry)
    misfit = 0.0
    for i in range(60):
        without.qpos[:], without.qvel[:] = data.qpos, data.qvel
        mujoco.mj_forward(dry, without)
        jacobian, mass = site_jacobian(dry, without), full_mass(dry, without)
        before = data.qvel.copy()
        mujoco.mj_step(wet, data)
        air_torque = jacobian.T @ reading(data)[:6]
        rest = mass @ (data.qvel - before) / timestep + without.qfrc_bias + damping * data.qvel
        np.testing.assert_allclose(air_torque, rest, rtol=0, atol=1e-10 * max(np.abs(rest)))
        wrong = mass @ data.qacc + without.qfrc_bias + damping * data.qvel
        misfit = max(misfit, max(np.abs(air_torque - wrong)) / max(np.abs(rest)))
        if i < 2:
            assert max(np.abs(air_torque)) > 1e-3
    assert misfit > 0.01


def test_sensor_after_forward_is_the_last_steps() -> None:
    """mj_forward asks the plugin again and gets the same: the load is in the state."""
    model = load(two_hinges(FREE))
    data = random_state(model, 0, 1.0)
    mujoco.mj_step(model, data, nstep=50)
    read = data.sensordata.copy()
    mujoco.mj_forward(model, data)
    np.testing.assert_array_equal(data.sensordata, read)
    assert np.abs(read).max() > 0


@pytest.mark.parametrize("air", AIRS)
def test_lift_and_drag(air: str) -> None:
    """Lift against gravity; drag against the sweep, as the paper's eq. 12."""
    model = load(two_hinges(AIRS[air]))
    data = random_state(model, 5, 0.7)
    for _ in range(30):
        mujoco.mj_forward(model, data)
        rotation = data.site("wing_frame").xmat.reshape(3, 3).copy()
        sweep, rate = data.qpos[0], data.qvel[0]
        mujoco.mj_step(model, data)
        force = rotation @ reading(data)[:3]
        along = np.array([-np.sin(sweep), np.cos(sweep), 0.0])
        assert reading(data)[6] == pytest.approx(force[2], rel=1e-12)
        assert reading(data)[7] == pytest.approx(-np.sign(rate) * (force @ along), rel=1e-9)


@pytest.mark.parametrize("air", AIRS)
def test_power_is_the_work_done_on_the_fluid(air: str) -> None:
    """About one axis the wing loses what the fluid gets, to roundoff, over any time."""
    sensors = f"<sensor>{SENSORS.format('flaprig.' + air)}</sensor>"
    # about an axis in the plate's plane and a little out of it
    hinge = '<joint axis="-0.8 0.1 0.5"/>'
    model = load(document(instance(AIRS[air]), wing(hinge), rest=sensors))
    data = mujoco.MjData(model)
    data.qvel[:] = 3.0
    dry = load(document("", wing(hinge, air="")))
    inertia = full_mass(dry, forwarded(dry))[0, 0]
    work, start = 0.0, data.qvel[0]
    for _ in range(300):
        mujoco.mj_step(model, data)
        work += reading(data)[8] * model.opt.timestep
    lost = 0.5 * inertia * (start**2 - data.qvel[0] ** 2)
    assert lost > 0.2 * 0.5 * inertia * start**2
    assert work == pytest.approx(lost, rel=1e-10)


@pytest.mark.parametrize("air", AIRS)
def test_power_is_force_times_mean_velocity(air: str) -> None:
    """-sum of J^T w times the step's mean velocity, with two joints."""
    model = load(two_hinges(AIRS[air]))
    data = random_state(model, 6, 1.0)
    for _ in range(40):
        mujoco.mj_forward(model, data)
        jacobian, before = site_jacobian(model, data), data.qvel.copy()
        mujoco.mj_step(model, data)
        power = -reading(data)[:6] @ jacobian @ (0.5 * (before + data.qvel))
        assert reading(data)[8] == pytest.approx(power, rel=1e-9, abs=1e-15)


def forwarded(model: mujoco.MjModel) -> mujoco.MjData:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data


# ---- the load cell


@pytest.mark.parametrize("buoyancy", ["true", "false"])
@pytest.mark.parametrize("air", AIRS)
def test_cell_reads_weight_less_buoyancy(air: str, buoyancy: str) -> None:
    """At rest, hanging: the plate's weight less that of the water it displaces."""
    model = load(two_hinges(AIRS[air] | {"buoyancy": buoyancy}, GRAVITY))
    data = mujoco.MjData(model)
    data.qpos[0] = 0.4
    mujoco.mj_step(model, data)
    displaced = 0.25 * 0.0625 * 0.003 * 1000.0 if buoyancy == "true" else 0.0
    down = (MASS - displaced) * 9.81
    # the wing hangs with its chord down: x is down, and its middle 0.125 m out of the cell and
    # a quarter chord below it
    cell = reading(data, "load_cell")
    np.testing.assert_allclose(cell[:3], [down, 0, 0], atol=1e-12)
    np.testing.assert_allclose(cell[3:6], [0, 0, -0.125 * down], atol=1e-12)
    np.testing.assert_array_equal(cell[6:], 0.0)
    # lift and wrench are those of the motion, and there is none
    np.testing.assert_allclose(reading(data)[:9], 0.0, atol=1e-12)


NATIVE = """<force name="force" site="load_cell"/><torque name="torque" site="load_cell"/>"""


@pytest.mark.parametrize("turned", ["", 'euler="0.3 -0.4 0.5"'])
def test_cell_is_mujocos_own_in_thin_air(turned: str) -> None:
    """Without a fluid to speak of, MuJoCo's force and torque sensors know all there is.

    Theirs is what the mount does to the wing, ours what the wing does to the mount.
    """
    air = BLADES | {"density": "1e-6"}
    xml = two_hinges(air, f'{GRAVITY} integrator="Euler"').replace(
        "</sensor>", f"{NATIVE}</sensor>"
    )
    xml = xml.replace(
        'name="load_cell" pos="0 0.025 0"', f'name="load_cell" pos="0.01 0.04 0.02" {turned}'
    )
    # mass off the plate's plane, on principal axes of its own
    xml = xml.replace(
        PLATE, PLATE + '<geom type="box" size=".01 .03 .02" pos=".02 .1 .03" euler=".2 .3 .4"/>'
    )
    model = load(xml)
    data = random_state(model, 2, 2.0)
    for _ in range(100):
        mujoco.mj_step(model, data)
        ours, scale = reading(data, "load_cell"), np.abs(reading(data, "force")).max()
        np.testing.assert_allclose(ours[:3], -reading(data, "force"), atol=1e-6 * scale)
        np.testing.assert_allclose(ours[3:6], -reading(data, "torque"), atol=1e-6 * scale)
    assert np.abs(data.qvel).max() > 1


@pytest.mark.parametrize("air", AIRS)
def test_cell_feels_what_the_joint_feels(air: str) -> None:
    """About the pitch axis nothing but the joint's own damping holds the wing."""
    damping = 1e-3
    model = load(two_hinges(AIRS[air], GRAVITY, f'damping="{damping}"'))
    data = random_state(model, 7, 1.0)
    for _ in range(50):
        mujoco.mj_step(model, data)
        # the cell is on the pitch axis -y; the damper pulls the wing back, the wing the damper on
        assert reading(data, "load_cell")[4] == pytest.approx(-damping * data.qvel[1], abs=1e-11)
    assert abs(data.qvel[1]) > 0.01


def test_cells_anywhere_agree() -> None:
    """The same wrench from another place, in other axes."""
    other = '<site name="other" pos="0.02 0.1 -0.01" euler="0.4 0.2 -0.7"/>'
    xml = two_hinges(FREE, GRAVITY).replace(SITES, SITES + other)
    sensor = SENSORS.format("flaprig.uvlm").splitlines()[-1]
    sensor = sensor.replace('objname="load_cell"', 'objname="other"')
    sensor = sensor.replace('name="load_cell"', 'name="there"')
    model = load(xml.replace("</sensor>", f"{sensor}</sensor>"))
    data = random_state(model, 8, 1.0)
    mujoco.mj_step(model, data, nstep=40)
    here, there = reading(data, "load_cell"), reading(data, "there")
    frames = [data.site(name).xmat.reshape(3, 3) for name in ("load_cell", "other")]
    turn = frames[1].T @ frames[0]
    offset = frames[0].T @ (data.site("other").xpos - data.site("load_cell").xpos)
    np.testing.assert_allclose(there[:3], turn @ here[:3], atol=1e-12)
    moment = here[3:6] - np.cross(offset, here[:3])
    np.testing.assert_allclose(there[3:6], turn @ moment, atol=1e-12)
    assert np.abs(here).max() > 0.1


def test_wrench_is_the_native_airs() -> None:
    """The loads that the air without MuJoCo has at this twist and its rate."""
    model = load(two_hinges(BLADES))
    data = random_state(model, 9, 1.0)
    mujoco.mj_forward(model, data)
    jacobian, before = site_jacobian(model, data), data.qvel.copy()
    rotation = data.site("wing_frame").xmat.copy()
    mujoco.mj_step(model, data)
    # the twist's components change with the joints' acceleration and with their motion
    moved = mujoco.MjData(model)
    eps = 1e-6
    moved.qpos[:] = random_state(model, 9, 1.0).qpos + eps * before
    mujoco.mj_forward(model, moved)
    rate = (site_jacobian(model, moved) - jacobian) @ before / eps
    rate = rate + jacobian @ (data.qvel - before) / model.opt.timestep
    parts = native(BLADES).run(
        np.zeros(0), model.opt.timestep, np.zeros((1, 3)), rotation.reshape(1, 3, 3),
        (jacobian @ before)[None], rate[None],
    )  # fmt: skip
    total: Array = sum(parts)[0]
    np.testing.assert_allclose(reading(data)[:6], total, rtol=0, atol=1e-6 * np.abs(total).max())


def test_clipped_sensor() -> None:
    """MuJoCo's cutoff holds for the plugins' sensors too."""
    clipped = SENSORS.format("flaprig.quasi_steady").splitlines()[1]
    clipped = clipped.replace('name="aero"', 'name="clipped" cutoff="0.01"')
    model = load(two_hinges(BLADES).replace("</sensor>", f"{clipped}</sensor>"))
    data = random_state(model, 0, 2.0)
    for _ in range(20):
        mujoco.mj_step(model, data)
        assert np.abs(reading(data, "clipped")).max() <= 0.01
    assert np.abs(reading(data)).max() > 0.1


def test_sensors_can_be_switched_off() -> None:
    model = load(two_hinges(BLADES))
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
    data = random_state(model, 0, 2.0)
    mujoco.mj_step(model, data, nstep=5)
    assert not data.sensordata.any()
