"""PyOpenGL as programs use it: GL and GLU in one namespace, without a check after each call, for measurements.

Use it only in a process that draws nothing else on Mesa: PyOpenGL reads its settings when it is imported.
`softshadow.testing.opengl` is the namespace for tests, which raises errors and has softshadow's array conventions.
"""

import importlib
import os
from typing import Any

import numpy as np

_windows: list[Any] = []  # contexts and their image memory, as long as the process lives


class PlainGL:
    """All functions and tokens of GL and GLU; each name is looked up once."""

    def __init__(self) -> None:
        os.environ["PYOPENGL_PLATFORM"] = "osmesa"
        settings: Any = importlib.import_module("OpenGL")
        settings.ERROR_CHECKING = False
        self._gl, self._glu = (importlib.import_module(f"OpenGL.{name}") for name in ("GL", "GLU"))
        self._osmesa = importlib.import_module("OpenGL.osmesa")

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._glu if name.startswith(("glu", "GLU_")) else self._gl, name)
        setattr(self, name, value)
        return value

    def open_window(self, width: int, height: int) -> None:
        """Make a new context current, with 24 bits of depth, 8 of stencil, and an accumulation buffer."""
        mesa = self._osmesa
        context = mesa.OSMesaCreateContextExt(mesa.OSMESA_RGBA, 24, 8, 16, None)
        pixels = np.zeros((height, width, 4), np.uint8)
        if not context or not mesa.OSMesaMakeCurrent(context, pixels, self.GL_UNSIGNED_BYTE, width, height):
            raise RuntimeError(f"OSMesa cannot create a context of {width} x {height} pixels")
        _windows.append((context, pixels))
