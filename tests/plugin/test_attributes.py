"""Every attribute of both plugins: a wrong value fails at compile time, in words."""

from __future__ import annotations

import re

import mujoco
import pytest

from flaprig.native import _native
from tests.plugin.models import BLADES, RECTANGLE, load, two_hinges

UVLM, QUASI_STEADY = "flaprig.uvlm", "flaprig.quasi_steady"
SMALL = {"chordwise": "2", "spanwise": "2", "wake_rows": "3"}
TABLE = {"coefficients": "table"}
LEE = {"coefficients": "lee2016"}

# (wrong value, what is allowed); the rest of the model is right
COMMON = {
    "site": ("nowhere", "the name of a site on the wing's own body"),
    "span": ("-1", "one number from 1e-05 to 1000 m"),
    "chord": ("wide", "one number from 1e-05 to 1000 m"),
    "root_offset": ("nan", "one number from -1000 to 1000 m"),
    "pitch_axis": ("0.2 0.3", "one number from -10 to 10 chords"),
    "stations": ("0 0.1", "2 to 1000 triples of numbers"),
    "density": ("0", "one number above 0 and up to 100000 kg/m3"),
    "wind": ("1 2", "three numbers within +-1000 m/s"),
    "thickness": ("-0.001", "one number from 0 to 10 m"),
    "buoyancy": ("yes", "false or true"),
}
LATTICE = {
    "chordwise": ("0", "a whole number from 1 to 64"),
    "spanwise": ("2.5", "a whole number from 1 to 128"),
    "wake_step": ("0", "one number from 1e-07 to 1000 s"),
    "wake_rows": ("-3", "a whole number from 1 to 100000"),
    "core": ("0", "one number above 0 and up to 2 mean chords"),
    "wake_detail": ("-1", "a whole number from 0 to 100000"),
    "wake_fade": ("1.5", "one number from 0 to 1"),
    "shedding_fraction": ("1", "one number from 0.01 to 0.99"),
    "tip_inset": ("0.6", "one number from 0 to 0.5 strips"),
    "rate": ("second", "ramped, backward or second_order"),
    "precision": ("half", "single or double"),
    "suction_efficiency": ("inf", "one number from 0 to 10"),
    "suction_factor": ("3", "one number from 0 to 2"),
    "side_suction_efficiency": ("11", "one number from 0 to 10"),
    "circulation_lag": ("-0.1", "one number from 0 to 10 chords"),
    "threads": ("1e9", "a whole number from 1 to 64"),
}
BLADE = {
    "strips": ("1001", "a whole number from 1 to 1000"),
    "coefficients": ("dickinson", "dickinson1999, lee2016 or table"),
    "reynolds": ("5", "one number from 100 to 1e+07"),
    "coefficient_table": ("0 1 1 4 1 1", '2 to 1000 triples "alpha lift drag"'),
    "rotation": ("1", "false or true"),
    "added_mass": ("no", "false or true"),
}
CASES = [(UVLM, name, *case) for name, case in (COMMON | LATTICE).items()]
CASES += [(QUASI_STEADY, name, *case) for name, case in (COMMON | BLADE).items()]


def good(plugin: str, name: str) -> dict[str, str]:
    """Attributes that are right and let this one be read."""
    attributes = RECTANGLE | (SMALL if plugin == UVLM else {"strips": "2"})
    if name == "stations":
        attributes = {k: v for k, v in attributes.items() if k not in RECTANGLE or k == "site"}
    return attributes | {"coefficient_table": TABLE, "reynolds": LEE}.get(name, {})


@pytest.mark.parametrize("plugin", [UVLM, QUASI_STEADY])
def test_every_attribute_has_a_case(plugin: str) -> None:
    ours = {name for kind, name, *_ in CASES if kind == plugin}
    assert ours == set(_native.attribute_names(plugin))


@pytest.mark.parametrize(("plugin", "name", "value", "allowed"), CASES)
def test_wrong_value(plugin: str, name: str, value: str, allowed: str) -> None:
    attributes = good(plugin, name) | {name: value}
    sentence = rf'{plugin} "air": {name} must be .*{re.escape(allowed)}.*got "{re.escape(value)}"$'
    with pytest.raises(ValueError, match=sentence) as refusal:
        load(two_hinges(attributes))
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("needed", ["span", "chord", "reynolds", "coefficient_table", "site"])
def test_missing_value(needed: str) -> None:
    attributes = good(QUASI_STEADY, needed)
    attributes.pop(needed, None)
    with pytest.raises(ValueError, match=f'"air": {needed} must be '):
        load(two_hinges(attributes))


def test_stations_and_a_rectangle() -> None:
    for other in ("span", "chord", "root_offset", "pitch_axis"):
        with pytest.raises(ValueError, match=f"{other} must be left out when stations are given"):
            load(two_hinges(BLADES | {other: "0.1"}))


@pytest.mark.parametrize("plugin", [UVLM, QUASI_STEADY])
def test_unknown_attribute(plugin: str) -> None:
    """MuJoCo itself refuses it, with the name."""
    attributes = good(plugin, "") | {"spann": "0.2"}
    with pytest.raises(ValueError, match="unrecognized attribute 'plugin:spann'"):
        load(two_hinges(attributes))
    other = "strips" if plugin == UVLM else "core"
    with pytest.raises(ValueError, match=f"unrecognized attribute 'plugin:{other}'"):
        load(two_hinges(good(plugin, "")).replace("</instance>",
             f'<config key="{other}" value="1"/></instance>'))  # fmt: skip


def test_wrong_value_through_mjspec() -> None:
    """The editor's way into the compiler."""
    spec = mujoco.MjSpec.from_string(two_hinges(good(UVLM, "")))
    config = dict(spec.plugins[0].config)
    spec.plugins[0].config = config | {"core": "-1"}
    with pytest.raises(ValueError, match=r'core must be one number above 0 .* got "-1"'):
        spec.compile()
    spec.plugins[0].config = config
    assert spec.compile().nplugin == 1


@pytest.mark.parametrize("name", ["core", "site"])
def test_long_values_are_cut_short(name: str) -> None:
    with pytest.raises(ValueError, match=f"{name} must be") as refusal:
        load(two_hinges(good(UVLM, name) | {name: "7 " * 5000}))
    assert len(str(refusal.value)) < 300
