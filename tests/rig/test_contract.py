"""Files that are no rig's: one sentence each, and never another kind of error."""

from __future__ import annotations

import copy
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from flaprig import RIG_WING, Wing
from flaprig._paths import RIG_XML
from flaprig.rig import Rig
from tests.rig.files import blades, saved

TEXT = RIG_XML.read_text(encoding="utf-8")
SERVO = 'input="pos vel ff" nominal="12 4.1 4.817108735504349"'


@pytest.fixture(autouse=True)
def _no_log_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """MuJoCo writes its warnings into MUJOCO_LOG.TXT where the process stands."""
    monkeypatch.chdir(tmp_path)


def refusal(text: str, folder: Path) -> str:
    """The one sentence about a file; what it names first is the file."""
    path = saved(text, folder)
    with pytest.raises(ValueError, match=r"^Rig.load: .*other\.xml") as caught:
        Rig.load(path)
    words = str(caught.value)
    assert "\n" not in words
    return words


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('name="plate"', 'name="blade"', "lacks geom plate and has geom: .*blade"),
        ('<site name="wing_frame"', '<site name="frame"', "lacks site wing_frame .* site: frame"),
        ('instance name="air"', 'instance name="sea"', "lacks plugin instance air .*sea"),
        ('name="sweep" axis', 'name="yaw" axis', "lacks joint sweep and has joint: pitch, yaw"),
        ('dcmotor name="pitch"', 'dcmotor name="m2"', "lacks actuator pitch and has actuator: m2"),
        ('name="sweep_encoder"', 'name="enc"', "must .*pitch_torque.*lacks sensor sweep_enc"),
        ('<joint name="sweep"', '<joint type="slide" name="sweep"', "sweep must be a hinge"),
        ('name="pitch" axis="0 -1 0"', 'name="pitch" axis="0 1 0"', "pitch's axis must be 0 -1"),
        ('name="sweep" axis="0 0 1"', 'name="sweep" axis="0 0.1 1"', "sweep's axis must be 0 0"),
        ('name="sweep" axis', 'name="sweep" pos="0.01 0 0" axis', "sweep must be through"),
        ('name="pitch" axis', 'name="pitch" pos="0.01 0 0" axis', "pitch must be through"),
        ('range="-1.5707963267948966', 'range="1.6', "sweep's range must be from low"),
        ('site name="wing_frame"', 'site name="wing_frame" pos="0 0.1 0"', "wing_frame must be"),
        ('body name="wing" xyaxes="0 0 -1 1 0 0"', 'body name="wing" xyaxes="0 0 1 1 0 0"',
         "must be"),
        ('size="0.03125 0.125', 'size="0.02 0.125', "x of geom plate must be from -0.015625 to"),
        ('0.125 0.0015" pos', '0.125 0.002" pos', "z of geom plate must be from -0.0015 to 0.0015"),
        ('key="span" value="0.25"', 'key="span" value="0.3"', "y of geom plate must be from 0.025"),
        ('name="plate" type="box"', 'name="plate" type="ellipsoid"', "must be a box or a mesh"),
        ('density="1180"', 'density="-1180"', "density"),
        ('density="1180"', 'density="0"', "mass and inertia|density must be a positive"),
        ('key="thickness" value="0.003"', 'key="thickness" value="0"', "thickness must be a"),
        ('key="density" value="1000"', 'key="density" value="-1"', "density must be"),
        ('key="chord" value="0.0625"', 'key="chord" value="nan"', "chord must be"),
        ("nominal=\"12 4.1 ", "nominal=\"-12 4.1 ", "K must be positive"),
        ("nominal=\"12 4.1 4.8", "nominal=\"1e9 4.1 4.8", "sweep|Motor"),
        ('0 0 12"', '0 0 1e9"', "voltage must be a number from .* to 10000 V"),
        ("1.702265913069837 0 0 12", "1.702265913069837 0 0 0", "controller must be"),
        ('controller="37.75119282920979 0', 'controller="37.75119282920979 3',
         "controller must be"),
        ('saturation="4.1 0 0"', "", "dcmotor sweep: saturation must be given"),
        ('thermal="57.24601336790474 12.3 0 0.00393 25 25"', "", "sweep: thermal must be given"),
        ("0.00393 25 25", "0.01 25 25", "thermal must be with copper's"),
        ('saturation="4.1 0 0"', 'saturation="4.1 0 0" gear="2"',
         "actuator sweep's gear must be 1"),
        ('saturation="4.1 0 0"', 'saturation="4.1 0 0" cogging="0.1 7 0"', "without inductance"),
        (SERVO, SERVO.replace("pos vel ff", "pos"), "input must be pos vel ff|invalid ctrl size"),
        ('jointpos name="sweep_encoder" joint="sweep"',
         'jointpos name="sweep_encoder" joint="pitch"',
         "must be jointpos of sweep, got 'jointpos of pitch'"),
        ('<jointvel name="sweep_velocity"', '<jointpos name="sweep_velocity"', "must be jointvel"),
        ('objname="load_cell"', 'objname="wing_frame"', "must be plugin of load_cell"),
        ('gravity="0 0 -9.81"', 'gravity="0 -9.81 0"', "option gravity must be downward"),
        ('timestep="0.002"', 'timestep="0"', "option timestep must be a positive number in s"),
        ('name="frequency" data="0.2"', 'name="frequency" data="0"', "numeric frequency must be"),
        ('name="frequency" data="0.2"', 'name="frequency" data="1 2"', "must be one number"),
        ('name="frequency" data="0.2"', 'name="frequency" data="200"', "steps_per_cycle must be"),
        ('data="0.82 80 0.082"', 'data="0.82 80"', "must be three numbers"),
        ('data="0.82 80 0.082"', 'data="-1 80 0.082"', "continuous torque must be"),
        ('data="0.82 80 0.082"', 'data="0.82 20 0.082"', "limit of sweep must be above"),
        ("<mujoco model", "<mujoco modl", "modl"),
        ("</mujoco>", "", "must be well-formed XML"),
        ("<worldbody>", '<include file="other.xml"/><worldbody>', "must not include itself"),
        ('joint="pitch" input', 'joint="sweep" input', "actuator pitch must be on joint pitch"),
    ],
)  # fmt: skip
def test_one_sentence(old: str, new: str, sentence: str, tmp_path: Path) -> None:
    assert old in TEXT
    words = refusal(TEXT.replace(old, new, 1), tmp_path)
    assert re.search(sentence, words), words


def test_another_reynolds_number_is_a_contradiction(tmp_path: Path) -> None:
    more = '<config key="coefficients" value="lee2016"/><config key="reynolds" value="5000"/>'
    words = refusal(blades(more), tmp_path)
    assert re.search(r"reynolds must be 87\d\d\.\d+, which frequency, .* give, got 5000", words)


def test_two_wings_are_no_rig(tmp_path: Path) -> None:
    text = TEXT.replace("</instance>", '</instance><instance name="b"/>', 1)
    assert "plugin instance must be one, air" in refusal(text, tmp_path)


def test_a_second_motion_is_no_rig(tmp_path: Path) -> None:
    text = TEXT.replace(
        '<joint name="pitch"', '<joint name="deviation" axis="1 0 0"/><joint name="pitch"'
    )
    words = refusal(text.replace('qpos="-1.0471975511965976 0"', 'qpos="-1 0 0"'), tmp_path)
    assert "the joints sweep and pitch, in this order, and no other" in words


@pytest.mark.parametrize(
    "text", ["", "rig", "<mujoco/>", "<robot name='r'/>", "\x00\x01", "<a>&b;</a>"]
)
def test_no_rig_at_all(text: str, tmp_path: Path) -> None:
    refusal(text, tmp_path)


def test_missing_files(tmp_path: Path) -> None:
    for path in (tmp_path / "nowhere.xml", tmp_path):
        with pytest.raises(FileNotFoundError, match=r"Rig.load: there is no file"):
            Rig.load(path)
    text = TEXT.replace("<worldbody>", '<include file="gone.xml"/><worldbody>')
    with pytest.raises(FileNotFoundError, match=r"includes .*gone\.xml, which is no file"):
        Rig.load(saved(text, tmp_path))
    with pytest.raises(ValueError, match="Rig: path must be a path, got 3"):
        Rig(3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"Rig.save: path must be one that ends in \.xml"):
        Rig.load().save(tmp_path / "rig.toml")
    with pytest.raises(FileNotFoundError):
        Rig.load().save(tmp_path / "nowhere" / "rig.xml")


def test_what_a_file_cannot_be_given_is_refused(tmp_path: Path) -> None:
    """A plate under a shifted frame would end up elsewhere than asked for."""
    text = TEXT.replace('<geom name="plate"', '<frame pos="0.1 0 0"><geom name="plate"')
    rest = ' 0.15 0" density="1180" material="acrylic"/>'
    assert f'pos="0.015625{rest}' in text
    text = text.replace(f'pos="0.015625{rest}', f'pos="-0.084375{rest}</frame>')
    rig = Rig.load(saved(text, tmp_path))
    assert rig.wing == RIG_WING
    with pytest.raises(ValueError, match="x of geom plate must be"):
        rig.with_(wing=Wing.rectangular(0.2, 0.05))


def without(number: int) -> str:
    """The file without its n-th element."""
    root = ET.fromstring(TEXT)
    parents = {child: parent for parent in root.iter() for child in parent}
    child = list(root.iter())[number]
    parents[child].remove(child)
    return ET.tostring(root, "unicode")


def renamed(number: int) -> str:
    """The file with another name at its n-th name."""
    root = copy.deepcopy(ET.fromstring(TEXT))
    named = [element for element in root.iter() if element.get("name")]
    named[number].set("name", "other")
    return ET.tostring(root, "unicode")


ELEMENTS = sum(1 for _ in ET.fromstring(TEXT).iter())
NAMES = sum(1 for element in ET.fromstring(TEXT).iter() if element.get("name"))


@pytest.mark.parametrize("change", [without, renamed])
def test_every_part_may_be_missing(change: object, tmp_path: Path) -> None:
    """Each element dropped and each name changed: a rig that compiles, or one sentence."""
    loaded, numbers = 0, range(1, ELEMENTS) if change is without else range(NAMES)
    for number in numbers:
        path = saved(change(number), tmp_path)  # type: ignore[operator]
        words = f"Rig.load: {path}: "
        try:
            Rig.load(path).compile()
            loaded += 1
        except ValueError as error:
            words = str(error)
        assert words.startswith(f"Rig.load: {path}: ")
        assert "\n" not in words
    assert 10 < loaded < len(numbers) - 15
