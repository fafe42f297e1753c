"""The result of a GL program, in the same form for every implementation of GL."""

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True, eq=False)
class ProgramResult:
    """The default framebuffer after a program, first row = bottom row, and the program's return value.

    color : (h, w, 4) uint8
    depth : (h, w) uint32        in units of 1/(2^24 - 1)
    stencil : (h, w) uint8
    returned : object
    errors : ((name of the call, GL error code), ...)   in order; Mesa only, softshadow raises errors
    """

    color: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray
    returned: Any = None
    errors: tuple[tuple[str, int], ...] = ()


def read_result(
    gl: Any, size: tuple[int, int], returned: Any, errors: tuple[tuple[str, int], ...] = ()
) -> ProgramResult:
    """Read the default framebuffer of the current context, of (width, height) pixels."""
    width, height = size
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glBindBuffer(gl.GL_PIXEL_PACK_BUFFER, 0)
    color = gl.glReadPixels(0, 0, width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    packed = gl.glReadPixels(0, 0, width, height, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)
    stencil = (packed & np.uint32(255)).astype(np.uint8)
    return ProgramResult(color, packed >> np.uint32(8), stencil, returned, errors)
