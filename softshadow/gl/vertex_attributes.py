"""The current colour and normal."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any

from softshadow.context import current, thread
from softshadow.gl.calls import in_lists, record, spelled_like_gl
from softshadow.gl.conversions import (
    OF_UNSIGNED_BYTES,
    from_byte,
    from_int,
    from_short,
    from_unsigned_byte,
    from_unsigned_int,
    from_unsigned_short,
    vector,
)
from softshadow.gl.materials import follow_color
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.vertex_format import carry_attribute, set_attribute


# -- colour ------------------------------------------------------------------------------------------------------------
def set_color(red: float, green: float, blue: float, *alpha: float) -> None:
    context, n_components = thread.context, 3 + len(alpha)
    primitive = context.primitive
    if primitive is not None and primitive.steady.get("color") == n_components:
        context.current.color = color = (float(red), float(green), float(blue), float(alpha[0]) if alpha else 1.0)
        primitive.changes["color"].append((len(primitive.positions), color))
        return
    buffer, size = context.vertex_buffer, n_components
    is_like_last = buffer.sizes.get("color") == buffer.active_sizes.get("color") == size
    if not (is_like_last and "color" in context.pending.old_values):
        size = carry_attribute(context, "color", n_components)  # which does nothing else
    if not alpha:
        alpha = context.current.color[3:] if size > 3 else (1.0,)
    color = (float(red), float(green), float(blue), float(alpha[0]))
    if primitive is None:
        context.current.color = color
        if context.groups["lighting"].fields["color_material"]:
            follow_color(context)
    else:  # glEnd lets the materials follow
        set_attribute(context, "color", n_components, color)


def glColor3f(red: float, green: float, blue: float) -> None:
    """Set the current colour, alpha 1."""
    context = thread.context
    try:
        if not (type(red) is float and type(green) is float and type(blue) is float):
            hypot(red, green, blue)  # the quickest question whether these are numbers
            red, green, blue = float(red), float(green), float(blue)
        primitive = context.primitive
        if primitive is not None and primitive.steady.get("color") == 3:
            context.current.color = color = (red, green, blue, 1.0)
            primitive.changes["color"].append((len(primitive.positions), color))
        elif context.compiled_list is None:
            set_color(red, green, blue)
        else:
            record(context, glColor3f, red, green, blue)
    except CONVERTING as error:
        raise refusal(glColor3f, error, red, green, blue) from error


def glColor4f(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the current colour."""
    context = thread.context
    try:
        if not (type(red) is float and type(green) is float and type(blue) is float and type(alpha) is float):
            hypot(red, green, blue, alpha)
            red, green, blue, alpha = float(red), float(green), float(blue), float(alpha)
        primitive = context.primitive
        if primitive is not None and primitive.steady.get("color") == 4:
            context.current.color = color = (red, green, blue, alpha)
            primitive.changes["color"].append((len(primitive.positions), color))
        elif context.compiled_list is None:
            set_color(red, green, blue, alpha)
        else:
            record(context, glColor4f, red, green, blue, alpha)
    except CONVERTING as error:
        raise refusal(glColor4f, error, red, green, blue, alpha) from error


def glColor3fv(v: Any) -> None:
    """Set the current colour from a vector, alpha 1."""
    try:
        glColor3f(*(v if type(v) is tuple and len(v) == 3 else vector(v, 3)))
    except CONVERTING as error:
        raise refusal(glColor3fv, error, v) from error


def glColor4fv(v: Any) -> None:
    """Set the current colour from a vector."""
    try:
        glColor4f(*(v if type(v) is tuple and len(v) == 4 else vector(v, 4)))
    except CONVERTING as error:
        raise refusal(glColor4fv, error, v) from error


@in_lists
def glColor3d(red: float, green: float, blue: float) -> None:
    """Set the current colour, alpha 1."""
    set_color(red, green, blue, 1.0)  # Mesa sets four components in all glColor3 calls but glColor3f


@in_lists
def glColor3dv(v: Any) -> None:
    """Set the current colour from a vector, alpha 1."""
    set_color(*vector(v, 3), 1.0)


glColor4d, glColor4dv = glColor4f, glColor4fv


def _calls_for(convert: Callable[[Any], float]) -> tuple[Callable[..., None], ...]:
    """Return glColor3, glColor4, glColor3v and glColor4v for integers that represent 0 to 1 or -1 to 1."""

    @in_lists
    def three(red: int, green: int, blue: int) -> None:
        """Set the current colour from integers, alpha 1."""
        set_color(convert(red), convert(green), convert(blue), 1.0)

    @in_lists
    def four(red: int, green: int, blue: int, alpha: int) -> None:
        """Set the current colour from integers."""
        set_color(convert(red), convert(green), convert(blue), convert(alpha))

    @in_lists
    def three_of_vector(v: Any) -> None:
        """Set the current colour from a vector of integers, alpha 1."""
        set_color(*vector(v, 3, convert), 1.0)

    @in_lists
    def four_of_vector(v: Any) -> None:
        """Set the current colour from a vector of integers."""
        set_color(*vector(v, 4, convert))

    return three, four, three_of_vector, four_of_vector


glColor3b, glColor4b, glColor3bv, glColor4bv = _calls_for(from_byte)
glColor3ubv, glColor4ubv = _calls_for(from_unsigned_byte)[2:]  # the other two, which programs make most, are below
glColor3s, glColor4s, glColor3sv, glColor4sv = _calls_for(from_short)
glColor3us, glColor4us, glColor3usv, glColor4usv = _calls_for(from_unsigned_short)
glColor3i, glColor4i, glColor3iv, glColor4iv = _calls_for(from_int)
glColor3ui, glColor4ui, glColor3uiv, glColor4uiv = _calls_for(from_unsigned_int)


def glColor4ub(red: int, green: int, blue: int, alpha: int) -> None:
    """Set the current colour from bytes that represent 0 to 1."""
    context = thread.context
    try:
        if not (type(red) is int and type(green) is int and type(blue) is int and type(alpha) is int):
            hypot(red, green, blue, alpha)  # the quickest question whether these are numbers
            red, green, blue, alpha = int(red), int(green), int(blue), int(alpha)
        value = OF_UNSIGNED_BYTES
        color = value[red & 255], value[green & 255], value[blue & 255], value[alpha & 255]
        primitive = context.primitive
        if primitive is not None and primitive.steady.get("color") == 4:
            context.current.color = color
            primitive.changes["color"].append((len(primitive.positions), color))
        elif context.compiled_list is None:
            set_color(*color)
        else:
            record(context, glColor4ub, red, green, blue, alpha)
    except CONVERTING as error:
        raise refusal(glColor4ub, error, red, green, blue, alpha) from error


def glColor3ub(red: int, green: int, blue: int) -> None:
    """Set the current colour from bytes that represent 0 to 1, alpha 1."""
    try:
        glColor4ub(red, green, blue, 255)
    except CONVERTING as error:
        raise refusal(glColor3ub, error, red, green, blue) from error


# -- normal ------------------------------------------------------------------------------------------------------------
def set_normal(x: float, y: float, z: float) -> None:
    context = thread.context
    carry_attribute(context, "normal", 3)
    set_attribute(context, "normal", 3, (float(x), float(y), float(z)))


def glNormal3f(nx: float, ny: float, nz: float) -> None:
    """Set the current normal."""
    context = thread.context
    try:
        if not (type(nx) is float and type(ny) is float and type(nz) is float):
            hypot(nx, ny, nz)  # the quickest question whether these are numbers
            nx, ny, nz = float(nx), float(ny), float(nz)
        primitive = context.primitive
        if primitive is not None and primitive.steady.get("normal") == 3:
            context.current.normal = normal = (nx, ny, nz)
            primitive.changes["normal"].append((len(primitive.positions), normal))
        elif context.compiled_list is None:
            set_normal(nx, ny, nz)
        else:
            record(context, glNormal3f, nx, ny, nz)
    except CONVERTING as error:
        raise refusal(glNormal3f, error, nx, ny, nz) from error


def glNormal3fv(v: Any) -> None:
    """Set the current normal from a vector."""
    try:
        glNormal3f(*(v if type(v) is tuple and len(v) == 3 else vector(v, 3)))
    except CONVERTING as error:
        raise refusal(glNormal3fv, error, v) from error


glNormal3d, glNormal3dv = glNormal3f, glNormal3fv


@in_lists
def glNormal3b(nx: int, ny: int, nz: int) -> None:
    """Set the current normal from bytes that represent -1 to 1."""
    set_normal(from_byte(nx), from_byte(ny), from_byte(nz))


@in_lists
def glNormal3s(nx: int, ny: int, nz: int) -> None:
    """Set the current normal from shorts that represent -1 to 1."""
    set_normal(from_short(nx), from_short(ny), from_short(nz))


@in_lists
def glNormal3i(nx: int, ny: int, nz: int) -> None:
    """Set the current normal from ints that represent -1 to 1."""
    set_normal(from_int(nx), from_int(ny), from_int(nz))


@in_lists
def glNormal3bv(v: Any) -> None:
    """Set the current normal from a vector of bytes."""
    set_normal(*vector(v, 3, from_byte))


@in_lists
def glNormal3sv(v: Any) -> None:
    """Set the current normal from a vector of shorts."""
    set_normal(*vector(v, 3, from_short))


@in_lists
def glNormal3iv(v: Any) -> None:
    """Set the current normal from a vector of ints."""
    set_normal(*vector(v, 3, from_int))


# -- edge flag ---------------------------------------------------------------------------------------------------------
@in_lists
def glEdgeFlag(flag: bool) -> None:
    """Set whether the vertices that follow begin an edge that glPolygonMode draws."""
    context = current()
    carry_attribute(context, "edge", 1)
    set_attribute(context, "edge", 1, bool(flag))


@in_lists
def glEdgeFlagv(flag: Any) -> None:
    """Set the edge flag from a vector."""
    glEdgeFlag(bool(vector(flag, 1)[0]))


__all__ = spelled_like_gl(globals())
