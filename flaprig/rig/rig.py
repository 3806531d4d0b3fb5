"""The rig of the paper's Figures 2 and 3 as a MuJoCo model: models/rig.xml and its numbers.

The XML carries the rig as built; a `Rig` holds the same numbers in Python and writes them into
the model again, so that another wing, fluid, servo or model of the air is one argument.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from flaprig import _checks as check
from flaprig._paths import RIG_XML
from flaprig.aero.models import SWEEP_AMPLITUDE, UVLM, QuasiSteady
from flaprig.fluid import WATER, Fluid
from flaprig.motors import RIG_MOTORS, Motor, Motors
from flaprig.native import library
from flaprig.rig import plate
from flaprig.rig.names import AIR, INPUTS, Axis, Geom, Site
from flaprig.strokes import Stroke
from flaprig.wing import RIG_WING, Wing

# stroke frequency of the rig [Hz]: paper section 2.2
RIG_FREQUENCY = 0.2


# plugin attributes that stay as the file has them, unless the model of the air names them
_KEPT = ("site", "buoyancy")


@dataclass(frozen=True)
class Rig:
    """One rig: a file and the numbers that go into it.

    Attributes:
        path: the MJCF file.
        wing: the plate on the pitch shaft.
        fluid: what the wing moves in.
        motors: the sweep and the pitch servo.
        model: the model of the fluid's forces, UVLM or QuasiSteady.
        frequency: of the stroke that the rig is to run, in [Hz]; sets the clock of the wake.
        sweep_amplitude: half of its peak-to-peak sweep in [rad]; with the frequency it sets the
            Reynolds number, for models of the air that ask for one.

    Raises:
        ValueError: an attribute of the wrong type, or a number that is not positive.
    """

    path: Path = RIG_XML
    wing: Wing = RIG_WING
    fluid: Fluid = WATER
    motors: Motors = RIG_MOTORS
    model: UVLM | QuasiSteady = UVLM()
    frequency: float = RIG_FREQUENCY
    sweep_amplitude: float = SWEEP_AMPLITUDE

    def __post_init__(self) -> None:
        kinds = {"path": Path, "wing": Wing, "fluid": Fluid, "motors": Motors}
        for name, kind in kinds.items():
            if not isinstance(getattr(self, name), kind):
                raise check.fail("Rig", name, f"a {kind.__name__}", getattr(self, name))
        if not isinstance(self.model, UVLM | QuasiSteady):
            raise check.fail("Rig", "model", "a UVLM or a QuasiSteady", self.model)
        for name, unit in (("frequency", "Hz"), ("sweep_amplitude", "rad")):
            number = check.positive("Rig", name, getattr(self, name), unit)
            object.__setattr__(self, name, number)

    @classmethod
    def load(cls, path: str | Path = RIG_XML) -> Rig:
        """The rig of the paper, or of another file with the same names.

        Raises:
            FileNotFoundError: there is no such file.
        """
        path = Path(path)
        if not path.is_file():
            raise FileNotFoundError(f"Rig.load: there is no file {path}")
        return cls(path=path)

    def with_(self, **changes: Any) -> Rig:
        """A new rig with wing, fluid, motors, model, frequency or sweep_amplitude changed.

        Raises:
            ValueError: a name that a rig does not have, or a bad value.
        """
        allowed = ("wing", "fluid", "motors", "model", "frequency", "sweep_amplitude")
        for name in changes:
            if name not in allowed:
                raise check.fail("Rig.with_", "argument", f"one of {', '.join(allowed)}", name)
        return replace(self, **changes)

    def running(self, stroke: Stroke) -> Rig:
        """The rig set to a stroke's frequency and sweep amplitude."""
        return self.with_(frequency=stroke.frequency, sweep_amplitude=stroke.sweep_amplitude)

    def spec(self) -> mujoco.MjSpec:
        """The rig as an editable MuJoCo specification, not yet compiled.

        Raises:
            ImportError: the plugin library is missing or does not fit MuJoCo.
        """
        library.load()
        spec = mujoco.MjSpec.from_file(str(self.path))
        plate.mount(spec, spec.geom(Geom.PLATE), self.wing)
        _move_root(spec, self.wing.root_offset)
        _fill_fluid(spec, self)
        for axis in Axis:
            _fit_motor(spec.actuator(axis), getattr(self.motors, axis))
        return spec

    def compile(self) -> mujoco.MjModel:
        """The compiled model, with joint stops that know the water's added mass.

        Raises:
            ImportError: the plugin library is missing or does not fit MuJoCo.
            ValueError: the plugin refuses an attribute; the sentence names it.
        """
        model = self.spec().compile()
        weigh_stops(model)
        return model


def weigh_stops(model: mujoco.MjModel) -> None:
    """Set the constraint weights of the degrees of freedom to the diagonal of M^-1.

    MuJoCo computes them from rigid inertia alone, which leaves the joint stops up to 500 times
    too soft in water; the plugin's added mass is in M after a forward pass. Changes the model.
    """
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    inverse = np.zeros((model.nv, model.nv))
    mujoco.mj_solveM(model, data, inverse, np.eye(model.nv))
    model.dof_invweight0[:] = np.diag(inverse)


def _move_root(spec: mujoco.MjSpec, root: float) -> None:
    """The cell's frame goes to the root; cell and clamp are drawn where there is room for them."""
    shift = root - spec.site(Site.LOAD_CELL).pos[1]
    spec.site(Site.LOAD_CELL).pos[1] = root
    spec.geom(Geom.SHAFT).pos[1] += shift / 2.0
    spec.geom(Geom.SHAFT).size[1] += shift / 2.0
    for name in (Geom.CELL, Geom.CLAMP):
        spec.geom(name).pos[1] += shift
        if shift < 0.0:
            spec.delete(spec.geom(name))
    if root == 0.0:
        spec.delete(spec.geom(Geom.SHAFT))


def _fit_motor(actuator: Any, motor: Motor) -> None:
    actuator.set_to_dcmotor(
        motorconst=[0.0, 0.0], resistance=0.0, ctrlspec=INPUTS, **motor.dcmotor
    )
    actuator.armature = motor.rotor_inertia
    # one range for position, velocity and torque: it must not clip any of them
    widest = max(motor.no_load_speed, motor.stall_torque, np.pi / 2.0)
    actuator.ctrlrange = [-widest, widest]


def _fill_fluid(spec: mujoco.MjSpec, rig: Rig) -> None:
    """Give the plugin instance the wing, the fluid and the model of the rig."""
    spec.activate_plugin(rig.model.plugin)
    instance = next(plugin for plugin in spec.plugins if plugin.name == AIR)
    kept = {key: value for key, value in instance.config.items() if key in _KEPT}
    instance.plugin_name = rig.model.plugin
    instance.config = kept | rig.model.attributes(
        rig.wing, rig.fluid, rig.frequency, rig.sweep_amplitude
    )
    for sensor in spec.sensors:
        if sensor.type == mujoco.mjtSensor.mjSENS_PLUGIN:
            sensor.plugin.plugin_name = rig.model.plugin
