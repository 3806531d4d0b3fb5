"""What was once silently wrong: refused in words, or right."""

from __future__ import annotations

import math
import re

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    BLADES,
    LATTICE,
    ONLY_ADDED_MASS,
    SITES,
    added_mass,
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

AIRS = {"uvlm": LATTICE, "quasi_steady": BLADES}

# ---- options of the model

# (option in XML, what sets it later, the sentence)
REFUSED = {
    "RK4": (
        'integrator="RK4"',
        ("integrator", int(mujoco.mjtIntegrator.mjINT_RK4)),
        "integrator RK4 .* use implicitfast",
    ),
    "PGS": (
        'solver="PGS"',
        ("solver", int(mujoco.mjtSolver.mjSOL_PGS)),
        "solver PGS .* use Newton or CG",
    ),
    "no passive forces": (
        "",
        (
            "disableflags",
            int(mujoco.mjtDisableBit.mjDSBL_SPRING | mujoco.mjtDisableBit.mjDSBL_DAMPER),
        ),
        "disabling both spring and damper removes every passive force",
    ),
}


@pytest.mark.parametrize("air", AIRS)
@pytest.mark.parametrize("name", REFUSED)
def test_option_is_refused_when_compiling(name: str, air: str) -> None:
    option, _, sentence = REFUSED[name]
    xml = two_hinges(AIRS[air], option)
    if name == "no passive forces":
        xml = xml.replace("<default>", '<option><flag spring="disable" damper="disable"/></option>'
                          "<default>")  # fmt: skip
    with pytest.raises(ValueError, match=f'flaprig.{air} "air": {sentence}'):
        load(xml)


@pytest.mark.parametrize("air", AIRS)
@pytest.mark.parametrize("name", REFUSED)
def test_option_is_refused_when_changed_later(name: str, air: str) -> None:
    """On the next step, and by everything that makes new data."""
    _, (field, value), sentence = REFUSED[name]
    model = load(two_hinges(AIRS[air]))
    data = random_state(model, 0)
    mujoco.mj_step(model, data)
    good = getattr(model.opt, field)
    setattr(model.opt, field, value)
    with pytest.raises(mujoco.FatalError, match=sentence):
        mujoco.mj_step(model, data)
    with pytest.raises(mujoco.FatalError, match=sentence):
        mujoco.MjData(model)
    # nothing is broken by it
    setattr(model.opt, field, good)
    mujoco.mj_step(model, data, nstep=10)
    assert np.isfinite(data.qpos).all()


@pytest.mark.parametrize("flag", ["spring", "damper"])
def test_one_of_spring_and_damper_may_go(flag: str) -> None:
    model = load(two_hinges(BLADES))
    bit = getattr(mujoco.mjtDisableBit, f"mjDSBL_{flag.upper()}")
    model.opt.disableflags |= int(bit)
    data = random_state(model, 0, 1.0)
    mujoco.mj_step(model, data)
    assert np.abs(reading(data)).max() > 1e-3


def test_solvers_that_are_allowed_know_the_added_mass() -> None:
    """A dry-friction joint in water against the same one with armature."""
    inertia = float(added_mass(ONLY_ADDED_MASS)[2, 2])
    for option in ('solver="Newton"', 'solver="CG"', 'cone="elliptic"'):
        ends = []
        for water in (True, False):
            joint = f'axis="0 -1 0" frictionloss="1e-3" armature="{0.0 if water else inertia!r}"'
            body = wing(f'<joint name="pitch" {joint}/>', air="air" if water else "")
            extension = instance(ONLY_ADDED_MASS) if water else ""
            model = load(document(extension, body, option))
            if water:
                model.dof_invweight0[:] = 1 / (1 / model.dof_invweight0 + inertia)
            data = mujoco.MjData(model)
            data.qvel[:] = 3.0
            mujoco.mj_step(model, data, nstep=150)
            ends.append((data.qpos[0], data.qvel[0]))
        assert 0.5 < ends[1][1] < 2.9
        assert ends[0] == pytest.approx(ends[1], rel=1e-7)


# ---- where the wing sits


def test_instance_on_two_bodies() -> None:
    twice = wing('<joint axis="0 1 0"/>').replace('name="wing"', 'name="other"')
    twice = twice.replace(SITES, "")
    one = wing('<joint axis="0 1 0"/>')
    with pytest.raises(ValueError, match="attached to two bodies; give each wing its own"):
        load(document(instance(BLADES), one + twice))


def test_instance_on_no_body() -> None:
    body = wing('<joint axis="0 1 0"/>', air="")
    with pytest.raises(ValueError, match="the instance is attached to no body"):
        load(document(instance(BLADES), body))


@pytest.mark.parametrize(
    ("site", "sentence"),
    [
        ("nowhere", r'site must be the name of a site on the wing\'s own body, got "nowhere"'),
        ("elsewhere", r'site must be the name of .* own body, got "elsewhere"'),
        ("", "site must be given: the name of a site .* x axis points along the chord"),
    ],
)
@pytest.mark.parametrize("air", AIRS)
def test_site_that_is_not_the_wings(site: str, sentence: str, air: str) -> None:
    body = wing('<joint axis="0 1 0"/>') + '<site name="elsewhere"/>'
    with pytest.raises(ValueError, match=sentence):
        load(document(instance(AIRS[air] | {"site": site}), body))


SIMPLE = '<geom type="box" size="0.03125 0.125 0.0015" density="1180"/>'
REMEDY = '<inertial pos="1e-6 0 0" mass="0.0553" diaginertia="2.9e-4 1.8e-5 3.06e-4"/>'


@pytest.mark.parametrize("joint", ["<freejoint/>", '<joint type="ball"/>'])
def test_free_body_without_room_for_the_added_mass(joint: str) -> None:
    """MuJoCo keeps a diagonal only; the remedy in the sentence works."""
    sentence = r"shift the body's <inertial> by 1e-6 m to make room for the added mass"
    with pytest.raises(ValueError, match=sentence):
        load(document(instance(BLADES), wing(joint, SIMPLE + SITES)))
    content = REMEDY + SIMPLE + SITES
    wet = load(document(instance(BLADES), wing(joint, content)))
    dry = load(document("", wing(joint, content, air="")))
    data, without = random_state(wet, 1), random_state(dry, 1)
    mujoco.mj_forward(wet, data)
    mujoco.mj_forward(dry, without)
    jacobian = site_jacobian(wet, data)[2:5]
    expected = full_mass(dry, without) + jacobian.T @ added_mass(BLADES) @ jacobian
    np.testing.assert_allclose(full_mass(wet, data), expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("air", AIRS)
def test_wing_welded_to_the_world(air: str) -> None:
    """Loads without a degree of freedom: a balance in a stream."""
    sensor = f'<sensor><plugin name="aero" plugin="flaprig.{air}" instance="air" objtype="body"'
    sensor += ' objname="wing"/></sensor>'
    attributes = AIRS[air] | {"wind": "0 0.5 0"}
    model = load(document(instance(attributes), wing(), rest=sensor))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=20)
    # broadside on: the plate's axes are x down, y along the span, z against world y
    assert reading(data)[2] < -0.5
    assert reading(data)[8] == 0.0


def test_mocap_wing() -> None:
    """A wing moved by a program's hand has no velocity for MuJoCo; it must not crash."""
    body = wing().replace('name="wing"', 'name="wing" mocap="true"')
    model = load(document(instance(LATTICE), body))
    data = mujoco.MjData(model)
    for i in range(200):
        data.mocap_pos[0] = [0.0, 0.001 * i, 0.0]
        mujoco.mj_step(model, data)
    assert np.isfinite(data.plugin_state).all()


# ---- numbers that are none


@pytest.mark.parametrize("air", AIRS)
@pytest.mark.parametrize("value", [math.nan, math.inf, 1e200])
@pytest.mark.parametrize("field", ["qpos", "qvel", "qfrc_applied", "plugin_state"])
def test_bad_numbers_become_a_warning(
    air: str, value: float, field: str, caplog: pytest.LogCaptureFixture
) -> None:
    """MuJoCo resets and counts a warning; nothing crashes, and the reset air is good again."""
    model = load(two_hinges(AIRS[air]))
    data = random_state(model, 0, 1.0)
    mujoco.mj_step(model, data, nstep=10)
    # beyond the plugin's own log and the wake's header, which hold nothing that acts
    getattr(data, field)[16 + 16 if field == "plugin_state" and air == "uvlm" else 0 :] = value
    mujoco.mj_step(model, data, nstep=2)
    if field != "plugin_state":
        assert sum(data.warning.number) > 0
    mujoco.mj_resetData(model, data)
    mujoco.mj_step(model, data, nstep=200)
    assert np.isfinite(data.plugin_state).all() and np.isfinite(data.sensordata).all()


@pytest.mark.parametrize("air", AIRS)
def test_bad_numbers_without_autoreset(air: str) -> None:
    model = load(two_hinges(AIRS[air]))
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = math.nan, 1e300
    mujoco.mj_step(model, data, nstep=200)
    assert not np.isfinite(data.qpos).all()


def test_sentences_are_one_line() -> None:
    """Every refusal names the plugin and the instance."""
    with pytest.raises(ValueError, match="core") as refusal:
        load(two_hinges(LATTICE | {"core": "0"}))
    assert re.fullmatch(r'Error: engine error: flaprig\.uvlm "air": [^\n]+', str(refusal.value))


def test_quasi_steady_air_remembers_nothing() -> None:
    model = load(two_hinges(BLADES))
    assert native(BLADES).state_size == 0
    assert model.npluginstate == 16
