"""Pictures of a MuJoCo model in memory, with the OpenGL library that works here."""

from __future__ import annotations

import importlib
import os
from types import TracebackType
from typing import Self

import mujoco
import numpy as np
from numpy.typing import NDArray

# shapes that one picture can hold: a wake of 100 x 12 rings has 2400 triangles
MOST_SHAPES = 20_000


class Painter:
    """Draws a model; use it in a `with` block, which gives the memory back.

    MuJoCo's own Renderer takes the library that was chosen when mujoco was first imported; this
    one takes it as an argument.
    """

    def __init__(self, model: mujoco.MjModel, backend: str, width: int, height: int) -> None:
        """Pictures of that size in pixels, with the library `gl.backend` found.

        Raises:
            ImportError: the library is not there.
        """
        # read by PyOpenGL when it is first imported
        if backend in ("egl", "osmesa"):
            os.environ.setdefault("PYOPENGL_PLATFORM", backend)
        model.vis.global_.offwidth = max(width, model.vis.global_.offwidth)
        model.vis.global_.offheight = max(height, model.vis.global_.offheight)
        self._model = model
        self._size = width, height
        self._gl = importlib.import_module(f"mujoco.{backend}").GLContext(width, height)
        self._gl.make_current()
        self._context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_150)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        self.scene = mujoco.MjvScene(model, MOST_SHAPES)

    def paint(self, data: mujoco.MjData, view: mujoco.MjvCamera) -> NDArray[np.uint8]:
        """The model, with the wake that its plugin draws. Shape (height, width, 3)."""
        option = mujoco.MjvOption()
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(
            self._model, data, option, mujoco.MjvPerturb(), view, everything, self.scene
        )
        width, height = self._size
        pixels = np.empty((height, width, 3), dtype=np.uint8)
        area = mujoco.MjrRect(0, 0, width, height)
        mujoco.mjr_render(area, self.scene, self._context)
        mujoco.mjr_readPixels(pixels, None, area, self._context)
        return np.flipud(pixels)

    def close(self) -> None:
        """Give the memory back."""
        self._context.free()
        self._gl.free()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
