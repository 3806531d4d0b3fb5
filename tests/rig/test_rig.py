"""The rig as built: its numbers, its frames, its stops and its controls."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from flaprig import rig as names
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import AIR, WATER
from flaprig.motors import RIG_MOTORS
from flaprig.rig import Axis, Body, Rig, Sensor, Site, controls, coordinates, readings, weigh_stops
from flaprig.wing import RIG_WING, Wing

BETA = Wing.beta(span=0.24, mean_chord=0.06, r1=0.5, r2=0.559)


def attributes(spec: mujoco.MjSpec) -> dict[str, str]:
    """The attributes of the fluid's plugin."""
    return dict(next(plugin for plugin in spec.plugins if plugin.name == names.AIR).config)


# ---- the file and the Python numbers


def test_file_has_the_python_numbers() -> None:
    assert Rig.load() == Rig(wing=RIG_WING, fluid=WATER, motors=RIG_MOTORS, model=UVLM())


def test_only_the_plate_has_mass(compiled: mujoco.MjModel) -> None:
    wing = compiled.body(Body.WING).id
    assert compiled.body_mass[wing] == pytest.approx(RIG_WING.mass, rel=1e-12)
    assert compiled.body_mass[wing] == pytest.approx(0.0553125, rel=1e-9)
    # the arm carries the pitch servo and lies near the axis: a tenth of the plate's inertia
    arm = compiled.body(Body.ARM).id
    assert 0.082 < compiled.body_mass[arm] < 0.4


def test_mass_matrix_is_plate_arm_and_rotors(compiled: mujoco.MjModel) -> None:
    """Without the water: plate and arm about the sweep axis, plus a rotor on each diagonal."""
    data = mujoco.MjData(compiled)
    mujoco.mj_forward(compiled, data)
    # rebuilt without the plugin
    mujoco.mj_makeM(compiled, data)
    mujoco.mj_factorM(compiled, data)
    inverse = np.zeros((2, 2))
    mujoco.mj_solveM(compiled, data, inverse, np.eye(2))
    mass = np.linalg.inv(inverse)
    rotor, inertia = RIG_MOTORS.sweep.rotor_inertia, RIG_WING.inertia
    arm = arm_inertia(compiled, compiled.body(Body.ARM).id)
    # at rest sweep turns about -x of the wing frame and pitch about -y
    assert mass[0, 0] == pytest.approx(inertia[0, 0] + arm + rotor, rel=1e-9)
    assert mass[1, 1] == pytest.approx(inertia[1, 1] + rotor, rel=1e-9)
    assert mass[0, 1] == pytest.approx(inertia[0, 1], rel=1e-9)
    assert arm < 0.1 * inertia[0, 0]


def arm_inertia(model: mujoco.MjModel, body: int) -> float:
    """Of the arm's own parts about the sweep axis [kg m2]."""
    axes = np.zeros(9)
    mujoco.mju_quat2Mat(axes, model.body_iquat[body])
    z_row = axes.reshape(3, 3)[2]
    offset = model.body_ipos[body][:2]
    return float(z_row**2 @ model.body_inertia[body] + model.body_mass[body] * offset @ offset)


# ---- frames


@pytest.mark.parametrize("seed", range(5))
def test_wing_frame_is_the_one_of_the_equations(compiled: mujoco.MjModel, seed: int) -> None:
    """e_c = -(cos theta z + sin theta e_t), e_r, n = e_c x e_r; Omega = phi' z - theta' e_r."""
    rng = np.random.default_rng(seed)
    sweep, pitch = rng.uniform(-1.5, 1.5, 2)
    rates = rng.uniform(-2.0, 2.0, 2)
    data = mujoco.MjData(compiled)
    data.qpos[:], data.qvel[:] = (sweep, pitch), rates
    mujoco.mj_forward(compiled, data)
    z = np.array([0.0, 0.0, 1.0])
    e_r = np.array([math.cos(sweep), math.sin(sweep), 0.0])
    e_t = np.array([-math.sin(sweep), math.cos(sweep), 0.0])
    e_c = -(math.cos(pitch) * z + math.sin(pitch) * e_t)
    expected = np.column_stack([e_c, e_r, np.cross(e_c, e_r)])
    for name in Site:
        site = data.site(name)
        np.testing.assert_allclose(site.xmat.reshape(3, 3), expected, atol=1e-12)
    np.testing.assert_allclose(data.site(Site.WING_FRAME).xpos, 0.0, atol=1e-12)
    np.testing.assert_allclose(data.site(Site.LOAD_CELL).xpos, 0.025 * e_r, atol=1e-12)
    spin = data.cvel[compiled.body(Body.WING).id][:3]
    np.testing.assert_allclose(spin, rates[0] * z - rates[1] * e_r, atol=1e-12)


def test_pitched_wing_leads_with_its_leading_edge(compiled: mujoco.MjModel) -> None:
    """theta > 0 with phi' > 0 is a positive angle of attack: the leading edge is ahead."""
    data = mujoco.MjData(compiled)
    data.qpos[:] = 0.0, math.radians(45.0)
    mujoco.mj_forward(compiled, data)
    leading = data.site(Site.WING_FRAME).xmat.reshape(3, 3) @ [-1.0, 0.0, 0.0]
    assert leading[1] > 0.5 and leading[2] > 0.5


# ---- stops, keyframe, controls


def test_stops_stand_at_ninety_degrees(compiled: mujoco.MjModel) -> None:
    for axis in Axis:
        joint = compiled.joint(axis)
        np.testing.assert_allclose(joint.range, [-math.pi / 2, math.pi / 2])
        assert compiled.jnt_limited[joint.id]


@pytest.mark.parametrize("axis", [0, 1])
def test_stops_are_stiff(compiled: mujoco.MjModel, axis: int) -> None:
    """The servo's whole stall torque pushes a stop in by less than a degree."""
    data = mujoco.MjData(compiled)
    data.ctrl[controls(compiled).position[axis]] = 100.0
    mujoco.mj_step(compiled, data, 1000)
    beyond = data.qpos[axis] - math.pi / 2
    assert 0.0 < beyond < math.radians(1.0)
    assert data.actuator_force[axis] == pytest.approx(RIG_MOTORS.sweep.stall_torque, rel=0.05)


def test_stops_know_the_added_mass(compiled: mujoco.MjModel) -> None:
    data = mujoco.MjData(compiled)
    mujoco.mj_forward(compiled, data)
    inverse = np.zeros((2, 2))
    mujoco.mj_solveM(compiled, data, inverse, np.eye(2))
    np.testing.assert_allclose(compiled.dof_invweight0, np.diag(inverse), rtol=1e-12)
    # in water the sweep has more than twice the inertia that MuJoCo counts
    rigid = mujoco.MjModel.from_xml_path(str(names.RIG_XML)).dof_invweight0
    assert rigid[0] / compiled.dof_invweight0[0] > 2.0
    once = compiled.dof_invweight0.copy()
    weigh_stops(compiled)
    np.testing.assert_array_equal(once, compiled.dof_invweight0)


def test_keyframe_starts_a_stroke(compiled: mujoco.MjModel) -> None:
    key = compiled.key(names.START)
    where = controls(compiled)
    # where every stroke of the piecewise family is at time 0
    np.testing.assert_allclose(key.qpos, [-math.pi / 3, 0.0], rtol=1e-12)
    np.testing.assert_array_equal(key.ctrl[where.position], key.qpos)
    np.testing.assert_array_equal(key.ctrl[where.velocity], 0.0)
    np.testing.assert_array_equal(key.ctrl[where.torque], 0.0)


def test_addresses_name_the_right_inputs(compiled: mujoco.MjModel) -> None:
    """A velocity set point of one servo moves that joint, and a torque feedforward is a torque."""
    where = controls(compiled)
    both = [where.position, where.velocity, where.torque]
    assert sorted(np.concatenate(both).tolist()) == list(range(compiled.nu)) == list(range(6))
    qpos, qvel = coordinates(compiled)
    for axis in range(2):
        data = mujoco.MjData(compiled)
        data.ctrl[where.velocity[axis]] = 0.1
        mujoco.mj_step(compiled, data)
        assert abs(data.qvel[qvel[axis]]) > 10.0 * abs(data.qvel[qvel[1 - axis]])
        mujoco.mj_resetData(compiled, data)
        data.ctrl[where.torque[axis]] = 0.02
        mujoco.mj_forward(compiled, data)
        assert data.actuator_force[axis] == pytest.approx(0.02, rel=1e-9)
        mujoco.mj_resetData(compiled, data)
        data.qpos[qpos[axis]] = data.ctrl[where.position[axis]] = 0.3
        mujoco.mj_forward(compiled, data)
        assert data.actuator_force[axis] == pytest.approx(0.0, abs=1e-12)


def test_controls_refuse_other_models() -> None:
    with pytest.raises(ValueError, match="actuator named sweep"):
        controls(mujoco.MjModel.from_xml_string("<mujoco/>"))
    motor = (
        "<mujoco><worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody>"
        "<actuator><motor name='sweep' joint='j'/></actuator></mujoco>"
    )
    with pytest.raises(ValueError, match="inputs pos vel ff"):
        controls(mujoco.MjModel.from_xml_string(motor))


def test_readings(compiled: mujoco.MjModel) -> None:
    where = readings(compiled)
    width = {name: part.stop - part.start for name, part in where.items()}
    assert width.pop(Sensor.AERO) == 9
    assert width.pop(Sensor.LOAD_CELL) == 6
    assert set(width.values()) == {1}
    data = mujoco.MjData(compiled)
    data.qpos[:], data.qvel[:] = (0.3, -0.4), (0.5, -0.6)
    mujoco.mj_forward(compiled, data)
    names_ = (Sensor.SWEEP_ENCODER, Sensor.PITCH_ENCODER, Sensor.SWEEP_VELOCITY)
    got = [data.sensordata[where[name]][0] for name in (*names_, Sensor.PITCH_VELOCITY)]
    np.testing.assert_allclose(got, [0.3, -0.4, 0.5, -0.6], rtol=1e-12)
    servos = (Sensor.SWEEP_TORQUE, Sensor.PITCH_TORQUE)
    torques = [data.sensordata[where[name]][0] for name in servos]
    np.testing.assert_allclose(torques, data.actuator_force, rtol=1e-12)


# ---- other wings, fluids, motors, models


@pytest.mark.parametrize("wing", [BETA, Wing.rectangular(0.3, 0.05, 0.04, 0.5, 0.002, 118.0)])
def test_another_wing(wing: Wing) -> None:
    model = Rig.load().with_(wing=wing).compile()
    assert model.body(Body.WING).mass[0] == pytest.approx(wing.mass, rel=1e-6)
    assert model.site(Site.LOAD_CELL).pos[1] == wing.root_offset
    np.testing.assert_allclose(model.body(Body.WING).ipos, wing.centroid, atol=1e-6)


def test_another_model_of_the_air() -> None:
    model = Rig.load().with_(model=QuasiSteady(), fluid=AIR, frequency=2.0)
    spec = model.spec()
    assert float(attributes(spec)["density"]) == AIR.density
    assert attributes(spec)["site"] == Site.WING_FRAME
    compiled = spec.compile()
    data = mujoco.MjData(compiled)
    mujoco.mj_step(compiled, data, 10)
    assert np.isfinite(data.qpos).all()
    assert readings(compiled)[Sensor.AERO].stop == 9


def test_frequency_sets_the_wake_clock() -> None:
    """steps_per_cycle ticks in a period."""
    for frequency in (0.2, 2.0):
        step = attributes(Rig.load().with_(frequency=frequency).spec())["wake_step"]
        assert float(step) == pytest.approx(1.0 / frequency / UVLM().steps_per_cycle, rel=1e-12)


def test_with_leaves_the_first_rig_alone() -> None:
    rig = Rig.load()
    other = rig.with_(wing=BETA)
    assert rig.wing == RIG_WING and other.wing == BETA and other.fluid == WATER


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"wing": 3}, "Rig: wing must be a Wing, got 3"),
        ({"fluid": None}, "Rig: fluid must be a Fluid, got None"),
        ({"motors": RIG_MOTORS.sweep}, "Rig: motors must be a Motors"),
        ({"model": "uvlm"}, "Rig: model must be a UVLM or a QuasiSteady"),
        ({"frequency": -1.0}, "Rig: frequency must be a positive number in Hz"),
        ({"frequency": math.nan}, "Rig: frequency must be a positive number in Hz"),
        ({"wings": BETA}, "Rig.with_: argument must be one of wing, fluid, motors"),
        ({"buoyancy": 1}, "Rig: buoyancy must be True or False, got 1"),
        ({"path": "x.xml"}, "Rig.with_: argument must be one of wing"),
    ],
)
def test_bad_changes(changes: dict[str, object], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        Rig.load().with_(**changes)


def test_missing_file() -> None:
    with pytest.raises(FileNotFoundError, match=r"there is no file .*nowhere\.xml"):
        Rig.load("nowhere.xml")
