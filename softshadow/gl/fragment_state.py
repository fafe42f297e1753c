"""Calls that set the fragment operations: alpha, stencil and depth test, blending, logic operation, masks."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from ctypes import c_float, c_int
from functools import lru_cache
from itertools import product
from math import hypot
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, thread
from softshadow.gl.calls import in_lists, is_allowed, spelled_like_gl
from softshadow.gl.conversions import (
    LARGEST_INT,
    PACK_PAIR,
    PACK_SINGLE,
    SINGLES,
    SMALLEST_INT,
    UNPACK_PAIR,
    UNPACK_SINGLE,
)
from softshadow.gl.errors import is_one_of, outside_begin
from softshadow.gl.refusals import CONVERTING, refusal
from softshadow.state import STENCIL_OPS, Stencil

# allowed values and what is stored: the same numbers as int
FUNCTIONS = {func: func for func in range(gl.GL_NEVER, gl.GL_ALWAYS + 1)}
A_FUNCTION = "GL_NEVER … GL_ALWAYS"
STENCIL_OP_VALUES = {getattr(gl, name): getattr(gl, name) for name in STENCIL_OPS}
FACES = (gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK)
FRONT, BACKS = "stencil.front", ("stencil.back", "stencil.other_back")  # GL 2.0's back state, without and with two_side
BOTH_FACES = tuple((FRONT, back) for back in BACKS)
A_FACE = "GL_FRONT, GL_BACK or GL_FRONT_AND_BACK"
EQUATIONS = {equation: equation for equation in (
    gl.GL_FUNC_ADD, gl.GL_FUNC_SUBTRACT, gl.GL_FUNC_REVERSE_SUBTRACT, gl.GL_MIN, gl.GL_MAX,
)}  # fmt: skip
AN_EQUATION = "GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN or GL_MAX"
FACTORS = {factor: factor for factor in (
    gl.GL_ZERO, gl.GL_ONE, gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR, gl.GL_DST_COLOR, gl.GL_ONE_MINUS_DST_COLOR,
    gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA, gl.GL_DST_ALPHA, gl.GL_ONE_MINUS_DST_ALPHA, gl.GL_CONSTANT_COLOR,
    gl.GL_ONE_MINUS_CONSTANT_COLOR, gl.GL_CONSTANT_ALPHA, gl.GL_ONE_MINUS_CONSTANT_ALPHA, gl.GL_SRC_ALPHA_SATURATE,
)}  # fmt: skip
A_FACTOR = "a blend factor (GL 2.1, table 4.2)"
UNSIGNED = 0xFFFFFFFF  # masks are unsigned: -1 sets all bits
MASKS = {mask: mask for mask in product((False, True), repeat=4)}  # so that equal masks are the same object
LOGIC_OPS = range(gl.GL_CLEAR, gl.GL_SET + 1)
F32 = np.float32


def clamp01(value: float) -> float:
    number = float(value)
    if number > 0.0:
        return number if number < 1.0 else 1.0
    return 0.0  # also for NaN, as in Mesa


def rounded_number(context: Context, value: float) -> float:
    """Return a number rounded to the context's precision."""
    if context.real is not F32:
        return float(value)
    try:
        number: float = UNPACK_SINGLE(PACK_SINGLE(value))[0]
    except struct.error:  # not a number, which ctypes says better
        return c_float(value).value
    return number


def rounded_pair(context: Context, one: float, other: float) -> tuple[float, float]:
    """Return two numbers rounded to the context's precision."""
    if context.real is not F32:
        return float(one), float(other)
    try:
        pair: tuple[float, float] = UNPACK_PAIR(PACK_PAIR(one, other))
    except struct.error:  # not a number, which ctypes says better
        return c_float(one).value, c_float(other).value
    return pair


def rounded(context: Context, *values: float) -> Any:
    """Return numbers rounded to the context's precision."""
    if context.real is not F32:
        return tuple(map(float, values))
    pack, unpack = SINGLES[len(values)]
    try:
        return unpack(pack(*values))
    except struct.error:  # not a number, which ctypes says better
        return tuple(c_float(value).value for value in values)


# -- depth and alpha test ----------------------------------------------------------------------------------------------
def glDepthFunc(func: int) -> None:
    """Set the comparison of the depth test."""
    context = thread.context
    if not (context.ready or is_allowed(context, glDepthFunc, func)):
        return
    if func in FUNCTIONS or is_one_of("glDepthFunc", "func", func, FUNCTIONS, A_FUNCTION):
        context.change_field("depth", "func", FUNCTIONS[func])


def glDepthMask(flag: Any) -> None:
    """Enable or disable depth writes."""
    context = thread.context
    if context.ready or is_allowed(context, glDepthMask, flag):
        context.change_field("depth", "write", bool(flag))


def glAlphaFunc(func: int, ref: float) -> None:
    """Set comparison and reference of the alpha test; the test clamps the reference to [0, 1]."""
    context = thread.context
    if not (context.ready or is_allowed(context, glAlphaFunc, func, ref)):
        return
    if func in FUNCTIONS or is_one_of("glAlphaFunc", "func", func, FUNCTIONS, A_FUNCTION):
        context.change_fields("alpha", {"func": FUNCTIONS[func], "ref": rounded_number(context, ref)})


# -- stencil test ------------------------------------------------------------------------------------------------------
def glStencilFunc(func: int, ref: int, mask: int) -> None:
    """Set the stencil comparison of both facings: (ref & mask) func (stencil & mask)."""
    context = thread.context
    try:
        hypot(ref, mask)  # the quickest question whether these are numbers
        if context.ready or is_allowed(context, glStencilFunc, func, ref, mask):
            faces = _active_faces(context)
            if not (context.ready and func in FUNCTIONS and type(ref) is type(mask) is int):
                _stencil_func(context, "glStencilFunc", faces, func, ref, mask)
                return
            fields = _fields_of_func(func, ref, mask)
            for name in faces:  # `_stencil_func` in three quarters of the time
                face = context.groups[name]
                face.fields.update(fields)
                context.changed.add(face)
    except CONVERTING as error:
        raise refusal(glStencilFunc, error, func, ref, mask) from error


def glStencilFuncSeparate(face: int, func: int, ref: int, mask: int) -> None:
    """Set the stencil comparison of one facing; the test clamps the reference to the range of the buffer."""
    context = thread.context
    if context.ready or is_allowed(context, glStencilFuncSeparate, face, func, ref, mask):
        faces = _faces(context, "glStencilFuncSeparate", face)
        _stencil_func(context, "glStencilFuncSeparate", faces, func, ref, mask)


def _stencil_func(context: Context, operation: str, faces: tuple[str, ...], func: int, ref: int, mask: int) -> None:
    if func in FUNCTIONS or is_one_of(operation, "func", func, FUNCTIONS, A_FUNCTION):
        try:
            fields = _fields_of_func(func, ref, mask)
        except TypeError:  # an array of one number, which cannot be remembered
            fields = _fields_of_func(func, int(ref), int(mask))
        context.change_groups(faces, fields)


@lru_cache(maxsize=256)
def _fields_of_func(func: int, ref: int, mask: int) -> Mapping[str, int]:
    ref = int(ref)
    if not SMALLEST_INT <= ref <= LARGEST_INT:
        ref = c_int(ref).value
    return {"func": FUNCTIONS[func], "ref": ref, "read_mask": int(mask) & UNSIGNED}


def glStencilOp(fail: int, zfail: int, zpass: int) -> None:
    """Set the stencil operations of both facings: stencil test fails, depth test fails, both pass."""
    context = thread.context
    if context.ready or is_allowed(context, glStencilOp, fail, zfail, zpass):
        values, faces = STENCIL_OP_VALUES, _active_faces(context)
        if not (context.ready and fail in values and zfail in values and zpass in values):
            _stencil_op(context, "glStencilOp", faces, fail, zfail, zpass)
            return
        for name in faces:  # `_stencil_op` in three quarters of the time
            face = context.groups[name]
            fields = face.fields
            fields["sfail"], fields["zfail"], fields["zpass"] = values[fail], values[zfail], values[zpass]
            context.changed.add(face)


def glStencilOpSeparate(face: int, sfail: int, dpfail: int, dppass: int) -> None:
    """Set the stencil operations of one facing."""
    context = thread.context
    if context.ready or is_allowed(context, glStencilOpSeparate, face, sfail, dpfail, dppass):
        faces = _faces(context, "glStencilOpSeparate", face)
        _stencil_op(context, "glStencilOpSeparate", faces, sfail, dpfail, dppass)


def _stencil_op(context: Context, operation: str, faces: tuple[str, ...], sfail: int, zfail: int, zpass: int) -> None:
    if not (sfail in STENCIL_OP_VALUES and zfail in STENCIL_OP_VALUES and zpass in STENCIL_OP_VALUES):
        for argument, op in (("sfail", sfail), ("zfail", zfail), ("zpass", zpass)):
            if not is_one_of(operation, argument, op, STENCIL_OP_VALUES, ", ".join(STENCIL_OPS)):
                return
    values = STENCIL_OP_VALUES
    context.change_groups(faces, {"sfail": values[sfail], "zfail": values[zfail], "zpass": values[zpass]})


def glStencilMask(mask: int) -> None:
    """Set the stencil write mask of both facings."""
    context = thread.context
    if context.ready or is_allowed(context, glStencilMask, mask):
        faces, value = _active_faces(context), int(mask) & UNSIGNED
        if not context.ready:
            context.change_groups(faces, {"write_mask": value})
            return
        for name in faces:  # the same in two thirds of the time
            face = context.groups[name]
            face.fields["write_mask"] = value
            context.changed.add(face)


def glStencilMaskSeparate(face: int, mask: int) -> None:
    """Set the stencil write mask of one facing."""
    context = thread.context
    if context.ready or is_allowed(context, glStencilMaskSeparate, face, mask):
        faces = _faces(context, "glStencilMaskSeparate", face)
        context.change_groups(faces, {"write_mask": int(mask) & UNSIGNED})


def _active_faces(context: Context) -> tuple[str, ...]:
    """Return the groups of the state that a call without a face sets, see glActiveStencilFaceEXT."""
    stencil = context.groups["stencil"].fields
    two_side = stencil["two_side"]
    return (BACKS[not two_side],) if stencil["active_back"] else BOTH_FACES[two_side]


def _faces(context: Context, operation: str, face: int) -> tuple[str, ...]:
    """Return the groups of the state that a call with a face sets; none after an error."""
    two_side = context.groups["stencil"].fields["two_side"]
    if not is_one_of(operation, "face", face, FACES, A_FACE):
        return ()
    return (
        BOTH_FACES[two_side] if face == gl.GL_FRONT_AND_BACK else (FRONT if face == gl.GL_FRONT else BACKS[two_side],)
    )


def extension_back(stencil: Stencil) -> str:
    """Return the name of the field with the back state of GL_EXT_stencil_two_side."""
    return "back" if stencil.two_side else "other_back"


def core_back(stencil: Stencil) -> str:
    """Return the name of the field with GL 2.0's back state."""
    return "other_back" if stencil.two_side else "back"


# -- two-sided stencil before GL 2.0 -----------------------------------------------------------------------------------
@in_lists
def glActiveStencilFaceEXT(face: int) -> None:
    """Choose whether glStencilFunc, glStencilOp and glStencilMask set the front or the extension's back state.

    The extension's back state is in use while GL_STENCIL_TEST_TWO_SIDE_EXT is enabled.
    """
    context, faces = outside_begin("glActiveStencilFaceEXT"), (gl.GL_FRONT, gl.GL_BACK)
    if context is not None and is_one_of("glActiveStencilFaceEXT", "face", face, faces, "GL_FRONT or GL_BACK"):
        context.change("stencil", active_back=face == gl.GL_BACK)


@in_lists
def glStencilFuncSeparateATI(frontfunc: int, backfunc: int, ref: int, mask: int) -> None:
    """Set the stencil comparison of each facing, with one reference and one mask for both."""
    context, operation = outside_begin("glStencilFuncSeparateATI"), "glStencilFuncSeparateATI"
    if context is None or not is_one_of(operation, "frontfunc", frontfunc, FUNCTIONS, A_FUNCTION):
        return
    if is_one_of(operation, "backfunc", backfunc, FUNCTIONS, A_FUNCTION):
        _stencil_func(context, operation, _faces(context, operation, gl.GL_FRONT), frontfunc, ref, mask)
        _stencil_func(context, operation, _faces(context, operation, gl.GL_BACK), backfunc, ref, mask)


glStencilOpSeparateATI = glStencilOpSeparate


# -- colour ------------------------------------------------------------------------------------------------------------
def glColorMask(red: Any, green: Any, blue: Any, alpha: Any) -> None:
    """Enable or disable writes to each colour channel."""
    context = thread.context
    if context.ready or is_allowed(context, glColorMask, red, green, blue, alpha):
        context.change_field("color", "mask", MASKS[bool(red), bool(green), bool(blue), bool(alpha)])


def glBlendFunc(sfactor: int, dfactor: int) -> None:
    """Set the blend factors of source and destination."""
    context = thread.context
    if not (context.ready or is_allowed(context, glBlendFunc, sfactor, dfactor)):
        return
    if sfactor in FACTORS and dfactor in FACTORS:
        source, target = FACTORS[sfactor], FACTORS[dfactor]
        fields = {"src_rgb": source, "dst_rgb": target, "src_alpha": source, "dst_alpha": target}
        context.change_fields("blend", fields)
    else:
        _blend_func(context, "glBlendFunc", sfactor, dfactor, sfactor, dfactor)


def glBlendFuncSeparate(
    sfactorRGB: int,
    dfactorRGB: int,
    sfactorAlpha: int,
    dfactorAlpha: int,
) -> None:
    """Set the blend factors separately for colour and alpha."""
    context = thread.context
    if context.ready or is_allowed(context, glBlendFuncSeparate, sfactorRGB, dfactorRGB, sfactorAlpha, dfactorAlpha):
        _blend_func(context, "glBlendFuncSeparate", sfactorRGB, dfactorRGB, sfactorAlpha, dfactorAlpha)


def _blend_func(
    context: Context, operation: str, src_rgb: int, dst_rgb: int, src_alpha: int, dst_alpha: int
) -> None:  # fmt: skip
    if not (src_rgb in FACTORS and dst_rgb in FACTORS and src_alpha in FACTORS and dst_alpha in FACTORS):
        names = ("sfactorRGB", "dfactorRGB", "sfactorAlpha", "dfactorAlpha")
        for name, value in zip(names, (src_rgb, dst_rgb, src_alpha, dst_alpha), strict=True):
            if not is_one_of(operation, name, value, FACTORS, A_FACTOR):
                return
    context.change(
        "blend", src_rgb=int(src_rgb), dst_rgb=int(dst_rgb), src_alpha=int(src_alpha), dst_alpha=int(dst_alpha)
    )


def glBlendEquation(mode: int) -> None:
    """Set the blend equation."""
    context = thread.context
    if not (context.ready or is_allowed(context, glBlendEquation, mode)):
        return
    if mode in EQUATIONS or is_one_of("glBlendEquation", "mode", mode, EQUATIONS, AN_EQUATION):
        context.change_fields("blend", {"equation_rgb": EQUATIONS[mode], "equation_alpha": EQUATIONS[mode]})


def glBlendEquationSeparate(modeRGB: int, modeAlpha: int) -> None:
    """Set the blend equation separately for colour and alpha."""
    context = thread.context
    if not (context.ready or is_allowed(context, glBlendEquationSeparate, modeRGB, modeAlpha)):
        return
    for name, value in (("modeRGB", modeRGB), ("modeAlpha", modeAlpha)):
        if not is_one_of("glBlendEquationSeparate", name, value, EQUATIONS, AN_EQUATION):
            return
    context.change_fields("blend", {"equation_rgb": EQUATIONS[modeRGB], "equation_alpha": EQUATIONS[modeAlpha]})


def glBlendColor(red: float, green: float, blue: float, alpha: float) -> None:
    """Set the constant blend colour."""
    context = thread.context
    if context.ready or is_allowed(context, glBlendColor, red, green, blue, alpha):
        context.change_field("blend", "color", rounded(context, red, green, blue, alpha))


def glLogicOp(opcode: int) -> None:
    """Set the bitwise operation of GL_COLOR_LOGIC_OP."""
    context = thread.context
    if not (context.ready or is_allowed(context, glLogicOp, opcode)):
        return
    if is_one_of("glLogicOp", "opcode", opcode, LOGIC_OPS, "GL_CLEAR … GL_SET"):
        context.change_field("blend", "logic_op", int(opcode))


__all__ = spelled_like_gl(globals())
