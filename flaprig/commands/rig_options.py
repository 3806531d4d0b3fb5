"""Which rig a command is about: a file, and what the other options change in it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from tyro.conf import arg

from flaprig.aero.models import QuasiSteady
from flaprig.commands.options import FluidOptions, ModelOptions, WingOptions
from flaprig.strokes import Stroke

if TYPE_CHECKING:
    from flaprig.rig import Rig

# the option of every command that is about a rig
RigFile = Annotated[
    Path | None, arg(name="rig", metavar="FILE", help_behavior_hint="(default: the paper's rig)")
]


def rig_of(
    file: Path | None,
    stroke: Stroke,
    wing: WingOptions,
    fluid: FluidOptions,
    model: ModelOptions | QuasiSteady,
) -> Rig:
    """The rig of a file with what the options ask for, set to the stroke.

    Args:
        file: MJCF of a rig; None: models/rig.xml.
        stroke: that it is to run.
        wing: options that were given change the file's wing.
        fluid: the same of its fluid.
        model: the same of its model of the fluid, or a model in its place.

    Raises:
        ValueError: a bad option, or a file that is no rig's.
        FileNotFoundError: there is no such file.
        ImportError: the plugin library is missing or does not fit MuJoCo.
    """
    # mujoco takes half a second to import: not for --help
    from flaprig.rig import RIG_XML, Rig

    own = Rig.load(RIG_XML if file is None else file)
    changed = own.with_(
        wing=wing.build(own.wing),
        fluid=fluid.build(own.fluid),
        model=model.build(own.model) if isinstance(model, ModelOptions) else model,
    )
    return changed.running(stroke)


def rig_summary(rig: Rig) -> dict[str, Any]:
    """What says in a summary which rig it was."""
    return {"rig": str(rig.path), "buoyancy": rig.buoyancy}
