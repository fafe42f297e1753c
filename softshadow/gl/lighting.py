"""Lights, the light model and the shade model."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, thread
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.capabilities import LIGHTS
from softshadow.gl.conversions import as_floats, as_ints, enum, first, from_int, to_int, truncated_int, vector
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.fragment_state import rounded, rounded_number
from softshadow.gl.refusals import CONVERTING, refusal

COLORS = {gl.GL_AMBIENT: "ambient", gl.GL_DIFFUSE: "diffuse", gl.GL_SPECULAR: "specular"}
PLACES = {gl.GL_POSITION: "position", gl.GL_SPOT_DIRECTION: "spot_direction"}
# parameter: (field, largest value); the smallest is 0
NUMBERS = {
    gl.GL_SPOT_EXPONENT: ("spot_exponent", 128.0),
    gl.GL_SPOT_CUTOFF: ("spot_cutoff", 180.0),
    gl.GL_CONSTANT_ATTENUATION: ("constant_attenuation", np.inf),
    gl.GL_LINEAR_ATTENUATION: ("linear_attenuation", np.inf),
    gl.GL_QUADRATIC_ATTENUATION: ("quadratic_attenuation", np.inf),
}
PARAMETERS = {**COLORS, **PLACES, **{pname: field for pname, (field, _) in NUMBERS.items()}}
NO_SPOT = 180.0
LARGEST_CUTOFF = 90.0
MODEL_SWITCHES = {gl.GL_LIGHT_MODEL_LOCAL_VIEWER: "local_viewer", gl.GL_LIGHT_MODEL_TWO_SIDE: "two_side"}
MODEL_NUMBERS = (*MODEL_SWITCHES, gl.GL_LIGHT_MODEL_COLOR_CONTROL)
MODEL_PARAMETERS = (gl.GL_LIGHT_MODEL_AMBIENT, *MODEL_NUMBERS)
SHADE_MODELS = (gl.GL_FLAT, gl.GL_SMOOTH)
COLOR_CONTROLS = (gl.GL_SINGLE_COLOR, gl.GL_SEPARATE_SPECULAR_COLOR)
CONVENTIONS = (gl.GL_FIRST_VERTEX_CONVENTION, gl.GL_LAST_VERTEX_CONVENTION)
A_CONVENTION = "GL_FIRST_VERTEX_CONVENTION or GL_LAST_VERTEX_CONVENTION"
GROUPS = {light: f"lighting.lights.{light - gl.GL_LIGHT0}" for light in LIGHTS}  # of the state
A_LIGHT = "GL_LIGHT0 … GL_LIGHT7"
A_PARAMETER = "a light parameter (GL 2.1, table 2.11)"


# -- lights ------------------------------------------------------------------------------------------------------------
@in_lists
def glLightfv(light: int, pname: int, params: Any) -> None:
    """Set a parameter of a light; positions and spot directions are transformed by the current modelview matrix."""
    _set("glLightfv", light, pname, params, float)


@in_lists
def glLightiv(light: int, pname: int, params: Any) -> None:
    """Set a parameter of a light from integers; colours use the full range of int."""
    _set("glLightiv", light, pname, params, from_int)


def glLightf(light: int, pname: int, param: float) -> None:
    """Set a parameter of a light that is a single number."""
    context = thread.context
    if not (context.ready or is_allowed(context, glLightf, light, pname, param)):
        return
    if not is_one_of("glLightf", "pname", pname, NUMBERS, "a light parameter that is a single number"):
        return
    if is_one_of("glLightf", "light", light, LIGHTS, A_LIGHT):
        _set_number("glLightf", context, light, pname, float(param))


glLighti = glLightf


def _set(operation: str, light: int, pname: int, params: Any, color: Callable[[Any], float]) -> None:
    context = outside_begin(operation)
    if context is None or not is_one_of(operation, "light", light, LIGHTS, A_LIGHT):
        return
    if not is_one_of(operation, "pname", pname, PARAMETERS, A_PARAMETER):
        return
    plain = int if color is from_int else float
    if pname in NUMBERS:
        _set_number(operation, context, light, pname, first(params, plain))
    elif pname in COLORS:
        _replace(context, light, COLORS[pname], rounded(context, *vector(params, 4, color)))
    elif pname == gl.GL_POSITION:
        _replace(context, light, "position", in_eye_space(context, vector(params, 4, plain)))
    else:
        _replace(context, light, "spot_direction", in_eye_space(context, vector(params, 3, plain)))


def in_eye_space(context: Context, place: Any) -> tuple[float, ...]:
    """Return a point (4,) or direction (3,) times the modelview matrix, each step rounded in GL's order."""
    m, count = context.modelview_stack.current, len(place)
    with np.errstate(all="ignore"):
        terms = m[:, :count] * np.array(place, context.real)
        product = (terms[:, 0] + terms[:, 1]) + terms[:, 2]
        if count == 4:
            product = product + terms[:, 3]
    return tuple(product.tolist()[:count])


def _set_number(operation: str, context: Context, light: int, pname: int, value: float) -> None:
    field, largest = NUMBERS[pname]
    limit = LARGEST_CUTOFF if pname == gl.GL_SPOT_CUTOFF and value != NO_SPOT else largest
    if not 0 <= value <= limit:
        expected = "0 to 90, or 180" if pname == gl.GL_SPOT_CUTOFF else f"0 to {largest:g}"
        fail(gl.GL_INVALID_VALUE, operation, f"param={value:g}: expected {expected} for GL_{field.upper()}")
    else:
        _replace(context, light, field, rounded_number(context, value))


def _replace(context: Context, light: int, field: str, value: Any) -> None:
    context.change_field(GROUPS[light], field, value)


def glGetLightfv(light: int, pname: int) -> Any:
    """Return a parameter of a light: a float, or an array float32; positions and directions in eye space."""
    return as_floats(_parameter("glGetLightfv", light, pname))


def glGetLightiv(light: int, pname: int) -> Any:
    """Return a parameter of a light: an int, or an array int32; colours use the full range of int."""
    return as_ints(_parameter("glGetLightiv", light, pname), to_int if pname in COLORS else truncated_int)


def _parameter(operation: str, light: int, pname: int) -> Any:
    context = outside_begin(operation)
    if context is None or not is_one_of(operation, "light", light, LIGHTS, A_LIGHT):
        return None
    if not is_one_of(operation, "pname", pname, PARAMETERS, A_PARAMETER):
        return None
    return getattr(context.state.lighting.lights[light - gl.GL_LIGHT0], PARAMETERS[pname])


# -- light model and shade model ---------------------------------------------------------------------------------------
@in_lists
def glLightModelfv(pname: int, params: Any) -> None:
    """Set the global ambient light, or a switch of the light model."""
    _set_model("glLightModelfv", pname, params, float)


@in_lists
def glLightModeliv(pname: int, params: Any) -> None:
    """Set the light model from integers; the ambient light uses the full range of int."""
    _set_model("glLightModeliv", pname, params, from_int)


def glLightModelf(pname: int, param: float) -> None:
    """Set a switch of the light model: local viewer, two-sided lighting, separate specular colour."""
    context = thread.context
    if not (context.ready or is_allowed(context, glLightModelf, pname, param)):
        return
    if pname in MODEL_SWITCHES:
        context.change_field("lighting", MODEL_SWITCHES[pname], bool(float(param)))
    elif is_one_of("glLightModelf", "pname", pname, MODEL_NUMBERS, "a switch of the light model"):
        _set_model("glLightModelf", pname, param, float)


glLightModeli = glLightModelf


def _set_model(operation: str, pname: int, params: Any, color: Callable[[Any], float]) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    if not is_one_of(operation, "pname", pname, MODEL_PARAMETERS, "a light model parameter (GL 2.1, table 2.11)"):
        return
    plain = int if color is from_int else float
    if pname == gl.GL_LIGHT_MODEL_AMBIENT:
        ambient = rounded(context, *vector(params, 4, color))
        before = context.groups["lighting"].fields["model_ambient"]
        if ambient != rounded(context, *before):  # initially 0.2, not rounded
            context.change("lighting", model_ambient=ambient)
    elif pname in MODEL_SWITCHES:
        context.change("lighting", **{MODEL_SWITCHES[pname]: bool(first(params, plain))})
    else:
        expected = "GL_SINGLE_COLOR or GL_SEPARATE_SPECULAR_COLOR"
        control = enum(first(params, plain))
        if is_one_of(operation, "param", control, COLOR_CONTROLS, expected):
            context.change("lighting", color_control=control)


def glShadeModel(mode: int) -> None:
    """Set whether colours are interpolated or taken from the provoking vertex."""
    context = thread.context
    try:
        if not (context.ready or is_allowed(context, glShadeModel, mode)):
            return
        if mode in SHADE_MODELS or is_one_of("glShadeModel", "mode", mode, SHADE_MODELS, "GL_FLAT or GL_SMOOTH"):
            context.change_field("lighting", "shade_model", int(mode))
    except CONVERTING as error:
        raise refusal(glShadeModel, error, mode) from error


@in_lists
def glProvokingVertex(provokeMode: int) -> None:
    """Set which vertex of a line or triangle gives its flat colour: the first or the last one."""
    context = outside_begin("glProvokingVertex")
    if context is not None and is_one_of("glProvokingVertex", "provokeMode", provokeMode, CONVENTIONS, A_CONVENTION):
        context.change("lighting", provoking_vertex=int(provokeMode))


__all__ = spelled_like_gl(globals())
