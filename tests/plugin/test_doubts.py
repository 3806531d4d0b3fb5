"""What compiles and is hardly meant: MuJoCo's own fluid, its wind, a mocap body under a wing."""

from __future__ import annotations

import warnings

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    BLADES,
    FREE,
    PLATE,
    document,
    instance,
    load,
    random_state,
    two_hinges,
    wing,
)

AIRS = {"uvlm": FREE, "quasi_steady": BLADES}
WATER = 'density="1000" viscosity="0.001"'
NOTHING = 'fluidshape="ellipsoid" fluidcoef="0 0 0 0 0"'
# as the sentence says it
CURE = f'<geom type="sphere" size="1e-6" mass="0" contype="0" conaffinity="0" {NOTHING}/>'


def doubts(xml: str) -> list[str]:
    """Warnings of the compilation, each once."""
    spec = mujoco.MjSpec.from_string(xml)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        spec.compile()
    return [line for warning in told for line in str(warning.message).split("\n") if line]


def with_geom(geom: str, option: str = WATER, plate: str = PLATE) -> str:
    """The two hinges, whose wing has one more geom."""
    return two_hinges(FREE, option).replace(PLATE, plate + geom)


@pytest.mark.parametrize("option", [WATER, 'density="1.2"', 'viscosity="1e-5"'])
@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
def test_second_fluid_is_said_with_its_cure(air: dict[str, str], option: str) -> None:
    told = doubts(two_hinges(air, option))
    assert len(told) == 1
    assert "air\": MuJoCo's own fluid (<option density=" in told[0]
    assert 'acts on body "wing" too' in told[0] and CURE in told[0]


@pytest.mark.parametrize(
    "geom",
    [
        CURE,
        CURE.replace("1e-6", "0.001"),
        CURE.replace('type="sphere" size="1e-6"', 'type="ellipsoid" size=".002 .002 .001"'),
    ],
)
def test_cure_silences_it_and_the_warning(geom: str) -> None:
    """The force of both fluids is then the one of the plugin alone."""
    cured = with_geom(geom)
    assert doubts(cured) == []
    forces = []
    for xml in (cured, with_geom(geom, ""), with_geom("")):
        # the arm stays in MuJoCo's fluid: only the wing's joint moves
        model = load(xml)
        data = random_state(model, 0, 1.0)
        data.qvel[0] = 0
        mujoco.mj_forward(model, data)
        forces.append(data.qfrc_passive.copy())
    wet, dry, both = forces
    np.testing.assert_allclose(wet, dry, rtol=1e-4, atol=1e-7)
    assert np.abs(both - dry).max() > 1e-2 * np.abs(dry).max()


@pytest.mark.parametrize(
    "xml",
    [
        # coefficients that are not zero; a plate that is an ellipsoid itself; large and light
        with_geom(CURE.replace("0 0 0 0 0", "0 0 0.1 0 0")),
        with_geom(CURE, plate=PLATE.replace("<geom", '<geom fluidshape="ellipsoid"')),
        with_geom("", plate=PLATE.replace("<geom", f"<geom {NOTHING}")),
        with_geom(CURE.replace("1e-6", "0.05")),
        # on the arm it does nothing for the wing
        two_hinges(FREE, WATER).replace('<body name="arm">', f'<body name="arm">{CURE}'),
    ],
)
def test_what_is_no_cure_is_not_taken_for_one(xml: str) -> None:
    assert len(doubts(xml)) == 1


def test_each_wet_wing_is_named() -> None:
    extension = instance(FREE, "left") + instance(FREE, "right")
    bodies = "".join(
        wing('<joint axis="0 -1 0"/>', air=side)
        .replace('name="wing"', f'name="{side}_wing"')
        .replace('name="load_cell"', "")
        .replace('name="wing_frame"', f'name="{side}_wing_frame"')
        for side in ("left", "right")
    )
    told = " ".join(doubts(document(extension, bodies, WATER)))
    assert 'body "left_wing" too' in told and 'flaprig.uvlm "right"' in told


def test_scene_fluid_does_not_reach_a_body_that_cannot_move() -> None:
    """A wind tunnel: the loads are right, and there is no body that is pushed twice."""
    still = document(instance(FREE | {"wind": "0 1 0"}), wing(), WATER)
    assert doubts(still) == []
    model = load(still)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=10)
    assert np.abs(data.plugin_state[:6]).max() > 0.1


def test_wind_of_the_scene_is_not_the_wings() -> None:
    told = doubts(two_hinges(FREE, 'wind="1 0 0.5"'))
    assert len(told) == 1 and '<option wind="1 0 0.5"> is the wind of MuJoCo' in told[0]
    assert doubts(two_hinges(FREE | {"wind": "1 0 0.5"}, 'wind="1 0 0.5"')) == []


@pytest.mark.parametrize("joint", ["", '<joint axis="0 -1 0"/>'])
@pytest.mark.parametrize("between", [False, True])
def test_mocap_body_that_carries_the_wing_is_named(joint: str, between: bool) -> None:
    body = wing(joint)
    body = f'<body name="arm" pos="0 0 0.1">{body}</body>' if between else body
    held = f'<body name="hand" mocap="true"><geom size="0.01"/>{body}</body>'
    told = doubts(document(instance(FREE), held))
    assert len(told) == 1 and 'body "hand" that carries the wing is a mocap body' in told[0]
    assert doubts(document(instance(FREE), held.replace(' mocap="true"', ""))) == []


def test_option_that_is_changed_later_is_said_once(told: list[str]) -> None:
    model = load(two_hinges(FREE))
    data = random_state(model, 0)
    mujoco.mj_step(model, data, nstep=3)
    assert told == []
    model.opt.density = 1.2
    mujoco.mj_step(model, data, nstep=3)
    assert len(told) == 1 and "MuJoCo's own fluid" in told[0]
    model.opt.density = 0
    mujoco.mj_step(model, data, nstep=3)
    assert len(told) == 1
