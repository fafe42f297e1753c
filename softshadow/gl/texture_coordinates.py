"""The current texture coordinates of each unit."""

from __future__ import annotations

from math import hypot
from typing import Any

from softshadow import tokens as gl
from softshadow.context import thread
from softshadow.gl.calls import in_lists, record, spelled_like_gl
from softshadow.gl.conversions import vector
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.vertex_format import REST, TEXCOORDS, carry_attribute, set_attribute
from softshadow.state import TEXTURE_UNITS

UNITS = range(gl.GL_TEXTURE0, gl.GL_TEXTURE0 + TEXTURE_UNITS)
A_UNIT = f"GL_TEXTURE0 … GL_TEXTURE{TEXTURE_UNITS - 1}"


def set_coordinate(unit: int, *coordinates: float) -> None:
    """Set the current texture coordinate of a unit."""
    context, new, name = thread.context, tuple(map(float, coordinates)), TEXCOORDS[unit]
    primitive = context.primitive
    if primitive is not None and primitive.steady.get(name) == len(new):
        coordinate: Any = new + REST[len(new) :]
        context.current.texcoords[unit] = coordinate
        primitive.changes[name].append((len(primitive.positions), coordinate))
        return
    before = context.current.texcoords[unit]
    size = max(carry_attribute(context, name, len(new)), len(new))
    set_attribute(context, name, len(new), new + before[len(new) : size] + REST[size:])


def _set_of(target: int, *coordinates: float) -> None:
    # wrong targets are undefined in GL; Mesa uses their lowest bits
    set_coordinate(int(target) % TEXTURE_UNITS, *coordinates)


# -- unit 0 ------------------------------------------------------------------------------------------------------------
@in_lists
def glTexCoord1f(s: float) -> None:
    """Set the texture coordinate of unit 0; t = r = 0, q = 1."""
    set_coordinate(0, s)


@in_lists
def glTexCoord1fv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector."""
    set_coordinate(0, *vector(v, 1))


def glTexCoord2f(s: float, t: float) -> None:
    """Set the texture coordinate of unit 0; r = 0, q = 1."""
    context = thread.context
    try:
        if not (type(s) is float and type(t) is float):
            hypot(s, t)  # the quickest question whether these are numbers
            s, t = float(s), float(t)
        primitive = context.primitive
        if primitive is not None and primitive.steady.get("texcoord0") == 2:
            context.current.texcoords[0] = coordinate = (s, t, 0.0, 1.0)
            primitive.changes["texcoord0"].append((len(primitive.positions), coordinate))
        elif context.compiled_list is None:
            set_coordinate(0, s, t)
        else:
            record(context, glTexCoord2f, s, t)
    except CONVERTING as error:
        raise refusal(glTexCoord2f, error, s, t) from error


def glTexCoord2fv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector."""
    try:
        glTexCoord2f(*(v if type(v) is tuple and len(v) == 2 else vector(v, 2)))
    except CONVERTING as error:
        raise refusal(glTexCoord2fv, error, v) from error


@in_lists
def glTexCoord3f(s: float, t: float, r: float) -> None:
    """Set the texture coordinate of unit 0; q = 1."""
    set_coordinate(0, s, t, r)


@in_lists
def glTexCoord3fv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector."""
    set_coordinate(0, *vector(v, 3))


@in_lists
def glTexCoord4f(s: float, t: float, r: float, q: float) -> None:
    """Set the texture coordinate of unit 0."""
    set_coordinate(0, s, t, r, q)


@in_lists
def glTexCoord4fv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector."""
    set_coordinate(0, *vector(v, 4))


@in_lists
def glTexCoord1iv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector of integers."""
    set_coordinate(0, *vector(v, 1, int))


@in_lists
def glTexCoord2iv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector of integers."""
    set_coordinate(0, *vector(v, 2, int))


@in_lists
def glTexCoord3iv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector of integers."""
    set_coordinate(0, *vector(v, 3, int))


@in_lists
def glTexCoord4iv(v: Any) -> None:
    """Set the texture coordinate of unit 0 from a vector of integers."""
    set_coordinate(0, *vector(v, 4, int))


glTexCoord1d = glTexCoord1i = glTexCoord1s = glTexCoord1f
glTexCoord1dv, glTexCoord1sv = glTexCoord1fv, glTexCoord1iv
glTexCoord2d = glTexCoord2i = glTexCoord2s = glTexCoord2f
glTexCoord2dv, glTexCoord2sv = glTexCoord2fv, glTexCoord2iv
glTexCoord3d = glTexCoord3i = glTexCoord3s = glTexCoord3f
glTexCoord3dv, glTexCoord3sv = glTexCoord3fv, glTexCoord3iv
glTexCoord4d = glTexCoord4i = glTexCoord4s = glTexCoord4f
glTexCoord4dv, glTexCoord4sv = glTexCoord4fv, glTexCoord4iv


# -- any unit ----------------------------------------------------------------------------------------------------------
@in_lists
def glMultiTexCoord1f(target: int, s: float) -> None:
    """Set the texture coordinate of a unit; t = r = 0, q = 1."""
    _set_of(target, s)


@in_lists
def glMultiTexCoord1fv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector."""
    _set_of(target, *vector(v, 1))


@in_lists
def glMultiTexCoord2f(target: int, s: float, t: float) -> None:
    """Set the texture coordinate of a unit; r = 0, q = 1."""
    _set_of(target, s, t)


@in_lists
def glMultiTexCoord2fv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector."""
    _set_of(target, *vector(v, 2))


@in_lists
def glMultiTexCoord3f(target: int, s: float, t: float, r: float) -> None:
    """Set the texture coordinate of a unit; q = 1."""
    _set_of(target, s, t, r)


@in_lists
def glMultiTexCoord3fv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector."""
    _set_of(target, *vector(v, 3))


@in_lists
def glMultiTexCoord4f(target: int, s: float, t: float, r: float, q: float) -> None:
    """Set the texture coordinate of a unit."""
    _set_of(target, s, t, r, q)


@in_lists
def glMultiTexCoord4fv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector."""
    _set_of(target, *vector(v, 4))


@in_lists
def glMultiTexCoord1iv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector of integers."""
    _set_of(target, *vector(v, 1, int))


@in_lists
def glMultiTexCoord2iv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector of integers."""
    _set_of(target, *vector(v, 2, int))


@in_lists
def glMultiTexCoord3iv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector of integers."""
    _set_of(target, *vector(v, 3, int))


@in_lists
def glMultiTexCoord4iv(target: int, v: Any) -> None:
    """Set the texture coordinate of a unit from a vector of integers."""
    _set_of(target, *vector(v, 4, int))


glMultiTexCoord1d = glMultiTexCoord1i = glMultiTexCoord1s = glMultiTexCoord1f
glMultiTexCoord1dv, glMultiTexCoord1sv = glMultiTexCoord1fv, glMultiTexCoord1iv
glMultiTexCoord2d = glMultiTexCoord2i = glMultiTexCoord2s = glMultiTexCoord2f
glMultiTexCoord2dv, glMultiTexCoord2sv = glMultiTexCoord2fv, glMultiTexCoord2iv
glMultiTexCoord3d = glMultiTexCoord3i = glMultiTexCoord3s = glMultiTexCoord3f
glMultiTexCoord3dv, glMultiTexCoord3sv = glMultiTexCoord3fv, glMultiTexCoord3iv
glMultiTexCoord4d = glMultiTexCoord4i = glMultiTexCoord4s = glMultiTexCoord4f
glMultiTexCoord4dv, glMultiTexCoord4sv = glMultiTexCoord4fv, glMultiTexCoord4iv

__all__ = spelled_like_gl(globals())
