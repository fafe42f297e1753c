"""The state variables of glGet, each with the function that reads it (GL 2.1, sec. 6.2)."""

from __future__ import annotations

from collections.abc import Callable
from ctypes import c_int
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.compression import FOR_ANY_IMAGE
from softshadow.context import MATRIX_STACK_DEPTHS, Context, MatrixStack
from softshadow.context.render_mode import MOST_NAMES
from softshadow.framebuffer import DEFAULT, DRAW_BUFFERS, LARGEST_SIDE, Framebuffer
from softshadow.gl.attributes import DEEPEST_ATTRIBUTES
from softshadow.gl.capabilities import CLIP_PLANES, HINTS, LIGHTS, MAPS
from softshadow.gl.fragment_state import core_back, extension_back
from softshadow.gl.framebuffers import COLOR_ATTACHMENTS
from softshadow.gl.lists import DEEPEST_LIST
from softshadow.gl.pixel_transfer import queries as transfer_queries
from softshadow.gl.rasterization import LARGEST_VIEWPORT
from softshadow.gl.texture_problems import LARGEST_3D
from softshadow.gl.textures import LARGEST_ANISOTROPY
from softshadow.gl.vertex_arrays import ARRAYS
from softshadow.image import Image
from softshadow.pixel_store import PixelStore
from softshadow.state import TEXTURE_UNITS, StencilFace

Read = Callable[[Context], Any]
SIZES = (1.0, 255.0)  # of lines and points


def drawn_to(c: Context) -> Framebuffer:
    """Return the framebuffer that draws go to."""
    return c.objects.framebuffers[c.state.draw_framebuffer]


def read_from(c: Context) -> Framebuffer:
    """Return the framebuffer that pixels are read from."""
    return c.objects.framebuffers[c.state.read_framebuffer]


def bits(image: Image | None) -> int:
    """Return the number of bits of a depth or stencil buffer; for float depth, of its dtype."""
    if image is None:
        return 0
    return image.format.largest.bit_length() or np.dtype(image.format.dtype).itemsize * 8


def color_bits(channel: int) -> Read:
    """Return the reader of the number of bits of a channel of the first colour buffer."""

    def read(c: Context) -> int:
        image = drawn_to(c).first_color
        if image is None or not image.format.written[channel]:
            return 0
        return np.dtype(image.format.dtype).itemsize * 8

    return read


def draw_buffers() -> dict[str, Read]:
    """Return the readers of GL_DRAW_BUFFERi by name."""

    def reader(index: int) -> Read:
        return lambda c: drawn_to(c).draw_buffer_at(index)

    return {f"GL_DRAW_BUFFER{index}": reader(index) for index in range(DRAW_BUFFERS)}


def accumulation_bits(c: Context) -> int:
    """Return the number of bits per channel of the accumulation buffer; only the window has one."""
    return 16 if c.state.draw_framebuffer == DEFAULT else 0


def clamped_color(color: Callable[[Context], Any]) -> Read:
    """Return the reader of a colour that glGet clamps."""
    return lambda c: clamped(c, *color(c))


def clamped(c: Context, *values: float) -> tuple[float, ...]:
    """Return values clamped to [0, 1] if the draw framebuffer `clamps`, else unchanged; NaN is clamped to 0."""
    return tuple(min(max(0.0, v), 1.0) for v in values) if drawn_to(c).clamps else values


def stencil(prefix: str, face: Callable[[Context], StencilFace]) -> dict[str, Read]:
    """Return the readers of one face; the reference is clamped to the range of the buffer."""

    def ref(c: Context) -> int:
        buffer = drawn_to(c).stencil
        return max(0, min(face(c).ref, buffer.format.largest if buffer else 0))

    return {
        f"GL_STENCIL_{prefix}FUNC": lambda c: face(c).func,
        f"GL_STENCIL_{prefix}REF": ref,
        f"GL_STENCIL_{prefix}VALUE_MASK": lambda c: face(c).read_mask,
        f"GL_STENCIL_{prefix}FAIL": lambda c: face(c).sfail,
        f"GL_STENCIL_{prefix}PASS_DEPTH_FAIL": lambda c: face(c).zfail,
        f"GL_STENCIL_{prefix}PASS_DEPTH_PASS": lambda c: face(c).zpass,
        f"GL_STENCIL_{prefix}WRITEMASK": lambda c: face(c).write_mask,
    }


def active_face(c: Context) -> StencilFace:
    """Return the stencil state that glStencilFunc sets."""
    state = c.state.stencil
    face: StencilFace = getattr(state, extension_back(state)) if state.active_back else state.front
    return face


def matrix(name: str, stack: Callable[[Context], MatrixStack]) -> dict[str, Read]:
    """Return the readers of a matrix stack; a matrix is (4, 4) in GL's memory order, column after column."""
    return {
        f"GL_{name}_MATRIX": lambda c: stack(c)[-1].T,
        f"GL_TRANSPOSE_{name}_MATRIX": lambda c: stack(c)[-1],
        f"GL_{name}_STACK_DEPTH": lambda c: len(stack(c)),
        f"GL_MAX_{name}_STACK_DEPTH": lambda c: MATRIX_STACK_DEPTHS[getattr(gl, f"GL_{name}")],
    }


def client_array(name: str, token: int) -> dict[str, Read]:
    """Return the readers of a vertex array; texture coordinates are those of the client's active unit."""

    def key(c: Context) -> str:
        return ARRAYS.get(token, f"texcoord{c.arrays.active_unit}")

    readers: dict[str, Read] = {
        f"GL_{name}_ARRAY": lambda c: key(c) in c.arrays.enabled,
        f"GL_{name}_ARRAY_TYPE": lambda c: c.arrays.layout(key(c)).type,
        f"GL_{name}_ARRAY_STRIDE": lambda c: c.arrays.layout(key(c)).stride,
        f"GL_{name}_ARRAY_BUFFER_BINDING": lambda c: c.arrays.offsets.get(key(c), (0, 0))[0],
    }
    if name not in ("NORMAL", "INDEX"):
        readers[f"GL_{name}_ARRAY_SIZE"] = lambda c: c.arrays.layout(key(c)).size
    return readers


def pixel_store(name: str, store: Callable[[Context], PixelStore]) -> dict[str, Read]:
    """Return the readers of GL_PACK_* or GL_UNPACK_* by name."""
    return {
        f"GL_{name}_ALIGNMENT": lambda c: store(c).alignment,
        f"GL_{name}_ROW_LENGTH": lambda c: store(c).row_length,
        f"GL_{name}_SKIP_ROWS": lambda c: store(c).skip_rows,
        f"GL_{name}_SKIP_PIXELS": lambda c: store(c).skip_pixels,
        f"GL_PIXEL_{name}_BUFFER_BINDING": lambda c: store(c).buffer,
        f"GL_{name}_IMAGE_HEIGHT": lambda c: store(c).image_height,
        f"GL_{name}_SKIP_IMAGES": lambda c: store(c).skip_images,
        f"GL_{name}_SWAP_BYTES": lambda c: store(c).swap_bytes,
        f"GL_{name}_LSB_FIRST": lambda c: store(c).lsb_first,
    }


QUERIES: dict[str, Read] = {
    "GL_VIEWPORT": lambda c: (c.state.viewport.x, c.state.viewport.y, c.state.viewport.width, c.state.viewport.height),
    "GL_DEPTH_RANGE": lambda c: (c.state.viewport.near, c.state.viewport.far),
    "GL_SCISSOR_BOX": lambda c: (c.state.scissor.x, c.state.scissor.y, c.state.scissor.width, c.state.scissor.height),
    "GL_ALPHA_TEST_FUNC": lambda c: c.state.alpha.func,
    "GL_ALPHA_TEST_REF": lambda c: clamped(c, c.state.alpha.ref)[0],
    **stencil("", active_face),
    **stencil("BACK_", lambda c: getattr(c.state.stencil, core_back(c.state.stencil))),
    "GL_ACTIVE_STENCIL_FACE_EXT": lambda c: gl.GL_BACK if c.state.stencil.active_back else gl.GL_FRONT,
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
    "GL_LINE_STIPPLE_PATTERN": lambda c: c.state.lines.pattern,
    "GL_LINE_STIPPLE_REPEAT": lambda c: c.state.lines.factor,
    "GL_POINT_SIZE_MIN": lambda c: c.state.points.smallest,
    "GL_POINT_SIZE_MAX": lambda c: c.state.points.largest,
    "GL_POINT_FADE_THRESHOLD_SIZE": lambda c: c.state.points.fade_threshold,
    "GL_POINT_DISTANCE_ATTENUATION": lambda c: c.state.points.attenuation,
    "GL_POINT_SPRITE_COORD_ORIGIN": lambda c: c.state.points.origin,
    "GL_BLEND_SRC": lambda c: c.state.blend.src_rgb,
    "GL_BLEND_DST": lambda c: c.state.blend.dst_rgb,
    "GL_BLEND_SRC_RGB": lambda c: c.state.blend.src_rgb,
    "GL_BLEND_DST_RGB": lambda c: c.state.blend.dst_rgb,
    "GL_BLEND_SRC_ALPHA": lambda c: c.state.blend.src_alpha,
    "GL_BLEND_DST_ALPHA": lambda c: c.state.blend.dst_alpha,
    "GL_BLEND_EQUATION_RGB": lambda c: c.state.blend.equation_rgb,
    "GL_BLEND_EQUATION_ALPHA": lambda c: c.state.blend.equation_alpha,
    "GL_BLEND_COLOR": clamped_color(lambda c: c.state.blend.color),
    "GL_LOGIC_OP_MODE": lambda c: c.state.blend.logic_op,
    "GL_COLOR_WRITEMASK": lambda c: c.state.color.mask,
    "GL_COLOR_CLEAR_VALUE": clamped_color(lambda c: c.state.color.clear),
    "GL_ACCUM_CLEAR_VALUE": lambda c: c.state.color.clear_accum,
    "GL_PROVOKING_VERTEX": lambda c: c.state.lighting.provoking_vertex,
    "GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION": lambda c: False,
    "GL_EDGE_FLAG": lambda c: c.current.edge,
    "GL_CURRENT_INDEX": lambda c: c.current.index,
    "GL_INDEX_CLEAR_VALUE": lambda c: c_int(c.color_indices.clear).value,
    "GL_INDEX_WRITEMASK": lambda c: c_int(c.color_indices.write_mask).value,
    "GL_INDEX_LOGIC_OP": lambda c: c.color_indices.logic_enabled,
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
    "GL_FOG_COLOR": clamped_color(lambda c: c.state.fog.color),
    "GL_FOG_COORD_SRC": lambda c: c.state.fog.source,
    "GL_MATRIX_MODE": lambda c: c.matrix_mode,
    **matrix("MODELVIEW", lambda c: c.modelview_stack),
    **matrix("PROJECTION", lambda c: c.projection_stack),
    **matrix("TEXTURE", lambda c: c.texture_stacks[c.active_unit]),
    "GL_CURRENT_COLOR": lambda c: c.current.color,
    "GL_CURRENT_NORMAL": lambda c: c.current.normal,
    "GL_CURRENT_TEXTURE_COORDS": lambda c: c.current.texcoords[c.active_unit],
    "GL_CURRENT_SECONDARY_COLOR": lambda c: c.current.secondary,
    "GL_CURRENT_FOG_COORD": lambda c: c.current.fog_coordinate,
    "GL_CURRENT_RASTER_POSITION": lambda c: c.current.raster.window,
    "GL_CURRENT_RASTER_POSITION_VALID": lambda c: c.current.raster.valid,
    "GL_CURRENT_RASTER_DISTANCE": lambda c: c.current.raster.distance,
    "GL_CURRENT_RASTER_COLOR": lambda c: c.current.raster.color,
    "GL_CURRENT_RASTER_SECONDARY_COLOR": lambda c: c.current.raster.secondary,
    "GL_CURRENT_RASTER_TEXTURE_COORDS": lambda c: c.current.raster.texcoords[c.active_unit],
    "GL_ZOOM_X": lambda c: c.pixel_zoom[0],
    "GL_ZOOM_Y": lambda c: c.pixel_zoom[1],
    "GL_ACTIVE_TEXTURE": lambda c: gl.GL_TEXTURE0 + c.active_unit,
    "GL_CLIENT_ACTIVE_TEXTURE": lambda c: gl.GL_TEXTURE0 + c.arrays.active_unit,
    **client_array("VERTEX", gl.GL_VERTEX_ARRAY),
    **client_array("NORMAL", gl.GL_NORMAL_ARRAY),
    **client_array("COLOR", gl.GL_COLOR_ARRAY),
    **client_array("TEXTURE_COORD", gl.GL_TEXTURE_COORD_ARRAY),
    **client_array("EDGE_FLAG", gl.GL_EDGE_FLAG_ARRAY),
    **client_array("SECONDARY_COLOR", gl.GL_SECONDARY_COLOR_ARRAY),
    **client_array("FOG_COORD", gl.GL_FOG_COORD_ARRAY),
    **client_array("INDEX", gl.GL_INDEX_ARRAY),
    "GL_ARRAY_BUFFER_BINDING": lambda c: c.arrays.array_buffer,
    "GL_ELEMENT_ARRAY_BUFFER_BINDING": lambda c: c.arrays.element_buffer,
    "GL_CLIENT_ATTRIB_STACK_DEPTH": lambda c: len(c.client_stack),
    "GL_TEXTURE_BINDING_1D": lambda c: c.state.units[c.active_unit].bound_1d,
    "GL_TEXTURE_BINDING_2D": lambda c: c.state.units[c.active_unit].bound_2d,
    "GL_TEXTURE_BINDING_3D": lambda c: c.state.units[c.active_unit].bound_3d,
    "GL_TEXTURE_BINDING_RECTANGLE": lambda c: c.state.units[c.active_unit].bound_rectangle,
    "GL_TEXTURE_BINDING_CUBE_MAP": lambda c: c.state.units[c.active_unit].bound_cube,
    "GL_DRAW_FRAMEBUFFER_BINDING": lambda c: c.state.draw_framebuffer,
    "GL_READ_FRAMEBUFFER_BINDING": lambda c: c.state.read_framebuffer,
    "GL_RENDERBUFFER_BINDING": lambda c: c.renderbuffer,
    "GL_DRAW_BUFFER": lambda c: drawn_to(c).draw_buffer_at(0),
    **draw_buffers(),
    "GL_DOUBLEBUFFER": lambda c: False,
    "GL_READ_BUFFER": lambda c: read_from(c).read_buffer,
    "GL_CURRENT_PROGRAM": lambda c: c.state.program,
    **pixel_store("PACK", lambda c: c.pack_store),
    **pixel_store("UNPACK", lambda c: c.unpack_store),
    "GL_ATTRIB_STACK_DEPTH": lambda c: len(c.attribute_stack),
    "GL_DEBUG_GROUP_STACK_DEPTH": lambda c: len(c.labels) + 1,
    "GL_LIST_BASE": lambda c: c.list_base,
    "GL_LIST_INDEX": lambda c: c.compiled_list.name if c.compiled_list else 0,
    "GL_LIST_MODE": lambda c: c.compiled_list.mode if c.compiled_list else 0,
    # limits and properties of this implementation
    "GL_RED_BITS": color_bits(0),
    "GL_GREEN_BITS": color_bits(1),
    "GL_BLUE_BITS": color_bits(2),
    "GL_ALPHA_BITS": color_bits(3),
    "GL_DEPTH_BITS": lambda c: bits(drawn_to(c).depth),
    "GL_STENCIL_BITS": lambda c: bits(drawn_to(c).stencil),
    **{f"GL_ACCUM_{name}_BITS": accumulation_bits for name in ("RED", "GREEN", "BLUE", "ALPHA")},
    "GL_MAX_EVAL_ORDER": lambda c: 30,
    "GL_MAP1_GRID_SEGMENTS": lambda c: c.evaluators.grid1[0],
    "GL_MAP1_GRID_DOMAIN": lambda c: c.evaluators.grid1[1:],
    "GL_MAP2_GRID_SEGMENTS": lambda c: tuple(grid[0] for grid in c.evaluators.grid2),
    "GL_MAP2_GRID_DOMAIN": lambda c: (*c.evaluators.grid2[0][1:], *c.evaluators.grid2[1][1:]),
    "GL_RENDER_MODE": lambda c: c.render_mode.mode,
    "GL_NAME_STACK_DEPTH": lambda c: len(c.render_mode.selection.names),
    "GL_MAX_NAME_STACK_DEPTH": lambda c: MOST_NAMES,
    "GL_SELECTION_BUFFER_SIZE": lambda c: c.render_mode.selection.size,
    "GL_FEEDBACK_BUFFER_SIZE": lambda c: c.render_mode.feedback.size,
    "GL_FEEDBACK_BUFFER_TYPE": lambda c: c.render_mode.feedback.kind,
    "GL_RGBA_MODE": lambda c: True,
    "GL_INDEX_MODE": lambda c: False,
    "GL_INDEX_BITS": lambda c: 0,
    "GL_CURRENT_RASTER_INDEX": lambda c: 1,
    "GL_STEREO": lambda c: False,
    "GL_SAMPLE_COVERAGE_VALUE": lambda c: c.state.color.coverage_value,
    "GL_SAMPLE_COVERAGE_INVERT": lambda c: c.state.color.coverage_inverted,
    "GL_SAMPLES": lambda c: 0,
    "GL_SAMPLE_BUFFERS": lambda c: 0,
    "GL_SUBPIXEL_BITS": lambda c: 8,
    "GL_MAX_TEXTURE_UNITS": lambda c: TEXTURE_UNITS,
    "GL_MAX_TEXTURE_SIZE": lambda c: LARGEST_SIDE,
    "GL_MAX_TEXTURE_LOD_BIAS": lambda c: 16.0,  # Mesa's answer; larger values work, too
    "GL_MAX_TEXTURE_COORDS": lambda c: TEXTURE_UNITS,
    "GL_MAX_TEXTURE_IMAGE_UNITS": lambda c: TEXTURE_UNITS,
    "GL_MAX_CUBE_MAP_TEXTURE_SIZE": lambda c: LARGEST_SIDE,
    "GL_MAX_RECTANGLE_TEXTURE_SIZE": lambda c: LARGEST_SIDE,
    "GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT": lambda c: LARGEST_ANISOTROPY,
    "GL_MAX_3D_TEXTURE_SIZE": lambda c: LARGEST_3D,
    "GL_NUM_COMPRESSED_TEXTURE_FORMATS": lambda c: len(FOR_ANY_IMAGE),
    "GL_COMPRESSED_TEXTURE_FORMATS": lambda c: FOR_ANY_IMAGE,
    "GL_MAX_DRAW_BUFFERS": lambda c: DRAW_BUFFERS,
    "GL_MAX_COLOR_ATTACHMENTS": lambda c: len(COLOR_ATTACHMENTS),
    "GL_MAX_RENDERBUFFER_SIZE": lambda c: LARGEST_SIDE,
    "GL_MAX_VIEWPORT_DIMS": lambda c: (LARGEST_VIEWPORT, LARGEST_VIEWPORT),
    "GL_MAX_LIGHTS": lambda c: len(LIGHTS),
    "GL_MAX_CLIP_PLANES": lambda c: len(CLIP_PLANES),
    "GL_MAX_ATTRIB_STACK_DEPTH": lambda c: DEEPEST_ATTRIBUTES,
    "GL_MAX_LIST_NESTING": lambda c: DEEPEST_LIST,
    "GL_MAX_ELEMENTS_VERTICES": lambda c: 3000,  # Mesa's answer; more are drawn as fast
    "GL_MAX_ELEMENTS_INDICES": lambda c: 3000,
    "GL_AUX_BUFFERS": lambda c: 0,
    "GL_LINE_WIDTH_RANGE": lambda c: SIZES,
    "GL_POINT_SIZE_RANGE": lambda c: SIZES,
    "GL_LINE_WIDTH_GRANULARITY": lambda c: 0.1,
    "GL_POINT_SIZE_GRANULARITY": lambda c: 0.1,
    "GL_ALIASED_LINE_WIDTH_RANGE": lambda c: SIZES,
    "GL_ALIASED_POINT_SIZE_RANGE": lambda c: SIZES,
}
BY_TOKEN: dict[int, Read] = {getattr(gl, name): read for name, read in QUERIES.items() if hasattr(gl, name)}
BY_TOKEN |= {cap: (lambda c, cap=cap: cap in c.evaluators.enabled) for cap in MAPS}
BY_TOKEN |= transfer_queries()
BY_TOKEN |= {hint: (lambda c, hint=hint: c.hints.get(hint, gl.GL_DONT_CARE)) for hint in HINTS}  # type: ignore[misc]
# colours, normals, depths and matrices: as an integer, 1.0 is the largest int (GL 2.1, sec. 6.1.2)
NORMALIZED = {
    getattr(gl, name)
    for name in (
        "GL_DEPTH_RANGE", "GL_DEPTH_CLEAR_VALUE", "GL_COLOR_CLEAR_VALUE", "GL_ACCUM_CLEAR_VALUE", "GL_CURRENT_COLOR",
        "GL_CURRENT_NORMAL", "GL_BLEND_COLOR", "GL_FOG_COLOR", "GL_LIGHT_MODEL_AMBIENT", "GL_ALPHA_TEST_REF",
        "GL_CURRENT_RASTER_COLOR", "GL_CURRENT_SECONDARY_COLOR", "GL_CURRENT_RASTER_SECONDARY_COLOR",
        "GL_MODELVIEW_MATRIX", "GL_PROJECTION_MATRIX", "GL_TEXTURE_MATRIX",
        "GL_TRANSPOSE_MODELVIEW_MATRIX", "GL_TRANSPOSE_PROJECTION_MATRIX", "GL_TRANSPOSE_TEXTURE_MATRIX",
    )
    if hasattr(gl, name)
}  # fmt: skip
