"""Lights, materials, shade model and fog."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.errors import StateError
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum
from softshadow.gl.fragment_state import A_FACE, FACES, LIGHTS, change, clamp01
from softshadow.state import Light, Lighting, Material

COLORS = {gl.GL_AMBIENT: "ambient", gl.GL_DIFFUSE: "diffuse", gl.GL_SPECULAR: "specular"}
LIGHT_VECTORS = {**COLORS, gl.GL_POSITION: "position", gl.GL_SPOT_DIRECTION: "spot_direction"}
# parameter: (field, smallest, largest)
LIGHT_NUMBERS = {
    gl.GL_SPOT_EXPONENT: ("spot_exponent", 0.0, 128.0),
    gl.GL_SPOT_CUTOFF: ("spot_cutoff", 0.0, 180.0),
    gl.GL_CONSTANT_ATTENUATION: ("constant_attenuation", 0.0, np.inf),
    gl.GL_LINEAR_ATTENUATION: ("linear_attenuation", 0.0, np.inf),
    gl.GL_QUADRATIC_ATTENUATION: ("quadratic_attenuation", 0.0, np.inf),
}
MATERIAL_COLORS = {**COLORS, gl.GL_EMISSION: "emission"}
FOLLOWED = {
    gl.GL_AMBIENT: ("ambient",),
    gl.GL_DIFFUSE: ("diffuse",),
    gl.GL_SPECULAR: ("specular",),
    gl.GL_EMISSION: ("emission",),
    gl.GL_AMBIENT_AND_DIFFUSE: ("ambient", "diffuse"),
}
MODEL_SWITCHES = {gl.GL_LIGHT_MODEL_LOCAL_VIEWER: "local_viewer", gl.GL_LIGHT_MODEL_TWO_SIDE: "two_side"}
FOG_NUMBERS = {gl.GL_FOG_DENSITY: "density", gl.GL_FOG_START: "start", gl.GL_FOG_END: "end"}
A_LIGHT = "GL_LIGHT0 … GL_LIGHT7"


def _single(value: float) -> float:
    return float(np.float32(value))


def _vector(params: Any, length: int) -> tuple[float, ...]:
    values = np.ravel(np.asarray(params, np.float64))
    if len(values) < length:
        raise ValueError(f"params={params!r}: expected {length} numbers")
    return tuple(_single(v) for v in values[:length])


# -- lights ------------------------------------------------------------------------------------------------------------
def glLightfv(light: int, pname: int, params: Any) -> None:
    """Set a parameter of a light; a position or spot direction goes through the modelview matrix of now."""
    context = outside_begin("glLightfv")
    if context is None or not is_one_of("glLightfv", "light", light, LIGHTS, A_LIGHT):
        return
    if pname in LIGHT_NUMBERS:
        _set_light_number("glLightfv", context, light, pname, float(np.ravel(params)[0]))
    elif pname not in LIGHT_VECTORS:
        wrong_enum("glLightfv", "pname", pname, "a light parameter (GL 2.1, table 2.11)")
    else:
        values = _vector(params, 3 if pname == gl.GL_SPOT_DIRECTION else 4)
        modelview = context.modelview_stack[-1]
        if pname == gl.GL_POSITION:
            x, y, z, w = (context.real(v) for v in values)
            turned = ((modelview[:, 0] * x + modelview[:, 1] * y) + modelview[:, 2] * z) + modelview[:, 3] * w
            values = tuple(float(v) for v in turned)
        elif pname == gl.GL_SPOT_DIRECTION:
            x, y, z = (context.real(v) for v in values)
            turned = (modelview[:3, 0] * x + modelview[:3, 1] * y) + modelview[:3, 2] * z
            values = tuple(float(v) for v in turned)
        _replace_light(context, light, **{LIGHT_VECTORS[pname]: values})


def glLightf(light: int, pname: int, param: float) -> None:
    """Set a parameter of a light that is one number."""
    context = outside_begin("glLightf")
    if context is None or not is_one_of("glLightf", "light", light, LIGHTS, A_LIGHT):
        return
    if is_one_of("glLightf", "pname", pname, LIGHT_NUMBERS, "a light parameter that is one number"):
        _set_light_number("glLightf", context, light, pname, float(param))


glLighti, glLightiv = glLightf, glLightfv


def _set_light_number(operation: str, context: Context, light: int, pname: int, value: float) -> None:
    field, smallest, largest = LIGHT_NUMBERS[pname]
    allowed = smallest <= value <= largest
    if pname == gl.GL_SPOT_CUTOFF:
        allowed = 0 <= value <= 90 or value == 180
    if not allowed:
        fail(gl.GL_INVALID_VALUE, operation, f"param={value:g}: expected {smallest:g} to {largest:g} for {field}")
    else:
        _replace_light(context, light, **{field: _single(value)})


def _replace_light(context: Context, light: int, **fields: Any) -> None:
    lights = list(context.state.lighting.lights)
    lights[light - gl.GL_LIGHT0] = replace(lights[light - gl.GL_LIGHT0], **fields)
    change(context, "lighting", lights=tuple(lights))


def glLightModelfv(pname: int, params: Any) -> None:
    """Set the scene's ambient light, or one of the light model's switches."""
    context = outside_begin("glLightModelfv")
    if context is None:
        return
    if pname == gl.GL_LIGHT_MODEL_AMBIENT:
        change(context, "lighting", model_ambient=_vector(params, 4))
    else:
        glLightModelf(pname, float(np.ravel(params)[0]))


def glLightModelf(pname: int, param: float) -> None:
    """Set a switch of the light model: local viewer, two sides, separate specular colour."""
    context = outside_begin("glLightModelf")
    if context is None:
        return
    if pname in MODEL_SWITCHES:
        change(context, "lighting", **{MODEL_SWITCHES[pname]: bool(param)})
    elif pname != gl.GL_LIGHT_MODEL_COLOR_CONTROL:
        wrong_enum("glLightModelf", "pname", pname, "a light model parameter that is one number")
    else:
        modes = (gl.GL_SINGLE_COLOR, gl.GL_SEPARATE_SPECULAR_COLOR)
        expected = "GL_SINGLE_COLOR or GL_SEPARATE_SPECULAR_COLOR"
        if is_one_of("glLightModelf", "param", int(param), modes, expected):
            change(context, "lighting", color_control=int(param))


glLightModeli, glLightModeliv = glLightModelf, glLightModelfv


# -- materials ---------------------------------------------------------------------------------------------------------
def _material_context(operation: str, face: int) -> Context | None:
    context = current()
    if context.primitive is not None:
        raise StateError(f"{operation} between glBegin and glEnd is not part of this subset: use glColorMaterial")
    return context if is_one_of(operation, "face", face, FACES, A_FACE) else None


def glMaterialfv(face: int, pname: int, params: Any) -> None:
    """Set a material of one or both facings. What GL_COLOR_MATERIAL follows keeps its colour."""
    context = _material_context("glMaterialfv", face)
    if context is None:
        return
    if pname == gl.GL_SHININESS:
        _set_shininess("glMaterialfv", context, face, float(np.ravel(params)[0]))
    elif pname == gl.GL_AMBIENT_AND_DIFFUSE or pname in MATERIAL_COLORS:
        fields = FOLLOWED[pname]
        _set_material(context, face, dict.fromkeys(fields, _vector(params, 4)), spare_followed=True)
    else:
        wrong_enum("glMaterialfv", "pname", pname, "a material parameter (GL 2.1, table 2.11)")


def glMaterialf(face: int, pname: int, param: float) -> None:
    """Set the shininess, 0 to 128."""
    context = _material_context("glMaterialf", face)
    if context is not None and is_one_of("glMaterialf", "pname", pname, (gl.GL_SHININESS,), "GL_SHININESS"):
        _set_shininess("glMaterialf", context, face, float(param))


glMateriali, glMaterialiv = glMaterialf, glMaterialfv


def _set_shininess(operation: str, context: Context, face: int, value: float) -> None:
    if not 0 <= value <= 128:
        fail(gl.GL_INVALID_VALUE, operation, f"param={value:g}: expected 0 to 128 for GL_SHININESS")
    else:
        _set_material(context, face, {"shininess": _single(value)})


def _set_material(context: Context, face: int, fields: Mapping[str, Any], spare_followed: bool = False) -> None:
    lighting = context.state.lighting
    made: dict[str, Material] = {}
    for name, token in (("front", gl.GL_FRONT), ("back", gl.GL_BACK)):
        if face in (token, gl.GL_FRONT_AND_BACK):
            followed = _followed(lighting, token) if spare_followed else ()
            set_now = {field: value for field, value in fields.items() if field not in followed}
            made[name] = replace(getattr(lighting, name), **set_now)
    change(context, "lighting", **made)


def _followed(lighting: Lighting, face: int) -> tuple[str, ...]:
    """Return the fields of a facing's material that follow the current colour."""
    follows = lighting.color_material and lighting.color_material_face in (face, gl.GL_FRONT_AND_BACK)
    return FOLLOWED[lighting.color_material_mode] if follows else ()


def follow_color(context: Context) -> None:
    """Give the current colour to the materials that GL_COLOR_MATERIAL makes follow it."""
    lighting = context.state.lighting
    color = tuple(_single(c) for c in context.current.color)
    fields = dict.fromkeys(FOLLOWED[lighting.color_material_mode], color)
    _set_material(context, lighting.color_material_face, fields)


def glColorMaterial(face: int, mode: int) -> None:
    """Set which material colours follow the current colour while GL_COLOR_MATERIAL is on."""
    context = outside_begin("glColorMaterial")
    expected = "GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION or GL_AMBIENT_AND_DIFFUSE"
    if context is None or not is_one_of("glColorMaterial", "face", face, FACES, A_FACE):
        return
    if is_one_of("glColorMaterial", "mode", mode, FOLLOWED, expected):
        change(context, "lighting", color_material_face=face, color_material_mode=mode)
        if context.state.lighting.color_material:
            follow_color(context)


def glShadeModel(mode: int) -> None:
    """Set whether colours are interpolated or those of the provoking vertex."""
    context = outside_begin("glShadeModel")
    if context is not None and is_one_of(
        "glShadeModel", "mode", mode, (gl.GL_FLAT, gl.GL_SMOOTH), "GL_FLAT or GL_SMOOTH"
    ):
        change(context, "lighting", shade_model=mode)


# -- fog ---------------------------------------------------------------------------------------------------------------
def glFogf(pname: int, param: float) -> None:
    """Set a fog parameter that is one number."""
    context = outside_begin("glFogf")
    if context is None:
        return
    if pname == gl.GL_FOG_MODE:
        modes = (gl.GL_LINEAR, gl.GL_EXP, gl.GL_EXP2)
        if is_one_of("glFogf", "param", int(param), modes, "GL_LINEAR, GL_EXP or GL_EXP2"):
            change(context, "fog", mode=int(param))
    elif pname == gl.GL_FOG_DENSITY and param < 0:
        fail(gl.GL_INVALID_VALUE, "glFogf", f"param={param:g}: expected 0 or more for GL_FOG_DENSITY")
    elif pname in FOG_NUMBERS:
        change(context, "fog", **{FOG_NUMBERS[pname]: _single(param)})
    else:
        wrong_enum("glFogf", "pname", pname, "a fog parameter that is one number")


def glFogfv(pname: int, params: Any) -> None:
    """Set the fog colour, or another fog parameter from a vector."""
    context = outside_begin("glFogfv")
    if context is None:
        return
    if pname == gl.GL_FOG_COLOR:
        change(context, "fog", color=tuple(clamp01(v) for v in _vector(params, 4)))
    else:
        glFogf(pname, float(np.ravel(params)[0]))


glFogi, glFogiv = glFogf, glFogfv


# -- queries -----------------------------------------------------------------------------------------------------------
def glGetLightfv(light: int, pname: int) -> Any:
    """Return a parameter of a light; position and spot direction in eye space."""
    context = outside_begin("glGetLightfv")
    if context is None or not is_one_of("glGetLightfv", "light", light, LIGHTS, A_LIGHT):
        return None
    standing: Light = context.state.lighting.lights[light - gl.GL_LIGHT0]
    if pname in LIGHT_VECTORS:
        return np.array(getattr(standing, LIGHT_VECTORS[pname]), np.float32)
    if pname in LIGHT_NUMBERS:
        return np.array([getattr(standing, LIGHT_NUMBERS[pname][0])], np.float32)
    return wrong_enum("glGetLightfv", "pname", pname, "a light parameter (GL 2.1, table 2.11)")


def glGetMaterialfv(face: int, pname: int) -> Any:
    """Return a material parameter of one facing."""
    context = outside_begin("glGetMaterialfv")
    faces = {gl.GL_FRONT: "front", gl.GL_BACK: "back"}
    if context is None or not is_one_of("glGetMaterialfv", "face", face, faces, "GL_FRONT or GL_BACK"):
        return None
    material: Material = getattr(context.state.lighting, faces[face])
    if pname == gl.GL_SHININESS:
        return np.array([material.shininess], np.float32)
    if pname in MATERIAL_COLORS:
        return np.array(getattr(material, MATERIAL_COLORS[pname]), np.float32)
    return wrong_enum("glGetMaterialfv", "pname", pname, "a material parameter (GL 2.1, table 2.11)")
