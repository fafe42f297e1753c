"""Mesa's namespace follows the read-out conventions of `softshadow.gl`."""

import numpy as np
import pytest

from softshadow.errors import StateError
from softshadow.pixel_store import dtype_of
from softshadow.testing import run_on_mesa
from softshadow.tokens import GL_FLOAT_32_UNSIGNED_INT_24_8_REV

pytestmark = pytest.mark.mesa
SIZE = (7, 5)
FLOAT_AND_STENCIL = dtype_of(GL_FLOAT_32_UNSIGNED_INT_24_8_REV)


def draw_a_slope(gl):
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
    gl.glColor4f(0.2, 0.4, 0.6, 0.8)
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y, z in ((-1, -1, -1), (3, -1, 0), (-1, 3, 1)):
        gl.glVertex3f(x, y, z)
    gl.glEnd()


@pytest.mark.parametrize(
    ("pixel_format", "pixel_type", "shape", "dtype"),
    [
        ("GL_RGBA", "GL_UNSIGNED_BYTE", (2, 3, 4), np.uint8),
        ("GL_RGB", "GL_FLOAT", (2, 3, 3), np.float32),
        ("GL_RED", "GL_UNSIGNED_BYTE", (2, 3), np.uint8),
        ("GL_ALPHA", "GL_FLOAT", (2, 3), np.float32),
        ("GL_LUMINANCE", "GL_UNSIGNED_BYTE", (2, 3), np.uint8),
        ("GL_DEPTH_COMPONENT", "GL_FLOAT", (2, 3), np.float32),
        ("GL_DEPTH_COMPONENT", "GL_UNSIGNED_INT", (2, 3), np.uint32),
        ("GL_DEPTH_COMPONENT", "GL_UNSIGNED_SHORT", (2, 3), np.uint16),
        ("GL_STENCIL_INDEX", "GL_UNSIGNED_BYTE", (2, 3), np.uint8),
        ("GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8", (2, 3), np.uint32),
        ("GL_DEPTH_STENCIL", "GL_FLOAT_32_UNSIGNED_INT_24_8_REV", (2, 3), FLOAT_AND_STENCIL),
    ],
)
def test_pixels_are_rows_from_the_bottom_returned_or_filled_in(pixel_format, pixel_type, shape, dtype):
    def program(gl):
        draw_a_slope(gl)
        arguments = (1, 2, 3, 2, getattr(gl, pixel_format), getattr(gl, pixel_type))
        array = np.zeros(shape, dtype)
        assert gl.glReadPixels(*arguments, array) is array
        return gl.glReadPixels(*arguments), array, gl.glGetIntegerv(gl.GL_PACK_ALIGNMENT)

    returned, array, alignment = run_on_mesa(program, SIZE).returned
    assert (returned.shape, returned.dtype) == (shape, dtype)
    np.testing.assert_array_equal(returned, array)
    assert returned.view(np.uint8).any()
    assert alignment == 4


def test_depth_readouts_follow_from_the_buffers_24_bits():
    def program(gl):
        draw_a_slope(gl)
        types = (gl.GL_FLOAT, gl.GL_UNSIGNED_INT, gl.GL_UNSIGNED_SHORT)
        return [gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, one) for one in types]

    result = run_on_mesa(program, SIZE)
    as_float, as_int, as_short = result.returned
    np.testing.assert_array_equal(as_float, (result.depth / (2**24 - 1)).astype(np.float32))
    np.testing.assert_array_equal(as_int, (result.depth << 8) | (result.depth >> 16))
    np.testing.assert_array_equal(as_short, np.rint(as_float * np.float32(65535)))


def test_an_array_of_the_wrong_shape_or_type_is_refused():
    def program(gl):
        gl.glReadPixels(0, 0, 3, 2, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, np.zeros((2, 3)))

    with pytest.raises(ValueError, match=r"must be float32 with shape \(2, 3\)"):
        run_on_mesa(program, SIZE)


def test_images_are_read_without_row_padding():
    texels = np.arange(18, dtype=np.uint8).reshape(2, 3, 3)

    def program(gl):
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB8, 3, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, texels)
        alignments = [int(gl.glGetIntegerv(name)) for name in (gl.GL_PACK_ALIGNMENT, gl.GL_UNPACK_ALIGNMENT)]
        return gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE), alignments

    image, alignments = run_on_mesa(program, SIZE).returned
    np.testing.assert_array_equal(image, texels)
    assert alignments == [4, 4]


def test_images_with_room_for_it_are_read_with_row_padding():
    padded = np.arange(24, dtype=np.uint8).reshape(2, 12)

    def program(gl):
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB8, 3, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, padded)
        return gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)

    image = run_on_mesa(program, SIZE).returned
    np.testing.assert_array_equal(image, padded[:, :9].reshape(2, 3, 3))


def test_one_name_is_an_int_and_several_are_an_array():
    def program(gl):
        generators = (gl.glGenTextures, gl.glGenFramebuffers, gl.glGenQueries)
        return [(generate(1), generate(2)) for generate in generators], gl.glGenLists(3)

    names, lists = run_on_mesa(program, SIZE).returned
    assert lists == 1
    for one, several in names:
        assert type(one) is int
        assert one == 1
        np.testing.assert_array_equal(several, [2, 3])


def test_vertex_arrays_stay_alive_until_they_are_drawn():
    def program(gl):
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, np.array([[-1, -1], [3, -1], [-1, 3]], np.float32))
        for _ in range(50):
            np.full(6, np.nan, np.float32)  # would land where a freed array was
        gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, [0, 1, 2])

    assert run_on_mesa(program, SIZE).color.all()


def test_debug_groups_take_a_string():
    def program(gl):
        gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "torus")
        gl.glPopDebugGroup()

    assert run_on_mesa(program, SIZE).errors == ()


@pytest.mark.parametrize("name", ["blinn-phong", "shadow-map"])
def test_a_programs_glsl_twin_is_compiled_once(name):
    def program(gl):
        twin = gl.program(name)
        gl.glUseProgram(twin)
        return twin, gl.program(name), int(gl.glGetIntegerv(gl.GL_CURRENT_PROGRAM))

    first, again, current = run_on_mesa(program, SIZE).returned
    assert first == again == current > 0


def test_an_unknown_program_names_the_nearest():
    with pytest.raises(StateError, match="did you mean 'shadow-map'"):
        run_on_mesa(lambda gl: gl.program("shadowmap"), SIZE)


def test_names_gl_does_not_know_are_attribute_errors():
    with pytest.raises(AttributeError, match="OpenGL has no glShadow"):
        run_on_mesa(lambda gl: gl.glShadow(), SIZE)


@pytest.mark.parametrize("query", ["glGetIntegerv", "glGetFloatv", "glGetBooleanv"])
def test_an_unknown_state_is_gls_own_error(query):
    result = run_on_mesa(lambda gl: getattr(gl, query)(0x7777), SIZE, raise_errors=False)
    assert result.errors == ((query, 0x0500),)
