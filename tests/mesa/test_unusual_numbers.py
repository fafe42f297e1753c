"""Vertices and coordinates at the limits of float32 (NaN, infinity, a subnormal 1/w) give the bits of Mesa."""

import itertools

import numpy as np
import pytest

import softshadow as ss
from softshadow.pipeline import use_short_cuts
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WRAPS = ["GL_REPEAT", "GL_MIRRORED_REPEAT", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_CLAMP"]
COORDINATES = [(0.0, 0.0, 0.0, 0.0), (1.0, -1.0, 0.0, 0.0), (1e30, -1e20, 0.0, 1.0)]  # NaN, infinite, huge
# on both sides of 2**31 / 255, and no numbers
LARGE_COLORS = [1.5, 8e6, 8421504, 8421505, 8.5e6, 1e30, 3e38, np.inf, -np.inf, np.nan, -1e30]


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("number", [np.nan, 3e38, 1e20, -1e30, 1e-30])
def test_triangles_with_unusual_vertices_cover_the_same_pixels(number, place):
    rng = np.random.default_rng(place)
    vertices = np.concatenate([rng.uniform(-1.2, 1.2, (60, 3)).round(3), np.ones((60, 1))], axis=1)
    vertices[::4, place] = number

    def program(gl):
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glBegin(gl.GL_TRIANGLES)
        for index, vertex in enumerate(vertices.tolist()):
            gl.glColor3f(index / 60, 1 - index / 60, 0.2)
            gl.glVertex4f(*vertex)
        gl.glEnd()

    comparison = compare(program, (33, 20))
    assert comparison, str(comparison)


@pytest.mark.parametrize("filtering", ["GL_NEAREST", "GL_LINEAR"])
@pytest.mark.parametrize("size", [(3, 8), (4, 5)])
def test_coordinates_that_are_no_numbers_find_the_same_texels(size, filtering):
    texels = np.random.default_rng(1).integers(0, 256, (size[1], size[0], 4), dtype=np.uint8)

    def program(gl):
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, *size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, getattr(gl, filtering))
        gl.glEnable(gl.GL_TEXTURE_2D)
        answers = []
        for s, t in itertools.product(WRAPS, repeat=2):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, getattr(gl, s))
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_T, getattr(gl, t))
            for coordinates in COORDINATES:
                gl.glTexCoord4f(*coordinates)
                gl.glRectf(-1, -1, 1, 1)
                answers.append(gl.glReadPixels(1, 1, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
        return answers

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)


@pytest.mark.parametrize("policy", [False, "always"])
@pytest.mark.parametrize("limits", [(-1000, 1000), (0.5, 3)])
@pytest.mark.parametrize("between", ["NEAREST", "LINEAR"])
@pytest.mark.parametrize("target", ["GL_TEXTURE_1D", "GL_TEXTURE_2D"])
def test_coordinates_that_are_no_numbers_find_the_same_levels(target, between, limits, policy):
    n_sides = 1 if target == "GL_TEXTURE_1D" else 2

    def program(gl):
        rng = np.random.default_rng(2)
        define = gl.glTexImage1D if n_sides == 1 else gl.glTexImage2D
        for level in range(5):
            sides = [16 >> level] * n_sides
            image = rng.integers(0, 256, (*sides, 4), dtype=np.uint8)
            define(getattr(gl, target), level, gl.GL_RGBA8, *sides, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
        parameters = {"MIN_FILTER": getattr(gl, f"GL_LINEAR_MIPMAP_{between}"), "MAG_FILTER": gl.GL_NEAREST}
        parameters |= dict(zip(("MIN_LOD", "MAX_LOD"), limits, strict=True))
        for name, value in parameters.items():
            gl.glTexParameterf(getattr(gl, target), getattr(gl, f"GL_TEXTURE_{name}"), value)
        gl.glEnable(getattr(gl, target))
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl.glTexCoord4f(0, 0, 0, 0)
            gl.glVertex2f(x, y)
        gl.glEnd()

    with use_short_cuts(policy):
        comparison = compare(program, (4, 4))
    assert comparison, str(comparison)


@pytest.mark.parametrize("function", ["GL_LESS", "GL_LEQUAL", "GL_EQUAL", "GL_NOTEQUAL", "GL_GEQUAL", "GL_GREATER"])
def test_an_alpha_that_is_no_number_is_compared_as_one(function):
    texels = np.full((4, 4, 4), 200, np.uint8)

    def program(gl):
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_WRAP_S, gl.GL_MIRRORED_REPEAT)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(getattr(gl, function), 0.5)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        gl.glTexCoord4f(0.0, 0.0, 0.0, 0.0)
        gl.glRectf(-1, -1, 1, 1)

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)


@pytest.mark.parametrize("blended", [False, True])
@pytest.mark.parametrize("internal_format", ["GL_RGBA8", "GL_RGB8", "GL_RG8", "GL_R8", "GL_RGBA32F"])
def test_colors_too_large_for_an_integer_are_written_as_by_mesa(internal_format, blended):
    texels = np.full((16, 1, 4), 0.5, np.float32)
    texels[: len(LARGE_COLORS), 0, ::2] = np.array(LARGE_COLORS)[:, None]
    texels[: len(LARGE_COLORS), 0, 3] = LARGE_COLORS

    def program(gl):
        target, source = gl.glGenTextures(2)
        gl.glBindTexture(gl.GL_TEXTURE_2D, target)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal_format), 4, 16, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, target, 0)
        gl.glClearColor(0.5, 0.5, 0.5, 0.5)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glBindTexture(gl.GL_TEXTURE_2D, source)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA32F, 1, 16, 0, gl.GL_RGBA, gl.GL_FLOAT, texels)
        for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, gl.GL_NEAREST)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        gl.glEnable(gl.GL_TEXTURE_2D)
        if blended:
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl.glTexCoord2f((x + 1) / 2, (y + 1) / 2)
            gl.glVertex2f(x, y)
        gl.glEnd()
        return [gl.glReadPixels(0, 0, 4, 16, gl.GL_RGBA, gl.GL_FLOAT)]

    comparison = compare(program, (4, 4))
    assert comparison, str(comparison)


def test_pixels_where_one_over_w_cancels_to_0_are_written_as_by_mesa():
    rng = np.random.default_rng(0)
    width, height = 64, 32
    far = 1e10 * np.concatenate([(rng.integers(0, (width, height), (60, 2)) + 0.5) / (width, height) * 2 - 1,
                                 np.ones((60, 2))], axis=1)  # on pixel centres  # fmt: skip
    near = np.concatenate([rng.uniform(-1, 1, (60, 2, 3)), rng.uniform(1, 2, (60, 2, 1))], axis=2)

    def program(gl):
        gl.glBegin(gl.GL_TRIANGLES)
        gl.glColor3f(0.1, 0.2, 0.3)
        for first, (second, third) in zip(far.tolist(), near.tolist(), strict=True):
            for vertex in (first, second, third):
                gl.glVertex4f(*vertex)
        gl.glEnd()

    comparison = compare(program, (width, height))
    assert comparison, str(comparison)


UNUSUAL = [np.nan, np.inf, 3e38, 1e-45, 0.49, 256.0]


def same_answers(program, size=(16, 12)):
    """Compare the buffers and answers of a program; answers that may be NaN are text."""
    comparison = compare(program, size)
    assert comparison, str(comparison)


@pytest.mark.parametrize("size", UNUSUAL)
def test_lines_and_points_of_unusual_sizes_cover_the_same_pixels(size):
    def program(gl):
        gl.glLineWidth(size)
        gl.glPointSize(size)
        answers = [str(float(gl.glGetFloatv(name))) for name in (gl.GL_LINE_WIDTH, gl.GL_POINT_SIZE)]
        for mode in (gl.GL_LINES, gl.GL_POINTS):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            gl.glBegin(mode)
            gl.glVertex2f(-0.9, -0.5)
            gl.glVertex2f(0.9, 0.7)
            gl.glEnd()
            answers.append(gl.glReadPixels(0, 0, 16, 12, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).tobytes())
        return answers

    same_answers(program)


@pytest.mark.parametrize("far", [1e10, 1e20, 1e30, 1e36])
def test_lines_to_far_places_cover_the_same_pixels(far):
    rng = np.random.default_rng(0)
    vertices = np.concatenate([rng.uniform(-1, 1, (40, 3)), np.ones((40, 1))], axis=1)
    wild = rng.random((40, 3)) < 0.2
    vertices[:, :3][wild] = rng.choice([far, -far, far / 3], int(wild.sum()))

    def program(gl):
        gl.glBegin(gl.GL_LINES)
        for vertex in vertices.tolist():
            gl.glVertex4f(*vertex)
        gl.glEnd()

    same_answers(program, (40, 30))


@pytest.mark.parametrize("internal_format", ["GL_RGBA8", "GL_RGB8", "GL_R8", "GL_RGBA32F", "GL_R32F"])
@pytest.mark.parametrize("reference", [np.nan, np.inf, -np.inf, 0.6])
def test_alpha_references_that_are_no_numbers_let_the_same_fragments_pass(internal_format, reference):
    def program(gl):
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        image = (getattr(gl, internal_format), 4, 4, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, *image)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, 1, 0)
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glColor4f(1, 0.5, 0.2, 0.6)
        answers = []
        for function in ("LESS", "EQUAL", "LEQUAL", "GREATER", "NOTEQUAL", "GEQUAL", "NEVER"):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            gl.glAlphaFunc(getattr(gl, f"GL_{function}"), reference)
            gl.glRectf(-1, -1, 1, 1)
            answers.append(gl.glReadPixels(1, 1, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).tobytes())
        return [*answers, str(float(gl.glGetFloatv(gl.GL_ALPHA_TEST_REF)))]

    same_answers(program)


def test_images_with_a_side_of_0_get_the_mipmaps_that_mesa_makes():
    def program(gl):
        answers = []
        for follows, (width, height) in itertools.product((0, 1), ((0, 0), (0, 4), (4, 0), (4, 4))):
            gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_GENERATE_MIPMAP, follows)
            for level, size in ((2, (3, 3)), (0, (width, height))):
                image = (gl.GL_RGBA8, *size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
                gl.glTexImage2D(gl.GL_TEXTURE_2D, level, *image)
            if not follows:
                gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
            sides = itertools.product(range(4), (gl.GL_TEXTURE_WIDTH, gl.GL_TEXTURE_HEIGHT))
            answers += [int(gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, *side)) for side in sides]
        return answers

    same_answers(program)


def test_projections_of_infinite_angles_and_empty_viewports_are_those_of_glu():
    views = [(0, 0, 16, 12), (0, 0, 0, 12), (3, 2, 0, 0), (0, 0, -5, 12), (1, 1, 2**31 - 1, 1)]
    points = [(1.0, 2.0, 0.5), (np.nan, 1.0, 1.0), (0.0, 0.0, 0.0), (3.0, 2.0, 1.0), (np.inf, 1.0, 1.0)]

    def program(gl):
        answers = []
        for angle, aspect in ((np.inf, 1.0), (-np.inf, 1.0), (np.nan, 1.0), (1e300, 1.0), (60.0, np.nan)):
            gl.glLoadIdentity()
            gl.gluPerspective(angle, aspect, 1.0, 2.0)
            answers.append(str(np.asarray(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)).tolist()))
        for view, point in itertools.product(views, points):
            for call in (gl.gluProject, gl.gluUnProject):
                place = call(*point, np.eye(4), np.eye(4), np.array(view, np.int32))
                answers.append(str([float(coordinate) for coordinate in place]))
        return answers

    same_answers(program)


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf, 3e38, -1e19, 2.0**31, -1e10, 2.5, -0.5])
def test_numbers_without_a_place_in_an_int_are_answered_as_by_mesa(number):
    def program(gl):
        gl.glPolygonOffset(number, number)
        gl.glFogf(gl.GL_FOG_START, number)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [number] * 4)
        gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_LOD, number)
        gl.glTexParameterfv(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_BORDER_COLOR, [number] * 4)
        answers = [gl.glGetIntegerv(name) for name in (gl.GL_POLYGON_OFFSET_FACTOR, gl.GL_FOG_START)]
        answers.append(gl.glGetLightiv(gl.GL_LIGHT0, gl.GL_POSITION))
        for name in (gl.GL_TEXTURE_MIN_LOD, gl.GL_TEXTURE_BORDER_COLOR):
            answers.append(gl.glGetTexParameteriv(gl.GL_TEXTURE_2D, name))
        return [np.ravel(answer).tolist() for answer in answers]

    same_answers(program)


@pytest.mark.parametrize("local_viewer", [0, 1])
@pytest.mark.parametrize("cutoff", [180, 90, 30])
@pytest.mark.parametrize("attenuation", [(1, 0, 0), (1, 0.2, 0), (0, 1, 0), (0.5, 0, 0.3)])
def test_a_vertex_at_the_place_of_a_light_has_the_color_of_mesa(attenuation, cutoff, local_viewer):
    def program(gl):
        gl.glEnable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_LIGHT0)
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [0, 0, 0, 1])
        gl.glLightfv(gl.GL_LIGHT0, gl.GL_AMBIENT, [0.3, 0.3, 0.3, 1])
        gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_CUTOFF, cutoff)
        for name, value in zip(("CONSTANT", "LINEAR", "QUADRATIC"), attenuation, strict=True):
            gl.glLightf(gl.GL_LIGHT0, getattr(gl, f"GL_{name}_ATTENUATION"), value)
        gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, local_viewer)
        gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, [1, 1, 1, 1])
        for exponent, shininess in ((0, 0), (5, 0), (0, 10), (5, 10)):
            gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_EXPONENT, exponent)
            gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, shininess)
            gl.glNormal3f(0, 0, 1)
            gl.glBegin(gl.GL_TRIANGLES)
            for vertex in ((0, 0, 0), (1, 0, 0), (0, 1, -0.5)):
                gl.glVertex3f(*vertex)
            gl.glEnd()
            gl.glRotatef(90, 0, 0, 1)  # turns about the light

    for short_cuts in (False, "always"):
        with ss.use_short_cuts(short_cuts):
            comparison = compare(program, (33, 20))
        assert comparison, str(comparison)


@pytest.mark.parametrize("color", [(np.nan, 0.5, -np.nan, 1.0), (np.inf, -np.inf, 2.0, np.nan)])
def test_colors_that_are_no_numbers_are_clamped_as_in_mesa(color):
    def program(gl):
        gl.glColor4f(*color)
        gl.glRectf(-1, -1, 1, 0)
        gl.glEnable(gl.GL_LIGHTING)
        gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, color)
        gl.glRectf(-1, 0, 0, 1)
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        gl.glRectf(0, 0, 1, 1)

    for short_cuts in (False, "always"):
        with ss.use_short_cuts(short_cuts):
            comparison = compare(program, (16, 16))
        assert comparison, str(comparison)
