"""Line and polygon stipples are Mesa's: colour, depth and stencil of whole frames."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (40, 33)
PATTERN = np.random.default_rng(3).integers(0, 256, 128, dtype=np.uint8)
LINES = ("GL_LINES", "GL_LINE_STRIP", "GL_LINE_LOOP")


def scene(gl: Any, rng: np.random.Generator) -> None:
    """Set the state of a picture: a camera, and a stencil buffer that counts the two facings."""
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glFrustum(-1, 1, -1, 1, 1, 9)
    gl.glTranslatef(0, 0, -3)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_INCR, gl.GL_INCR)
    gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_DECR_WRAP, gl.GL_DECR_WRAP)
    gl.glShadeModel(gl.GL_FLAT if rng.random() < 0.5 else gl.GL_SMOOTH)


def primitives(gl: Any, rng: np.random.Generator, mode: str, spread: float) -> None:
    for _ in range(3):
        gl.glBegin(getattr(gl, mode))
        for _ in range(7):
            gl.glColor4f(*rng.random(4))
            gl.glVertex3f(*((rng.random(3) * 2 - 1) * spread))
        gl.glEnd()


@pytest.mark.parametrize("spread", [0.95, 4.0])
@pytest.mark.parametrize("mode", LINES)
def test_stippled_lines_are_cut_where_mesa_cuts_them(mode: str, spread: float) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(len(mode))
        scene(gl, rng)
        gl.glEnable(gl.GL_LINE_STIPPLE)
        for width in (1.0, 3.0):
            gl.glLineWidth(width)
            gl.glLineStipple(int(rng.integers(1, 4)), int(rng.integers(0, 1 << 16)))
            primitives(gl, rng, mode, spread)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert compared.ours.stencil.any()


@pytest.mark.parametrize("faces", [("GL_LINE", "GL_LINE"), ("GL_LINE", "GL_FILL"), ("GL_FILL", "GL_FILL")])
@pytest.mark.parametrize("mode", ["GL_TRIANGLES", "GL_QUADS", "GL_POLYGON", "GL_TRIANGLE_STRIP"])
def test_outlines_and_offsets_of_polygons_under_a_line_stipple_are_those_of_mesa(
    mode: str, faces: tuple[str, str]
) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(len(mode))
        scene(gl, rng)
        gl.glEnable(gl.GL_LINE_STIPPLE)
        gl.glLineStipple(2, 0x2F35)
        for face, chosen in zip(("GL_FRONT", "GL_BACK"), faces, strict=True):
            gl.glPolygonMode(getattr(gl, face), getattr(gl, chosen))
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(1.5, 3.0)
        primitives(gl, rng, mode, 3.0)

    compared = compare(program, SIZE)
    assert compared, str(compared)


@pytest.mark.parametrize("mode", ["GL_TRIANGLES", "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON"])
def test_polygon_stipple_leaves_out_the_fragments_that_mesa_leaves_out(mode: str) -> None:
    def program(gl: Any) -> Any:
        rng = np.random.default_rng(len(mode))
        scene(gl, rng)
        gl.glEnable(gl.GL_POLYGON_STIPPLE)
        gl.glPolygonStipple(PATTERN)
        primitives(gl, rng, mode, 3.0)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
        primitives(gl, rng, mode, 3.0)
        return gl.glGetPolygonStipple()

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert np.array_equal(compared.ours.returned, PATTERN)


def test_the_stipple_of_a_framebuffer_object_begins_at_its_own_lower_left() -> None:
    def program(gl: Any) -> Any:
        texture = gl.glGenTextures(1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 20, 36, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, gl.GL_TEXTURE_2D, texture, 0)
        gl.glViewport(0, 0, 20, 36)
        gl.glEnable(gl.GL_POLYGON_STIPPLE)
        gl.glPolygonStipple(PATTERN)
        gl.glRectf(-1, -1, 1, 1)
        pixels = gl.glReadPixels(0, 0, 20, 36, gl.GL_RED, gl.GL_UNSIGNED_BYTE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return np.ravel(pixels)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    bits = np.unpackbits(PATTERN).reshape(32, 32)
    rows, columns = np.arange(36)[:, None] % 32, np.arange(20) % 32
    assert np.array_equal(compared.ours.returned.reshape(36, 20) != 0, bits[rows, columns] != 0)
