"""glGet: every state that can be set can be read back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import MATRIX_STACK_DEPTHS, Context
from softshadow.gl.capabilities import CAPABILITIES, GENERATED, LIGHTS, UNIT_CAPABILITIES, glIsEnabled
from softshadow.gl.errors import outside_begin, wrong_enum
from softshadow.gl.rasterization import LARGEST_VIEWPORT
from softshadow.image import Image
from softshadow.state import TEXTURE_UNITS, StencilFace

STRINGS = {
    gl.GL_VENDOR: b"softshadow",
    gl.GL_RENDERER: b"softshadow software rasterizer",
    gl.GL_VERSION: b"2.1 softshadow",
    gl.GL_EXTENSIONS: b"GL_ARB_depth_clamp GL_ARB_depth_texture GL_ARB_framebuffer_object GL_ARB_shadow GL_KHR_debug",
}


def glGetString(name: int) -> bytes | None:
    """Return a string about this implementation."""
    if name in STRINGS:
        return STRINGS[name]
    wrong_enum("glGetString", "name", name, "GL_VENDOR, GL_RENDERER, GL_VERSION or GL_EXTENSIONS")
    return None


def _bits(image: Image | None) -> int:
    """Bits of a depth or stencil plane: of float depth, those it is stored in."""
    if image is None:
        return 0
    return image.format.largest.bit_length() or image.format.dtype(0).itemsize * 8


def _column_major(matrix: np.ndarray) -> np.ndarray:
    """A matrix in GL's memory order, as (4, 4)."""
    return np.ascontiguousarray(matrix.T)


def _face(prefix: str, face: Callable[[Context], StencilFace]) -> dict[str, Callable[[Context], Any]]:
    """The queries of one facing; the reference as the buffer clamps it."""

    def ref(c: Context) -> int:
        stencil = c.storage.framebuffers[c.state.draw_framebuffer].stencil
        return max(0, min(face(c).ref, stencil.format.largest if stencil else 255))

    return {
        f"GL_STENCIL_{prefix}FUNC": lambda c: face(c).func,
        f"GL_STENCIL_{prefix}REF": ref,
        f"GL_STENCIL_{prefix}VALUE_MASK": lambda c: face(c).read_mask,
        f"GL_STENCIL_{prefix}FAIL": lambda c: face(c).sfail,
        f"GL_STENCIL_{prefix}PASS_DEPTH_FAIL": lambda c: face(c).zfail,
        f"GL_STENCIL_{prefix}PASS_DEPTH_PASS": lambda c: face(c).zpass,
        f"GL_STENCIL_{prefix}WRITEMASK": lambda c: face(c).write_mask,
    }


QUERIES: dict[str, Callable[[Context], Any]] = {
    "GL_VIEWPORT": lambda c: (c.state.viewport.x, c.state.viewport.y, c.state.viewport.width, c.state.viewport.height),
    "GL_DEPTH_RANGE": lambda c: (c.state.viewport.near, c.state.viewport.far),
    "GL_SCISSOR_BOX": lambda c: (c.state.scissor.x, c.state.scissor.y, c.state.scissor.width, c.state.scissor.height),
    "GL_ALPHA_TEST_FUNC": lambda c: c.state.alpha.func,
    "GL_ALPHA_TEST_REF": lambda c: c.state.alpha.ref,
    **_face("", lambda c: c.state.stencil.front),
    **_face("BACK_", lambda c: c.state.stencil.back),
    "GL_STENCIL_CLEAR_VALUE": lambda c: c.state.stencil.clear,
    "GL_DEPTH_FUNC": lambda c: c.state.depth.func,
    "GL_DEPTH_WRITEMASK": lambda c: c.state.depth.write,
    "GL_DEPTH_CLEAR_VALUE": lambda c: c.state.depth.clear,
    "GL_CULL_FACE_MODE": lambda c: c.state.cull.face,
    "GL_FRONT_FACE": lambda c: c.state.cull.front_face,
    "GL_POLYGON_MODE": lambda c: (c.state.polygon.mode_front, c.state.polygon.mode_back),
    "GL_POLYGON_OFFSET_FACTOR": lambda c: c.state.polygon.factor,
    "GL_POLYGON_OFFSET_UNITS": lambda c: c.state.polygon.units,
    "GL_LINE_WIDTH": lambda c: c.state.polygon.line_width,
    "GL_POINT_SIZE": lambda c: c.state.polygon.point_size,
    "GL_BLEND_SRC": lambda c: c.state.blend.src_rgb,
    "GL_BLEND_DST": lambda c: c.state.blend.dst_rgb,
    "GL_BLEND_SRC_RGB": lambda c: c.state.blend.src_rgb,
    "GL_BLEND_DST_RGB": lambda c: c.state.blend.dst_rgb,
    "GL_BLEND_SRC_ALPHA": lambda c: c.state.blend.src_alpha,
    "GL_BLEND_DST_ALPHA": lambda c: c.state.blend.dst_alpha,
    "GL_BLEND_EQUATION_RGB": lambda c: c.state.blend.equation_rgb,
    "GL_BLEND_EQUATION_ALPHA": lambda c: c.state.blend.equation_alpha,
    "GL_BLEND_COLOR": lambda c: c.state.blend.color,
    "GL_LOGIC_OP_MODE": lambda c: c.state.blend.logic_op,
    "GL_COLOR_WRITEMASK": lambda c: c.state.color.mask,
    "GL_COLOR_CLEAR_VALUE": lambda c: c.state.color.clear,
    "GL_SHADE_MODEL": lambda c: c.state.lighting.shade_model,
    "GL_LIGHT_MODEL_AMBIENT": lambda c: c.state.lighting.model_ambient,
    "GL_LIGHT_MODEL_LOCAL_VIEWER": lambda c: c.state.lighting.local_viewer,
    "GL_LIGHT_MODEL_TWO_SIDE": lambda c: c.state.lighting.two_side,
    "GL_LIGHT_MODEL_COLOR_CONTROL": lambda c: c.state.lighting.color_control,
    "GL_COLOR_MATERIAL_FACE": lambda c: c.state.lighting.color_material_face,
    "GL_COLOR_MATERIAL_PARAMETER": lambda c: c.state.lighting.color_material_mode,
    "GL_FOG_MODE": lambda c: c.state.fog.mode,
    "GL_FOG_DENSITY": lambda c: c.state.fog.density,
    "GL_FOG_START": lambda c: c.state.fog.start,
    "GL_FOG_END": lambda c: c.state.fog.end,
    "GL_FOG_COLOR": lambda c: c.state.fog.color,
    "GL_MATRIX_MODE": lambda c: c.matrix_mode,
    "GL_MODELVIEW_MATRIX": lambda c: _column_major(c.modelview_stack[-1]),
    "GL_PROJECTION_MATRIX": lambda c: _column_major(c.projection_stack[-1]),
    "GL_TEXTURE_MATRIX": lambda c: _column_major(c.texture_stacks[c.active_unit][-1]),
    "GL_MODELVIEW_STACK_DEPTH": lambda c: len(c.modelview_stack),
    "GL_PROJECTION_STACK_DEPTH": lambda c: len(c.projection_stack),
    "GL_TEXTURE_STACK_DEPTH": lambda c: len(c.texture_stacks[c.active_unit]),
    "GL_MAX_MODELVIEW_STACK_DEPTH": lambda c: MATRIX_STACK_DEPTHS[gl.GL_MODELVIEW],
    "GL_MAX_PROJECTION_STACK_DEPTH": lambda c: MATRIX_STACK_DEPTHS[gl.GL_PROJECTION],
    "GL_MAX_TEXTURE_STACK_DEPTH": lambda c: MATRIX_STACK_DEPTHS[gl.GL_TEXTURE],
    "GL_CURRENT_COLOR": lambda c: c.current.color,
    "GL_CURRENT_NORMAL": lambda c: c.current.normal,
    "GL_CURRENT_TEXTURE_COORDS": lambda c: c.current.texcoords[c.active_unit],
    "GL_ACTIVE_TEXTURE": lambda c: gl.GL_TEXTURE0 + c.active_unit,
    "GL_CLIENT_ACTIVE_TEXTURE": lambda c: gl.GL_TEXTURE0 + c.arrays.active_unit,
    "GL_TEXTURE_BINDING_2D": lambda c: c.state.units[c.active_unit].bound_2d,
    "GL_TEXTURE_BINDING_CUBE_MAP": lambda c: c.state.units[c.active_unit].bound_cube,
    "GL_MAX_TEXTURE_UNITS": lambda c: TEXTURE_UNITS,
    "GL_MAX_TEXTURE_SIZE": lambda c: LARGEST_VIEWPORT,
    "GL_MAX_VIEWPORT_DIMS": lambda c: (LARGEST_VIEWPORT, LARGEST_VIEWPORT),
    "GL_MAX_LIGHTS": lambda c: len(LIGHTS),
    "GL_SUBPIXEL_BITS": lambda c: 8,
    "GL_DRAW_FRAMEBUFFER_BINDING": lambda c: c.state.draw_framebuffer,
    "GL_READ_FRAMEBUFFER_BINDING": lambda c: c.state.read_framebuffer,
    "GL_DRAW_BUFFER": lambda c: c.storage.framebuffers[c.state.draw_framebuffer].draw_buffer,
    "GL_READ_BUFFER": lambda c: c.storage.framebuffers[c.state.read_framebuffer].read_buffer,
    "GL_CURRENT_PROGRAM": lambda c: c.state.program,
    "GL_RED_BITS": lambda c: 8,
    "GL_GREEN_BITS": lambda c: 8,
    "GL_BLUE_BITS": lambda c: 8,
    "GL_ALPHA_BITS": lambda c: 8,
    "GL_DEPTH_BITS": lambda c: _bits(c.storage.framebuffers[c.state.draw_framebuffer].depth),
    "GL_STENCIL_BITS": lambda c: _bits(c.storage.framebuffers[c.state.draw_framebuffer].stencil),
    "GL_PACK_ALIGNMENT": lambda c: c.pack_store.alignment,
    "GL_UNPACK_ALIGNMENT": lambda c: c.unpack_store.alignment,
}
BY_TOKEN = {getattr(gl, name): read for name, read in QUERIES.items()}
# state that is a colour or a depth in 0..1: as an integer it spans the whole range (GL 2.1, sec. 6.1.2)
NORMALISED = {
    getattr(gl, name)
    for name in (
        "GL_DEPTH_RANGE", "GL_DEPTH_CLEAR_VALUE", "GL_COLOR_CLEAR_VALUE", "GL_CURRENT_COLOR", "GL_CURRENT_NORMAL",
        "GL_BLEND_COLOR", "GL_FOG_COLOR", "GL_LIGHT_MODEL_AMBIENT", "GL_ALPHA_TEST_REF",
    )
}  # fmt: skip
LARGEST_INT = 2**31 - 1


def _read(operation: str, pname: int) -> Any:
    context = outside_begin(operation)
    if context is None:
        return None
    if pname in BY_TOKEN:
        return BY_TOKEN[pname](context)
    if pname in CAPABILITIES or pname in UNIT_CAPABILITIES or pname in GENERATED or pname in LIGHTS:
        return glIsEnabled(pname)
    return wrong_enum(operation, "pname", pname, "a state of this subset")


def glGetFloatv(pname: int) -> Any:
    """Return state as float32: a number, or an array; matrices as (4, 4) in GL's memory order."""
    value = _read("glGetFloatv", pname)
    if value is None:
        return None
    return np.array(value, np.float32) if isinstance(value, tuple | np.ndarray) else float(np.float32(value))


def glGetDoublev(pname: int) -> Any:
    """Return state as float64: a number, or an array; matrices as (4, 4) in GL's memory order."""
    value = _read("glGetDoublev", pname)
    if value is None:
        return None
    return np.array(value, np.float64) if isinstance(value, tuple | np.ndarray) else float(value)


def glGetIntegerv(pname: int) -> Any:
    """Return state as integers: a number, or an array int32. Colours and depths in 0..1 span the range of an int."""
    value = _read("glGetIntegerv", pname)
    if value is None:
        return None
    if pname in NORMALISED:
        scaled = np.rint(np.clip(np.asarray(value, np.float64), -1, 1) * LARGEST_INT)
        return scaled.astype(np.int32) if scaled.ndim else int(scaled)
    if isinstance(value, tuple | np.ndarray):
        return np.rint(np.asarray(value, np.float64)).astype(np.int32)
    return int(np.int64(round(value)).astype(np.int32)) if not isinstance(value, bool) else int(value)


def glGetBooleanv(pname: int) -> Any:
    """Return state as truth: whether it is not 0."""
    value = _read("glGetBooleanv", pname)
    if value is None:
        return None
    return np.array(value, bool) if isinstance(value, tuple | np.ndarray) else bool(value)
