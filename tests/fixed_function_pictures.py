"""Random pictures of the fixed function: textures, fog, blending and tests below the GL facade."""

from dataclasses import replace
from typing import Any

import numpy as np

from draws import random_state
from softshadow import gl
from softshadow.state import Blend

WRAPS = (gl.GL_REPEAT, gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP_TO_BORDER, gl.GL_CLAMP, gl.GL_MIRRORED_REPEAT)
MIN_FILTERS = (
    gl.GL_NEAREST, gl.GL_LINEAR, gl.GL_NEAREST_MIPMAP_NEAREST, gl.GL_LINEAR_MIPMAP_NEAREST,
    gl.GL_NEAREST_MIPMAP_LINEAR, gl.GL_LINEAR_MIPMAP_LINEAR,
)  # fmt: skip
FORMATS = (
    gl.GL_RGBA, gl.GL_RGB, gl.GL_LUMINANCE, gl.GL_LUMINANCE_ALPHA, gl.GL_ALPHA, gl.GL_INTENSITY, gl.GL_RED, gl.GL_RG,
)  # fmt: skip
DEPTH_FORMATS = (gl.GL_DEPTH_COMPONENT16, gl.GL_DEPTH_COMPONENT24, gl.GL_DEPTH_COMPONENT32, gl.GL_DEPTH_COMPONENT32F)
FLOAT_FORMATS = (
    gl.GL_RGBA32F, gl.GL_RGB16F, gl.GL_R32F, gl.GL_LUMINANCE_ALPHA16F_ARB, gl.GL_RGBA16, gl.GL_ALPHA16,
    gl.GL_SRGB8_ALPHA8, gl.GL_SRGB8,
)  # fmt: skip
TEXELS = 0.0, 1.0  # the least and the largest one
DEPTH_SHARE = 0.3  # of the textures
ANISOTROPY = 1.0  # GL_TEXTURE_MAX_ANISOTROPY_EXT
COORDINATES = 1.0  # about the largest ones
FUNCS = tuple(range(gl.GL_NEVER, gl.GL_ALWAYS + 1))
TARGETS = (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_2D, gl.GL_TEXTURE_2D, gl.GL_TEXTURE_3D, gl.GL_TEXTURE_CUBE_MAP)
MODES = (gl.GL_MODULATE, gl.GL_REPLACE, gl.GL_DECAL, gl.GL_BLEND, gl.GL_ADD, gl.GL_COMBINE)
COMBINE_ALPHA = (
    gl.GL_REPLACE, gl.GL_MODULATE, gl.GL_ADD, gl.GL_ADD_SIGNED, gl.GL_INTERPOLATE, gl.GL_SUBTRACT,
)  # fmt: skip
COMBINE_RGB = (*COMBINE_ALPHA, gl.GL_DOT3_RGB, gl.GL_DOT3_RGBA)
SOURCES = (
    gl.GL_TEXTURE, gl.GL_CONSTANT, gl.GL_PRIMARY_COLOR, gl.GL_PREVIOUS, gl.GL_TEXTURE0, gl.GL_TEXTURE1, gl.GL_TEXTURE2,
)  # fmt: skip
ALPHA_OPERANDS = (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
RGB_OPERANDS = (gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR, *ALPHA_OPERANDS)
FACTORS = (
    gl.GL_ZERO, gl.GL_ONE, gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR, gl.GL_DST_COLOR, gl.GL_ONE_MINUS_DST_COLOR,
    gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA, gl.GL_DST_ALPHA, gl.GL_ONE_MINUS_DST_ALPHA, gl.GL_CONSTANT_COLOR,
    gl.GL_ONE_MINUS_CONSTANT_COLOR, gl.GL_CONSTANT_ALPHA, gl.GL_ONE_MINUS_CONSTANT_ALPHA,
)  # fmt: skip
EQUATIONS = (gl.GL_FUNC_ADD, gl.GL_FUNC_SUBTRACT, gl.GL_FUNC_REVERSE_SUBTRACT, gl.GL_MIN, gl.GL_MAX)


def pick(rng, values):
    return values[rng.integers(len(values))]


def random_texture(rng, unit):
    """Bind a random texture to a unit, with random environment, filters and wrap modes."""
    gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
    target = pick(rng, TARGETS)
    gl.glEnable(target)
    gl.glBindTexture(target, gl.glGenTextures(1))

    def parameter(name, value):
        gl.glTexParameteri(target, getattr(gl, f"GL_TEXTURE_{name}"), int(value))

    min_filter = pick(rng, MIN_FILTERS)
    parameter("MIN_FILTER", min_filter)
    parameter("MAG_FILTER", pick(rng, (gl.GL_NEAREST, gl.GL_LINEAR)))
    gl.glTexParameterf(target, gl.GL_TEXTURE_MAX_ANISOTROPY_EXT, ANISOTROPY)
    if target == gl.GL_TEXTURE_CUBE_MAP and rng.random() < 0.2:
        gl.glEnable(gl.GL_TEXTURE_CUBE_MAP_SEAMLESS)
    edges = WRAPS[:2] if rng.random() < 0.5 else WRAPS
    parameter("WRAP_S", pick(rng, edges))
    parameter("WRAP_T", pick(rng, edges))
    parameter("WRAP_R", pick(rng, edges))
    gl.glTexParameterfv(target, gl.GL_TEXTURE_BORDER_COLOR, rng.uniform(-0.2, 1.2, 4).astype(np.float32))
    if rng.random() < 0.3:
        gl.glTexParameterf(target, gl.GL_TEXTURE_MIN_LOD, float(rng.choice([-1, 0.5, 2, 20])))
        gl.glTexParameterf(target, gl.GL_TEXTURE_MAX_LOD, float(rng.choice([1.5, 3, 15, 20])))
    if rng.random() < 0.3:
        gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, float(rng.uniform(-2, 2)))
    width, height = (2 ** rng.integers(0, 7, 2) if rng.random() < 0.5 else rng.integers(1, 65, 2)).tolist()
    height = width if target == gl.GL_TEXTURE_CUBE_MAP else height
    height = 1 if target == gl.GL_TEXTURE_1D else height
    slices = int(rng.integers(1, 9)) if target == gl.GL_TEXTURE_3D else 1
    is_depth = rng.random() < DEPTH_SHARE and target != gl.GL_TEXTURE_3D
    internal = int(pick(rng, DEPTH_FORMATS if is_depth else FORMATS))
    format, channels = (gl.GL_DEPTH_COMPONENT, 1) if is_depth else (gl.GL_RGBA, 4)
    if is_depth:
        parameter("COMPARE_MODE", pick(rng, (gl.GL_NONE, gl.GL_COMPARE_R_TO_TEXTURE, gl.GL_COMPARE_R_TO_TEXTURE)))
        parameter("COMPARE_FUNC", pick(rng, FUNCS))
        gl.glTexParameteri(target, gl.GL_DEPTH_TEXTURE_MODE, pick(rng, (gl.GL_LUMINANCE, gl.GL_INTENSITY, gl.GL_ALPHA)))
    level = 0
    while True:
        n_images = 6 if target == gl.GL_TEXTURE_CUBE_MAP else slices
        texels = rng.uniform(*TEXELS, (n_images, height, width, channels)).astype(np.float32)
        if target == gl.GL_TEXTURE_3D:
            gl.glTexImage3D(target, level, internal, width, height, slices, 0, format, gl.GL_FLOAT, texels)
        elif target == gl.GL_TEXTURE_CUBE_MAP:
            for face in range(6):
                to = gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
                gl.glTexImage2D(to, level, internal, width, height, 0, format, gl.GL_FLOAT, texels[face])
        elif target == gl.GL_TEXTURE_1D:
            gl.glTexImage1D(target, level, internal, width, 0, format, gl.GL_FLOAT, texels[0, 0])
        else:
            gl.glTexImage2D(target, level, internal, width, height, 0, format, gl.GL_FLOAT, texels[0])
        if width == height == slices == 1 or min_filter in (gl.GL_NEAREST, gl.GL_LINEAR):
            break
        level, width, height, slices = level + 1, max(width // 2, 1), max(height // 2, 1), max(slices // 2, 1)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, pick(rng, MODES))
    random_combining(rng)
    gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, rng.random(4).astype(np.float32))


def random_combining(rng):
    """Let the active unit combine random sources, if its mode is GL_COMBINE."""

    def environment(name, value):
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, getattr(gl, f"GL_{name}"), int(value))

    environment("COMBINE_RGB", pick(rng, COMBINE_RGB))
    environment("COMBINE_ALPHA", pick(rng, COMBINE_ALPHA))
    for n in range(3):
        environment(f"SOURCE{n}_RGB", pick(rng, SOURCES))
        environment(f"SOURCE{n}_ALPHA", pick(rng, SOURCES))
        environment(f"OPERAND{n}_RGB", pick(rng, RGB_OPERANDS))
        environment(f"OPERAND{n}_ALPHA", pick(rng, ALPHA_OPERANDS))
    environment("RGB_SCALE", pick(rng, (1, 1, 2, 4)))
    environment("ALPHA_SCALE", pick(rng, (1, 1, 2, 4)))


def random_fog(rng):
    gl.glEnable(gl.GL_FOG)
    gl.glFogi(gl.GL_FOG_MODE, pick(rng, (gl.GL_LINEAR, gl.GL_EXP, gl.GL_EXP2)))
    gl.glFogf(gl.GL_FOG_DENSITY, float(rng.uniform(0, 2)))
    gl.glFogf(gl.GL_FOG_START, float(rng.uniform(-1, 1)))
    gl.glFogf(gl.GL_FOG_END, float(rng.choice([-1, 1, 2, 5])))
    gl.glFogfv(gl.GL_FOG_COLOR, rng.random(4).astype(np.float32))


def random_blending(rng, state):
    """Return a state with random blending, or a logic operation."""
    factors = [int(pick(rng, FACTORS)) for _ in range(4)]
    if rng.random() < 0.1:
        factors[rng.choice([0, 2])] = gl.GL_SRC_ALPHA_SATURATE
    equations = [int(pick(rng, EQUATIONS))] * 2 if rng.random() < 0.6 else [int(pick(rng, EQUATIONS)) for _ in range(2)]
    if rng.random() < 0.5:
        equations = [gl.GL_FUNC_ADD] * 2
    constant = tuple(rng.uniform(-0.1, 1.1, 4).tolist())
    logic = bool(rng.random() < 0.15)
    operation = int(rng.integers(gl.GL_CLEAR, gl.GL_SET + 1))
    values: Any = (True, *factors, *equations, constant, logic, operation)
    blend = Blend(*values)
    return replace(state, blend=blend)


def random_special_fragments(rng):
    """Turn on some of polygon stipple, smoothing and point sprites; their sizes are random."""
    for capability in (gl.GL_POLYGON_STIPPLE, gl.GL_LINE_SMOOTH, gl.GL_POINT_SMOOTH, gl.GL_LINE_STIPPLE):
        if rng.random() < 0.5:
            gl.glEnable(capability)
    gl.glPolygonStipple(rng.integers(0, 256, 128, dtype=np.uint8))
    gl.glLineStipple(int(rng.integers(1, 4)), int(rng.integers(0, 1 << 16)))
    gl.glLineWidth(float(rng.uniform(0.5, 9)))
    gl.glPointSize(float(rng.uniform(0.5, 30)))
    if rng.random() < 0.3:
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, (0.2, 0.1, 0.3))
    if rng.random() < 0.5:
        gl.glEnable(gl.GL_POINT_SPRITE)
        gl.glPointParameteri(gl.GL_POINT_SPRITE_COORD_ORIGIN, pick(rng, (gl.GL_LOWER_LEFT, gl.GL_UPPER_LEFT)))
    for unit in range(2):
        gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
        gl.glTexEnvi(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE, bool(rng.random() < 0.7))
    for face in (gl.GL_FRONT, gl.GL_BACK):
        gl.glPolygonMode(face, pick(rng, (gl.GL_FILL, gl.GL_LINE, gl.GL_POINT)))


def draw_to_texture(internal_format, width, height):
    """Bind a framebuffer with a texture of this format, and with depths and stencil values."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal_format, width, height, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
    gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, buffer := gl.glGenRenderbuffers(1))
    gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, gl.GL_DEPTH24_STENCIL8, width, height)
    for attachment in (gl.GL_DEPTH_ATTACHMENT, gl.GL_STENCIL_ATTACHMENT):
        gl.glFramebufferRenderbuffer(gl.GL_FRAMEBUFFER, attachment, gl.GL_RENDERBUFFER, buffer)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


def random_picture(
    seed,
    *,
    size=(70, 50),
    n_triangles=12,
    ordered=False,
    tested=False,
    special=False,
    white=False,
    counted=False,
    units=None,
    stored_as=None,
    **options,
):
    """Return a window after a draw in a random state of the fixed function, over a random background.

    `ordered`: with blending or a logic operation; `tested`: with alpha test; `special`: see `random_special_fragments`;
    `white`: all vertices have this colour, without lighting and fog; `counted`: an occlusion query counts fragments;
    `stored_as`: the internal format of a texture that is drawn to, in place of the window.
    """
    rng = np.random.default_rng(seed)
    context = gl.create_context(*size, **options)
    if stored_as:
        draw_to_texture(stored_as, *size)
    gl.glClearColor(*rng.random(4).tolist())
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    count = rng.integers(0, 5) if units is None else units
    first = rng.integers(0, 2) if count == 1 else 0
    for unit in range(first, first + count):
        random_texture(rng, unit)
    if rng.random() < 0.4:
        random_fog(rng)
    if rng.random() < 0.3:
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_LIGHT0)
        gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_SPECULAR, [1, 0.5, 0.2, 1])
        gl.glLightModeli(
            gl.GL_LIGHT_MODEL_COLOR_CONTROL, pick(rng, (gl.GL_SINGLE_COLOR, gl.GL_SEPARATE_SPECULAR_COLOR))
        )
    if white:
        gl.glDisable(gl.GL_LIGHTING)
        gl.glDisable(gl.GL_FOG)
    gl.glShadeModel(gl.GL_SMOOTH if rng.random() < 0.8 else gl.GL_FLAT)
    gl.glMatrixMode(gl.GL_TEXTURE)
    scale = np.diag([COORDINATES, COORDINATES, 1, 1]).astype(np.float32)  # of the columns, which are GL's rows
    gl.glLoadMatrixf((np.eye(4, dtype=np.float32) + rng.normal(0, 0.1, (4, 4)).astype(np.float32)) @ scale)
    if special:
        random_special_fragments(rng)
    tests = random_state(rng, context.state)
    if rng.random() < 0.6:
        tests = replace(tests, stencil=context.state.stencil)
    if rng.random() < 0.4:
        tests = replace(tests, depth=replace(tests.depth, enabled=True, func=gl.GL_LESS, write=True))
    if rng.random() < 0.7:
        tests = replace(tests, color=replace(tests.color, mask=(True,) * 4))
    if ordered:
        tests = random_blending(rng, tests)
    if tested:
        tests = replace(tests, alpha=replace(tests.alpha, enabled=True, func=int(pick(rng, FUNCS)), ref=rng.random()))
    context.state = tests
    positions = rng.normal(0, 1, (3 * n_triangles, 4)).astype(np.float32)
    positions[:, 3] = rng.choice(np.float32([1, 1, 1, 0.5, 2, -1, 0.01]), 3 * n_triangles)
    if rng.random() < 0.5:  # small ones
        positions = np.ones((n_triangles, 3, 4), np.float32)
        positions[:, :, :3] = rng.uniform(-1.05, 1.05, (n_triangles, 1, 3))
        positions[:, :, :3] += rng.normal(0, 1, (n_triangles, 3, 3)) * 0.15
        positions = positions.reshape(-1, 4)
    scale = rng.choice([0.5, 3, 30])
    coordinates = rng.normal(0, 1, (4, 3 * n_triangles, 4)) * [scale, scale, 1, 0.1] + [0, 0, 0.5, 1]
    colors = rng.uniform(-0.1, 1.2, (3 * n_triangles, 4))
    if white:
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
    if counted:
        gl.glBeginQuery(gl.GL_SAMPLES_PASSED, gl.glGenQueries(1))
    gl.glBegin(pick(rng, (gl.GL_TRIANGLES, gl.GL_TRIANGLES, gl.GL_QUADS, gl.GL_LINES, gl.GL_POINTS)))
    for n in range(3 * n_triangles):
        if not white:
            gl.glColor4f(*colors[n].tolist())
        gl.glNormal3f(*rng.normal(0, 1, 3).tolist())
        for unit in range(4):
            gl.glMultiTexCoord4f(gl.GL_TEXTURE0 + unit, *coordinates[unit, n].tolist())
        gl.glVertex4f(*positions[n].tolist())
    gl.glEnd()
    if counted:
        gl.glEndQuery(gl.GL_SAMPLES_PASSED)
    gl.glFinish()
    return context
