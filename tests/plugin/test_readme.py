"""The plugin's README against the plugin: its model runs, its tables are the code's."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pytest

from flaprig.native import _native
from tests.plugin.models import load, reading, two_hinges

README = Path(__file__).resolve().parents[2] / "flaprig" / "native" / "plugin" / "README.md"
PLUGINS = ("flaprig.uvlm", "flaprig.quasi_steady")


@cache
def tables() -> dict[str, dict[str, str]]:
    """Default of every attribute, by the heading of its table."""
    found: dict[str, dict[str, str]] = {}
    heading = ""
    for line in README.read_text().splitlines():
        if line.startswith("## "):
            heading = line[3:]
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if heading.startswith("Attributes") and cells[0].startswith("`"):
            assert len(cells) == 5, line
            found.setdefault(heading, {})[cells[0].strip("`")] = cells[2]
    return found


def defaults(plugin: str) -> dict[str, str]:
    return tables()["Attributes of both plugins"] | tables()[f"Attributes of {plugin}"]


def model_of_the_readme() -> str:
    (xml,) = re.findall(r"```xml\n(.*?)```", README.read_text(), re.DOTALL)
    return xml


@pytest.mark.parametrize("plugin", PLUGINS)
def test_model_runs(plugin: str) -> None:
    xml = model_of_the_readme().replace(PLUGINS[0], plugin)
    if plugin == PLUGINS[1]:
        xml = re.sub(r"\n *<config key=\"wake_step\"[^\n]*", "", xml)
    model = load(xml)
    data = mujoco.MjData(model)
    data.ctrl[:] = 0.8, 0.5
    lift = 0.0
    for _ in range(500):
        mujoco.mj_step(model, data)
        lift = max(lift, reading(data)[6])
    np.testing.assert_allclose(data.qpos, [0.8, 0.5], atol=0.2)
    assert np.isfinite(data.sensordata).all()
    # the sweep of a pitched wing lifts; buoyancy, 0.46 N, is no lift
    assert lift > 0.05
    assert data.sensor("cell").data[:6].all() and not data.sensor("cell").data[6:].any()
    assert (model.npluginstate > 16) == (plugin == PLUGINS[0])


@pytest.mark.parametrize("plugin", PLUGINS)
def test_tables_list_every_attribute(plugin: str) -> None:
    assert list(defaults(plugin)) == _native.attribute_names(plugin)


@pytest.mark.parametrize("plugin", PLUGINS)
def test_defaults_are_the_plugins(plugin: str) -> None:
    """An attribute left out is the same as its default written out."""
    bare = {"site": "wing_frame", "span": "0.25", "chord": "0.0625"}
    written = {k: v for k, v in defaults(plugin).items() if v not in ("required", "none")}
    assert len(written) > 8
    ends = []
    for attributes in (bare, bare | written):
        xml = two_hinges(attributes)
        for other in PLUGINS:
            xml = xml.replace(other, plugin)
        model = load(xml)
        data = mujoco.MjData(model)
        data.qvel[:] = 1.0
        mujoco.mj_step(model, data, nstep=120)
        ends.append((*data.qpos, *data.qvel, *data.sensordata, model.npluginstate))
    assert ends[0] == ends[1]


@pytest.mark.parametrize("plugin", PLUGINS)
def test_defaults_matter(plugin: str) -> None:
    """The comparison above would see a default that is wrong."""
    names = {"core": "0.3", "tip_inset": "0", "suction_efficiency": "1", "wake_step": "0.04"}
    if plugin == PLUGINS[1]:
        names = {"strips": "23", "rotation": "false", "added_mass": "false"}
    common = {"density": "999", "pitch_axis": "0.3", "buoyancy": "true", "wind": "0 0.1 0"}
    bare = {"site": "wing_frame", "span": "0.25", "chord": "0.0625"}
    ends = []
    for change in ({}, *({k: v} for k, v in (names | common).items())):
        xml = two_hinges(bare | change, 'gravity="0 0 -9.81"')
        for other in PLUGINS:
            xml = xml.replace(other, plugin)
        model = load(xml)
        data = mujoco.MjData(model)
        data.qvel[:] = 1.0
        mujoco.mj_step(model, data, nstep=120)
        ends.append(tuple(data.qpos))
    assert len(set(ends)) == len(ends)
