"""The rig's file is the truth: what it says is simulated, and only what was asked changes."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from flaprig import LEE_2016, RIG_WING, UVLM, Coefficients, Fluid, QuasiSteady, SunTangStroke, Wing
from flaprig._paths import RIG_XML
from flaprig.catalogue import CATALOGUE
from flaprig.motors import RIG_MOTORS, XM430_W350, Motors
from flaprig.rig import Rig
from tests.rig.files import CHANGES, blades, changed, differences, saved

BETA = Wing.beta(span=0.24, mean_chord=0.06, r1=0.5, r2=0.559)
TABLE = Coefficients.from_table([0.0, 1.0, 3.0], [0.0, 1.5, 0.1], [0.1, 1.0, 2.0])
# set by `weigh_stops`
BY_THE_RUN = ["dof_invweight0"]
# what a rig can be asked for, each far from the paper's
WISHES = {
    "wing": BETA,
    "thick plate": replace(RIG_WING, thickness=0.004, density=1330.0),
    "root": Wing.rectangular(0.2, 0.07, 0.0, 0.3),
    "fluid": Fluid(1.2, 1.5e-5, (0.0, 0.1, 0.0)),
    "motors": Motors(CATALOGUE["MX-106"], replace(XM430_W350, slew_rate=3.0, torque_limit=2.5)),
    "lattice": UVLM(4, 6, 30, wake_cycles=0.333, wake_detail=0.77, suction_factor=1.1),
    "extended": UVLM.extended(steps_per_cycle=25),
    "accurate": UVLM.accurate(precision="double", threads=2),
    "brute force": UVLM(wake_detail=0.0, wake_cycles=2.5),
    "blades": QuasiSteady(TABLE, strips=7, steps_per_cycle=31, added_mass=False),
    "lee": QuasiSteady(LEE_2016),
    "frequency": 0.37,
    "sweep_amplitude": 0.8,
    "buoyancy": False,
}
NAME = {
    "thick plate": "wing", "root": "wing", "lattice": "model", "extended": "model",
    "accurate": "model", "brute force": "model", "blades": "model", "lee": "model",
}  # fmt: skip


def wish(name: str) -> dict[str, object]:
    return {NAME.get(name, name): WISHES[name]}


@pytest.fixture(params=CHANGES)
def other(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Another lab's file."""
    return saved(changed(request.param), tmp_path)


def test_a_rig_is_its_file(other: Path) -> None:
    ours, theirs = Rig.load(other).compile(), mujoco.MjModel.from_xml_path(str(other))
    assert differences(ours, theirs) == BY_THE_RUN


@pytest.mark.parametrize(
    "more",
    ["", '<config key="coefficients" value="lee2016"/><config key="reynolds" value="8720"/>'],
)
def test_blades_are_their_file(more: str, tmp_path: Path) -> None:
    path = saved(blades(more), tmp_path)
    rig = Rig.load(path)
    assert rig.model == QuasiSteady(
        LEE_2016 if more else QuasiSteady().coefficients, 9, rotation=False
    )
    model = mujoco.MjModel.from_xml_path(str(path))
    assert differences(rig.compile(), model) == BY_THE_RUN


def test_every_file_differs_from_the_papers(other: Path) -> None:
    rig = Rig.load(other)
    assert rig != Rig.load() and Rig.load() != rig
    assert rig == Rig.load(other) and hash(rig) == hash(Rig.load(other))


def test_numbers_are_read(tmp_path: Path) -> None:
    def load(name: str) -> Rig:
        return Rig.load(saved(changed(name), tmp_path))

    rig = load("chord and density")
    assert rig.wing == Wing.rectangular(0.25, 0.05, 0.025, 0.25, density=1330.0)
    assert rig.fluid.density == 998.2
    servo = load("24 V and armature").motors.pitch
    assert (servo.voltage, servo.stall_torque, servo.torque_limit) == (24.0, 8.2, 6.0)
    assert servo.no_load_speed == 9.634217471008698 and servo.rotor_inertia == 0.03
    lattice = load("lattice").model
    # 33 rows, 40 of which are a cycle of 5 s
    assert lattice == UVLM(
        3, 5, 40, wake_cycles=33 / 40, wake_detail=50 / 40, rate="backward", core=0.2
    )
    assert load("pitch axis").wing.pitch_axis == pytest.approx(0.4, rel=1e-12)
    rig = load("wind and mass")
    assert rig.fluid.wind == (0.1, 0.0, -0.02)
    assert rig.wing.mass == pytest.approx(0.06, rel=1e-12) and rig.motors.pitch.mass == 0.1
    assert not load("no buoyancy").buoyancy
    servo = load("heat").motors.sweep
    assert servo.thermal_resistance == pytest.approx(40.0, rel=1e-12)
    assert (servo.heat_capacity, servo.ambient_temperature) == (20.0, 31.0)


@pytest.mark.parametrize("name", WISHES)
def test_what_is_asked_for_is_there_and_saved(name: str, other: Path, tmp_path: Path) -> None:
    rig = Rig.load(other).with_(**wish(name))
    for key, value in wish(name).items():
        assert getattr(rig, key) == value
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    rig.save(folder / "saved.xml")
    again = Rig.load(folder / "saved.xml")
    assert again == rig and again.numbers == rig.numbers
    assert differences(again.compile(), rig.compile()) == []
    assert [path.name for path in folder.iterdir()] == ["saved.xml"]


@pytest.mark.parametrize("name", WISHES)
def test_there_and_back_is_the_same_rig(name: str) -> None:
    rig = Rig.load()
    (key,) = wish(name)
    back = rig.with_(**wish(name)).with_(**{key: getattr(rig, key)})
    assert back.numbers == rig.numbers
    if name not in ("wing", "root"):
        # a beta wing needs a mesh, and a root at the axis has no shaft
        assert back == rig


def test_nothing_else_changes(tmp_path: Path) -> None:
    """Friction, springs and foreign elements of a file stay, number by number."""
    rig = Rig.load(saved(changed("friction"), tmp_path))
    stiff = Motors(RIG_MOTORS.sweep, replace(RIG_MOTORS.pitch, stiffness=50.0))
    changes = differences(rig.with_(motors=stiff).compile(), rig.compile())
    assert changes == ["actuator_gainprm"]
    heavy = rig.with_(wing=replace(RIG_WING, density=1200.0)).compile()
    assert not [
        f
        for f in differences(heavy, rig.compile())
        if f.startswith(("dof_damp", "jnt", "actuator_gain", "actuator_arm"))
    ]
    lines = zip(
        rig.document.text.splitlines(), rig.with_(frequency=0.3).document.text.splitlines(),
        strict=False,
    )  # fmt: skip
    told = [new.strip() for old, new in lines if "value" in old and old != new]
    assert told == ['<config key="wake_step" value="0.03333333333333333"/>']


def test_an_unchanged_rig_is_saved_letter_by_letter(tmp_path: Path) -> None:
    rig = Rig.load()
    rig.with_(wing=RIG_WING, motors=RIG_MOTORS, model=UVLM()).save(tmp_path / "same.xml")
    assert (tmp_path / "same.xml").read_bytes() == RIG_XML.read_bytes()


def test_arguments_are_written_over_the_file(other: Path) -> None:
    made, asked = Rig(other, wing=BETA, buoyancy=False), Rig.load(other)
    assert made == asked.with_(wing=BETA, buoyancy=False)
    assert (made.motors, made.model) == (asked.motors, asked.model)
    assert replace(made, frequency=0.5) == made.with_(frequency=0.5)


def test_a_rig_is_a_value(other: Path) -> None:
    rig = Rig.load(other).with_(model=QuasiSteady())
    copy = pickle.loads(pickle.dumps(rig))
    # also after its file is gone
    other.unlink()
    assert copy == rig and differences(copy.compile(), rig.compile()) == []
    with pytest.raises(AttributeError):
        rig.wing = BETA  # type: ignore[misc]
    assert rig != "rig"


def test_a_stroke_sets_the_clock_alone(other: Path) -> None:
    rig = Rig.load(other)
    faster = rig.running(SunTangStroke(0.25, 0.9, 0.5))
    assert (faster.frequency, faster.sweep_amplitude) == (0.25, 0.9)
    kept = [
        name
        for name in rig.numbers.__dataclass_fields__
        if name not in ("frequency", "sweep_amplitude")
    ]
    assert all(getattr(faster, name) == getattr(rig, name) for name in kept)
    changes = differences(faster.compile(), rig.compile())
    assert {name.split("_")[0] for name in changes} <= {"plugin", "numeric", "npluginattr"}


def test_includes_and_meshes_are_found(tmp_path: Path) -> None:
    """A file in pieces, with a mesh of its own, saved into another folder."""
    text = RIG_XML.read_text(encoding="utf-8")
    start, end = text.index("  <actuator>"), text.index("  <sensor>")
    saved(f"<any>{text[start:end]}</any>", tmp_path, "servos.xml")
    (tmp_path / "meshes").mkdir()
    corners = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    saved(corners, tmp_path / "meshes", "horn.obj")
    text = text[:start] + '<include file="servos.xml"/>' + text[end:]
    text = text.replace("<compiler ", '<compiler meshdir="meshes" ')
    text = text.replace("<asset>", '<asset><mesh name="h" file="horn.obj"/>')
    text = text.replace("<worldbody>", '<worldbody><geom type="mesh" mesh="h"/>')
    path = saved(text, tmp_path)
    rig = Rig.load(path)
    assert differences(rig.compile(), mujoco.MjModel.from_xml_path(str(path))) == BY_THE_RUN
    assert rig.motors == RIG_MOTORS
    (tmp_path / "deep" / "er").mkdir(parents=True)
    stronger = rig.with_(motors=Motors(CATALOGUE["MX-106"], RIG_MOTORS.pitch))
    stronger.save(tmp_path / "deep" / "er" / "rig.xml")
    assert Rig.load(tmp_path / "deep" / "er" / "rig.xml") == stronger


def test_defaults_of_a_class_are_read_and_kept(tmp_path: Path) -> None:
    """Servos whose numbers stand in <default>: one number changes, in the element."""
    text = RIG_XML.read_text(encoding="utf-8")
    shared = 'nominal="12 4.1 4.817108735504349" saturation="4.1 0 0"'
    text = text.replace(shared, 'class="servo"')
    text = text.replace(
        "<default>", f'<default><default class="servo"><dcmotor {shared}/></default>', 1
    )
    rig = Rig.load(saved(text, tmp_path))
    assert rig.motors == RIG_MOTORS
    weak = Motors(replace(XM430_W350, stall_torque=3.9), XM430_W350)
    assert rig.with_(motors=weak).motors == weak


def test_a_missing_number_is_told(tmp_path: Path) -> None:
    text = RIG_XML.read_text(encoding="utf-8")
    start, end = text.index("<custom>"), text.index("</custom>")
    rig = Rig.load(saved(text[:start] + "<custom>" + text[end:], tmp_path))
    assert rig.numbers == Rig.load().numbers
    words = " ".join(rig.notices)
    for name in (
        "frequency",
        "sweep_amplitude",
        "kinematic_viscosity",
        "sweep_servo",
        "pitch_servo",
    ):
        assert f"no numeric {name} in <custom>" in words
    assert Rig.load().notices == ()
    odd = text.replace('key="wake_step" value="0.05"', 'key="wake_step" value="0.03"')
    rig = Rig.load(saved(odd, tmp_path))
    assert rig.model.steps_per_cycle == 167 and "does not divide a cycle" in rig.notices[0]
    lee = blades(
        '<config key="coefficients" value="lee2016"/><config key="reynolds" value="4355"/>'
    )
    lee = lee.replace('<numeric name="kinematic_viscosity" data="1e-06"/>', "")
    rig = Rig.load(saved(lee, tmp_path))
    # half the Reynolds number of the rig in water
    assert rig.fluid.kinematic_viscosity == pytest.approx(2.0e-6, rel=1e-2)
    np.testing.assert_allclose(rig.numbers.reynolds, 4355.0, rtol=1e-12)
