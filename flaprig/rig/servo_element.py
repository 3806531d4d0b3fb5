"""A servo in a rig's file: MuJoCo's `dcmotor` read as a Motor, and a Motor's numbers written.

MuJoCo knows a servo by torque constant, resistance and thermal resistance. What it does not know,
continuous torque, temperature limit and mass, is in `<custom><numeric name="sweep_servo">`.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import mujoco

from flaprig import _checks as check
from flaprig.motors import (
    COPPER,
    REFERENCE_TEMPERATURE,
    XM430_W350,
    Motor,
    Motors,
    continuous_torque,
)
from flaprig.rig.contract import OWNER
from flaprig.rig.names import PITCH_SERVO, Axis
from flaprig.rig.numeric import numerics, set_numeric

# two numbers that mean the same after a division there and back
ROUNDING = 1e-9
# share by which copper's coefficient and reference temperature may differ from motors.py's
_SAME_COPPER = 0.02
# share by which a file may round the range of its controls
_RANGE_ROUNDING = 1e-3
# slots of MuJoCo's parameters of a dcmotor
_RESISTANCE, _CONSTANT, _COPPER, _REFERENCE, _KP, _KI, _KD, _VOLTAGE = range(8)
_THERMAL, _CAPACITY, _AMBIENT, _SLEW = 2, 3, 4, 7


def rating_name(axis: Axis) -> str:
    """Name of the numeric of continuous torque [N m], temperature limit [degC] and mass [kg]."""
    return f"{axis}_servo"


def read_motors(model: mujoco.MjModel, root: ET.Element) -> Motors:
    """Both servos of a compiled file.

    Raises:
        ValueError: a servo that no Motor can be; names the actuator.
    """
    return Motors(*(_read(model, root, axis) for axis in Axis))


def _read(model: mujoco.MjModel, root: ET.Element, axis: Axis) -> Motor:
    number = model.actuator(axis).id
    gain, dynamics = model.actuator_gainprm[number], model.actuator_dynprm[number]
    _refuse_other_laws(model, number, axis)
    constant, ohms, voltage = gain[_CONSTANT], gain[_RESISTANCE], gain[_VOLTAGE]
    electrical = (voltage, constant * voltage / ohms, voltage / constant)
    nominal = numbers_of(root, axis, "nominal")
    # the file's own digits, where they say the same
    if len(nominal) == 3 and all(map(same, nominal, electrical)):
        electrical = (nominal[0], nominal[1], nominal[2])
    limit = float(model.actuator_forcerange[number, 1])
    ambient, thermal = float(dynamics[_AMBIENT]), float(dynamics[_THERMAL])
    continuous, hottest, mass = _rating(model, axis)
    if hottest <= ambient:
        raise check.fail(OWNER, f"temperature limit of {axis}", f"above {ambient} degC", hottest)
    if axis is Axis.PITCH:
        mass = _mass_on_the_arm(root) or mass
    rated = continuous_torque(thermal, constant, ohms, hottest, ambient)
    return Motor(
        voltage=float(electrical[0]),
        stall_torque=float(electrical[1]),
        no_load_speed=float(electrical[2]),
        # the file's thermal resistance is what MuJoCo heats with: where it says another, it counts
        continuous_torque=(
            continuous if same(continuous, rated) else min(rated, float(electrical[1]))
        ),
        temperature_limit=hottest,
        ambient_temperature=ambient,
        heat_capacity=float(dynamics[_CAPACITY]),
        rotor_inertia=float(model.actuator_armature[number]),
        stiffness=float(gain[_KP]),
        damping=float(gain[_KD]),
        mass=mass,
        slew_rate=float(dynamics[_SLEW]),
        torque_limit=0.0 if same(limit, electrical[1]) else limit,
    )


def _rating(model: mujoco.MjModel, axis: Axis) -> tuple[float, float, float]:
    """Continuous torque, temperature limit, mass; those of the rig's own servo where not given."""
    own = (XM430_W350.continuous_torque, XM430_W350.temperature_limit, XM430_W350.mass)
    given = numerics(model).get(rating_name(axis), own)
    if len(given) != 3:
        allowed = "three numbers: continuous torque [N m], temperature limit [degC], mass [kg]"
        raise check.fail(OWNER, f"numeric {rating_name(axis)}", allowed, given)
    name = f"numeric {rating_name(axis)}"
    for value, words in zip(given, ("continuous torque", "temperature limit", "mass"), strict=True):
        check.positive(OWNER, f"{name}'s {words}", value)
    return given


def _refuse_other_laws(model: mujoco.MjModel, number: int, axis: Axis) -> None:
    """The servo's law in Python has no integral gain, inductance, cogging or LuGre friction."""
    owner, gain = f"{OWNER}: dcmotor {axis}", model.actuator_gainprm[number]
    dynamics = model.actuator_dynprm[number]
    if gain[_KI] or gain[_RESISTANCE] <= 0.0 or gain[_CONSTANT] <= 0.0 or gain[_VOLTAGE] <= 0.0:
        allowed = "kp 0 kd slew 0 volts, with kp, kd and the supply's volts above zero, and nominal"
        raise check.fail(owner, "controller", allowed, [float(x) for x in gain[_KP:8]])
    if not model.actuator_forcelimited[number]:
        raise check.fail(owner, "saturation", "given: the torque limit in N m", "none")
    if dynamics[_THERMAL] <= 0.0 or dynamics[_CAPACITY] <= 0.0:
        raise check.fail(owner, "thermal", "given, with K/W and J/K above zero", "none")
    copper = (float(gain[_COPPER]), float(gain[_REFERENCE]))
    if not all(
        math.isclose(a, b, rel_tol=_SAME_COPPER)
        for a, b in zip(copper, (COPPER, REFERENCE_TEMPERATURE), strict=True)
    ):
        allowed = f"with copper's {COPPER} 1/K from {REFERENCE_TEMPERATURE} degC"
        raise check.fail(owner, "thermal", allowed, copper)
    states = 2 if dynamics[_SLEW] else 1
    if model.actuator_actnum[number] != states or model.actuator_biasprm[number].any():
        raise check.fail(owner, "servo", "without inductance, cogging and lugre", "one with some")


def write_motors(root: ET.Element, old: Motors, new: Motors) -> None:
    """Write what differs between two pairs of servos, number by number.

    Raises:
        ValueError: the file has a servo that is no <dcmotor> element.
    """
    for axis in Axis:
        before, after = getattr(old, axis), getattr(new, axis)
        if before != after:
            _write(root, axis, before, after)


def _write(root: ET.Element, axis: Axis, old: Motor, new: Motor) -> None:
    element = element_of(root, axis)
    if element is None:
        raise check.fail("Rig", f"servo {axis}", "a <dcmotor> element to be changed", "another")
    for name, values in new.dcmotor.items():
        given = numbers_of(root, axis, name) or [0.0] * len(values)
        given += [0.0] * (len(values) - len(given))
        before = old.dcmotor[name]
        changed = [g if a == b else b for g, a, b in zip(given, before, values, strict=True)]
        if changed != given:
            element.set(name, " ".join(map(repr, changed)))
    if new.dcmotor["nominal"] != old.dcmotor["nominal"]:
        # MuJoCo prefers these, and a class may have made them out of its own nominal
        inherited = _default(root, element.get("class"), "nominal")
        for name, value in (("motorconst", new.torque_constant), ("resistance", new.resistance)):
            element.attrib.pop(name, None)
            if inherited:
                element.set(name, repr(value))
    _widen(element, old, new)
    if new.rotor_inertia != old.rotor_inertia:
        element.set("armature", repr(new.rotor_inertia))
    rating = [(m.continuous_torque, m.temperature_limit, m.mass) for m in (old, new)]
    if rating[0] != rating[1]:
        set_numeric(root, rating_name(axis), rating[1])
    if axis is Axis.PITCH and new.mass != old.mass:
        _weigh(root, new.mass)


def _widen(element: ET.Element, old: Motor, new: Motor) -> None:
    """A range of the controls that is the servo's own goes with it; another is never too narrow."""
    given = [float(word) for word in element.get("ctrlrange", "").split()]
    if len(given) != 2 or max(-given[0], given[1]) <= 0.0:
        return
    before, after = (max(motor.no_load_speed, motor.peak_torque) for motor in (old, new))
    if all(math.isclose(end, before, rel_tol=_RANGE_ROUNDING) for end in (-given[0], given[1])):
        wide = [-after, after]
    else:
        wide = [min(given[0], -after), max(given[1], after)]
    if wide != given:
        element.set("ctrlrange", " ".join(map(repr, wide)))


def _mass_on_the_arm(root: ET.Element) -> float | None:
    geom = root.find(f".//worldbody//geom[@name='{PITCH_SERVO}']")
    given = None if geom is None else geom.get("mass")
    return float(given) if given else None


def _weigh(root: ET.Element, mass: float) -> None:
    """The pitch servo rides on the arm: its geom has its mass."""
    for geom in root.iterfind(f".//worldbody//geom[@name='{PITCH_SERVO}'][@mass]"):
        geom.set("mass", repr(mass))


def element_of(root: ET.Element, axis: Axis) -> ET.Element | None:
    """The <dcmotor> of an axis; None where the file has another kind of actuator."""
    return root.find(f".//actuator/dcmotor[@name='{axis}']")


def numbers_of(root: ET.Element, axis: Axis, name: str) -> list[float]:
    """An attribute of a servo's element, or of the defaults that it stands under; empty if none."""
    element = element_of(root, axis)
    if element is None:
        return []
    own = element.get(name)
    if own is None:
        own = _default(root, element.get("class"), name)
    return [float(word) for word in own.split()] if own else []


def _default(root: ET.Element, name: str | None, attribute: str) -> str | None:
    """What the defaults of a class say of <dcmotor>, the nearest class first."""
    parents = {child: parent for parent in root.iter("default") for child in parent}
    tops = [c for c in root.findall("default") if c.get("class", "main") == "main"]
    at = next((c for c in root.iter("default") if name and c.get("class") == name), None)
    levels = [at] if at is not None else []
    while levels and levels[-1] in parents:
        levels.append(parents[levels[-1]])
    for level in levels or tops:
        found = level.find("dcmotor")
        if found is not None and found.get(attribute):
            return found.get(attribute)
    return None


def same(a: float, b: float) -> bool:
    """Whether two numbers differ by no more than a file's rounding."""
    return math.isclose(a, b, rel_tol=ROUNDING)
