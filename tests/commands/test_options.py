"""The shared options: degrees become radians here, and nothing is silently ignored."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from flaprig import LEE_2016, RIG_WING, UVLM, WATER, QuasiSteady, SunTangStroke, Wing
from flaprig.commands.options import FluidOptions, ModelOptions, StrokeOptions, WingOptions


def test_defaults_are_the_rig() -> None:
    assert StrokeOptions().build() == SunTangStroke(0.2, math.pi / 3, math.pi / 4)
    assert WingOptions().build() == RIG_WING
    assert FluidOptions().build() == WATER
    assert ModelOptions().build() == UVLM()
    assert ModelOptions("quasi-steady").build() == QuasiSteady()
    assert ModelOptions("uvlm-extended").build() == UVLM.extended()
    assert ModelOptions("uvlm-accurate", chordwise=8).build() == UVLM.accurate(chordwise=8)


def test_every_option_arrives() -> None:
    stroke = StrokeOptions(0.3, 50.0, 40.0, 0.4, 0.2).build()
    assert stroke == SunTangStroke(0.3, math.radians(50), math.radians(40), 0.4, 0.2)
    assert WingOptions("beta", 0.24, 0.06, 0.01, 0.3, 0.48, 0.54).build() == Wing.beta(
        0.24, 0.06, 0.48, 0.54, 0.01, 0.3
    )
    assert ModelOptions("uvlm", 50, 4, 8, 0.5, 0.2, 2.0, 2).build() == UVLM(
        chordwise=4,
        spanwise=8,
        steps_per_cycle=50,
        suction_efficiency=0.5,
        wake_cycles=2.0,
        core=0.2,
        threads=2,
    )
    model = ModelOptions("quasi-steady", 64, coefficients="lee2016").build()
    assert model == QuasiSteady(LEE_2016, steps_per_cycle=64)


def test_stroke_file(tmp_path: Path) -> None:
    stroke = SunTangStroke(0.25, 1.0, 0.5, 0.3, 0.2)
    stroke.save(tmp_path / "stroke.json")
    assert StrokeOptions(file=tmp_path / "stroke.json").build() == stroke
    with pytest.raises(ValueError, match="--frequency must be left out with --stroke FILE"):
        StrokeOptions(frequency=0.3, file=tmp_path / "stroke.json").build()


@pytest.mark.parametrize(
    ("options", "flag"),
    [
        (WingOptions(r2=0.5), "--r2"),
        (ModelOptions("quasi-steady", wake_cycles=2.0), "--wake-cycles"),
        (ModelOptions("quasi-steady", suction_efficiency=0.1), "--suction-efficiency"),
        (ModelOptions("uvlm", coefficients="lee2016"), "--coefficients"),
        (ModelOptions("uvlm-extended", suction_efficiency=0.1), "--suction-efficiency"),
        (ModelOptions("uvlm-accurate", coefficients="lee2016"), "--coefficients"),
    ],
)
def test_options_that_would_be_ignored(options: WingOptions | ModelOptions, flag: str) -> None:
    with pytest.raises(ValueError, match=f"{flag} must be left out"):
        options.build()
