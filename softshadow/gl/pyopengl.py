"""PyOpenGL's additions: calls without a type suffix, and calls that take type and size from an array."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.gl.array_draws import glDrawElements
from softshadow.gl.calls import spelled_like_gl
from softshadow.gl.immediate import glVertex2f, glVertex3f, glVertex4f
from softshadow.gl.lighting import glLightfv
from softshadow.gl.materials import glMaterialf, glMaterialfv
from softshadow.gl.raster_position import glRasterPos2d, glRasterPos3d, glRasterPos4d
from softshadow.gl.texture_coordinates import glTexCoord2d
from softshadow.gl.textures import glTexParameterf, glTexParameterfv, glTexParameteri
from softshadow.gl.transforms import glRotated, glScaled, glTranslated
from softshadow.gl.vertex_arrays import (
    TYPES,
    glColorPointer,
    glIndexPointer,
    glNormalPointer,
    glTexCoordPointer,
    glVertexPointer,
)
from softshadow.gl.vertex_attributes import glColor3d, glColor3fv, glColor4d, glColor4fv, glNormal3d

glRotate, glTranslate, glScale = glRotated, glTranslated, glScaled
glLight, glTexCoord, glNormal = glLightfv, glTexCoord2d, glNormal3d


# -- by the number of arguments ----------------------------------------------------------------------------------------
def glVertex(*arguments: Any) -> None:
    """Add a vertex from two to four numbers, or from a vector."""
    numbers = arguments[0] if len(arguments) == 1 else arguments
    calls: dict[int, Callable[..., None]] = {2: glVertex2f, 3: glVertex3f, 4: glVertex4f}
    calls[len(numbers)](*numbers)


def glColor(*arguments: Any) -> None:
    """Set the current colour from three or four numbers, or from a vector."""
    if len(arguments) == 1:
        {3: glColor3fv, 4: glColor4fv}[np.size(arguments[0])](arguments[0])
    else:
        calls: dict[int, Callable[..., None]] = {3: glColor3d, 4: glColor4d}
        calls[len(arguments)](*arguments)


def glRasterPos(*arguments: Any) -> None:
    """Set the raster position from two to four numbers, or from a vector."""
    numbers = arguments[0] if len(arguments) == 1 else arguments
    calls: dict[int, Callable[..., None]] = {2: glRasterPos2d, 3: glRasterPos3d, 4: glRasterPos4d}
    calls[len(numbers)](*numbers)


def glMaterial(face: int, pname: int, *arguments: Any) -> None:
    """Set a material parameter from a vector or a number."""
    if len(arguments) == 1:
        glMaterialfv(face, pname, arguments[0])
    else:
        glMaterialf(face, pname, *arguments)


def glTexParameter(target: int, pname: int, parameter: Any) -> None:
    """Set a parameter of the bound texture from an int, a float, or a vector."""
    call = glTexParameterf if isinstance(parameter, float) else glTexParameterfv
    (glTexParameteri if isinstance(parameter, int) else call)(target, pname, parameter)


# -- type and size of an array -----------------------------------------------------------------------------------------
def _sized(
    name: str, call: Callable[..., None], type: int, largest: int, otherwise: int | None
) -> Callable[[Any], Any]:
    """Return a pointer call that takes type and size from an array (n, size), or the size `otherwise`."""

    def point(array: Any) -> Any:
        if array is None or isinstance(array, ctypes.c_void_p):  # an offset into the buffer object that is bound
            call(*(() if otherwise is None else (otherwise,)), type, 0, array)
            return array
        values = np.ascontiguousarray(array, TYPES[type])
        size = values.shape[-1] if values.ndim > 1 and values.shape[-1] <= largest else otherwise
        call(*(() if otherwise is None else (size,)), type, 0, values)
        return values

    return _named(point, name, f"Call {call.__name__} with an array of {np.dtype(TYPES[type])} numbers.")


def _indexed(name: str, type: int) -> Callable[[int, Any], None]:
    def draw(mode: int, indices: Any) -> None:
        values = np.ravel(np.ascontiguousarray(indices, TYPES[type]))
        glDrawElements(mode, len(values), type, values)

    return _named(draw, name, f"Draw with an array of {np.dtype(TYPES[type])} indices.")


def _named(function: Any, name: str, documentation: str) -> Any:
    function.__name__ = function.__qualname__ = name
    function.__doc__ = documentation
    return function


def _pointers(call: Callable[..., None], largest: int, otherwise: int | None, types: tuple[int, ...]) -> list[Any]:
    suffixes = {
        gl.GL_BYTE: "b", gl.GL_DOUBLE: "d", gl.GL_FLOAT: "f", gl.GL_INT: "i", gl.GL_SHORT: "s",
        gl.GL_UNSIGNED_BYTE: "ub", gl.GL_UNSIGNED_INT: "ui", gl.GL_UNSIGNED_SHORT: "us",
    }  # fmt: skip
    return [_sized(f"{call.__name__}{suffixes[type]}", call, type, largest, otherwise) for type in types]


SIGNED = (gl.GL_DOUBLE, gl.GL_FLOAT, gl.GL_INT, gl.GL_SHORT)
OF_COLORS = (gl.GL_BYTE, *SIGNED, gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_INT, gl.GL_UNSIGNED_SHORT)
glVertexPointerd, glVertexPointerf, glVertexPointeri, glVertexPointers = _pointers(glVertexPointer, 4, 3, SIGNED)
glTexCoordPointerd, glTexCoordPointerf, glTexCoordPointeri, glTexCoordPointers = _pointers(
    glTexCoordPointer, 4, 2, SIGNED
)
glNormalPointerb, glNormalPointerd, glNormalPointerf, glNormalPointeri, glNormalPointers = _pointers(
    glNormalPointer, 3, None, (gl.GL_BYTE, *SIGNED)
)
(
    glColorPointerb, glColorPointerd, glColorPointerf, glColorPointeri, glColorPointers,
    glColorPointerub, glColorPointerui, glColorPointerus,
) = _pointers(glColorPointer, 4, 3, OF_COLORS)  # fmt: skip
(
    glIndexPointerb, glIndexPointerd, glIndexPointerf, glIndexPointeri, glIndexPointers, glIndexPointerub,
) = _pointers(glIndexPointer, 1, None, (gl.GL_BYTE, *SIGNED, gl.GL_UNSIGNED_BYTE))  # fmt: skip
glDrawElementsub = _indexed("glDrawElementsub", gl.GL_UNSIGNED_BYTE)
glDrawElementsui = _indexed("glDrawElementsui", gl.GL_UNSIGNED_INT)
glDrawElementsus = _indexed("glDrawElementsus", gl.GL_UNSIGNED_SHORT)


__all__ = spelled_like_gl(globals())
