"""Texture units: the active unit, texture environment, level-of-detail bias, generated coordinates."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, thread
from softshadow.context.state_groups import UNITS
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.conversions import NUMBERS, enum, first, from_int, numbers, vector
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.gl.texture_combiners import COMBINE_PARAMETERS, SCALES, parameter_of, with_parameter
from softshadow.gl.textures import queried_color, set_unit
from softshadow.programs.inverse import inverse
from softshadow.state import TEXTURE_UNITS, TexGen
from softshadow.tokens import token_name

MODES = {  # of the environment; a number that equals one, such as 7681.0, stands for it
    mode: mode for mode in (gl.GL_MODULATE, gl.GL_DECAL, gl.GL_BLEND, gl.GL_REPLACE, gl.GL_ADD, gl.GL_COMBINE)
}
COORDINATES = (gl.GL_S, gl.GL_T, gl.GL_R, gl.GL_Q)
GEN_MODES = {  # mode: the coordinates that can be generated this way
    gl.GL_OBJECT_LINEAR: COORDINATES,
    gl.GL_EYE_LINEAR: COORDINATES,
    gl.GL_SPHERE_MAP: COORDINATES[:2],
    gl.GL_NORMAL_MAP: COORDINATES[:3],
    gl.GL_REFLECTION_MAP: COORDINATES[:3],
}
PLANES = {gl.GL_OBJECT_PLANE: "object_plane", gl.GL_EYE_PLANE: "eye_plane"}


def glActiveTexture(texture: int) -> None:
    """Select the unit that texture calls and the texture matrix stack apply to."""
    context = thread.context
    if not (context.ready or is_allowed(context, glActiveTexture, texture)):
        return None
    unit = int(texture) - gl.GL_TEXTURE0
    if not 0 <= unit < TEXTURE_UNITS:
        return fail(
            gl.GL_INVALID_ENUM,
            "glActiveTexture",
            f"texture={token_name(texture)}: expected GL_TEXTURE0 to GL_TEXTURE{TEXTURE_UNITS - 1}",
        )
    if context.active_unit != unit:
        context.separate()
        context.touched |= gl.GL_TEXTURE_BIT
    context.select_unit(unit)
    return None


# -- environment -------------------------------------------------------------------------------------------------------
@in_lists
def glTexEnvi(target: int, pname: int, param: int) -> None:
    """Set how a texture's colour is combined with the fragment's."""
    _set_environment("glTexEnvi", target, pname, param)


@in_lists
def glTexEnvf(target: int, pname: int, param: float) -> None:
    """Set how a texture's colour is combined with the fragment's, or the unit's level-of-detail bias."""
    _set_environment("glTexEnvf", target, pname, param)


@in_lists
def glTexEnvfv(target: int, pname: int, params: Any) -> None:
    """Set a parameter of the texture environment; GL_TEXTURE_ENV_COLOR takes four floats."""
    _set_environment("glTexEnvfv", target, pname, numbers(params), is_vector=True)


@in_lists
def glTexEnviv(target: int, pname: int, params: Any) -> None:
    """Set a parameter of the texture environment; for the colour, 2**31 - 1 represents 1."""
    is_color = pname == gl.GL_TEXTURE_ENV_COLOR
    values = vector(params, 4, from_int) if is_color else numbers(params, int)
    _set_environment("glTexEnviv", target, pname, values, is_vector=True)


def _set_environment(operation: str, target: int, pname: int, value: Any, is_vector: bool = False) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    is_number = not is_vector and type(value) in NUMBERS
    if pname == gl.GL_TEXTURE_ENV_MODE and target == gl.GL_TEXTURE_ENV and is_number and value in MODES:
        context.change_field(UNITS[context.active_unit], "env_mode", MODES[value])
        return None
    values = (value,) if is_number else np.ravel(value)
    if problem := _environment_problem(target, pname, is_vector):
        return fail(gl.GL_INVALID_ENUM, operation, problem)
    if target == gl.GL_POINT_SPRITE:
        return _replace_coordinates(context, operation, values[0])
    if pname == gl.GL_TEXTURE_LOD_BIAS:
        set_unit(context, context.active_unit, lod_bias=float(np.float32(values[0])))
        return None
    if pname == gl.GL_TEXTURE_ENV_COLOR:
        color = np.array(vector(values, 4), np.float32)
        set_unit(context, context.active_unit, env_color=tuple(color.tolist()))
        return None
    if pname in COMBINE_PARAMETERS:
        unit = context.state.units[context.active_unit]
        combine, message = with_parameter(unit.combine, pname, values[0])
        if combine is None:
            return fail(gl.GL_INVALID_VALUE if pname in SCALES else gl.GL_INVALID_ENUM, operation, message)
        set_unit(context, context.active_unit, combine=combine)
        return None
    mode = enum(values[0])
    if mode not in MODES:
        expected = ", ".join(token_name(m, MODE_NAMES) for m in MODES)
        return fail(
            gl.GL_INVALID_ENUM, operation, f"GL_TEXTURE_ENV_MODE={token_name(mode)}: expected one of {expected}"
        )
    set_unit(context, context.active_unit, env_mode=mode)
    return None


def _replace_coordinates(context: Context, operation: str, value: float) -> None:
    """Set whether point sprites replace the coordinates of the active unit."""
    if value not in (0, 1):
        return fail(gl.GL_INVALID_VALUE, operation, f"GL_COORD_REPLACE={value:g}: expected GL_TRUE or GL_FALSE")
    replaced, unit = context.state.points.replaced, context.active_unit
    context.change("points", replaced=(*replaced[:unit], bool(value), *replaced[unit + 1 :]))
    return None


def _environment_problem(target: int, pname: int, is_vector: bool) -> str | None:
    if target == gl.GL_POINT_SPRITE:
        return None if pname == gl.GL_COORD_REPLACE else f"pname={token_name(pname)}: expected GL_COORD_REPLACE"
    if target == gl.GL_TEXTURE_FILTER_CONTROL:
        return None if pname == gl.GL_TEXTURE_LOD_BIAS else f"pname={token_name(pname)}: expected GL_TEXTURE_LOD_BIAS"
    if target != gl.GL_TEXTURE_ENV:
        return f"target={token_name(target)}: expected GL_TEXTURE_ENV, GL_TEXTURE_FILTER_CONTROL or GL_POINT_SPRITE"
    if (
        pname == gl.GL_TEXTURE_ENV_MODE
        or pname in COMBINE_PARAMETERS
        or (pname == gl.GL_TEXTURE_ENV_COLOR and is_vector)
    ):
        return None
    return (
        f"pname={token_name(pname)}: expected GL_TEXTURE_ENV_MODE, a parameter of GL_COMBINE, or GL_TEXTURE_ENV_COLOR "
        "with four numbers"
    )


def glGetTexEnviv(target: int, pname: int, params: Any = None) -> Any:
    """Return a parameter of the texture environment: an int, or 4 int32 for its colour."""
    return _environment("glGetTexEnviv", target, pname, params, np.int32)


def glGetTexEnvfv(target: int, pname: int, params: Any = None) -> Any:
    """Return a parameter of the texture environment: a float, or 4 float32 for its colour."""
    return _environment("glGetTexEnvfv", target, pname, params, np.float32)


def _environment(operation: str, target: int, pname: int, params: Any, dtype: type[np.generic]) -> Any:
    if (context := outside_begin(operation)) is None:
        return None
    if problem := _environment_problem(target, pname, is_vector=True):
        return fail(gl.GL_INVALID_ENUM, operation, problem)
    if target == gl.GL_POINT_SPRITE:
        return _answer(np.array([context.state.points.replaced[context.active_unit]], dtype), params)
    unit = context.state.units[context.active_unit]
    if pname == gl.GL_TEXTURE_ENV_MODE:
        return _answer(np.array([unit.env_mode], dtype), params)
    if pname == gl.GL_TEXTURE_LOD_BIAS:
        return _answer(np.array([unit.lod_bias], np.float32).astype(dtype), params)
    if pname in COMBINE_PARAMETERS:
        return _answer(np.array([parameter_of(unit.combine, pname)], dtype), params)
    color = queried_color(context, unit.env_color)
    scaled = color if dtype == np.float32 else (color.astype(np.float64) * 2147483647.0).astype(dtype)
    return _answer(scaled, params)


def _answer(values: np.ndarray, params: Any) -> Any:
    if params is not None:
        np.asarray(params)[: len(values)] = values
    return values if len(values) > 1 else values[0].item()


# -- generated coordinates ---------------------------------------------------------------------------------------------
def glTexGeni(coord: int, pname: int, param: int) -> None:
    """Set how a coordinate is generated: GL_SPHERE_MAP only s and t, GL_NORMAL_MAP and GL_REFLECTION_MAP not q."""
    context = thread.context
    try:
        hypot(param)  # the quickest question whether this is a number
        if context.ready or is_allowed(context, glTexGeni, coord, pname, param):
            _set_mode(context, "glTexGeni", coord, pname, param)
    except CONVERTING as error:
        raise refusal(glTexGeni, error, coord, pname, param) from error


@in_lists
def glTexGenf(coord: int, pname: int, param: float) -> None:
    """Set how a coordinate is generated."""
    _set_mode(outside_begin("glTexGenf"), "glTexGenf", coord, pname, param)


@in_lists
def glTexGend(coord: int, pname: int, param: float) -> None:
    """Set how a coordinate is generated."""
    _set_mode(outside_begin("glTexGend"), "glTexGend", coord, pname, param)


@in_lists
def glTexGenfv(coord: int, pname: int, params: Any) -> None:
    """Set a plane of a generated coordinate, or its mode; an eye plane is transformed to eye space."""
    _set_generation("glTexGenfv", coord, pname, params)


@in_lists
def glTexGendv(coord: int, pname: int, params: Any) -> None:
    """Set a plane of a generated coordinate, or its mode."""
    _set_generation("glTexGendv", coord, pname, params)


@in_lists
def glTexGeniv(coord: int, pname: int, params: Any) -> None:
    """Set a plane of a generated coordinate, or its mode."""
    _set_generation("glTexGeniv", coord, pname, params, int)


def _set_mode(context: Context | None, operation: str, coord: int, pname: int, value: Any) -> None:
    if context is None:  # between glBegin and glEnd
        return None
    if problem := _generation_problem(coord, pname, is_vector=False):
        return fail(gl.GL_INVALID_ENUM, operation, problem)
    chosen = value if type(value) is int else enum(value)
    if coord not in GEN_MODES.get(chosen, ()):
        expected = ", ".join(token_name(mode) for mode, coordinates in GEN_MODES.items() if coord in coordinates)
        return fail(
            gl.GL_INVALID_ENUM,
            operation,
            f"GL_TEXTURE_GEN_MODE={token_name(chosen)}: expected one of {expected} for {token_name(coord)}",
        )
    _replace_generation(context, coord, "mode", chosen)
    return None


def _set_generation(
    operation: str, coord: int, pname: int, params: Any, convert: Callable[[Any], float] = float
) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    if pname == gl.GL_TEXTURE_GEN_MODE:
        return _set_mode(context, operation, coord, pname, first(params, convert))
    if problem := _generation_problem(coord, pname, is_vector=True):
        return fail(gl.GL_INVALID_ENUM, operation, problem)
    plane = np.array(vector(params, 4, convert), np.float32)
    if pname == gl.GL_EYE_PLANE:
        plane = eye_plane(context, plane)
    _replace_generation(context, coord, PLANES[pname], tuple(plane.tolist()))
    return None


def eye_plane(context: Context, plane: np.ndarray) -> np.ndarray:
    """Return a plane (4,) in eye space: the row vector times the inverse of the current modelview matrix."""
    m = inverse(context.modelview_stack.current, context.modelview_stack.kind)
    with np.errstate(all="ignore"):
        m *= plane.astype(np.float32)[:, None]
        return np.asarray(m[0] + m[1] + m[2] + m[3])


def _generation_problem(coord: int, pname: int, is_vector: bool) -> str | None:
    if coord not in COORDINATES:
        return f"coord={token_name(coord)}: expected GL_S, GL_T, GL_R or GL_Q"
    if pname == gl.GL_TEXTURE_GEN_MODE or (is_vector and pname in PLANES):
        return None
    planes = "or with four numbers GL_OBJECT_PLANE or GL_EYE_PLANE"
    return f"pname={token_name(pname)}: expected GL_TEXTURE_GEN_MODE, {planes}"


def _replace_generation(context: Context, coord: int, field: str, value: Any) -> None:
    unit, index = UNITS[context.active_unit], COORDINATES.index(coord)
    gen: tuple[TexGen, ...] = context.groups[unit].fields["gen"]
    if getattr(gen[index], field) != value:
        changed = evolve(gen[index], **{field: value})
        context.change_field(unit, "gen", (*gen[:index], changed, *gen[index + 1 :]))


def glGetTexGeniv(coord: int, pname: int, params: Any = None) -> Any:
    """Return the mode of a generated coordinate, or a plane as 4 int32."""
    return _generation("glGetTexGeniv", coord, pname, params, np.int32)


def glGetTexGenfv(coord: int, pname: int, params: Any = None) -> Any:
    """Return the mode of a generated coordinate as a float, or a plane as 4 float32; an eye plane is in eye space."""
    return _generation("glGetTexGenfv", coord, pname, params, np.float32)


def glGetTexGendv(coord: int, pname: int, params: Any = None) -> Any:
    """Return the mode of a generated coordinate as a float, or a plane as 4 float64."""
    return _generation("glGetTexGendv", coord, pname, params, np.float64)


def _generation(operation: str, coord: int, pname: int, params: Any, dtype: type[np.generic]) -> Any:
    if (context := outside_begin(operation)) is None:
        return None
    if problem := _generation_problem(coord, pname, is_vector=True):
        return fail(gl.GL_INVALID_ENUM, operation, problem)
    gen = context.state.units[context.active_unit].gen[COORDINATES.index(coord)]
    values = [gen.mode] if pname == gl.GL_TEXTURE_GEN_MODE else getattr(gen, PLANES[pname])
    return _answer(np.array(values, np.float32).astype(dtype), params)


MODE_NAMES = ("GL_BLEND", "GL_REPLACE", "GL_ADD")


__all__ = spelled_like_gl(globals())
