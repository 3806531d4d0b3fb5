"""Small MJCF models with the air in them, put together from strings."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import WATER
from flaprig.native import _native, library
from flaprig.rig import RIG_FREQUENCY
from flaprig.wing import RIG_WING

Array = NDArray[np.float64]

# the rig's stroke frequency [Hz] and a lattice that is quick and still feels everything
FREQUENCY = RIG_FREQUENCY
SMALL = UVLM(chordwise=3, spanwise=4, steps_per_cycle=40)
# the attributes with which the plugins are what flaprig.simulate runs
LATTICE = {"site": "wing_frame"} | SMALL.attributes(RIG_WING, WATER, FREQUENCY)
# the wake of the instant itself, circulation that lags, suction around the tips
EXTENDED = replace(
    SMALL,
    steps_per_cycle=100,
    rate="backward",
    circulation_lag=0.3,
    side_suction_efficiency=1.0,
)
LAGGING = {"site": "wing_frame"} | EXTENDED.attributes(RIG_WING, WATER, FREQUENCY)
BLADES = {"site": "wing_frame"} | QuasiSteady().attributes(RIG_WING, WATER, FREQUENCY)
RECTANGLE = {"site": "wing_frame", "span": "0.25", "chord": "0.0625", "root_offset": "0.025"}
# a wake clock that also resolves what a wing without servos does
FREE = LATTICE | {"wake_step": "0.025"}
# blade elements without any force but the added mass
ONLY_ADDED_MASS = BLADES | {
    "coefficients": "table",
    "coefficient_table": "0 0 0 3.1416 0 0",
    "rotation": "false",
}

# the acrylic plate in wing axes
PLATE = '<geom type="box" size="0.03125 0.125 0.0015" pos="0.015625 0.15 0" density="1180"/>'
SITES = '<site name="wing_frame"/><site name="load_cell" pos="0 0.025 0"/>'
# flat in wing axes, turned so that the span is along +x and the leading edge up
UPRIGHT = 'xyaxes="0 0 -1 1 0 0"'
SENSORS = """
<plugin name="aero" plugin="{0}" instance="air" objtype="body" objname="wing"/>
<plugin name="load_cell" plugin="{0}" instance="air" objtype="site" objname="load_cell"/>"""


def kind_of(attributes: dict[str, str]) -> str:
    """The plugin that these attributes belong to."""
    lattice = "chordwise" in attributes or "wake_rows" in attributes
    return "flaprig.uvlm" if lattice else "flaprig.quasi_steady"


def instance(attributes: dict[str, str], name: str = "air", plugin: str = "") -> str:
    """The <plugin> element of <extension>."""
    config = "".join(f'<config key="{k}" value="{v}"/>' for k, v in attributes.items())
    kind = plugin or kind_of(attributes)
    return f'<plugin plugin="{kind}"><instance name="{name}">{config}</instance></plugin>'


def document(extension: str, worldbody: str, option: str = "", rest: str = "") -> str:
    """A whole model; nothing collides, gravity is off unless the option says otherwise."""
    gravity = "" if "gravity" in option else 'gravity="0 0 0"'
    integrator = "" if "integrator" in option else 'integrator="implicitfast"'
    return f"""<mujoco><compiler angle="radian" autolimits="true"/>
<option {gravity} {integrator} {option}/>
<default><geom contype="0" conaffinity="0"/></default>
<extension>{extension}</extension><worldbody>{worldbody}</worldbody>{rest}</mujoco>"""


def wing(joints: str = "", content: str = PLATE + SITES, air: str = "air", place: str = "") -> str:
    """A body named wing that carries the air, unless air is empty."""
    plugin = f'<plugin instance="{air}"/>' if air else ""
    return f'<body name="wing" {place or UPRIGHT}>{joints}{content}{plugin}</body>'


def two_hinges(attributes: dict[str, str] | None, option: str = "", limits: str = "") -> str:
    """The rig's two hinges without its motors; without air when attributes is None."""
    pitch = f'<joint name="pitch" axis="0 -1 0" {limits}/>'
    body = wing(pitch, air="" if attributes is None else "air")
    arm = f"""<body name="arm"><joint name="sweep" axis="0 0 1" {limits}/>
<geom type="cylinder" size="0.01 0.05" mass="0.2"/>{body}</body>"""
    if attributes is None:
        return document("", arm, option)
    sensors = f"<sensor>{SENSORS.format(kind_of(attributes))}</sensor>"
    return document(instance(attributes), arm, option, sensors)


def load(xml: str) -> mujoco.MjModel:
    """Compiled, with the plugins known to MuJoCo."""
    library.load()
    return mujoco.MjModel.from_xml_string(xml)


def reading(data: mujoco.MjData, name: str = "aero") -> Array:
    """A copy of one sensor's numbers."""
    return data.sensor(name).data.copy()


def random_state(model: mujoco.MjModel, seed: int, size: float = 0.3) -> mujoco.MjData:
    """Joints somewhere, moving."""
    rng = np.random.default_rng(seed)
    data = mujoco.MjData(model)
    mujoco.mj_integratePos(model, data.qpos, rng.uniform(-size, size, model.nv), 1.0)
    data.qvel[:] = rng.uniform(-size, size, model.nv)
    return data


def native(attributes: dict[str, str]) -> _native.Air:
    """The same air without MuJoCo."""
    return _native.Air(kind_of(attributes), {k: v for k, v in attributes.items() if k != "site"})


def added_mass(attributes: dict[str, str]) -> Array:
    """The mass on (v_z, w_x, w_y) that the air adds. Shape (3, 3)."""
    return native(attributes).added_mass


# the plugin's own memory (loads of the last step) stands ahead of the air's
OWN_MEMORY = 16


def wake_of(model: mujoco.MjModel, data: mujoco.MjData, attributes: dict[str, str]) -> Array:
    """Vertices of the wake in MuJoCo's state, newest first. Shape (rows + 1, strips + 1, 3)."""
    start, size = model.plugin_stateadr[0] + OWN_MEMORY, model.plugin_statenum[0] - OWN_MEMORY
    return native(attributes).wake(data.plugin_state[start : start + size].copy())[0]


def site_jacobian(model: mujoco.MjModel, data: mujoco.MjData, site: str = "wing_frame") -> Array:
    """Twist of a site's frame in its own axes over the joints' velocities. Shape (6, nv)."""
    linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mujoco.mj_jacSite(model, data, linear, angular, model.site(site).id)
    turn = data.site(site).xmat.reshape(3, 3).T
    return np.vstack([turn @ linear, turn @ angular])


def full_mass(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """M. Shape (nv, nv)."""
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    return mass


def integration_state(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """All that the next step depends on."""
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
    return state


# models that are refused at different points of the compilation
REFUSED_MODELS = {
    "attribute": two_hinges(FREE | {"core": "0"}),
    "site": two_hinges(FREE | {"site": "nowhere"}),
    "option": two_hinges(FREE, 'solver="PGS"'),
    "free body": document(
        instance(FREE), wing("<freejoint/>", PLATE.replace('pos="0.015625 0.15 0"', "") + SITES)
    ),
}
