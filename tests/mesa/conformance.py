"""What the programs of conformance facts are made of: quads, and the values that a window must hold everywhere."""

from typing import Any

import numpy as np

from softshadow.testing import ProgramResult

SIZE = (16, 16)
FULL = 2**24 - 1  # of 24-bit depth
FUNCTIONS = {
    "GL_NEVER": np.zeros_like, "GL_ALWAYS": np.ones_like, "GL_LESS": np.less, "GL_LEQUAL": np.less_equal,
    "GL_EQUAL": np.equal, "GL_GREATER": np.greater, "GL_GEQUAL": np.greater_equal, "GL_NOTEQUAL": np.not_equal,
}  # fmt: skip


def quad(gl: Any, z: float = 0.0, box: tuple[float, ...] = (-1, -1, 1, 1), clockwise: bool = False) -> None:
    """Draw a rectangle (left, bottom, right, top) in clip coordinates at a depth in [-1, 1]."""
    left, bottom, right, top = box
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    gl.glBegin(gl.GL_QUADS)
    for x, y in reversed(corners) if clockwise else corners:
        gl.glVertex3f(x, y, z)
    gl.glEnd()


def passes(function: str, left: int, right: int) -> bool:
    """Return whether a comparison of GL holds."""
    if function in ("GL_NEVER", "GL_ALWAYS"):
        return function == "GL_ALWAYS"
    return bool(FUNCTIONS[function](left, right))


def holds(plane: np.ndarray, value: Any) -> None:
    """Assert that a plane holds one value at all pixels."""
    assert np.unique(plane.reshape(-1, plane.shape[-1]) if plane.ndim == 3 else plane.ravel(), axis=0).tolist() == [
        value
    ]


def red(result: ProgramResult) -> np.ndarray:
    """Return where the window is red."""
    return np.asarray((result.color == (255, 0, 0, 255)).all(axis=-1))
