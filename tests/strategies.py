"""Hypothesis strategies for the tests, one section for each block of the package.

Those for meshes, lights and scenes are in `softshadow.testing.strategies`, which users have, too.
"""

import numpy as np
from hypothesis import reject
from hypothesis import strategies as st

from softshadow.testing.strategies import closed_meshes as closed_meshes
from softshadow.testing.strategies import coordinates as coordinates
from softshadow.testing.strategies import floor_scenes as floor_scenes
from softshadow.testing.strategies import lights as lights
from softshadow.testing.strategies import scenes_from_within as scenes_from_within
from softshadow.testing.strategies import sheets as sheets
from softshadow.testing.strategies import soups as open_meshes  # noqa: F401

# -- techniques --------------------------------------------------------------------------------------------------------


@st.composite
def planes_and_lights(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Return a plane (4,) with a normal of any length, and a homogeneous light (4,) that is not in it."""
    normal = np.array(draw(st.tuples(*[coordinates(-2, 2)] * 3).filter(any)))
    light = np.array([*draw(st.tuples(*[coordinates(-4, 4)] * 3).filter(any)), draw(st.sampled_from([0.0, 1.0]))])
    plane = np.array([*normal, draw(coordinates(-3, 3))])
    if abs(plane @ light) < 1 / 16:  # too near to the plane for a well-conditioned matrix
        plane[:3] = light[:3]
        plane[3] = 1.0 if light[3] else 0.0
    return plane, light


# -- pipeline ----------------------------------------------------------------------------------------------------------

FUNCTIONS = ("GL_NEVER", "GL_LESS", "GL_EQUAL", "GL_LEQUAL", "GL_GREATER", "GL_NOTEQUAL", "GL_GEQUAL", "GL_ALWAYS")
STENCIL_OPS = ("GL_KEEP", "GL_ZERO", "GL_REPLACE", "GL_INCR", "GL_DECR", "GL_INVERT", "GL_INCR_WRAP", "GL_DECR_WRAP")


@st.composite
def fragment_states(draw: st.DrawFn) -> dict:
    """Return a per-fragment state of the oracle: scissored or not; alpha, stencil and depth test, or None for each."""
    func, op, byte = st.sampled_from(FUNCTIONS), st.sampled_from(STENCIL_OPS), st.integers(0, 255)
    bits = draw(st.sampled_from([8, 8, 1, 3]))
    return {
        "scissored": draw(st.integers(0, 9)) == 0,
        "alpha": draw(st.none() | st.tuples(func, byte)),
        "stencil": draw(st.none() | st.tuples(func, st.integers(-3, 300), byte, op, op, op, byte, st.just(bits))),
        "depth": draw(st.none() | st.tuples(func, st.booleans())),
    }


@st.composite
def window_fans(draw: st.DrawFn, size: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """Return a closed fan around a point: positions (V, 2) on a grid of 1/8 pixel, triangles (T, 3).

    Each rim vertex stays in the middle two thirds of its own sector, so the triangles never overlap. Corners often lie
    on pixel centres, so that edges pass through samples.
    """
    step, n_corners = 8, draw(st.integers(4, 9))
    sector = 360 / n_corners
    angles = np.radians([sector * (i + draw(st.integers(-8, 8)) / 24) for i in range(n_corners)])
    radii = np.array([draw(st.integers(3 * step, (size // 2 - 1) * step)) for _ in range(n_corners)])
    center = np.array([draw(st.integers(size // 2 * step - 4, size // 2 * step + 4)) for _ in range(2)])
    rim = np.rint(np.stack([np.cos(angles), np.sin(angles)], axis=1) * radii[:, None])
    positions = np.concatenate([center[None], center + rim]) / step
    fan = [(0, 1 + i, 1 + (i + 1) % n_corners) for i in range(n_corners)]
    return positions.astype(np.float32), np.array(fan, np.int32)


# -- gl ----------------------------------------------------------------------------------------------------------------

NO_TOKEN = "GL_CURRENT_PROGRAM"  # a token that no state setter takes
FACES = ("GL_FRONT", "GL_BACK", "GL_FRONT_AND_BACK")
FACTORS = (
    "GL_ZERO", "GL_ONE", "GL_SRC_COLOR", "GL_ONE_MINUS_SRC_COLOR", "GL_DST_COLOR", "GL_ONE_MINUS_DST_COLOR",
    "GL_SRC_ALPHA", "GL_ONE_MINUS_SRC_ALPHA", "GL_DST_ALPHA", "GL_ONE_MINUS_DST_ALPHA", "GL_CONSTANT_COLOR",
    "GL_ONE_MINUS_CONSTANT_COLOR", "GL_CONSTANT_ALPHA", "GL_ONE_MINUS_CONSTANT_ALPHA", "GL_SRC_ALPHA_SATURATE",
)  # fmt: skip
EQUATIONS = ("GL_FUNC_ADD", "GL_FUNC_SUBTRACT", "GL_FUNC_REVERSE_SUBTRACT", "GL_MIN", "GL_MAX")
CAPABILITIES = (
    "GL_SCISSOR_TEST", "GL_ALPHA_TEST", "GL_STENCIL_TEST", "GL_DEPTH_TEST", "GL_DEPTH_CLAMP", "GL_CULL_FACE",
    "GL_POLYGON_OFFSET_FILL", "GL_POLYGON_OFFSET_LINE", "GL_POLYGON_OFFSET_POINT", "GL_BLEND", "GL_COLOR_LOGIC_OP",
    "GL_DITHER", "GL_MULTISAMPLE", "GL_LIGHTING", "GL_COLOR_MATERIAL", "GL_NORMALIZE", "GL_RESCALE_NORMAL", "GL_FOG",
    "GL_TEXTURE_2D", "GL_TEXTURE_CUBE_MAP", "GL_TEXTURE_GEN_S", "GL_TEXTURE_GEN_Q", "GL_LIGHT0", "GL_LIGHT3",
    "GL_CLIP_PLANE0", "GL_CLIP_PLANE2", "GL_TEXTURE_CUBE_MAP_SEAMLESS",
    "GL_POLYGON_SMOOTH", "GL_POLYGON_STIPPLE", "GL_LINE_SMOOTH", "GL_LINE_STIPPLE", "GL_POINT_SMOOTH",
    "GL_POINT_SPRITE",
)  # fmt: skip
LOGIC_OPS = ("GL_CLEAR", "GL_AND", "GL_COPY", "GL_XOR", "GL_INVERT", "GL_SET")
MATRIX_MODES = ("GL_MODELVIEW", "GL_PROJECTION", "GL_TEXTURE")
COLOR_PARAMETERS = ("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR", "GL_EMISSION", "GL_AMBIENT_AND_DIFFUSE")
ATTRIBUTE_BITS = (
    "GL_CURRENT_BIT", "GL_POINT_BIT", "GL_LINE_BIT", "GL_POLYGON_BIT", "GL_PIXEL_MODE_BIT", "GL_LIGHTING_BIT",
    "GL_FOG_BIT", "GL_DEPTH_BUFFER_BIT", "GL_ACCUM_BUFFER_BIT", "GL_STENCIL_BUFFER_BIT", "GL_VIEWPORT_BIT",
    "GL_TRANSFORM_BIT", "GL_ENABLE_BIT", "GL_COLOR_BUFFER_BIT", "GL_HINT_BIT", "GL_LIST_BIT", "GL_TEXTURE_BIT",
    "GL_POLYGON_STIPPLE_BIT",
    "GL_SCISSOR_BIT", "GL_MULTISAMPLE_BIT", "GL_ALL_ATTRIB_BITS",
)  # fmt: skip
HINTS = ("GL_PERSPECTIVE_CORRECTION_HINT", "GL_FOG_HINT", "GL_GENERATE_MIPMAP_HINT", "GL_LINE_SMOOTH_HINT")


def state_calls() -> st.SearchStrategy[list[tuple]]:
    """Return calls that set state: (name, arguments), tokens by name; about one in ten is an error."""
    real = st.sampled_from([0.0, 0.1, 0.25, 0.3, 0.5, 0.7, 1.0, 1.5, 2.5, -1.0, -0.5, 3.0, 1000.0])
    unit = st.sampled_from([0.0, 0.1, 0.3, 0.5, 0.7, 1.0, 1.5, -0.5])
    pixel = st.sampled_from([0, 1, 7, 64, -3, 20000, -40000])
    integer = st.sampled_from([0, 1, 2, 128, 255, 256, 300, -1, 2**31 - 1])
    byte, signed = st.integers(0, 255), st.integers(-128, 127)
    large, unsigned = st.sampled_from([0, 1, -1, 2**31 - 1, -(2**31), 12345]), st.sampled_from([0, 7, 2**32 - 1])
    truth = st.booleans()

    def one_of(*names: str) -> st.SearchStrategy[str]:
        return st.sampled_from([*names] * (1 + 9 // len(names)) + [NO_TOKEN])

    def call(name: str, *arguments: st.SearchStrategy) -> st.SearchStrategy[tuple]:
        return st.tuples(st.just(name), st.tuples(*arguments))

    def floats(count: int) -> st.SearchStrategy[list[float]]:
        return st.lists(real, min_size=count, max_size=count)

    def ints(count: int) -> st.SearchStrategy[list[int]]:
        return st.lists(large, min_size=count, max_size=count)

    func, op, face, factor = one_of(*FUNCTIONS), one_of(*STENCIL_OPS), one_of(*FACES), one_of(*FACTORS)
    light, equation = one_of("GL_LIGHT0", "GL_LIGHT1", "GL_LIGHT7"), one_of(*EQUATIONS)
    attenuations = ("GL_CONSTANT_ATTENUATION", "GL_LINEAR_ATTENUATION", "GL_QUADRATIC_ATTENUATION")
    light_number = one_of("GL_SPOT_EXPONENT", "GL_SPOT_CUTOFF", *attenuations)
    light_color = one_of("GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR")
    fog_number = one_of("GL_FOG_DENSITY", "GL_FOG_START", "GL_FOG_END")
    origin = one_of("GL_LOWER_LEFT", "GL_UPPER_LEFT")
    point_number = one_of("GL_POINT_SIZE_MIN", "GL_POINT_SIZE_MAX", "GL_POINT_FADE_THRESHOLD_SIZE")
    plane, unit_name = one_of("GL_CLIP_PLANE0", "GL_CLIP_PLANE2"), st.sampled_from(["GL_TEXTURE0", "GL_TEXTURE3"])
    model_switch = one_of("GL_LIGHT_MODEL_LOCAL_VIEWER", "GL_LIGHT_MODEL_TWO_SIDE", "GL_LIGHT_MODEL_COLOR_CONTROL")
    bit = st.sampled_from(ATTRIBUTE_BITS)
    return st.lists(
        st.one_of(
            call("glEnable", one_of(*CAPABILITIES)),
            call("glEnable", one_of(*CAPABILITIES)),
            call("glDisable", one_of(*CAPABILITIES)),
            call("glDepthFunc", func),
            call("glDepthMask", truth),
            call("glClearDepth", unit),
            call("glDepthRange", unit, unit),
            call("glAlphaFunc", func, unit),
            call("glStencilFunc", func, integer, integer),
            call("glStencilFuncSeparate", face, func, integer, integer),
            call("glStencilOp", op, op, op),
            call("glStencilOpSeparate", face, op, op, op),
            call("glStencilMask", integer),
            call("glStencilMaskSeparate", face, integer),
            call("glClearStencil", integer),
            call("glColorMask", truth, truth, truth, truth),
            call("glClearColor", real, real, real, real),
            call("glClearAccum", unit, unit, unit, unit),
            call("glBlendFunc", factor, factor),
            call("glBlendFuncSeparate", factor, factor, factor, factor),
            call("glBlendEquation", equation),
            call("glBlendEquationSeparate", equation, equation),
            call("glBlendColor", real, real, real, real),
            call("glLogicOp", one_of(*LOGIC_OPS)),
            call("glCullFace", face),
            call("glFrontFace", one_of("GL_CW", "GL_CCW")),
            call("glPolygonMode", face, one_of("GL_POINT", "GL_LINE", "GL_FILL")),
            call("glPolygonOffset", real, real),
            call("glLineWidth", real),
            call("glPointSize", real),
            call("glLineStipple", integer, integer.map(lambda bits: bits & 0xFFFF)),
            call("glPolygonStipple", st.binary(min_size=128, max_size=128)),
            call("glPointParameterf", point_number, real),
            call("glPointParameteri", st.just("GL_POINT_SPRITE_COORD_ORIGIN"), origin),
            call("glPointParameterfv", st.just("GL_POINT_DISTANCE_ATTENUATION"), floats(3)),
            call("glTexEnvi", st.just("GL_POINT_SPRITE"), one_of("GL_COORD_REPLACE"), st.sampled_from([0, 1, 2])),
            call("glViewport", pixel, pixel, pixel, pixel),
            call("glScissor", pixel, pixel, pixel, pixel),
            call("glHint", one_of(*HINTS), one_of("GL_DONT_CARE", "GL_FASTEST", "GL_NICEST")),
            call("glShadeModel", one_of("GL_FLAT", "GL_SMOOTH")),
            call("glLightfv", light, one_of("GL_POSITION", "GL_AMBIENT", "GL_DIFFUSE", "GL_SPECULAR"), floats(4)),
            call("glLightfv", light, st.just("GL_SPOT_DIRECTION"), floats(3)),
            call("glLightiv", light, light_color, ints(4)),
            call("glLightf", light, light_number, real),
            call("glLighti", light, light_number, st.sampled_from([0, 1, 45, 90, 91, 128, 129, 180])),
            call("glLightModelfv", one_of("GL_LIGHT_MODEL_AMBIENT"), floats(4)),
            call("glLightModeliv", one_of("GL_LIGHT_MODEL_AMBIENT"), ints(4)),
            call("glLightModeli", model_switch, st.sampled_from([0, 1, 0x81F9, 0x81FA])),
            call("glMaterialfv", face, one_of(*COLOR_PARAMETERS), floats(4)),
            call("glMaterialiv", face, one_of(*COLOR_PARAMETERS), ints(4)),
            call("glMaterialf", face, one_of("GL_SHININESS"), st.sampled_from([0.0, 12.5, 128.0, 129.0, -1.0])),
            call("glColorMaterial", face, one_of(*COLOR_PARAMETERS)),
            call("glFogi", st.just("GL_FOG_MODE"), one_of("GL_LINEAR", "GL_EXP", "GL_EXP2")),
            call("glFogf", fog_number, real),
            call("glFogfv", one_of("GL_FOG_COLOR"), floats(4)),
            call("glFogiv", one_of("GL_FOG_COLOR"), ints(4)),
            call("glClipPlane", plane, floats(4)),
            call("glColor4f", real, real, real, real),
            call("glColor3ub", byte, byte, byte),
            call("glColor4b", signed, signed, signed, signed),
            call("glColor3i", large, large, large),
            call("glColor4ui", unsigned, unsigned, unsigned, unsigned),
            call("glColor3s", signed, signed, signed),
            call("glColor3us", byte, byte, byte),
            call("glNormal3f", real, real, real),
            call("glNormal3b", signed, signed, signed),
            call("glNormal3i", large, large, large),
            call("glTexCoord2f", real, real),
            call("glMultiTexCoord4f", unit_name, real, real, real, real),
            call("glActiveTexture", unit_name),
            call("glClientActiveTexture", unit_name),
            call("glBindTexture", st.just("GL_TEXTURE_2D"), st.integers(0, 3)),
            call("glMatrixMode", one_of(*MATRIX_MODES)),
            call("glPushMatrix"),
            call("glPopMatrix"),
            call("glLoadIdentity"),
            call("glTranslatef", real, real, real),
            call("glScalef", real, real, real),
            call("glRotatef", real, real, real, real),
            call("glFrustum", real, real, real, real, real, real),
            call("glOrtho", real, real, real, real, real, real),
            call("glListBase", st.integers(0, 9)),
            call("glPushAttrib", bit),
            call("glPushAttrib", bit),
            call("glPopAttrib"),
            call("glPopAttrib"),
        ),
        min_size=1,
        max_size=40,
    )


def axes_and_angles() -> st.SearchStrategy[tuple[float, np.ndarray]]:
    """Return an angle in degrees and an axis, often a coordinate axis."""
    axis = st.tuples(*[st.integers(-4, 4)] * 3).filter(any) | st.sampled_from([(1, 0, 0), (0, 1, 0), (0, 0, -1)])
    return st.tuples(st.integers(-720, 720).map(float), axis.map(lambda a: np.array(a, np.float64)))


@st.composite
def cameras(draw: st.DrawFn) -> tuple:
    """Return an eye, another point as centre, and an up vector that is not along the view."""
    point = st.tuples(*[coordinates(-4, 4)] * 3)
    eye, center, up = draw(point), draw(point), draw(st.tuples(*[st.integers(-3, 3)] * 3))
    if np.linalg.norm(np.cross(np.subtract(center, eye), up)) < 0.1:
        reject()
    return eye, center, up
