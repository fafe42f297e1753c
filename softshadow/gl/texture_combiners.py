"""The parameters of GL_COMBINE: their names, allowed values and fields."""

from __future__ import annotations

from typing import Any

from softshadow import tokens as gl
from softshadow.frozen import evolve
from softshadow.gl.conversions import enum
from softshadow.state import TEXTURE_UNITS, Combine
from softshadow.tokens import token_name

FUNCTIONS_ALPHA = (gl.GL_REPLACE, gl.GL_MODULATE, gl.GL_ADD, gl.GL_ADD_SIGNED, gl.GL_INTERPOLATE, gl.GL_SUBTRACT)
FUNCTIONS_RGB = (*FUNCTIONS_ALPHA, gl.GL_DOT3_RGB, gl.GL_DOT3_RGBA)
SOURCES = (
    gl.GL_TEXTURE, gl.GL_CONSTANT, gl.GL_PRIMARY_COLOR, gl.GL_PREVIOUS,
    *range(gl.GL_TEXTURE0, gl.GL_TEXTURE0 + TEXTURE_UNITS),
)  # fmt: skip
OPERANDS_ALPHA = (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
OPERANDS_RGB = (gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR, *OPERANDS_ALPHA)
SCALES = {gl.GL_RGB_SCALE: "rgb_scale", gl.GL_ALPHA_SCALE: "alpha_scale"}
SCALE_VALUES = (1.0, 2.0, 4.0)
MODES = {
    gl.GL_COMBINE_RGB: ("mode_rgb", FUNCTIONS_RGB),
    gl.GL_COMBINE_ALPHA: ("mode_alpha", FUNCTIONS_ALPHA),
}
# parameter: (field, index of the argument, allowed values)
ARGUMENTS = {
    first + i: (field, i, values)
    for first, field, values in (
        (gl.GL_SOURCE0_RGB, "sources_rgb", SOURCES),
        (gl.GL_SOURCE0_ALPHA, "sources_alpha", SOURCES),
        (gl.GL_OPERAND0_RGB, "operands_rgb", OPERANDS_RGB),
        (gl.GL_OPERAND0_ALPHA, "operands_alpha", OPERANDS_ALPHA),
    )
    for i in range(3)
}
COMBINE_PARAMETERS = {*SCALES, *MODES, *ARGUMENTS}


def with_parameter(combine: Combine, pname: int, value: Any) -> tuple[Combine | None, str]:
    """Return (`combine` with one parameter changed, ""), or (None, message) if the value is not allowed."""
    if pname in SCALES:
        if float(value) in SCALE_VALUES:
            return evolve(combine, **{SCALES[pname]: float(value)}), ""
        return None, f"{token_name(pname)}={value}: expected 1, 2 or 4"
    values = MODES[pname][1] if pname in MODES else ARGUMENTS[pname][2]
    chosen = enum(value)
    if chosen not in values:
        expected = ", ".join(token_name(v) for v in values)
        return None, f"{token_name(pname)}={token_name(chosen)}: expected one of {expected}"
    if pname in MODES:
        return evolve(combine, **{MODES[pname][0]: chosen}), ""
    field, index, _ = ARGUMENTS[pname]
    old = getattr(combine, field)
    changed: Any = (*old[:index], chosen, *old[index + 1 :])
    return evolve(combine, **{field: changed}), ""


def parameter_of(combine: Combine, pname: int) -> float:
    """Return the value of a parameter."""
    if pname in SCALES:
        return float(getattr(combine, SCALES[pname]))
    if pname in MODES:
        return int(getattr(combine, MODES[pname][0]))
    field, index, _ = ARGUMENTS[pname]
    return int(getattr(combine, field)[index])
