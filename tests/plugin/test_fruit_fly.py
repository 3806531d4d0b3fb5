"""The plugins on the wings of dm_control's fruit fly, in composer, whose files stay as they are."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

pytest.importorskip("dm_control")
# of dm_control and what it imports, and MuJoCo's word on the fly's own fluid
pytestmark = pytest.mark.filterwarnings("ignore")

# the fly's model is in centimetres and grams; the wings' geometry is that of its ellipsoids, about
WING = {"span": "0.228", "chord": "0.11", "root_offset": "0.035", "density": "0.00128"}
LATTICE = {"chordwise": "3", "spanwise": "4", "wake_step": "0.0004", "wake_rows": "30"}
KINDS = {"left": "flaprig.uvlm", "right": "flaprig.quasi_steady"}
ATTRIBUTES = {"left": WING | LATTICE, "right": WING}


def winged_fly(silent: bool) -> Any:
    """FruitFly with a fluid model on either wing, the lattice on the left one."""
    from dm_control.locomotion.walkers import fruitfly_v2

    fly = fruitfly_v2.FruitFly(use_wings=True)
    root = fly.mjcf_model
    for side, kind in KINDS.items():
        wing = root.find("body", f"wing_{side}")
        wing.add("site", name=f"{side}_frame", xyaxes=[-1, 0, 0, 0, -1 if side == "left" else 1, 0])
        air = root.extension.add("plugin", plugin=kind).add("instance", name=f"air_{side}")
        for key, value in ({"site": f"{side}_frame"} | ATTRIBUTES[side]).items():
            air.add("config", key=key, value=value)
        wing.add("plugin", instance=air)
        root.sensor.add(
            "plugin", name=f"aero_{side}", plugin=kind, instance=air, objtype="body", objname=wing
        )
        if silent:
            for geom in wing.geom:
                geom.fluidshape = "none"
            wing.add(
                "geom", type="sphere", size=[1e-6], mass=0, contype=0, conaffinity=0,
                fluidshape="ellipsoid", fluidcoef=[0, 0, 0, 0, 0],
            )  # fmt: skip
    return fly


def environment(silent: bool = False) -> Any:
    from dm_control import composer
    from dm_control.locomotion.arenas import floors

    class Stand(composer.Task):
        """On the floor, under random actions."""

        def __init__(self) -> None:
            self._arena = floors.Floor()
            self.fly = winged_fly(silent)
            self.fly.create_root_joints(self._arena.attach(self.fly))
            self.set_timesteps(control_timestep=1e-3, physics_timestep=1e-4)

        @property
        def root_entity(self) -> Any:
            return self._arena

        def get_reward(self, physics: Any) -> float:
            return 0.0

    return composer.Environment(Stand(), random_state=0)


def test_fruit_fly_goes_500_steps() -> None:
    """With noslip_iterations of the arena at work on its feet, and fluid on its wings."""
    env = environment()
    env.reset()
    model, data = env.physics.model.ptr, env.physics.data.ptr
    assert model.nplugin == 2 and model.opt.noslip_iterations == 5
    rng, spec, contacts = np.random.default_rng(0), env.action_spec(), 0
    for _ in range(50):
        env.step(rng.uniform(spec.minimum, spec.maximum))
        contacts = max(contacts, data.ncon)
        assert np.isfinite(data.qpos).all() and np.isfinite(data.sensordata).all()
    assert data.time == pytest.approx(500e-4) and contacts > 10
    assert not data.warning.number.any()
    for side in KINDS:
        assert np.abs(data.sensor(f"walker/aero_{side}").data[2]) > 0


@pytest.mark.parametrize("silent", [False, True])
def test_flys_own_fluid_is_said_or_silenced(silent: bool, told: list[str]) -> None:
    environment(silent).reset()
    said = any(' acts on body "walker/wing_left" too' in text for text in told)
    assert said == (not silent)
