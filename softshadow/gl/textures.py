"""Texture objects: names, bindings, sampler parameters and their queries."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, thread
from softshadow.context.state_groups import UNITS
from softshadow.frozen import evolve
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.conversions import clamped_int, enum, first, from_int, to_int, vector
from softshadow.gl.errors import fail, outside_begin
from softshadow.gl.names import generate, names_argument, reserve
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.image import Image
from softshadow.pipeline.commands import AttachTexture, CreateTexture, DeleteTextures, SetSampler
from softshadow.state.texturing import BINDINGS
from softshadow.texture import INITIAL_SAMPLER, Sampler, Texture, initial_sampler, stored_name
from softshadow.tokens import token_name

FACES = tuple(range(gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X, gl.GL_TEXTURE_CUBE_MAP_NEGATIVE_Z + 1))
IMAGE_TARGETS = {  # by dimensions
    0: (gl.GL_TEXTURE_1D, gl.GL_TEXTURE_2D, gl.GL_TEXTURE_RECTANGLE, gl.GL_TEXTURE_3D, *FACES),
    1: (gl.GL_TEXTURE_1D,),
    2: (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_RECTANGLE, *FACES),
    3: (gl.GL_TEXTURE_3D,),
}
EXPECTED_TARGET = "expected GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_RECTANGLE or GL_TEXTURE_CUBE_MAP"

WRAPS = (gl.GL_REPEAT, gl.GL_CLAMP, gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP_TO_BORDER, gl.GL_MIRRORED_REPEAT)
FILTERS = (gl.GL_NEAREST, gl.GL_LINEAR)
MIPMAP_FILTERS = tuple(range(gl.GL_NEAREST_MIPMAP_NEAREST, gl.GL_LINEAR_MIPMAP_LINEAR + 1))
CHOICES: dict[int, tuple[str, tuple[int, ...]]] = {
    gl.GL_TEXTURE_MIN_FILTER: ("min_filter", FILTERS + MIPMAP_FILTERS),
    gl.GL_TEXTURE_MAG_FILTER: ("mag_filter", FILTERS),
    gl.GL_TEXTURE_WRAP_S: ("wrap_s", WRAPS),
    gl.GL_TEXTURE_WRAP_T: ("wrap_t", WRAPS),
    gl.GL_TEXTURE_WRAP_R: ("wrap_r", WRAPS),
    gl.GL_TEXTURE_COMPARE_MODE: ("compare_mode", (gl.GL_NONE, gl.GL_COMPARE_R_TO_TEXTURE)),
    gl.GL_TEXTURE_COMPARE_FUNC: ("compare_func", tuple(range(gl.GL_NEVER, gl.GL_ALWAYS + 1))),
    gl.GL_DEPTH_TEXTURE_MODE: ("depth_mode", (gl.GL_LUMINANCE, gl.GL_INTENSITY, gl.GL_ALPHA, gl.GL_RED)),
    gl.GL_TEXTURE_CUBE_MAP_SEAMLESS: ("seamless", (gl.GL_FALSE, gl.GL_TRUE)),
}
NOT_OF_RECTANGLES = (*MIPMAP_FILTERS, gl.GL_REPEAT, gl.GL_MIRRORED_REPEAT)
LEVELS = {gl.GL_TEXTURE_BASE_LEVEL: "base_level", gl.GL_TEXTURE_MAX_LEVEL: "max_level"}
NUMBERS = {
    gl.GL_TEXTURE_MIN_LOD: "min_lod",
    gl.GL_TEXTURE_MAX_LOD: "max_lod",
    gl.GL_TEXTURE_LOD_BIAS: "lod_bias",
    gl.GL_TEXTURE_PRIORITY: "priority",
    gl.GL_TEXTURE_MAX_ANISOTROPY_EXT: "max_anisotropy",
}
LARGEST_ANISOTROPY = 16.0
BOOLEANS = {gl.GL_GENERATE_MIPMAP: "generate_mipmap"}
FIELDS = {name: field for name, (field, _) in CHOICES.items()} | LEVELS | NUMBERS | BOOLEANS


# -- objects and bindings ----------------------------------------------------------------------------------------------
def glGenTextures(n: int, textures: Any = None) -> Any:
    """Return unused texture names: an int for n = 1, else an array."""
    names = generate("glGenTextures", "texture", n, textures)
    if names is not None:
        thread.context.generated_textures.update(dict.fromkeys(np.ravel(names).tolist(), INITIAL_SAMPLER.priority))
    return names


def glBindTexture(target: int, texture: int) -> None:
    """Bind a texture to the active unit; a new name becomes a texture of this target."""
    context = thread.context
    if not (context.ready or is_allowed(context, glBindTexture, target, texture)):
        return None
    if target not in BINDINGS:
        return fail(gl.GL_INVALID_ENUM, "glBindTexture", f"target={token_name(target)}: {EXPECTED_TARGET}")
    name = int(texture)
    if name:
        texture_object = context.objects.textures.get(name)
        if texture_object is None:
            reserve(context, "texture", name)
            context.execute(CreateTexture(name, target))
            priority = context.generated_textures.get(name, INITIAL_SAMPLER.priority)
            if priority != INITIAL_SAMPLER.priority:
                context.execute(SetSampler(name, evolve(initial_sampler(target), priority=priority)))
        elif texture_object.target != target:
            return fail(
                gl.GL_INVALID_OPERATION,
                "glBindTexture",
                f"texture={name}: expected a {token_name(target)}, it is a {token_name(texture_object.target)}",
            )
    context.change_field(UNITS[context.active_unit], BINDINGS[target], name)
    return None


def glDeleteTextures(*arguments: Any) -> None:
    """Delete textures: (name), (names) or (n, names). They leave all units and are detached from bound framebuffers."""
    if (context := outside_begin("glDeleteTextures")) is None:
        return None
    names = [name for name in names_argument("glDeleteTextures", arguments) if name > 0]
    for framebuffer in {context.state.draw_framebuffer, context.state.read_framebuffer}:
        attachments = context.objects.framebuffers[framebuffer].attachments
        for point, attachment in list(attachments.items()):
            if attachment.texture in names:
                context.execute(AttachTexture(framebuffer, point, 0))
    for index, unit in enumerate(context.state.units):
        unbound = {field: 0 for field in BINDINGS.values() if getattr(unit, field) in names}
        if unbound:
            set_unit(context, index, **unbound)
    for name in names:
        context.generated_textures.pop(name, None)
    existing = tuple(name for name in names if name in context.objects.textures)
    if existing:
        context.execute(DeleteTextures(existing))


def glIsTexture(texture: int) -> bool:
    """Return whether a texture of this name exists; the first glBindTexture creates it."""
    context = outside_begin("glIsTexture")
    return context is not None and texture > 0 and int(texture) in context.objects.textures


def set_unit(context: Context, index: int, **fields: Any) -> None:
    """Replace fields of a texture unit's state."""
    context.change(UNITS[index], **fields)


def object_target(target: int) -> int:
    """Return the target of the texture object: GL_TEXTURE_CUBE_MAP for a face of a cube map."""
    return gl.GL_TEXTURE_CUBE_MAP if target in FACES else target


def bound_name(context: Context, target: int) -> int:
    """Return the key in the storage of the texture bound to a target; the target may be a face of a cube map."""
    target = object_target(target)
    return stored_name(target, int(context.groups[UNITS[context.active_unit]].fields[BINDINGS[target]]))


def bound_texture(context: Context, target: int) -> Texture:
    """Return the texture bound to a target; the default textures, named 0, are created at their first use."""
    name = bound_name(context, target)
    if name not in context.objects.textures:
        context.execute(CreateTexture(name, object_target(target)))
    return context.objects.textures[name]


def face_of(target: int) -> int:
    """Return the index of a cube map's face, 0 for any other target of images."""
    return FACES.index(target) if target in FACES else 0


def image_at(context: Context, target: int, level: int) -> Image | None:
    """Return the image of a level of the bound texture, or None if it is not defined."""
    texture = context.objects.textures.get(bound_name(context, target))
    return texture.images.get((face_of(target), level)) if texture is not None else None


def target_problem(target: int) -> tuple[int, str] | None:
    """Return (error code, message) if a target of textures is wrong, else None."""
    if target in BINDINGS:
        return None
    return gl.GL_INVALID_ENUM, f"target={token_name(target)}: {EXPECTED_TARGET}"


def image_target_problem(target: int, dimensions: int = 0) -> tuple[int, str] | None:
    """Return (error code, message) if a target of images is wrong, else None; 0 dimensions are any number."""
    allowed = IMAGE_TARGETS[dimensions]
    if target in allowed:
        return None
    expected = ", ".join(token_name(each) for each in allowed if each not in FACES)
    expected += " or a face of GL_TEXTURE_CUBE_MAP" if FACES[0] in allowed else ""
    return gl.GL_INVALID_ENUM, f"target={token_name(target)}: expected {expected}"


# -- parameters --------------------------------------------------------------------------------------------------------
def glTexParameteri(target: int, pname: int, param: int) -> None:
    """Set one parameter of the bound texture."""
    context = thread.context
    try:
        hypot(param)  # the quickest question whether this is a number
        if context.ready or is_allowed(context, glTexParameteri, target, pname, param):
            _set_parameter(context, "glTexParameteri", target, pname, param)
    except CONVERTING as error:
        raise refusal(glTexParameteri, error, target, pname, param) from error


@in_lists
def glTexParameterf(target: int, pname: int, param: float) -> None:
    """Set one parameter of the bound texture."""
    _set_parameter(outside_begin("glTexParameterf"), "glTexParameterf", target, pname, param)


@in_lists
def glTexParameterfv(target: int, pname: int, params: Any) -> None:
    """Set a parameter of the bound texture; GL_TEXTURE_BORDER_COLOR takes four floats."""
    if pname == gl.GL_TEXTURE_BORDER_COLOR:
        _set_border("glTexParameterfv", target, vector(params, 4))
    else:
        _set_parameter(outside_begin("glTexParameterfv"), "glTexParameterfv", target, pname, first(params))


@in_lists
def glTexParameteriv(target: int, pname: int, params: Any) -> None:
    """Set a parameter of the bound texture; in GL_TEXTURE_BORDER_COLOR, 2**31 - 1 represents 1."""
    if pname == gl.GL_TEXTURE_BORDER_COLOR:
        _set_border("glTexParameteriv", target, vector(params, 4, from_int))
    else:
        _set_parameter(outside_begin("glTexParameteriv"), "glTexParameteriv", target, pname, first(params, int))


def _set_border(operation: str, target: int, color: Sequence[float]) -> None:
    if (context := outside_begin(operation)) is None:
        return None
    if problem := target_problem(target):
        return fail(problem[0], operation, problem[1])
    _set_sampler(context, target, "border_color", tuple(np.array(color, np.float32).tolist()))
    return None


def _set_parameter(context: Context | None, operation: str, target: int, pname: int, value: Any) -> None:
    if context is None:  # between glBegin and glEnd
        return None
    if problem := target_problem(target):
        return fail(problem[0], operation, problem[1])
    if pname in CHOICES:
        (field, choices), chosen = CHOICES[pname], value if type(value) is int else enum(value)
        if target == gl.GL_TEXTURE_RECTANGLE:
            choices = tuple(choice for choice in choices if choice not in NOT_OF_RECTANGLES)
        if chosen not in choices:
            expected = ", ".join(token_name(c) for c in choices)
            return fail(
                gl.GL_INVALID_ENUM,
                operation,
                f"{token_name(pname)}={token_name(chosen)}: expected one of {expected}",
            )
        _set_sampler(context, target, field, chosen)
    elif pname in LEVELS:
        level = clamped_int(value)
        if level < 0:
            return fail(gl.GL_INVALID_VALUE, operation, f"{token_name(pname)}={value}: expected 0 or more")
        if target == gl.GL_TEXTURE_RECTANGLE and level not in (0, getattr(sampler_of(context, target), LEVELS[pname])):
            code = gl.GL_INVALID_OPERATION if pname == gl.GL_TEXTURE_BASE_LEVEL else gl.GL_INVALID_VALUE
            reason = f"{token_name(pname)}={level}: expected 0, since a rectangle has only one level"
            return fail(code, operation, reason)
        _set_sampler(context, target, LEVELS[pname], level)
    elif pname in BOOLEANS:
        _set_sampler(context, target, BOOLEANS[pname], bool(clamped_int(value)))
    elif pname in NUMBERS:
        number = float(np.float32(value))
        if pname == gl.GL_TEXTURE_MAX_ANISOTROPY_EXT:
            if number < 1:
                return fail(gl.GL_INVALID_VALUE, operation, f"{token_name(pname)}={value}: expected 1 or more")
            number = number if number < LARGEST_ANISOTROPY else LARGEST_ANISOTROPY  # also instead of NaN
        elif pname == gl.GL_TEXTURE_PRIORITY:
            number = clamped_priority(number)
        _set_sampler(context, target, NUMBERS[pname], number)
    else:
        return fail(gl.GL_INVALID_ENUM, operation, f"pname={token_name(pname)}: expected a texture parameter")
    return None


def clamped_priority(value: float) -> float:
    """Return a priority in [0, 1], single precision; 1 for NaN, as Mesa's comparisons give."""
    number = float(np.float32(value))
    return 0.0 if number < 0 else number if number < 1 else 1.0


def note_defined(context: Context, texture: Texture, level: int, depths_copied: bool) -> None:
    """Set what depths of a texture are looked up as, after an image was defined; see `Sampler.looked_up_as`."""
    before = texture.sampler
    ignores = depths_copied and (before.ignores_depth_mode or level == before.base_level)
    if ignores != before.ignores_depth_mode:
        context.execute(SetSampler(texture.name, evolve(before, ignores_depth_mode=ignores)))


def _set_sampler(context: Context, target: int, field: str, value: Any) -> None:
    texture = bound_texture(context, target)
    before = texture.sampler
    if getattr(before, field) == value:
        return
    changed = evolve(before, **{field: value})
    if field in ("depth_mode", "base_level"):
        changed = evolve(changed, ignores_depth_mode=False)
    context.touched |= gl.GL_TEXTURE_BIT
    context.execute(SetSampler(texture.name, changed))


# -- queries -----------------------------------------------------------------------------------------------------------
def glGetTexParameterfv(target: int, pname: int, params: Any = None) -> Any:
    """Return a parameter of the bound texture: a float, or 4 float32 for GL_TEXTURE_BORDER_COLOR."""
    return _parameter("glGetTexParameterfv", target, pname, params, np.float32)


def glGetTexParameteriv(target: int, pname: int, params: Any = None) -> Any:
    """Return a parameter of the bound texture: an int, or 4 int32 for GL_TEXTURE_BORDER_COLOR."""
    return _parameter("glGetTexParameteriv", target, pname, params, np.int32)


def sampler_of(context: Context, target: int) -> Sampler:
    """Return the sampler parameters of the bound texture."""
    known = context.objects.textures.get(bound_name(context, target))
    return known.sampler if known is not None else initial_sampler(target)


def queried_color(context: Context, color: tuple[float, ...]) -> np.ndarray:
    """Return a texture colour as queries return it: clamped (NaN to 0), unless the colour buffer is float."""
    target = context.objects.framebuffers[context.state.draw_framebuffer].first_color
    values = np.array(color, np.float32)
    return values if target is not None and target.format.kind == "float" else np.fmax(values, np.float32(0)).clip(0, 1)


def _parameter(operation: str, target: int, pname: int, params: Any, dtype: type[np.generic]) -> Any:
    if (context := outside_begin(operation)) is None:
        return None
    if problem := target_problem(target):
        return fail(problem[0], operation, problem[1])
    sampler = sampler_of(context, target)
    if pname == gl.GL_TEXTURE_BORDER_COLOR:
        color = queried_color(context, sampler.border_color)
        answer = color if dtype == np.float32 else (color.astype(np.float64) * 2147483647.0).astype(np.int32)
    elif pname == gl.GL_TEXTURE_RESIDENT:
        answer = np.array([1], dtype)
    elif pname in FIELDS:
        value = getattr(sampler, FIELDS[pname])
        if pname == gl.GL_TEXTURE_PRIORITY and dtype == np.int32:
            value = to_int(value)
        answer = np.array([value], np.float32) if dtype == np.float32 else np.array([clamped_int(value)], np.int32)
    else:
        return fail(gl.GL_INVALID_ENUM, operation, f"pname={token_name(pname)}: expected a texture parameter")
    if params is not None:
        np.asarray(params)[: len(answer)] = answer
    return answer if len(answer) > 1 else answer[0].item()


__all__ = spelled_like_gl(globals())
