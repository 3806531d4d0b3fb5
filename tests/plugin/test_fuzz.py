"""Thousands of random model files: each loads and steps, or is refused with one line."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from pathlib import Path
from xml.sax.saxutils import quoteattr

import pytest

from flaprig.native import _native
from tests.plugin.models import PLATE, RECTANGLE, SENSORS, SITES

MODELS = 4000
GARBAGE = [
    "", " ", "nan", "NaN", "inf", "-inf", "1e999", "-1", "0", "1e-300", "1e300", "1,5", "0x10",
    "true", "TRUE", "false", "null", "1 2 3", "1 2 3 4 5 6 7", "abc", "ä€", "<>&\"'", "%s%n%d",
    "9" * 400, "1 " * 4000, "\t1", "1e", "--1", ".", "0.5.5", "wing_frame", "load_cell", "table",
]  # fmt: skip
# values that may be right; numbers stay small, so that thousands of models are quick
PLAUSIBLE = {
    "site": ["wing_frame", "load_cell", "outside"],
    "span": ["0.25", "1e-5", "1000", "0.1"],
    "chord": ["0.0625", "1e-5", "1000"],
    "root_offset": ["0", "-0.1", "0.025", "-1000"],
    "pitch_axis": ["0.25", "0", "10", "-10"],
    "stations": [
        "0 .1 0 1 .1 0", "0 0 0 .1 .05 -.01 .2 0 0", "0 0 0 1 0 0", "1 .1 0 0 .1 0",
        "0 .1 0 0 .1 0", "0 .1 0 1 -.1 0", "0 .1 nan 1 .1 0", "0 .1 0 1e-9 .1 0",
    ],
    "density": ["1000", "1.2", "1e-300", "100000"],
    "wind": ["0 0 0", "1 -2 3", "1000 1000 1000", "0 0 1001"],
    "thickness": ["0", "0.003", "10"],
    "buoyancy": ["true", "false"],
    "chordwise": ["1", "2", "3", "65"],
    "spanwise": ["1", "2", "4", "129"],
    "wake_step": ["0.05", "1e-7", "1000", "0.002"],
    "wake_rows": ["1", "2", "10", "100001"],
    "core": ["0.2", "2", "1e-12", "0.001"],
    "wake_detail": ["0", "1", "2", "50", "1.5"],
    "wake_fade": ["0", "0.3", "1"],
    "shedding_fraction": ["0.25", "0.01", "0.99"],
    "tip_inset": ["0", "0.25", "0.5"],
    "rate": ["ramped", "backward", "second_order"],
    "precision": ["single", "double"],
    "side_suction_efficiency": ["0", "1", "10"],
    "circulation_lag": ["0", "0.125", "10"],
    "suction_efficiency": ["0", "1", "10"],
    "suction_factor": ["0", "1", "2"],
    "threads": ["1", "2"],
    "strips": ["1", "24", "1000"],
    "coefficients": ["dickinson1999", "lee2016", "table"],
    "reynolds": ["100", "1e7", "14000"],
    "coefficient_table": ["0 0 0 3.1416 1 1", "0 0 0 0 1 1", "0 100 -100 1 0 0"],
    "rotation": ["true", "false"],
    "added_mass": ["true", "false"],
}  # fmt: skip
JOINTS = [
    '<joint axis="0 -1 0"/>', '<joint axis="0 1 0"/><joint axis="1 0 0"/>', "<freejoint/>",
    '<joint type="ball"/>', "", '<joint type="slide" axis="0 0 1"/>',
]  # fmt: skip
OPTIONS = [
    "", 'integrator="RK4"', 'integrator="Euler"', 'integrator="implicit"', 'solver="PGS"',
    'solver="CG"', 'gravity="0 0 0"', 'timestep="1e-9"', 'timestep="10"', 'density="3"',
]  # fmt: skip


def attributes(rng: random.Random, plugin: str) -> dict[str, str]:
    """A valid lot, in which some things are changed, left out or spoilt."""
    chosen = dict(RECTANGLE)
    if rng.random() < 0.3:
        chosen = {"site": "wing_frame", "stations": PLAUSIBLE["stations"][rng.randrange(8)]}
    if plugin == "flaprig.uvlm":
        chosen |= {"chordwise": "2", "spanwise": "2", "wake_rows": "4"}
    names = _native.attribute_names(plugin)
    for _ in range(rng.choice([0, 1, 1, 2, 4])):
        name = rng.choice(names)
        chosen[name] = rng.choice(PLAUSIBLE[name] if rng.random() < 0.6 else GARBAGE)
    if rng.random() < 0.1:
        del chosen[rng.choice(list(chosen))]
    if rng.random() < 0.02:
        chosen[rng.choice(["", "spann", "köre", "core "])] = rng.choice(GARBAGE)
    return chosen


def random_xml(rng: random.Random) -> str:
    """A model with one wing, or now and then with a second on the same instance."""
    plugin = rng.choice(["flaprig.uvlm", "flaprig.quasi_steady"])
    config = "".join(
        f"<config key={quoteattr(key)} value={quoteattr(value)}/>"
        for key, value in attributes(rng, plugin).items()
    )
    air = f'<plugin plugin="{plugin}"><instance name="air">{config}</instance></plugin>'
    sites = SITES if rng.random() < 0.98 else ""
    body = f'<body name="wing">{rng.choice(JOINTS)}{PLATE}{sites}<plugin instance="air"/></body>'
    if rng.random() < 0.02:
        body += '<body><plugin instance="air"/></body>'
    sensors = SENSORS.format(plugin) if sites and rng.random() < 0.7 else ""
    return (
        f"<mujoco><option {rng.choice(OPTIONS)}/><extension>{air}</extension>"
        f'<worldbody><site name="outside"/>{body}</worldbody><sensor>{sensors}</sensor></mujoco>'
    )


def run(first: int, count: int) -> dict[str, int | list[str]]:
    """Try that many models; what went otherwise than allowed is listed."""
    import mujoco

    from flaprig.native import library

    library.load()
    tally = {"loaded": 0, "refused": 0}
    faults: list[str] = []
    for seed in range(first, first + count):
        xml = random_xml(random.Random(seed))
        try:
            model = mujoco.MjModel.from_xml_string(xml)
            data = mujoco.MjData(model)
            data.qvel[:] = 0.5
            mujoco.mj_step(model, data, nstep=40)
            tally["loaded"] += 1
        except ValueError as error:
            tally["refused"] += 1
            text = str(error)
            # MuJoCo's own refusals, of names, add the element and its line
            lines = 3 if "unrecognized attribute" in text else 1
            if len(text.splitlines()) > lines or len(text) > 900:
                faults.append(f"{seed}: {text}")
        except Exception as error:
            faults.append(f"{seed}: {type(error).__name__} {error}")
    return tally | {"faults": faults}


@pytest.mark.parametrize("part", [0, 1])
def test_random_models(part: int, root: Path, tmp_path: Path) -> None:
    """In a process of their own, whose death would be seen."""
    count = MODELS // 2
    code = (
        "import json, sys; sys.path.insert(0, sys.argv[1]); from tests.plugin import test_fuzz;"
        f"print(json.dumps(test_fuzz.run({part * count}, {count})))"
    )
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code, str(root)],
        cwd=tmp_path, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    result = json.loads(done.stdout.splitlines()[-1])
    assert result["faults"] == []
    assert result["loaded"] + result["refused"] == count
    # both happen often, or the test would be about nothing
    assert result["loaded"] > count // 5 and result["refused"] > count // 5
