"""Capabilities, the per-fragment state, polygons, viewport and clears: one function per GL call."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.gl.errors import fail, is_one_of, outside_begin, wrong_enum
from softshadow.pipeline.commands import Clear
from softshadow.state import STENCIL_OPS

FUNCTIONS = range(gl.GL_NEVER, gl.GL_ALWAYS + 1)
A_FUNCTION = "GL_NEVER … GL_ALWAYS"
STENCIL_OP_VALUES = {getattr(gl, name) for name in STENCIL_OPS}
FACES = (gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)
A_FACE = "GL_FRONT, GL_BACK or GL_FRONT_AND_BACK"
EQUATIONS = (gl.GL_FUNC_ADD, gl.GL_FUNC_SUBTRACT, gl.GL_FUNC_REVERSE_SUBTRACT, gl.GL_MIN, gl.GL_MAX)
SOURCE_FACTORS = {
    gl.GL_ZERO, gl.GL_ONE, gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR, gl.GL_DST_COLOR, gl.GL_ONE_MINUS_DST_COLOR,
    gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA, gl.GL_DST_ALPHA, gl.GL_ONE_MINUS_DST_ALPHA, gl.GL_CONSTANT_COLOR,
    gl.GL_ONE_MINUS_CONSTANT_COLOR, gl.GL_CONSTANT_ALPHA, gl.GL_ONE_MINUS_CONSTANT_ALPHA, gl.GL_SRC_ALPHA_SATURATE,
}  # fmt: skip
LARGEST_VIEWPORT = 16384
BUFFER_BITS = gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT | gl.GL_ACCUM_BUFFER_BIT

# capability: (group of the state, field)
CAPABILITIES: dict[int, tuple[str, str]] = {
    gl.GL_SCISSOR_TEST: ("scissor", "enabled"),
    gl.GL_ALPHA_TEST: ("alpha", "enabled"),
    gl.GL_STENCIL_TEST: ("stencil", "enabled"),
    gl.GL_DEPTH_TEST: ("depth", "enabled"),
    gl.GL_DEPTH_CLAMP: ("depth", "clamp"),
    gl.GL_CULL_FACE: ("cull", "enabled"),
    gl.GL_POLYGON_OFFSET_FILL: ("polygon", "offset_fill"),
    gl.GL_POLYGON_OFFSET_LINE: ("polygon", "offset_line"),
    gl.GL_POLYGON_OFFSET_POINT: ("polygon", "offset_point"),
    gl.GL_BLEND: ("blend", "enabled"),
    gl.GL_COLOR_LOGIC_OP: ("blend", "logic_enabled"),
    gl.GL_DITHER: ("color", "dither"),
    gl.GL_LIGHTING: ("lighting", "enabled"),
    gl.GL_COLOR_MATERIAL: ("lighting", "color_material"),
    gl.GL_NORMALIZE: ("lighting", "normalize"),
    gl.GL_RESCALE_NORMAL: ("lighting", "rescale_normal"),
    gl.GL_FOG: ("fog", "enabled"),
}
UNIT_CAPABILITIES = {gl.GL_TEXTURE_2D: "enabled_2d", gl.GL_TEXTURE_CUBE_MAP: "enabled_cube"}
GENERATED = (gl.GL_TEXTURE_GEN_S, gl.GL_TEXTURE_GEN_T, gl.GL_TEXTURE_GEN_R, gl.GL_TEXTURE_GEN_Q)
LIGHTS = range(gl.GL_LIGHT0, gl.GL_LIGHT7 + 1)


def change(context: Context, group: str, **fields: Any) -> None:
    """Replace fields of one group of the state."""
    context.set(**{group: replace(getattr(context.state, group), **fields)})


def clamp01(value: float) -> float:
    return min(max(float(value), 0.0), 1.0)


# -- capabilities ------------------------------------------------------------------------------------------------------
def glEnable(cap: int) -> None:
    """Switch a capability on."""
    _switch("glEnable", cap, True)


def glDisable(cap: int) -> None:
    """Switch a capability off."""
    _switch("glDisable", cap, False)


def _switch(operation: str, cap: int, on: bool) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    if cap in CAPABILITIES:
        group, field = CAPABILITIES[cap]
        change(context, group, **{field: on})
        if cap == gl.GL_COLOR_MATERIAL and on:
            from softshadow.gl.lighting import follow_color

            follow_color(context)
    elif cap in LIGHTS:
        lights = list(context.state.lighting.lights)
        lights[cap - gl.GL_LIGHT0] = replace(lights[cap - gl.GL_LIGHT0], enabled=on)
        change(context, "lighting", lights=tuple(lights))
    elif cap in UNIT_CAPABILITIES or cap in GENERATED:
        _switch_unit(context, cap, on)
    else:
        wrong_enum(operation, "cap", cap, "a capability of this subset")


def _switch_unit(context: Context, cap: int, on: bool) -> None:
    units = list(context.state.units)
    unit = units[context.active_unit]
    if cap in UNIT_CAPABILITIES:
        units[context.active_unit] = replace(unit, **{UNIT_CAPABILITIES[cap]: on})  # type: ignore[arg-type]
    else:
        s, t, r, q = (
            replace(gen, enabled=on) if cap == name else gen for name, gen in zip(GENERATED, unit.gen, strict=True)
        )
        units[context.active_unit] = replace(unit, gen=(s, t, r, q))
    context.set(units=tuple(units))


def glIsEnabled(cap: int) -> bool | None:
    """Return whether a capability is on."""
    context = outside_begin("glIsEnabled")
    if context is None:
        return None
    if cap in CAPABILITIES:
        group, field = CAPABILITIES[cap]
        return bool(getattr(getattr(context.state, group), field))
    unit = context.state.units[context.active_unit]
    if cap in UNIT_CAPABILITIES:
        return bool(getattr(unit, UNIT_CAPABILITIES[cap]))
    if cap in GENERATED:
        return unit.gen[GENERATED.index(cap)].enabled
    if cap in LIGHTS:
        return context.state.lighting.lights[cap - gl.GL_LIGHT0].enabled
    wrong_enum("glIsEnabled", "cap", cap, "a capability of this subset")
    return None


# -- depth, alpha, stencil ---------------------------------------------------------------------------------------------
def glDepthFunc(func: int) -> None:
    """Set the comparison of the depth test."""
    context = outside_begin("glDepthFunc")
    if context is not None and is_one_of("glDepthFunc", "func", func, FUNCTIONS, A_FUNCTION):
        change(context, "depth", func=func)


def glDepthMask(flag: Any) -> None:
    """Switch the writing of depth."""
    context = outside_begin("glDepthMask")
    if context is not None:
        change(context, "depth", write=bool(flag))


def glAlphaFunc(func: int, ref: float) -> None:
    """Set comparison and reference (clamped to [0, 1]) of the alpha test."""
    context = outside_begin("glAlphaFunc")
    if context is not None and is_one_of("glAlphaFunc", "func", func, FUNCTIONS, A_FUNCTION):
        change(context, "alpha", func=func, ref=clamp01(ref))


def glStencilFunc(func: int, ref: int, mask: int) -> None:
    """Set the stencil comparison of both facings: (ref & mask) func (stencil & mask)."""
    glStencilFuncSeparate(gl.GL_FRONT_AND_BACK, func, ref, mask, operation="glStencilFunc")


def glStencilFuncSeparate(face: int, func: int, ref: int, mask: int, operation: str = "glStencilFuncSeparate") -> None:
    """Set the stencil comparison of one facing; the reference is clamped to what the buffer holds."""
    if is_one_of(operation, "func", func, FUNCTIONS, A_FUNCTION):
        _set_faces(operation, face, func=func, ref=int(ref), read_mask=int(mask) & 0xFFFFFFFF)


def glStencilOp(fail: int, zfail: int, zpass: int) -> None:
    """Set what happens to the stencil value of both facings: stencil test fails, depth test fails, both pass."""
    _stencil_op("glStencilOp", gl.GL_FRONT_AND_BACK, fail, zfail, zpass)


def glStencilOpSeparate(face: int, sfail: int, dpfail: int, dppass: int) -> None:
    """Set what happens to the stencil value of one facing."""
    _stencil_op("glStencilOpSeparate", face, sfail, dpfail, dppass)


def _stencil_op(operation: str, face: int, sfail: int, zfail: int, zpass: int) -> None:
    for argument, op in (("sfail", sfail), ("zfail", zfail), ("zpass", zpass)):
        if not is_one_of(operation, argument, op, STENCIL_OP_VALUES, ", ".join(STENCIL_OPS)):
            return
    _set_faces(operation, face, sfail=sfail, zfail=zfail, zpass=zpass)


def glStencilMask(mask: int) -> None:
    """Set which stencil bits are written, for both facings."""
    _set_faces("glStencilMask", gl.GL_FRONT_AND_BACK, write_mask=int(mask) & 0xFFFFFFFF)


def glStencilMaskSeparate(face: int, mask: int) -> None:
    """Set which stencil bits are written, for one facing."""
    _set_faces("glStencilMaskSeparate", face, write_mask=int(mask) & 0xFFFFFFFF)


def _set_faces(operation: str, face: int, **fields: int) -> None:
    context = outside_begin(operation)
    if context is None or not is_one_of(operation, "face", face, FACES, A_FACE):
        return
    stencil = context.state.stencil
    if face != gl.GL_BACK:
        stencil = replace(stencil, front=replace(stencil.front, **fields))
    if face != gl.GL_FRONT:
        stencil = replace(stencil, back=replace(stencil.back, **fields))
    context.set(stencil=stencil)


# -- colour ------------------------------------------------------------------------------------------------------------
def glColorMask(red: Any, green: Any, blue: Any, alpha: Any) -> None:
    """Switch the writing of each colour channel."""
    context = outside_begin("glColorMask")
    if context is not None:
        change(context, "color", mask=(bool(red), bool(green), bool(blue), bool(alpha)))


def glBlendFunc(sfactor: int, dfactor: int) -> None:
    """Set the factors of source and destination."""
    _blend_func("glBlendFunc", sfactor, dfactor, sfactor, dfactor)


def glBlendFuncSeparate(src_rgb: int, dst_rgb: int, src_alpha: int, dst_alpha: int) -> None:
    """Set the factors of colour and alpha apart."""
    _blend_func("glBlendFuncSeparate", src_rgb, dst_rgb, src_alpha, dst_alpha)


def _blend_func(operation: str, src_rgb: int, dst_rgb: int, src_alpha: int, dst_alpha: int) -> None:
    context = outside_begin(operation)
    if context is None:
        return
    names = ("sfactorRGB", "dfactorRGB", "sfactorAlpha", "dfactorAlpha")
    for name, value in zip(names, (src_rgb, dst_rgb, src_alpha, dst_alpha), strict=True):
        if not is_one_of(operation, name, value, SOURCE_FACTORS, "a blend factor (GL 2.1, table 4.2)"):
            return
    change(context, "blend", src_rgb=src_rgb, dst_rgb=dst_rgb, src_alpha=src_alpha, dst_alpha=dst_alpha)


def glBlendEquation(mode: int) -> None:
    """Set how source and destination are put together."""
    glBlendEquationSeparate(mode, mode)


def glBlendEquationSeparate(mode_rgb: int, mode_alpha: int) -> None:
    """Set how source and destination are put together, colour and alpha apart."""
    context = outside_begin("glBlendEquation")
    expected = "GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN or GL_MAX"
    for value in (mode_rgb, mode_alpha):
        if not is_one_of("glBlendEquation", "mode", value, EQUATIONS, expected):
            return
    if context is not None:
        change(context, "blend", equation_rgb=mode_rgb, equation_alpha=mode_alpha)


def glBlendColor(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the constant colour of blending."""
    context = outside_begin("glBlendColor")
    if context is not None:
        change(context, "blend", color=(float(red), float(green), float(blue), float(alpha)))


def glLogicOp(opcode: int) -> None:
    """Set the bitwise operation on colours."""
    context = outside_begin("glLogicOp")
    allowed = range(gl.GL_CLEAR, gl.GL_SET + 1)
    if context is not None and is_one_of("glLogicOp", "opcode", opcode, allowed, "GL_CLEAR … GL_SET"):
        change(context, "blend", logic_op=opcode)


# -- polygons and places -----------------------------------------------------------------------------------------------
def glCullFace(mode: int) -> None:
    """Set which facing GL_CULL_FACE removes."""
    context = outside_begin("glCullFace")
    if context is not None and is_one_of("glCullFace", "mode", mode, FACES, A_FACE):
        change(context, "cull", face=mode)


def glFrontFace(mode: int) -> None:
    """Set which winding is front."""
    context = outside_begin("glFrontFace")
    if context is not None and is_one_of("glFrontFace", "mode", mode, (gl.GL_CW, gl.GL_CCW), "GL_CW or GL_CCW"):
        change(context, "cull", front_face=mode)


def glPolygonMode(face: int, mode: int) -> None:
    """Set whether polygons are filled, outlined or dotted."""
    context = outside_begin("glPolygonMode")
    modes = (gl.GL_POINT, gl.GL_LINE, gl.GL_FILL)
    if context is None or not is_one_of("glPolygonMode", "face", face, FACES, A_FACE):
        return
    if is_one_of("glPolygonMode", "mode", mode, modes, "GL_POINT, GL_LINE or GL_FILL"):
        if face != gl.GL_BACK:
            change(context, "polygon", mode_front=mode)
        if face != gl.GL_FRONT:
            change(context, "polygon", mode_back=mode)


def glPolygonOffset(factor: float, units: float) -> None:
    """Set factor (of the slope) and units (of the smallest step) that are added to the depth of polygons."""
    context = outside_begin("glPolygonOffset")
    if context is not None:
        change(context, "polygon", factor=float(factor), units=float(units))


def glLineWidth(width: float) -> None:
    """Set the width of lines in pixels."""
    context = outside_begin("glLineWidth")
    if context is not None:
        if width <= 0:
            fail(gl.GL_INVALID_VALUE, "glLineWidth", f"width={width}: expected more than 0")
        else:
            change(context, "polygon", line_width=float(width))


def glPointSize(size: float) -> None:
    """Set the size of points in pixels."""
    context = outside_begin("glPointSize")
    if context is not None:
        if size <= 0:
            fail(gl.GL_INVALID_VALUE, "glPointSize", f"size={size}: expected more than 0")
        else:
            change(context, "polygon", point_size=float(size))


def glViewport(x: int, y: int, width: int, height: int) -> None:
    """Set where clip space lands in the window, in pixels from the lower left."""
    context = outside_begin("glViewport")
    if context is not None and _box_is_valid("glViewport", width, height):
        width, height = min(int(width), LARGEST_VIEWPORT), min(int(height), LARGEST_VIEWPORT)
        change(context, "viewport", x=int(x), y=int(y), width=width, height=height)


def glScissor(x: int, y: int, width: int, height: int) -> None:
    """Set the scissor box, in pixels from the lower left."""
    context = outside_begin("glScissor")
    if context is not None and _box_is_valid("glScissor", width, height):
        change(context, "scissor", x=int(x), y=int(y), width=int(width), height=int(height))


def _box_is_valid(operation: str, width: int, height: int) -> bool:
    if width < 0 or height < 0:
        fail(gl.GL_INVALID_VALUE, operation, f"width={width}, height={height}: expected 0 or more")
        return False
    return True


def glDepthRange(near: float, far: float) -> None:
    """Set the depths of the near and the far plane, clamped to [0, 1]."""
    context = outside_begin("glDepthRange")
    if context is not None:
        change(context, "viewport", near=clamp01(near), far=clamp01(far))


def glHint(target: int, mode: int) -> None:
    """Accept a hint; hints change nothing here."""
    context = outside_begin("glHint")
    modes = (gl.GL_DONT_CARE, gl.GL_FASTEST, gl.GL_NICEST)
    if context is not None:
        is_one_of("glHint", "mode", mode, modes, "GL_DONT_CARE, GL_FASTEST or GL_NICEST")


# -- clears ------------------------------------------------------------------------------------------------------------
def glClearColor(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the colour that glClear writes."""
    context = outside_begin("glClearColor")
    if context is not None:
        change(context, "color", clear=tuple(float(np.float32(c)) for c in (red, green, blue, alpha)))


def glClearDepth(depth: float) -> None:
    """Set the depth that glClear writes, clamped to [0, 1]."""
    context = outside_begin("glClearDepth")
    if context is not None:
        change(context, "depth", clear=clamp01(depth))


def glClearStencil(s: int) -> None:
    """Set the stencil value that glClear writes."""
    context = outside_begin("glClearStencil")
    if context is not None:
        change(context, "stencil", clear=int(s))


def glClear(mask: int) -> None:
    """Clear buffers: under scissor and write masks, whatever the tests are set to."""
    context = outside_begin("glClear")
    if context is None:
        return
    if mask & ~BUFFER_BITS:
        fail(gl.GL_INVALID_VALUE, "glClear", f"mask=0x{mask:X}: expected buffer bits only")
    else:
        context.execute(Clear(context.state, int(mask)))


def glFlush() -> None:
    """Do nothing: every call has been carried out when it returns."""
    current()


def glFinish() -> None:
    """Do nothing: every call has been carried out when it returns."""
    current()
