"""What a rig's file says in numbers: wing, fluid, servos, model of the fluid, its clock."""

from __future__ import annotations

from dataclasses import dataclass, replace

from flaprig import _checks as check
from flaprig.aero.air_model import geometry, given, reynolds_number
from flaprig.aero.models import MODELS, SWEEP_AMPLITUDE, UVLM, QuasiSteady
from flaprig.aero.uvlm import wake_step
from flaprig.fluid import WATER, Fluid
from flaprig.motors import Motors
from flaprig.rig import plate
from flaprig.rig.contract import OWNER, require_kinds, require_names
from flaprig.rig.document import Document
from flaprig.rig.names import AIR, Axis, Geom
from flaprig.rig.numeric import numerics
from flaprig.rig.servo_element import rating_name, read_motors, same
from flaprig.wing import Wing

# stroke frequency of the rig [Hz]: paper section 2.2
RIG_FREQUENCY = 0.2
# numbers in <custom>, and what counts where a file leaves them out
USUAL = {
    "frequency": RIG_FREQUENCY,
    "sweep_amplitude": SWEEP_AMPLITUDE,
    "kinematic_viscosity": WATER.kinematic_viscosity,
}


@dataclass(frozen=True)
class RigNumbers:
    """The numbers of a rig, as Rig has them.

    Attributes:
        wing: the plate on the pitch shaft.
        fluid: what the wing moves in.
        motors: the sweep and the pitch servo.
        model: the model of the fluid's forces, UVLM or QuasiSteady.
        frequency: of the stroke that the rig is to run, in [Hz].
        sweep_amplitude: half of its peak-to-peak sweep in [rad].
        buoyancy: whether the displaced fluid carries the plate.

    Raises:
        ValueError: an attribute of the wrong type, or a number that is not positive.
    """

    wing: Wing
    fluid: Fluid
    motors: Motors
    model: UVLM | QuasiSteady
    frequency: float
    sweep_amplitude: float
    buoyancy: bool

    def __post_init__(self) -> None:
        kinds = {"wing": Wing, "fluid": Fluid, "motors": Motors}
        for name, kind in kinds.items():
            if not isinstance(getattr(self, name), kind):
                raise check.fail("Rig", name, f"a {kind.__name__}", getattr(self, name))
        if not isinstance(self.model, tuple(MODELS.values())):
            names = " or a ".join(model.__name__ for model in MODELS.values())
            raise check.fail("Rig", "model", f"a {names}", self.model)
        for name, unit in (("frequency", "Hz"), ("sweep_amplitude", "rad")):
            number = check.positive("Rig", name, getattr(self, name), unit)
            object.__setattr__(self, name, number)
        check.flag("Rig", "buoyancy", self.buoyancy)

    def attributes(self) -> dict[str, str]:
        """All attributes of the plugin, the site aside."""
        air = self.model.attributes(self.wing, self.fluid, self.frequency, self.sweep_amplitude)
        return air | {"buoyancy": str(self.buoyancy).lower()}

    @property
    def reynolds(self) -> float:
        """At the frequency and the sweep amplitude."""
        return reynolds_number(self.wing, self.fluid, self.frequency, self.sweep_amplitude)


@dataclass(frozen=True)
class Read:
    """A file understood.

    Attributes:
        numbers: what it says.
        notices: what it does not say or says unclearly, and what was taken, a sentence each.
    """

    numbers: RigNumbers
    notices: tuple[str, ...]


def read(document: Document) -> Read:
    """The numbers of a document.

    Raises:
        ValueError: one sentence on what is missing, contradictory or out of range.
    """
    spec = document.spec()
    require_names(spec)
    model, root = spec.compile(), document.root()
    require_kinds(model)
    instance = next(plugin for plugin in spec.plugins if plugin.name == AIR)
    attributes = {key: value for key, value in instance.config.items() if value.strip()}
    kind = MODELS[instance.plugin_name]
    custom = numerics(model)
    wing, fluid = geometry(attributes)
    wing = replace(wing, density=plate.density(spec.geom(Geom.PLATE), wing))
    plate.require_same(model, wing)
    frequency, amplitude = (_one(custom, name) for name in ("frequency", "sweep_amplitude"))
    fluid = replace(fluid, kinematic_viscosity=_viscosity(custom, attributes, wing, fluid))
    reynolds = reynolds_number(wing, fluid, frequency, amplitude)
    air = kind.from_attributes(attributes, custom, frequency, reynolds)
    numbers = RigNumbers(
        wing,
        fluid,
        read_motors(model, root),
        air,
        frequency,
        amplitude,
        attributes.get("buoyancy", "").strip() == "true",
    )
    return Read(numbers, _notices(numbers, attributes, custom))


def _one(custom: dict[str, tuple[float, ...]], name: str) -> float:
    """A positive number of <custom>, or the usual one."""
    values = custom.get(name, (USUAL[name],))
    if len(values) != 1:
        raise check.fail(OWNER, f"numeric {name}", "one number", values)
    return check.positive(OWNER, f"numeric {name}", values[0])


def _viscosity(
    custom: dict[str, tuple[float, ...]], attributes: dict[str, str], wing: Wing, fluid: Fluid
) -> float:
    """As given, else as a given Reynolds number says, else water's, in [m2/s]."""
    reynolds = given(attributes, "reynolds", 0.0)
    if "kinematic_viscosity" in custom or not reynolds:
        return _one(custom, "kinematic_viscosity")
    frequency, amplitude = (_one(custom, name) for name in ("frequency", "sweep_amplitude"))
    now = reynolds_number(wing, fluid, frequency, amplitude)
    return fluid.kinematic_viscosity * now / reynolds


def _notices(
    numbers: RigNumbers, attributes: dict[str, str], custom: dict[str, tuple[float, ...]]
) -> tuple[str, ...]:
    taken = {
        "frequency": f"{numbers.frequency:.6g} Hz is",
        "sweep_amplitude": f"{numbers.sweep_amplitude:.6g} rad is",
        "kinematic_viscosity": f"{numbers.fluid.kinematic_viscosity:.6g} m2/s is",
    }
    rating = "temperature limit and mass of the XM430-W350 are"
    taken |= {rating_name(axis): rating for axis in Axis}
    found = [
        f"The rig's file has no numeric {name} in <custom>: {words} taken."
        for name, words in taken.items()
        if name not in custom
    ]
    meant = numbers.attributes().get("wake_step")
    if meant is not None and not same(written := wake_step(attributes), float(meant)):
        found.append(
            f"The rig's file has a wake_step of {written:.6g} s, which does not divide a cycle of "
            f"{numbers.frequency:.6g} Hz: other frequencies are run with "
            f"{numbers.model.steps_per_cycle} steps a cycle."
        )
    return tuple(found)
