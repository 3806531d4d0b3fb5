"""Pictures without a shell variable: the library that works is found when one is asked for."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from flaprig.render import gl

# two environments of each id and two tasks of each name, all drawn before any is closed
DRAW = """
import gymnasium, sys
import flaprig.envs
from flaprig.tasks import ALL_TASKS, load

names = [name for name in gymnasium.registry if name.startswith("flaprig/")]
envs = [gymnasium.make(name, render_mode="rgb_array") for name in names for _ in range(2)]
for env in envs:
    env.reset(seed=1)
for env in [*envs, *envs]:
    frame = env.render()
    assert frame.shape == (480, 640, 3) and frame.mean() > 20 and frame.std() > 5
for name in ALL_TASKS:
    for env in (load(*name), load(*name)):
        env.reset()
        assert env.physics.render(60, 80, camera_id="iso").std() > 5
        depth = env.physics.render(60, 80, camera_id="iso", depth=True)
        assert depth.min() > 0.0
for env in envs:
    env.close()
print(len(envs), "drawn")
"""


def run(code: str, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in ("DISPLAY", "WAYLAND_DISPLAY", "MUJOCO_GL", "PYOPENGL_PLATFORM")
    }
    command = [sys.executable, "-c", code]
    return subprocess.run(
        command, env=environment | variables, capture_output=True, text=True, check=False
    )


def test_two_environments_of_each_id_without_a_variable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    if gl.backend() is None:
        pytest.skip("no OpenGL library works here: " + gl.ADVICE)
    done = run(DRAW)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "6 drawn\n"


@pytest.mark.parametrize("name", ["flaprig/HoverKinematics-v0", "flaprig/Track-v0"])
def test_where_nothing_draws_one_sentence_says_what_to_install(name: str) -> None:
    code = (
        "import gymnasium, flaprig.envs\n"
        f"env = gymnasium.make({name!r}, render_mode='rgb_array')\n"
        "env.reset()\n"
        "try: env.render()\n"
        "except RuntimeError as error: print(error)\n"
    )
    done = run(code, MUJOCO_GL="disable")
    assert done.returncode == 0, done.stderr
    assert "no OpenGL library draws pictures here" in done.stdout and "libegl1" in done.stdout


def test_who_draws_nothing_pays_nothing() -> None:
    """No trial of a library before the first picture."""
    code = (
        "import gymnasium, flaprig.envs\n"
        "from flaprig.render import gl\n"
        "env = gymnasium.make('flaprig/Track-v0', render_mode='rgb_array')\n"
        "env.reset()\n"
        "env.step([0, 0, 0, 0])\n"
        "print(gl.works.cache_info().misses)\n"
    )
    done = run(code)
    assert done.stdout == "0\n", done.stderr
