"""What a demonstration is: two numbers, by the slide and as it is, from programs that run here and on Mesa."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from softshadow.listings.listing import Steps

WINDOW = (128, 128)  # pixels, as for the listings


@dataclass(frozen=True, eq=False)
class Demonstration:
    """A small program that shows an error of the slides that no listing and no failure shows.

    Attributes
    ----------
    name : str
    what : str                   what is counted or queried
    program : program(gl)        returns two numbers: by the slide, and as it is
    on_mesa : bool               whether it calls GL, and so runs on Mesa as well
    """

    name: str
    what: str
    program: Callable[[Any], list[int]]
    on_mesa: bool = True


def finish(steps: Steps) -> None:
    """Carry out all steps of a listing."""
    for _ in steps:
        pass


def stencil_of(gl: Any) -> np.ndarray:
    """Return the stencil buffer, (h, w) uint8."""
    x, y, width, height = gl.glGetIntegerv(gl.GL_SCISSOR_BOX)
    return np.asarray(gl.glReadPixels(x, y, width, height, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)).reshape(
        height, width
    )


def depth_of(gl: Any) -> np.ndarray:
    """Return the depth buffer in steps of 24 bits, (h, w) int64."""
    x, y, width, height = gl.glGetIntegerv(gl.GL_SCISSOR_BOX)
    depth = np.asarray(gl.glReadPixels(x, y, width, height, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT), np.float64)
    return np.rint(depth.reshape(height, width) * (2**24 - 1)).astype(np.int64)


def color_of(gl: Any) -> np.ndarray:
    """Return the colour buffer, (h, w, 4) uint8."""
    x, y, width, height = gl.glGetIntegerv(gl.GL_SCISSOR_BOX)
    pixels = np.asarray(gl.glReadPixels(x, y, width, height, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
    return np.frombuffer(pixels.tobytes(), np.uint8).reshape(height, width, 4)


def clear(gl: Any) -> None:
    """Clear colour, depth and stencil buffer."""
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)


def number(mask: ArrayLike) -> int:
    """Return how many pixels of a mask are set, as a plain number."""
    return int(np.count_nonzero(mask))


def differing(one: np.ndarray, other: np.ndarray) -> int:
    """Return in how many pixels two colour buffers differ."""
    return number((one != other).any(axis=-1))
