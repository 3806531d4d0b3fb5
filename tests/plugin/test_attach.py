"""A wing's file put into other models: its site is found whatever the attach puts around names."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

from tests.plugin.models import BLADES, FREE, PLATE, document, instance, load, two_hinges, wing

mjcf = pytest.importorskip("dm_control.mjcf")

AIRS = {"uvlm": FREE, "quasi_steady": BLADES}
THORAX = """<mujoco><compiler angle="radian"/>
<option integrator="implicitfast" gravity="0 0 0"/>{asset}
<worldbody><body name="thorax"><geom size="0.05" contype="0" conaffinity="0"/>{places}</body>
</worldbody></mujoco>"""
# half a turn about z between the two
TURNS = {"left": "0 0 0", "right": "0 0 3.141592653589793"}
# lift, drag and power of a mirrored motion are the same; forces and torques in wing axes are not
MIRROR = np.array([1, 1, -1, -1, -1, 1, 1, 1, 1])


def places(element: str, content: str = "") -> str:
    return "".join(
        f'<{element} name="{side}" euler="{turn}">{content.format(side)}</{element}>'
        for side, turn in TURNS.items()
    )


def by_spec(air: dict[str, str], _: Path, **around: str) -> mujoco.MjModel:
    """`around`: prefix and suffix, in which {} is the side."""
    parent = mujoco.MjSpec.from_string(THORAX.format(asset="", places=places("frame")))
    for frame in list(parent.frames):
        names = {key: text.format(frame.name) for key, text in around.items()}
        parent.attach(mujoco.MjSpec.from_string(two_hinges(air)), frame=frame, **names)
    return parent.compile()


def by_element(air: dict[str, str], folder: Path) -> mujoco.MjModel:
    (folder / "wing.xml").write_text(two_hinges(air))
    attach = '<attach model="wing" body="arm" prefix="{}_"/>'
    asset = '<asset><model name="wing" file="wing.xml"/></asset>'
    (folder / "fly.xml").write_text(THORAX.format(asset=asset, places=places("frame", attach)))
    return mujoco.MjModel.from_xml_path(str(folder / "fly.xml"))


def by_mjcf(air: dict[str, str], _: Path) -> mujoco.MjModel:
    root = mjcf.from_xml_string(THORAX.format(asset="", places=places("site")))
    for side in TURNS:
        child = mjcf.from_xml_string(two_hinges(air))
        child.model = side
        root.find("site", side).attach(child)
    return mjcf.Physics.from_mjcf_model(root).model.ptr


WAYS: dict[str, Callable[[dict[str, str], Path], mujoco.MjModel]] = {
    "MjSpec, prefix": lambda air, folder: by_spec(air, folder, prefix="{}_"),
    "MjSpec, suffix": lambda air, folder: by_spec(air, folder, prefix="", suffix="_{}"),
    "MjSpec, both": lambda air, folder: by_spec(air, folder, prefix="my/{}/", suffix="_1"),
    "attach": by_element,
    "dm_control": by_mjcf,
}


# MuJoCo's own word on an empty prefix
@pytest.mark.filterwarnings("ignore:Attaching a spec with an empty prefix")
@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
def test_two_wings_from_one_file_are_each_others_mirror(
    air: dict[str, str], way: Callable[[dict[str, str], Path], mujoco.MjModel], tmp_path: Path
) -> None:
    model = way(air, tmp_path)
    assert model.nplugin == 2 and model.nq == 4 and model.nsensor == 4
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = [0.1, 0.7, -0.1, -0.7], [1.3, 0.4, -1.3, -0.4]
    largest = 0.0
    for _ in range(120):
        mujoco.mj_step(model, data)
        # body, cell, body, cell
        left, _, right, _ = data.sensordata.reshape(4, 9)
        largest = max(largest, np.abs(left).max())
        np.testing.assert_allclose(right, MIRROR * left, rtol=0, atol=1e-12)
    assert largest > 0.01
    np.testing.assert_allclose(data.qpos[2:], -data.qpos[:2], rtol=0, atol=1e-12)
    assert not data.warning.number.any()


def test_attached_wing_flies_as_the_file_itself(tmp_path: Path) -> None:
    alone, left = load(two_hinges(FREE)), by_element(FREE, tmp_path)
    histories = []
    for model in (alone, left):
        data = mujoco.MjData(model)
        data.qpos[:2], data.qvel[:2] = [0.1, 0.7], [1.3, 0.4]
        mujoco.mj_step(model, data, nstep=120)
        histories.append(np.concatenate([data.qpos[:2], data.sensordata[:18]]))
    np.testing.assert_allclose(histories[1], histories[0], rtol=0, atol=1e-12)


def test_attach_within_an_attach() -> None:
    fly = mujoco.MjSpec.from_string(THORAX.format(asset="", places=places("frame")))
    for frame in list(fly.frames):
        child = mujoco.MjSpec.from_string(two_hinges(FREE))
        fly.attach(child, frame=frame, prefix=f"{frame.name}-", suffix=".v2")
    swarm = mujoco.MjSpec()
    swarm.worldbody.add_frame(name="here")
    swarm.option.gravity = fly.option.gravity
    swarm.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    swarm.attach(fly, frame=swarm.frames[0], prefix="fly/")
    model = swarm.compile()
    assert model.nplugin == 2
    assert {model.site(i).name for i in range(model.nsite)} >= {"fly/left-wing_frame.v2"}


# ---- which site of a body


def upright(sites: str, site: str | None, name: str = "air", elsewhere: str = "") -> bool:
    """Whether the frame is the right one, whose blade hangs: buoyancy turns it to the upside."""
    attributes = {k: v for k, v in BLADES.items() if k != "site"} | {"buoyancy": "true"}
    attributes |= {} if site is None else {"site": site}
    body = wing('<joint name="pitch" axis="0 -1 0"/>', PLATE + sites, air=name)
    sensor = f"""<sensor><plugin name="aero" plugin="flaprig.quasi_steady" instance="{name}"
objtype="body" objname="wing"/></sensor>"""
    xml = document(instance(attributes, name), elsewhere + body, 'gravity="0 0 -9.81"', sensor)
    model = load(xml)
    data = mujoco.MjData(model)
    data.qpos[0] = 0.5
    mujoco.mj_forward(model, data)
    torque = float(data.qfrc_passive[0])
    assert abs(torque) > 1e-3
    return torque > 0


# the wing frame, and one turned by half a turn about y
RIGHT, TURNED = '<site name="{}"/>', '<site name="{}" euler="0 3.1416 0"/>'


def pair(right: str, turned: str) -> str:
    return RIGHT.format(right) + TURNED.format(turned)


@pytest.mark.parametrize(
    ("names", "site", "instance_name", "taken"),
    [
        # exact before all else
        (("frame", "left_frame"), "frame", "left_air", "frame"),
        (("left_frame", "frame"), "frame", "left_air", "frame"),
        # what the instance has around its name, too
        (("left_frame", "left_old_frame"), "frame", "left_air", "left_frame"),
        (("frame_l", "frame_old_l"), "frame", "air_l", "frame_l"),
        (("a/frame", "a/b/frame"), "frame", "a/air", "a/frame"),
        # a prefix before a suffix
        (("left_frame", "frame_old"), "frame", "air", "left_frame"),
        (("frame_2", "cell"), "frame", "air", "frame_2"),
        (("l_frame_2", "cell"), "frame", "air", "l_frame_2"),
    ],
)
def test_site_is_found(names: tuple[str, str], site: str, instance_name: str, taken: str) -> None:
    for first, second in (names, names[::-1]):
        sites = "".join(
            (RIGHT if name == taken else TURNED).format(name) for name in (first, second)
        )
        assert upright(sites, site, instance_name)


def test_same_name_on_another_body_does_not_win() -> None:
    elsewhere = f'<body name="other">{TURNED.format("frame")}</body>'
    sites = RIGHT.format("left_frame") + TURNED.format("left_cell")
    assert upright(sites, "frame", "left_air", elsewhere)


def test_only_site_needs_no_name() -> None:
    assert upright(RIGHT.format("anything"), None)
    assert not upright(TURNED.format("anything"), None)


def test_only_site_of_another_name_is_taken_with_a_warning() -> None:
    spec = mujoco.MjSpec.from_string(two_hinges(BLADES | {"site": "tip"}))
    spec.delete(spec.site("load_cell"))
    for sensor in list(spec.sensors):
        spec.delete(sensor)
    with pytest.warns(UserWarning, match='has no site "tip"; its only one, "wing_frame", is taken'):
        spec.compile()


@pytest.mark.parametrize(
    ("sites", "site", "sentence"),
    [
        ("", "frame", 'body "wing" has none'),
        ("", None, 'site must be given: .*body "wing" has none'),
        (pair("a", "b"), None, 'body "wing" has "a", "b"'),
        (pair("a", "b"), "c", 'body "wing" has "a", "b": .* own body, got "c"$'),
        (pair("x_frame", "y_frame"), "frame", '"x_frame", "y_frame": .*, got "frame"$'),
        ("<site/><site name='b'/>", "c", 'has one without a name, "b"'),
    ],
)
def test_refusal_lists_the_bodys_sites(sites: str, site: str | None, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        upright(sites, site)


def test_plugin_without_an_instance_goes_through_dm_control(tmp_path: Path) -> None:
    """MuJoCo's own ways lose it, whoever's plugin it is: docs of the plugin say so."""
    config = re.search(r'<instance name="air">(.*?)</instance>', two_hinges(BLADES), re.DOTALL)
    assert config is not None
    inline = two_hinges(BLADES).replace(config.group(0), "")
    inline = re.sub("<sensor>.*</sensor>", "", inline, flags=re.DOTALL)
    within = f'<plugin plugin="flaprig.quasi_steady">{config.group(1)}</plugin>'
    inline = inline.replace('<plugin instance="air"/>', within)
    root = mjcf.from_xml_string(THORAX.format(asset="", places=places("site")))
    for side in TURNS:
        child = mjcf.from_xml_string(inline)
        child.model = side
        root.find("site", side).attach(child)
    assert mjcf.Physics.from_mjcf_model(root).model.nplugin == 2
