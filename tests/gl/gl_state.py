"""Programs that set state and return every error and all state afterwards, on any GL namespace."""

from typing import Any

import numpy as np

from mesa.gl_calls import Call

NAMES = (
    "GL_VIEWPORT", "GL_DEPTH_RANGE", "GL_SCISSOR_BOX", "GL_ALPHA_TEST_FUNC", "GL_ALPHA_TEST_REF",
    "GL_STENCIL_FUNC", "GL_STENCIL_REF", "GL_STENCIL_VALUE_MASK", "GL_STENCIL_FAIL", "GL_STENCIL_PASS_DEPTH_FAIL",
    "GL_STENCIL_PASS_DEPTH_PASS", "GL_STENCIL_WRITEMASK", "GL_STENCIL_BACK_FUNC", "GL_STENCIL_BACK_REF",
    "GL_STENCIL_BACK_VALUE_MASK", "GL_STENCIL_BACK_FAIL", "GL_STENCIL_BACK_PASS_DEPTH_FAIL",
    "GL_STENCIL_BACK_PASS_DEPTH_PASS", "GL_STENCIL_BACK_WRITEMASK", "GL_STENCIL_CLEAR_VALUE", "GL_DEPTH_FUNC",
    "GL_DEPTH_WRITEMASK", "GL_DEPTH_CLEAR_VALUE", "GL_CULL_FACE_MODE", "GL_FRONT_FACE", "GL_POLYGON_MODE",
    "GL_POLYGON_OFFSET_FACTOR", "GL_POLYGON_OFFSET_UNITS", "GL_LINE_WIDTH", "GL_POINT_SIZE", "GL_BLEND_SRC",
    "GL_BLEND_DST", "GL_BLEND_SRC_RGB", "GL_BLEND_DST_RGB", "GL_BLEND_SRC_ALPHA", "GL_BLEND_DST_ALPHA",
    "GL_BLEND_EQUATION_RGB", "GL_BLEND_EQUATION_ALPHA", "GL_BLEND_COLOR", "GL_LOGIC_OP_MODE", "GL_COLOR_WRITEMASK",
    "GL_COLOR_CLEAR_VALUE", "GL_ACCUM_CLEAR_VALUE", "GL_SHADE_MODEL", "GL_LIGHT_MODEL_AMBIENT",
    "GL_LIGHT_MODEL_LOCAL_VIEWER", "GL_LIGHT_MODEL_TWO_SIDE", "GL_LIGHT_MODEL_COLOR_CONTROL",
    "GL_COLOR_MATERIAL_FACE", "GL_COLOR_MATERIAL_PARAMETER", "GL_FOG_MODE", "GL_FOG_DENSITY", "GL_FOG_START",
    "GL_FOG_END", "GL_FOG_COLOR", "GL_MATRIX_MODE", "GL_MODELVIEW_MATRIX", "GL_PROJECTION_MATRIX",
    "GL_TEXTURE_MATRIX", "GL_TRANSPOSE_MODELVIEW_MATRIX", "GL_MODELVIEW_STACK_DEPTH", "GL_PROJECTION_STACK_DEPTH",
    "GL_TEXTURE_STACK_DEPTH", "GL_CURRENT_COLOR", "GL_CURRENT_NORMAL", "GL_CURRENT_TEXTURE_COORDS",
    "GL_ACTIVE_TEXTURE", "GL_CLIENT_ACTIVE_TEXTURE", "GL_TEXTURE_BINDING_2D", "GL_ATTRIB_STACK_DEPTH",
    "GL_TEXTURE_BINDING_CUBE_MAP", "GL_MAX_CUBE_MAP_TEXTURE_SIZE", "GL_MAX_TEXTURE_LOD_BIAS",
    "GL_LIST_BASE", "GL_LIST_INDEX", "GL_PERSPECTIVE_CORRECTION_HINT", "GL_FOG_HINT", "GL_GENERATE_MIPMAP_HINT",
    "GL_LINE_SMOOTH_HINT", "GL_MAX_LIGHTS", "GL_MAX_TEXTURE_SIZE", "GL_MAX_VIEWPORT_DIMS", "GL_SUBPIXEL_BITS",
    "GL_LINE_STIPPLE_PATTERN", "GL_LINE_STIPPLE_REPEAT", "GL_POINT_SIZE_MIN", "GL_POINT_SIZE_MAX",
    "GL_POINT_FADE_THRESHOLD_SIZE", "GL_POINT_DISTANCE_ATTENUATION", "GL_POINT_SPRITE_COORD_ORIGIN",
    "GL_DEPTH_BITS", "GL_STENCIL_BITS", "GL_RED_BITS", "GL_ALPHA_BITS", "GL_FOG_COORD_SRC", "GL_CURRENT_FOG_COORD",
    "GL_CURRENT_SECONDARY_COLOR", "GL_CURRENT_RASTER_SECONDARY_COLOR", "GL_SECONDARY_COLOR_ARRAY_SIZE",
    "GL_SECONDARY_COLOR_ARRAY_TYPE", "GL_FOG_COORD_ARRAY_TYPE", "GL_SECONDARY_COLOR_ARRAY_BUFFER_BINDING",
    "GL_FOG_COORD_ARRAY_BUFFER_BINDING",
)  # fmt: skip
CAPABILITIES = (
    "GL_SCISSOR_TEST", "GL_ALPHA_TEST", "GL_STENCIL_TEST", "GL_DEPTH_TEST", "GL_DEPTH_CLAMP", "GL_CULL_FACE",
    "GL_POLYGON_OFFSET_FILL", "GL_POLYGON_OFFSET_LINE", "GL_POLYGON_OFFSET_POINT", "GL_BLEND", "GL_COLOR_LOGIC_OP",
    "GL_DITHER", "GL_MULTISAMPLE", "GL_LIGHTING", "GL_COLOR_MATERIAL", "GL_NORMALIZE", "GL_RESCALE_NORMAL", "GL_FOG",
    "GL_TEXTURE_2D", "GL_TEXTURE_CUBE_MAP", "GL_TEXTURE_GEN_S", "GL_TEXTURE_GEN_Q", "GL_LIGHT0", "GL_LIGHT3",
    "GL_CLIP_PLANE0", "GL_CLIP_PLANE2", "GL_TEXTURE_CUBE_MAP_SEAMLESS",
    "GL_POLYGON_SMOOTH", "GL_POLYGON_STIPPLE", "GL_LINE_SMOOTH", "GL_LINE_STIPPLE", "GL_POINT_SMOOTH",
    "GL_POINT_SPRITE", "GL_COLOR_SUM", "GL_SECONDARY_COLOR_ARRAY", "GL_FOG_COORD_ARRAY",
)  # fmt: skip
LIGHT_PARAMETERS = (
    "GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_POSITION", "GL_SPOT_DIRECTION", "GL_SPOT_EXPONENT",
    "GL_SPOT_CUTOFF", "GL_CONSTANT_ATTENUATION", "GL_LINEAR_ATTENUATION", "GL_QUADRATIC_ATTENUATION",
)  # fmt: skip
MATERIAL_PARAMETERS = ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_EMISSION", "GL_SHININESS")
GETTERS = ("glGetFloatv", "glGetDoublev", "glGetIntegerv", "glGetBooleanv")


def make(gl: Any, calls: list[Call]) -> list[int]:
    """Make the calls, tokens by name, and return the GL error code of each, 0 for none."""
    codes = []
    for name, arguments in calls:
        values = [getattr(gl, a) if isinstance(a, str) else a for a in arguments]
        try:
            getattr(gl, name)(*values)
        except Exception as error:
            if not hasattr(error, "err"):
                raise
        codes.append(int(gl.glGetError()))
    return codes


def state_of(gl: Any) -> dict[str, Any]:
    """Return every state by the call that asks for it, as arrays."""
    answers: dict[str, Any] = {}
    for name in NAMES:
        for getter in GETTERS:
            answers[f"{getter}({name})"] = getattr(gl, getter)(getattr(gl, name))
    for name in CAPABILITIES:
        answers[f"glIsEnabled({name})"] = gl.glIsEnabled(getattr(gl, name))
    for light in ("GL_LIGHT0", "GL_LIGHT1", "GL_LIGHT7"):
        for name in LIGHT_PARAMETERS:
            answers[f"glGetLightfv({light}, {name})"] = gl.glGetLightfv(getattr(gl, light), getattr(gl, name))
    for face in ("GL_FRONT", "GL_BACK"):
        for name in MATERIAL_PARAMETERS:
            answers[f"glGetMaterialfv({face}, {name})"] = gl.glGetMaterialfv(getattr(gl, face), getattr(gl, name))
            answers[f"glGetMaterialiv({face}, {name})"] = gl.glGetMaterialiv(getattr(gl, face), getattr(gl, name))
    for plane in ("GL_CLIP_PLANE0", "GL_CLIP_PLANE2"):
        answers[f"glGetClipPlane({plane})"] = gl.glGetClipPlane(getattr(gl, plane))
    answers["glGetTexEnviv(GL_POINT_SPRITE)"] = gl.glGetTexEnviv(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE)
    answers["glGetPolygonStipple"] = gl.glGetPolygonStipple()
    return {call: np.array(answer) for call, answer in answers.items()}


def same(ours: Any, theirs: Any) -> bool:
    """Return whether two answers have the same shape and the same numbers, bit for bit but for the sign of zero."""
    return ours.shape == theirs.shape and bool(np.all((ours == theirs) | ((ours != ours) & (theirs != theirs))))
