"""Writing into a rig's file what differs between the numbers that it has and those asked for.

Everything else stays as it was written: an attribute, a key or one number of several is changed
only where the two sets of numbers say different things there.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

from flaprig.native import _native
from flaprig.rig import plate
from flaprig.rig.document import Document, add
from flaprig.rig.names import AIR, Geom, Site
from flaprig.rig.numbers import RigNumbers
from flaprig.rig.numeric import set_numeric
from flaprig.rig.servo_element import write_motors

# keys of a rectangle, which stations replace
_RECTANGLE = ("span", "chord", "root_offset", "pitch_axis")


def written(document: Document, old: RigNumbers, new: RigNumbers) -> Document:
    """The document with the new numbers.

    Args:
        document: the file.
        old: what it says.
        new: what it is to say.

    Raises:
        ValueError: a servo is to be changed that is no <dcmotor> element.
    """
    if old == new:
        return document
    root = document.root()
    if new.wing != old.wing:
        plate.write(root, old.wing, new.wing)
        _move_root(root, new.wing.root_offset, new.wing.root_offset - old.wing.root_offset)
    write_motors(root, old.motors, new.motors)
    _write_air(root, old, new)
    _write_numerics(root, old, new)
    return document.edited(root)


def _write_air(root: ET.Element, old: RigNumbers, new: RigNumbers) -> None:
    """Keys of the plugin's instance whose value is another now."""
    before, after = old.attributes(), new.attributes()
    instance = next(e for e in root.iterfind(".//instance") if e.get("name") == AIR)
    if new.model.plugin != old.model.plugin:
        _change_plugin(root, instance, new.model.plugin)
    known = set(_native.attribute_names(new.model.plugin))
    gone = set(before) - set(after)
    if before["stations"] != after["stations"]:
        gone |= set(_RECTANGLE)
    configs = {config.get("key", ""): config for config in instance.findall("config")}
    for key, config in configs.items():
        if key in gone or key not in known:
            instance.remove(config)
    for key, value in after.items():
        if value == before.get(key):
            continue
        place = configs[key] if key in configs else add(instance, "config", key=key)
        place.set("value", value)


def _change_plugin(root: ET.Element, instance: ET.Element, name: str) -> None:
    """Put the instance, its sensors and its body under another plugin's name."""
    for extension in root.findall("extension"):
        for plugin in extension.findall("plugin"):
            if instance not in list(plugin):
                continue
            if len(plugin.findall("instance")) == 1:
                plugin.set("plugin", name)
                break
            plugin.remove(instance)
            add(extension, "plugin", plugin=name).append(instance)
            break
    for user in root.iterfind(f".//plugin[@instance='{AIR}']"):
        if user.get("plugin"):
            user.set("plugin", name)


def _write_numerics(root: ET.Element, old: RigNumbers, new: RigNumbers) -> None:
    """What MJCF has no place for: the clock, the viscosity, and what attributes round."""
    for name, before, after in (
        ("frequency", old.frequency, new.frequency),
        ("sweep_amplitude", old.sweep_amplitude, new.sweep_amplitude),
        ("kinematic_viscosity", old.fluid.kinematic_viscosity, new.fluid.kinematic_viscosity),
    ):
        if before != after:
            set_numeric(root, name, [after])
    if new.model == old.model:
        return
    bare = type(new.model).from_attributes(new.attributes(), {}, new.frequency, new.reynolds)
    exact, rounded = new.model.numerics(), bare.numerics()
    for name in {**old.model.numerics(), **exact}:
        needed = exact.get(name) != rounded.get(name)
        set_numeric(root, name, exact.get(name, ()) if needed else ())


def _move_root(root: ET.Element, place: float, shift: float) -> None:
    """The cell's frame moves with the root; cell and clamp are drawn where there is room for them.

    Only what the file places by plain numbers is moved.
    """
    if shift == 0.0:
        return
    for element in root.iterfind(f".//worldbody//site[@name='{Site.LOAD_CELL}']"):
        _shift(element, "pos", shift)
    for name in (Geom.SHAFT, Geom.CELL, Geom.CLAMP):
        for body in root.iterfind(".//worldbody//body"):
            for geom in body.findall(f"geom[@name='{name}']"):
                if shift < 0.0 and (name is not Geom.SHAFT or place == 0.0):
                    body.remove(geom)
                elif name is Geom.SHAFT:
                    _shift(geom, "pos", shift / 2.0)
                    _shift(geom, "size", shift / 2.0)
                else:
                    _shift(geom, "pos", shift)


def _shift(element: ET.Element, attribute: str, by: float) -> None:
    """Add to the second number of an attribute, which runs along the span."""
    numbers = [float(word) for word in element.get(attribute, "0 0 0").split()]
    if len(numbers) > 1:
        numbers[1] += by
        element.set(attribute, " ".join(map(repr, numbers)))
