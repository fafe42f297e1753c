"""PyOpenGL's image calls that end in the type of the numbers: glTexImage2Dub, glReadPixelsf.

Like PyOpenGL, they take width and height from the first two dimensions of an array, in this order.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.gl.pixel_rectangles import glDrawPixels
from softshadow.gl.pixels import glReadPixels
from softshadow.gl.texture_images import glTexImage1D, glTexImage2D, glTexSubImage1D, glTexSubImage2D
from softshadow.gl.texture_queries import glGetTexImage

TYPES = {
    "b": (gl.GL_BYTE, np.int8), "f": (gl.GL_FLOAT, np.float32), "i": (gl.GL_INT, np.int32),
    "s": (gl.GL_SHORT, np.int16), "ub": (gl.GL_UNSIGNED_BYTE, np.uint8), "ui": (gl.GL_UNSIGNED_INT, np.uint32),
    "us": (gl.GL_UNSIGNED_SHORT, np.uint16),
}  # fmt: skip


def _writes(suffix: str, type: int, numbers: Any) -> dict[str, Callable[..., None]]:
    """Return the calls that take an image, by name."""

    def tex_image_1d(target: int, level: int, internalformat: int, border: int, format: int, pixels: Any) -> None:
        array = np.ascontiguousarray(pixels, numbers)
        glTexImage1D(target, level, internalformat, array.shape[0], border, format, type, array)

    def tex_image_2d(target: int, level: int, internalformat: int, border: int, format: int, pixels: Any) -> None:
        array = np.ascontiguousarray(pixels, numbers)
        glTexImage2D(target, level, internalformat, array.shape[0], array.shape[1], border, format, type, array)

    def tex_sub_image_1d(target: int, level: int, xoffset: int, format: int, pixels: Any) -> None:
        array = np.ascontiguousarray(pixels, numbers)
        glTexSubImage1D(target, level, xoffset, array.shape[0], format, type, array)

    def tex_sub_image_2d(target: int, level: int, xoffset: int, yoffset: int, format: int, pixels: Any) -> None:
        array = np.ascontiguousarray(pixels, numbers)
        glTexSubImage2D(target, level, xoffset, yoffset, array.shape[0], array.shape[1], format, type, array)

    def draw_pixels(format: int, pixels: Any) -> None:
        array = np.ascontiguousarray(pixels, numbers)
        glDrawPixels(array.shape[0], array.shape[1], format, type, array)

    calls: dict[str, Callable[..., None]] = {
        "glTexImage1D": tex_image_1d, "glTexImage2D": tex_image_2d, "glTexSubImage1D": tex_sub_image_1d,
        "glTexSubImage2D": tex_sub_image_2d, "glDrawPixels": draw_pixels,
    }  # fmt: skip
    return {f"{name}{suffix}": call for name, call in calls.items()}


def _reads(suffix: str, type: int) -> dict[str, Callable[..., Any]]:
    """Return the calls that return an image, by name."""

    def read_pixels(x: int, y: int, width: int, height: int, format: int, array: Any = None) -> Any:
        return glReadPixels(x, y, width, height, format, type, array)

    def get_tex_image(target: int, level: int, format: int, array: Any = None) -> Any:
        return glGetTexImage(target, level, format, type, array)

    return {f"glReadPixels{suffix}": read_pixels, f"glGetTexImage{suffix}": get_tex_image}


def _calls() -> dict[str, Callable[..., Any]]:
    found: dict[str, Callable[..., Any]] = {}
    for suffix, (type, numbers) in TYPES.items():
        calls = {**_writes(suffix, type, numbers), **_reads(suffix, type)}
        for name, call in calls.items():
            call.__name__ = call.__qualname__ = name
            call.__doc__ = f"Call {name.removesuffix(suffix)} with {np.dtype(numbers)} numbers."
        found |= calls
    return found


TYPED_CALLS = _calls()
globals().update(TYPED_CALLS)

__all__ = list(TYPED_CALLS)
