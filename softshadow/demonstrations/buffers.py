"""Demonstrations about the stencil buffer, the depth buffer and culling, each with one or two rectangles."""

from typing import Any

from softshadow.demonstrations.demonstration import Demonstration, clear, color_of, depth_of, number, stencil_of
from softshadow.listings.depth_and_stencil import GREEN, RED, draw_quad

SQUARE = (-0.5, -0.5, 0.5, 0.5)


def culled_faces(gl: Any) -> list[int]:
    """E5: with glCullFace(GL_BACK), a counter-clockwise rectangle remains."""
    clear(gl)
    gl.glEnable(gl.GL_CULL_FACE)
    gl.glCullFace(gl.GL_BACK)
    draw_quad(gl, RED, *SQUARE)
    return [0, number(color_of(gl)[..., 0] > 0)]


def names_of_gl(gl: Any) -> list[int]:
    """E4: KEEP and GL_KEEP among the names of GL."""
    return [int(hasattr(gl, "KEEP")), int(hasattr(gl, "GL_KEEP"))]


def steps_of_a_unit(gl: Any) -> list[int]:
    """E32: how many steps of 24-bit depth glPolygonOffset(0, 10) moves a rectangle."""
    clear(gl)
    gl.glEnable(gl.GL_DEPTH_TEST)
    draw_quad(gl, RED, *SQUARE)
    before = depth_of(gl).min()
    clear(gl)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    gl.glPolygonOffset(0, 10)
    draw_quad(gl, RED, *SQUARE)
    return [10, int(depth_of(gl).min() - before)]


def replaced_value(gl: Any) -> list[int]:
    """E42: what GL_REPLACE writes for the reference 7 and the mask 1."""
    clear(gl)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 7, 1)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    draw_quad(gl, RED, *SQUARE)
    return [7 & 1, int(stencil_of(gl).max())]


def reference_is_written(gl: Any) -> list[int]:
    """E44: pixels that hold 5 after a change of the reference from 1 to 5, and of nothing else."""
    clear(gl)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 255)
    draw_quad(gl, RED, *SQUARE)
    before = number(stencil_of(gl) == 5)
    gl.glStencilFunc(gl.GL_ALWAYS, 5, 255)
    draw_quad(gl, RED, *SQUARE)
    return [before, number(stencil_of(gl) == 5)]


def stencil_bits(gl: Any) -> list[int]:
    """E57: setStencil takes a truth value, setStencilBufferSize a number of bits, which GL reports."""
    return [int(True), int(gl.glGetIntegerv(gl.GL_STENCIL_BITS))]


def stencil_before_depth(gl: Any) -> list[int]:
    """E59: a fragment that fails both tests: 3 is written if the stencil test comes first, 0 if the depth test does."""
    clear(gl)
    gl.glClearStencil(1)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_NEVER)
    gl.glStencilFunc(gl.GL_NEVER, 3, 255)
    gl.glStencilOp(gl.GL_REPLACE, gl.GL_ZERO, gl.GL_INVERT)
    draw_quad(gl, RED, *SQUARE)
    written = stencil_of(gl)
    return [3, int(written[written != 1].max())]


def stencil_write_mask(gl: Any) -> list[int]:
    """E64: the lowest eight bits of the stencil write mask of a new context."""
    return [0, int(gl.glGetIntegerv(gl.GL_STENCIL_WRITEMASK)) & 0xFF]


def function_without_test(gl: Any) -> list[int]:
    """E65: pixels written after glStencilFunc, with the stencil test enabled and without."""
    written = []
    for enable in (gl.glEnable, gl.glDisable):
        clear(gl)
        enable(gl.GL_STENCIL_TEST)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        draw_quad(gl, GREEN, *SQUARE)
        written.append(number(stencil_of(gl)))
    return written


DEMONSTRATIONS = (
    Demonstration("names-of-gl", "whether OpenGL has the name: KEEP, GL_KEEP", names_of_gl, on_mesa=False),
    Demonstration("culled-faces", "pixels of a front face that glCullFace(GL_BACK) leaves", culled_faces),
    Demonstration("steps-of-a-unit", "steps of 24-bit depth in ten units of glPolygonOffset", steps_of_a_unit),
    Demonstration("replaced-value", "value that GL_REPLACE writes, reference 7, mask 1", replaced_value),
    Demonstration("reference-is-written", "pixels with the new reference of glStencilFunc", reference_is_written),
    Demonstration("stencil-bits", "argument of setStencil; bits of the stencil buffer", stencil_bits),
    Demonstration("stencil-before-depth", "value where both tests fail (3: stencil first)", stencil_before_depth),
    Demonstration("stencil-write-mask", "default of the stencil write mask, 8 bits", stencil_write_mask),
    Demonstration("function-without-test", "pixels written after glStencilFunc alone", function_without_test),
)
