"""Files of rigs that are not the paper's: its file with changes that belong together."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np

from flaprig._paths import RIG_XML

# name of a change, and pairs of old and new text; each old text stands in models/rig.xml
CHANGES: dict[str, tuple[tuple[str, str], ...]] = {
    "chord and density": (
        ('key="chord" value="0.0625"', 'key="chord" value="0.05"'),
        ('size="0.03125 0.125 0.0015" pos="0.015625', 'size="0.025 0.125 0.0015" pos="0.0125'),
        ('density="1180"', 'density="1330"'),
        ('key="density" value="1000"', 'key="density" value="998.2"'),
    ),
    "24 V and armature": (
        ("nominal=\"12 4.1 4.817108735504349\"", "nominal=\"24 8.2 9.634217471008698\""),
        ("0 0 12\"", "0 0 24\""),
        ('saturation="4.1 0 0"', 'saturation="6 0 0"'),
        ('armature="0.014639486852400598"', 'armature="0.03"'),
    ),
    "lattice": (
        ('key="chordwise" value="6"', 'key="chordwise" value="3"'),
        ('key="spanwise" value="12"', 'key="spanwise" value="5"'),
        ('key="wake_step" value="0.05"', 'key="wake_step" value="0.125"'),
        ('key="wake_rows" value="100"', 'key="wake_rows" value="33"'),
        ('key="rate" value="ramped"', 'key="rate" value="backward"'),
        ('key="core" value="0.15"', 'key="core" value="0.2"'),
    ),
    "pitch axis": (
        ('key="pitch_axis" value="0.25"', 'key="pitch_axis" value="0.4"'),
        ('pos="0.015625 0.15 0"', 'pos="0.00625 0.15 0"'),
    ),
    "stops": (("range=\"-1.5707963267948966 1.5707963267948966\"", "range=\"-1.2 1.1\""),),
    "friction": (
        ('<joint name="sweep"', '<joint name="sweep" damping="0.03" frictionloss="0.11"'),
        ('<joint name="pitch"', '<joint name="pitch" stiffness="0.01" armature="0.001"'),
    ),
    "no buoyancy": (('key="buoyancy" value="true"', 'key="buoyancy" value="false"'),),
    "wind and mass": (
        ('key="wind" value="0 0 0"', 'key="wind" value="0.1 0 -0.02"'),
        ('pos="0.015625 0.15 0" density="1180"', 'pos="0.015625 0.15 0" mass="0.06"'),
        ('size="0.01425 0.02325 0.017" pos="0 -0.012 0.276" mass="0.082"',
         'size="0.01425 0.02325 0.017" pos="0 -0.012 0.276" mass="0.1"'),
    ),
    "heat": (('thermal="57.24601336790474 12.3 0 0.00393 25 25"',
              'thermal="40 20 0 0.00393 25 31"'),),
    "things of its own": (
        ("<worldbody>", '<worldbody><body pos="1 0 0"><freejoint/><geom size=".1"/></body>'),
        ("</sensor>", '<framepos objtype="site" objname="load_cell"/></sensor>'),
        ("</custom>", '<numeric name="mine" data="1 2 3"/></custom>'),
    ),
}  # fmt: skip


def changed(name: str) -> str:
    """The paper's file with a change."""
    text = RIG_XML.read_text(encoding="utf-8")
    for old, new in CHANGES[name]:
        assert old in text, old
        text = text.replace(old, new)
    if name == "things of its own":
        # a free body that comes first has the first seven of qpos
        text = text.replace('qpos="-1.0471975511965976 0"', 'qpos="1 0 0 1 0 0 0 -1.047 0"')
    return text


def blades(more: str = "") -> str:
    """The paper's file with blade elements instead of the lattice."""
    text = RIG_XML.read_text(encoding="utf-8").replace("flaprig.uvlm", "flaprig.quasi_steady")
    start, end = text.index("<!-- lattice:"), text.index("</instance>")
    own = '<config key="strips" value="9"/><config key="rotation" value="false"/>'
    return text[:start] + own + more + text[end:]


def saved(text: str, folder: Path, name: str = "other.xml") -> Path:
    """A file with that text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def differences(one: mujoco.MjModel, two: mujoco.MjModel) -> list[str]:
    """Names of all numbers, arrays and texts of two models that are not the same."""
    found = []
    for part, other in ((one, two), (one.opt, two.opt)):
        for name in dir(part):
            if name.startswith("_"):
                continue
            value = getattr(part, name)
            if isinstance(value, np.ndarray | int | float | bytes | str) and not np.array_equal(
                np.asarray(value), np.asarray(getattr(other, name))
            ):
                found.append(name)
    return found
