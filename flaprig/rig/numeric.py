"""Numbers of a rig that MJCF has no element for: `<custom><numeric name="..." data="..."/>`."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import mujoco

from flaprig.rig.document import add, section


def numerics(model: mujoco.MjModel) -> dict[str, tuple[float, ...]]:
    """All numbers of <custom> in a compiled file, by name."""
    found = {}
    for number in range(model.nnumeric):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_NUMERIC, number)
        start = model.numeric_adr[number]
        values = model.numeric_data[start : start + model.numeric_size[number]]
        found[name] = tuple(values.tolist())
    return found


def set_numeric(root: ET.Element, name: str, values: Sequence[float]) -> None:
    """Write numbers under a name; without numbers the name goes."""
    element = root.find(f".//custom/numeric[@name='{name}']")
    if not values:
        for custom in root.findall("custom"):
            if element is not None and element in list(custom):
                custom.remove(element)
        return
    if element is None:
        element = add(section(root, "custom"), "numeric", name=name)
    element.attrib.pop("size", None)
    element.set("data", " ".join(repr(float(value)) for value in values))
