"""Materials, and material colours that follow glColor."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current, thread
from softshadow.context.current_values import MATERIALS
from softshadow.gl.calls import in_lists, is_allowed, record, spelled_like_gl
from softshadow.gl.conversions import as_floats, as_ints, first, from_int, nearest_int, to_int, vector
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.fragment_state import A_FACE, FACES, rounded, rounded_number
from softshadow.gl.vertex_format import carry_attribute

# parameter: fields of the material
FIELDS: dict[int, tuple[str, ...]] = {
    gl.GL_AMBIENT: ("ambient",),
    gl.GL_DIFFUSE: ("diffuse",),
    gl.GL_SPECULAR: ("specular",),
    gl.GL_EMISSION: ("emission",),
    gl.GL_AMBIENT_AND_DIFFUSE: ("ambient", "diffuse"),
}
PARAMETERS = {**FIELDS, gl.GL_SHININESS: ("shininess",)}
A_COLOR = "GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION or GL_AMBIENT_AND_DIFFUSE"
SIDES = {gl.GL_FRONT: ("front",), gl.GL_BACK: ("back",), gl.GL_FRONT_AND_BACK: ("front", "back")}
NAMES = {  # of the attributes, by side and field
    side: {field: f"{side}.{field}" for fields in PARAMETERS.values() for field in fields}
    for side in SIDES[gl.GL_FRONT_AND_BACK]
}
LARGEST_SHININESS = 128
# by face, what glMaterialf changes: groups of the state, and names of the attributes
SHININESS = {face: [(MATERIALS[side], NAMES[side]["shininess"]) for side in sides] for face, sides in SIDES.items()}


@in_lists
def glMaterialfv(face: int, pname: int, params: Any) -> None:
    """Set a material parameter of one or both faces; allowed between glBegin and glEnd.

    Colours that follow glColor because of GL_COLOR_MATERIAL do not change.
    """
    context = _context_if_valid("glMaterialfv", face, pname)
    if context is None:
        return
    if pname == gl.GL_SHININESS:
        _set_shininess("glMaterialfv", context, face, first(params))
    else:
        set_material(context, face, dict.fromkeys(FIELDS[pname], rounded(context, *vector(params, 4))))


@in_lists
def glMaterialiv(face: int, pname: int, params: Any) -> None:
    """Set a material parameter from integers; colours use the full range of int."""
    context = _context_if_valid("glMaterialiv", face, pname)
    if context is None:
        return
    if pname == gl.GL_SHININESS:
        _set_shininess("glMaterialiv", context, face, first(params, int))
    else:
        set_material(context, face, dict.fromkeys(FIELDS[pname], tuple(vector(params, 4, from_int))))


def _context_if_valid(operation: str, face: int, pname: int) -> Context | None:
    context = current()
    if not is_one_of(operation, "face", face, FACES, A_FACE):
        return None
    return context if is_one_of(operation, "pname", pname, PARAMETERS, f"GL_SHININESS, {A_COLOR}") else None


def glMaterialf(face: int, pname: int, param: float) -> None:
    """Set the shininess, 0 to 128."""
    context = thread.context
    if context.compiled_list is not None:
        record(context, glMaterialf, face, pname, param)
    elif pname == gl.GL_SHININESS and face in SIDES and 0 <= param <= LARGEST_SHININESS:
        value, old_values, buffer = rounded_number(context, param), context.pending.old_values, context.vertex_buffer
        if context.primitive is not None:
            set_material(context, face, {"shininess": value})
            return
        for group, name in SHININESS[face]:  # `set_material` in half the time: no shininess follows a colour
            if not (name in old_values and buffer.sizes.get(name) == buffer.active_sizes.get(name) == 1):
                carry_attribute(context, name, 1)
            material = context.groups[group]
            material.fields["shininess"] = value
            context.changed.add(material)
    elif is_one_of("glMaterialf", "pname", pname, (gl.GL_SHININESS,), "GL_SHININESS") and is_one_of(
        "glMaterialf", "face", face, FACES, A_FACE
    ):
        _set_shininess("glMaterialf", context, face, param)


glMateriali = glMaterialf


def _set_shininess(operation: str, context: Context, face: int, value: float) -> None:
    if 0 <= value <= LARGEST_SHININESS:
        set_material(context, face, {"shininess": rounded_number(context, value)})
    else:
        fail(gl.GL_INVALID_VALUE, operation, f"param={value:g}: expected 0 to 128 for GL_SHININESS")


def set_material(context: Context, face: int, fields: Mapping[str, Any]) -> None:
    """Set fields of the material of one or both faces, except those that follow glColor.

    Between glBegin and glEnd they become attributes of the vertices.
    """
    follows, primitive = context.groups["lighting"].fields["color_material"], context.primitive
    buffer, old_values = context.vertex_buffer, context.pending.old_values
    sizes, active_sizes = buffer.sizes, buffer.active_sizes
    for side in SIDES[face]:
        free, names = fields, NAMES[side]
        if follows:
            fixed = followed(context, side)
            free = {field: value for field, value in fields.items() if field not in fixed}
        for field, value in free.items():
            name, size = names[field], len(value) if type(value) is tuple else 1
            if not (sizes.get(name) == active_sizes.get(name) == size and name in old_values):
                carry_attribute(context, name, size)  # which does nothing else
            if primitive is not None:
                primitive.materials |= {name}
                primitive.change(name, context.attribute(name), value)
            context.set_material(side, field, value)


UNLISTED_MATERIAL = inspect.unwrap(glMaterialfv)  # as display lists keep it


def material_values(call: Any) -> list[tuple[str, tuple[float, ...]]]:
    """Return names and values of what a call in a display list sets, if it is glMaterialfv and sets colours."""
    if getattr(call, "func", None) is not UNLISTED_MATERIAL:
        return []
    face, pname, params = call.args
    is_known = isinstance(face, int) and face in SIDES and isinstance(pname, int) and pname in FIELDS
    numbers = np.array(params)
    if not is_known or numbers.shape != (4,) or numbers.dtype.kind not in "fiu":
        return []
    color = tuple(numbers.astype(np.float64).tolist())
    return [(NAMES[side][field], color) for side in SIDES[face] for field in FIELDS[pname]]


# -- colours that follow glColor ---------------------------------------------------------------------------------------
def glColorMaterial(face: int, mode: int) -> None:
    """Set which material colours follow glColor while GL_COLOR_MATERIAL is enabled."""
    context = thread.context
    if not (context.ready or is_allowed(context, glColorMaterial, face, mode)):
        return
    if not (face in SIDES or is_one_of("glColorMaterial", "face", face, FACES, A_FACE)):
        return
    if mode in FIELDS or is_one_of("glColorMaterial", "mode", mode, FIELDS, A_COLOR):
        lighting = context.groups["lighting"].fields
        if face == lighting["color_material_face"] and mode == lighting["color_material_mode"]:
            return
        if not context.pending.has_vertices:
            context.stop_following()  # a colour that is not yet current sets the materials of the new mode only
        context.change_fields("lighting", {"color_material_face": int(face), "color_material_mode": int(mode)})
        start_to_follow(context)


def followed(context: Context, side: str) -> tuple[str, ...]:
    """Return the fields of the "front" or "back" material that follow glColor."""
    lighting = context.groups["lighting"].fields
    if lighting["color_material"] and side in SIDES[lighting["color_material_face"]]:
        return FIELDS[lighting["color_material_mode"]]
    return ()


def follow_color(context: Context) -> None:
    """Copy the current colour to the material fields that follow it, if it is another one than Mesa's current one."""
    lighting = context.groups["lighting"].fields
    if lighting["color_material"]:
        color = context.current.color
        if context.pending.old_values.get("color", color) != color:
            context.follow(SIDES[lighting["color_material_face"]], FIELDS[lighting["color_material_mode"]])
        else:
            context.stop_following()


def start_to_follow(context: Context) -> None:
    """Copy the current colour to the materials that begin to follow it.

    A pending material is only hidden by it: Mesa makes it current again with the next flush (vbo_exec_copy_to_current).
    """
    lighting = context.groups["lighting"].fields
    if lighting["color_material"]:
        if context.pending.has_vertices:
            context.reset_attributes()
        context.update_current()
        hidden = {name: context.attribute(name) for name in context.pending.names if "." in name}
        context.follow(SIDES[lighting["color_material_face"]], FIELDS[lighting["color_material_mode"]])
        context.pending.hidden, context.pending.before_following = hidden | context.pending.hidden, None


# -- queries -----------------------------------------------------------------------------------------------------------
def glGetMaterialfv(face: int, pname: int) -> Any:
    """Return a material parameter of one face: 4 float32, or a float for GL_SHININESS."""
    return as_floats(_material("glGetMaterialfv", face, pname))


def glGetMaterialiv(face: int, pname: int) -> Any:
    """Return a material parameter of one face as integers; colours use the full range of int."""
    return as_ints(_material("glGetMaterialiv", face, pname), nearest_int if pname == gl.GL_SHININESS else to_int)


def _material(operation: str, face: int, pname: int) -> Any:
    context = outside_begin(operation)
    faces = (gl.GL_FRONT, gl.GL_BACK)
    if context is None or not is_one_of(operation, "face", face, faces, "GL_FRONT or GL_BACK"):
        return None
    context.flush()
    context.update_current()
    readable = [name for name, fields in PARAMETERS.items() if len(fields) == 1]
    if not is_one_of(operation, "pname", pname, readable, "a material parameter (GL 2.1, table 2.11)"):
        return None
    return getattr(getattr(context.state.lighting, SIDES[face][0]), PARAMETERS[pname][0])


__all__ = spelled_like_gl(globals())
