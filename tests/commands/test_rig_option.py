"""--rig FILE: every command is about that rig, and other options change only what they name."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from flaprig import RIG_WING, UVLM, WATER, Fluid, QuasiSteady, Wing
from flaprig.aero.coefficients import LEE_2016
from flaprig.cli import main
from flaprig.commands.options import FluidOptions, ModelOptions, StrokeOptions, WingOptions
from flaprig.commands.rig_options import rig_of
from flaprig.motors import XM430_W350, Motors
from flaprig.rig import Rig
from tests.rig.files import changed, saved

BETA = Wing.beta(0.24, 0.06, 0.5, thickness=0.002, density=1300.0)
OIL = Fluid(900.0, 3e-5, (0.0, 0.0, 0.01))
QUICK = ["--cycles", "2", "--json"]


@pytest.fixture
def lab(tmp_path: Path) -> Path:
    """A small rig in oil, with blade elements: quick."""
    servo = replace(XM430_W350, voltage=11.1, stall_torque=3.8)
    Rig(
        wing=Wing.rectangular(0.2, 0.05, 0.03, 0.3),
        fluid=OIL,
        motors=Motors(servo, servo),
        model=QuasiSteady(strips=7, steps_per_cycle=50),
    ).save(tmp_path / "lab.xml")
    return tmp_path / "lab.xml"


def told(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    assert main(list(words)) in (0, 1)
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("command", ["simulate", "twin", "check"])
def test_the_file_counts(command: str, lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ours = told(capsys, command, "--rig", str(lab), *QUICK)
    assert ours["rig"] == str(lab) and ours["buoyancy"] is True
    assert (ours["model"], ours["steps_per_cycle"]) == ("quasi-steady", 50)
    # the same by options, without the file: wing and fluid are the only ones that options have
    words = "--span .2 --chord .05 --root-offset .03 --pitch-axis .3 --density 900 --viscosity 3e-5"
    options = [*words.split(), "--wind", "0", "0", "0.01", "--model", "quasi-steady"]
    theirs = told(capsys, command, *options, "--steps-per-cycle", "50", *QUICK)
    assert ours["cl"] == pytest.approx(theirs["cl"], rel=0.02)
    assert ours["cl"] != theirs["cl"] and str(theirs["rig"]).endswith("rig.xml")


def test_export_is_for_that_rig(
    lab: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = ("--cycles", "1", "--json", "--out")
    torque = []
    for name, words in (("a", ("--rig", str(lab))), ("b", ())):
        found = told(capsys, "export", *words, *out, str(tmp_path / name))
        rows = np.genfromtxt(tmp_path / name / "trajectory.csv", delimiter=",", names=True)
        torque.append(np.abs(rows["sweep_torque_Nm"]).mean())
        assert (found["rig"] == str(lab)) == (name == "a")
    # a shorter wing, less than half the torque
    assert torque[0] < 0.6 * torque[1]


def test_the_stops_of_the_file_are_the_limits(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also with --limits paper: stops at 1.0 rad leave no room for 60 degrees."""
    path = saved(changed("stops").replace("-1.2 1.1", "-1.0 1.0"), tmp_path)
    words = ("check", "--rig", str(path), "--model", "quasi-steady", *QUICK, "--limits", "paper")
    found = told(capsys, *words)
    assert "sweep_position_rad" in found["broken"]  # type: ignore[operator]


@pytest.mark.parametrize("command", ["simulate", "twin", "check", "export", "view"])
def test_what_is_no_rig_is_one_sentence(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = ["--out", str(tmp_path / "out")] if command in ("export", "twin") else []
    for path, words in ((tmp_path / "none.xml", "there is no file"), (None, "lacks joint sweep")):
        file = path or saved("<mujoco/>", tmp_path)
        assert main([command, "--rig", str(file), *out]) == 2
        error = capsys.readouterr().err
        assert words in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()


def built(file: Path | None, wing: WingOptions, fluid: FluidOptions, model: ModelOptions) -> Rig:
    return rig_of(file, StrokeOptions().build(), wing, fluid, model)


def test_options_change_what_they_name(lab: Path) -> None:
    rig = Rig.load(lab)
    none = (WingOptions(), FluidOptions(), ModelOptions())
    assert built(lab, *none) == rig
    assert built(None, *none) == Rig.load()
    narrow = built(lab, WingOptions(chord=0.04), *none[1:])
    assert narrow.wing == Wing.rectangular(0.2, 0.04, 0.03, 0.3)
    assert narrow == rig.with_(wing=narrow.wing)
    thin = built(lab, none[0], FluidOptions(density=1.2), none[2])
    assert thin == rig.with_(fluid=replace(OIL, density=1.2))
    lee = built(lab, *none[:2], ModelOptions(coefficients="lee2016"))
    assert lee.model == QuasiSteady(LEE_2016, strips=7, steps_per_cycle=50)
    # a model that is named has its own defaults
    assert built(lab, *none[:2], ModelOptions("quasi-steady")).model == QuasiSteady()
    assert built(lab, *none[:2], ModelOptions("uvlm", chordwise=4)).model == UVLM(4)
    with pytest.raises(ValueError, match="--core must be left out with --model quasi-steady"):
        built(lab, *none[:2], ModelOptions(core=0.1))


def test_another_planform_is_stretched() -> None:
    wing = WingOptions(span=0.3, chord=0.05, root_offset=0.01, pitch_axis=0.4).build(BETA)
    assert wing.span == pytest.approx(0.3) and wing.mean_chord == pytest.approx(0.05)
    assert wing.root_offset == 0.01 and wing.pitch_axis == pytest.approx(0.4)
    assert wing.r2hat == pytest.approx(BETA.r2hat, rel=1e-9)
    assert (wing.thickness, wing.density) == (0.002, 1300.0)
    assert WingOptions().build(BETA) is BETA
    # of the rig's plate, in another shape
    assert WingOptions("rectangle").build(BETA).density == 1300.0
    assert WingOptions("beta").build(BETA).thickness == 0.002
    with pytest.raises(ValueError, match="--r1 must be left out unless --planform is beta"):
        WingOptions(r1=0.5).build(BETA)
    with pytest.raises(ValueError, match="options: --chord must be a positive number in m"):
        WingOptions(chord=-1.0).build(BETA)
    assert FluidOptions().build(OIL) == OIL and FluidOptions().build() == WATER
    np.testing.assert_array_equal(WingOptions().build().stations, RIG_WING.stations)
