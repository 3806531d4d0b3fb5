"""What a rig's file must have: names, kinds and frames, each failure one sentence.

The file is read with names first, since MuJoCo's own words about a missing one do not say what
else is expected; kinds and frames follow from the compiled model.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from flaprig import _checks as check
from flaprig.aero.models import MODELS
from flaprig.rig.names import AIR, INPUTS, Axis, Geom, Sensor, Site

OWNER = "rig's file"
# sine of an angle, and share of a chord, by which frames may be off: digits of a file
FRAME = 1e-3
# strongest gravity accepted [m/s2]
MOST_GRAVITY = 1e3
UP = np.array([0.0, 0.0, 1.0])
# what each sensor must be, and of what
SENSORS = {
    Sensor.AERO: (mujoco.mjtSensor.mjSENS_PLUGIN, ""),
    Sensor.LOAD_CELL: (mujoco.mjtSensor.mjSENS_PLUGIN, Site.LOAD_CELL),
    Sensor.SWEEP_ENCODER: (mujoco.mjtSensor.mjSENS_JOINTPOS, Axis.SWEEP),
    Sensor.PITCH_ENCODER: (mujoco.mjtSensor.mjSENS_JOINTPOS, Axis.PITCH),
    Sensor.SWEEP_VELOCITY: (mujoco.mjtSensor.mjSENS_JOINTVEL, Axis.SWEEP),
    Sensor.PITCH_VELOCITY: (mujoco.mjtSensor.mjSENS_JOINTVEL, Axis.PITCH),
    Sensor.SWEEP_TORQUE: (mujoco.mjtSensor.mjSENS_ACTUATORFRC, Axis.SWEEP),
    Sensor.PITCH_TORQUE: (mujoco.mjtSensor.mjSENS_ACTUATORFRC, Axis.PITCH),
}


def require_names(spec: mujoco.MjSpec) -> None:
    """Refuse a file that lacks a name, in one sentence with all that are needed and all there are.

    Raises:
        ValueError: lists what a rig's file must have, what this one lacks and what it has.
    """
    kinds: dict[str, tuple[Any, Sequence[str]]] = {
        "joint": (spec.joints, list(Axis)),
        "geom": (spec.geoms, [Geom.PLATE]),
        "site": (spec.sites, list(Site)),
        "actuator": (spec.actuators, list(Axis)),
        "sensor": (spec.sensors, list(Sensor)),
        "plugin instance": ([p for p in spec.plugins if p.plugin_name in MODELS], [AIR]),
    }
    needed, missing, there = [], [], []
    for kind, (elements, names) in kinds.items():
        found = sorted({element.name for element in elements if element.name})
        lacking = [str(name) for name in names if name not in found]
        needed.append(f"{kind} {', '.join(names)}")
        if lacking:
            missing.append(f"{kind} {', '.join(lacking)}")
            there.append(f"{kind}: {', '.join(found) or 'none'}")
    if missing:
        raise ValueError(
            f"{OWNER} must have {'; '.join(needed)} (of {' or '.join(MODELS)}); this one lacks "
            f"{', '.join(missing)} and has {'; '.join(there)}"
        )
    instances = [p.name for p in spec.plugins if p.plugin_name in MODELS]
    if len(instances) > 1:
        raise check.fail(OWNER, "plugin instance", f"one, {AIR}: a rig has one wing", instances)


def require_kinds(model: mujoco.MjModel) -> None:
    """Refuse joints, servos, sensors and frames that are not those of a rig.

    Raises:
        ValueError: names the element, what it must be and what it is.
    """
    _require_numbers(model)
    for axis in Axis:
        _require_joint(model, axis)
        _require_servo(model, axis)
    for name in Sensor:
        _require_sensor(model, name)
    _require_wing(model)
    _require_frames(model)


def _require_numbers(model: mujoco.MjModel) -> None:
    arrays = {name: getattr(model, name) for name in dir(model) if not name.startswith("_")}
    bad = [
        name
        for name, values in arrays.items()
        if isinstance(values, np.ndarray) and values.dtype.kind == "f" and np.isnan(values).any()
    ]
    if bad:
        raise check.fail(OWNER, "numbers", "finite", f"NaN in {', '.join(bad)}")
    check.positive(OWNER, "option timestep", model.opt.timestep, "s")
    gravity = np.asarray(model.opt.gravity)
    if np.abs(gravity[:2]).max() > FRAME * abs(gravity[2]) or not -MOST_GRAVITY <= gravity[2] <= 0:
        allowed = f"downward and at most {MOST_GRAVITY:g} m/s2, as 0 0 -9.81"
        raise check.fail(OWNER, "option gravity", allowed, gravity.tolist())


def _require_joint(model: mujoco.MjModel, axis: Axis) -> None:
    if model.joint(axis).type[0] != mujoco.mjtJoint.mjJNT_HINGE:
        kind = mujoco.mjtJoint(int(model.joint(axis).type[0])).name.removeprefix("mjJNT_").lower()
        raise check.fail(OWNER, f"joint {axis}", "a hinge", kind)
    low, high = model.joint(axis).range
    # MuJoCo takes a range from high to low for none
    if (low or high) and not low < high:
        raise check.fail(OWNER, f"joint {axis}'s range", "from low to high", [low, high])


def _require_servo(model: mujoco.MjModel, axis: Axis) -> None:
    number, name = model.actuator(axis).id, f"actuator {axis}"
    if model.actuator_gaintype[number] != mujoco.mjtGain.mjGAIN_DCMOTOR:
        kind = mujoco.mjtGain(int(model.actuator_gaintype[number])).name
        raise check.fail(OWNER, name, "a dcmotor", kind.removeprefix("mjGAIN_").lower())
    if model.actuator_ctrlspec[number] != INPUTS:
        raise check.fail(OWNER, f"{name}'s input", "pos vel ff", "another")
    joint = model.actuator_trnid[number, 0]
    moves = model.actuator_trntype[number] == mujoco.mjtTrn.mjTRN_JOINT
    if not moves or joint != model.joint(axis).id:
        raise check.fail(OWNER, name, f"on joint {axis}", "on another")
    if model.actuator_gear[number, 0] != 1.0:
        allowed = "1: torques, speeds and inertias are those at the horn"
        raise check.fail(OWNER, f"{name}'s gear", allowed, float(model.actuator_gear[number, 0]))


def _require_sensor(model: mujoco.MjModel, name: Sensor) -> None:
    number = model.sensor(name).id
    kind, what = SENSORS[name]
    measured = mujoco.mj_id2name(model, model.sensor_objtype[number], model.sensor_objid[number])
    if name is Sensor.AERO:
        what = model.body(_wing(model)).name
        right = model.sensor_objtype[number] == mujoco.mjtObj.mjOBJ_BODY
        right &= model.sensor_objid[number] == _wing(model)
    else:
        right = measured == what
    if model.sensor_type[number] != kind or not right:
        word = kind.name.removeprefix("mjSENS_").lower()
        got = mujoco.mjtSensor(int(model.sensor_type[number])).name.removeprefix("mjSENS_").lower()
        raise check.fail(OWNER, f"sensor {name}", f"{word} of {what}", f"{got} of {measured}")


def _wing(model: mujoco.MjModel) -> int:
    """The body that carries the wing frame."""
    return int(model.site_bodyid[model.site(Site.WING_FRAME).id])


def _require_wing(model: mujoco.MjModel) -> None:
    """Plate, load cell and plugin sit on the wing's body, which sweeps and pitches and no more."""
    wing, name = _wing(model), model.body(_wing(model)).name
    for kind, found in (
        (f"geom {Geom.PLATE}", model.geom_bodyid[model.geom(Geom.PLATE).id]),
        (f"site {Site.LOAD_CELL}", model.site_bodyid[model.site(Site.LOAD_CELL).id]),
    ):
        if found != wing:
            allowed = f"on the wing's body {name!r}"
            raise check.fail(OWNER, kind, allowed, f"on {model.body(int(found)).name}")
    instance = model.body_plugin[wing]
    if instance < 0 or mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_PLUGIN, instance) != AIR:
        raise check.fail(OWNER, f"plugin instance {AIR}", f"on the wing's body {name!r}", "another")
    chain, body = [], wing
    while body > 0:
        first = model.body_jntadr[body]
        chain += [first + k for k in reversed(range(model.body_jntnum[body]))]
        body = int(model.body_parentid[body])
    moved = [model.joint(int(number)).name or "one without a name" for number in reversed(chain)]
    if moved != list(Axis):
        allowed = "the joints sweep and pitch, in this order, and no other"
        raise check.fail(OWNER, f"what moves body {name!r}", allowed, ", ".join(moved) or "none")


def _require_frames(model: mujoco.MjModel) -> None:
    """At angles of zero: sweep up, pitch against the span, chord down, both through the origin."""
    data = mujoco.MjData(model)
    joints = [model.joint(axis) for axis in Axis]
    for joint in joints:
        data.qpos[joint.qposadr[0]] = 0.0
    mujoco.mj_kinematics(model, data)
    frame = model.site(Site.WING_FRAME)
    body, turn = _wing(model), data.site_xmat[frame.id].reshape(3, 3)
    aligned = data.xmat[body].reshape(3, 3).T @ turn
    if np.abs(frame.pos).max() > FRAME or np.abs(aligned - np.eye(3)).max() > FRAME:
        allowed = "the frame of the wing's body: pos 0 0 0, not turned"
        raise check.fail(OWNER, f"site {Site.WING_FRAME}", allowed, frame.pos.tolist())
    span, chord = turn[:, 1], turn[:, 0]
    wanted = {Axis.SWEEP: (UP, "0 0 1 in the world"),
              Axis.PITCH: (-span, "0 -1 0 in the wing's frame, against the span")}  # fmt: skip
    for joint, axis in zip(joints, Axis, strict=True):
        direction, words = wanted[axis]
        along = data.xaxis[joint.id]
        if np.abs(along - direction).max() > FRAME:
            found = along if axis is Axis.SWEEP else turn.T @ along
            raise check.fail(OWNER, f"joint {axis}'s axis", words, np.round(found, 4).tolist())
        arm = data.site_xpos[frame.id] - data.xanchor[joint.id]
        if np.linalg.norm(np.cross(arm, along)) > 1e-5:
            allowed = "through the wing frame's origin"
            raise check.fail(OWNER, f"joint {axis}", allowed, f"{arm.tolist()} m beside it")
    if np.abs(chord + UP).max() > FRAME:
        allowed = "downward at sweep and pitch of 0: the leading edge is up"
        raise check.fail(OWNER, f"x of site {Site.WING_FRAME}", allowed, chord.tolist())
