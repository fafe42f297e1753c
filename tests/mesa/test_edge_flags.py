"""Edge flags under glPolygonMode are Mesa's, from all kinds of draws; so is the provoking vertex of flat colours."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from softshadow import gl as softshadow_gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa
SIZE = (24, 24)
MODES = ("GL_LINES", "GL_LINE_LOOP", "GL_LINE_STRIP", "GL_TRIANGLES", "GL_TRIANGLE_STRIP", "GL_TRIANGLE_FAN",
         "GL_QUADS", "GL_QUAD_STRIP", "GL_POLYGON")  # fmt: skip
CONVENTIONS = ("GL_FIRST_VERTEX_CONVENTION", "GL_LAST_VERTEX_CONVENTION")
# an edge flag within an incomplete primitive of a list is no part of this
COMPLETE = {"GL_TRIANGLES": 3, "GL_QUADS": 4, "GL_QUAD_STRIP": 2}


def draw(gl: Any, rng: np.random.Generator, mode: str, how: str, with_flags: bool) -> None:
    """Draw a few random vertices with colours and, perhaps, edge flags."""
    n = int(rng.integers(4, 9)) // COMPLETE.get(mode, 1) * COMPLETE.get(mode, 1)
    spread = 0.9 if rng.random() < 0.7 else 1.5
    positions, colors = rng.uniform(-spread, spread, (n, 3)).astype(np.float32), rng.random((n, 3), np.float32)
    flags = (rng.random(n) < 0.6).astype(np.uint8)
    if how in ("immediate", "list"):
        if how == "list":
            gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(getattr(gl, mode))
        for position, color, flag in zip(positions.tolist(), colors.tolist(), flags.tolist(), strict=True):
            gl.glColor3f(*color)
            if with_flags:
                gl.glEdgeFlag(flag)
            gl.glVertex3f(*position)
        gl.glEnd()
        if how == "list":
            gl.glEndList()
            gl.glCallList(1)
        return
    arrays = [gl.GL_VERTEX_ARRAY, gl.GL_COLOR_ARRAY, *([gl.GL_EDGE_FLAG_ARRAY] if with_flags else [])]
    for array in arrays:
        gl.glEnableClientState(array)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions)
    gl.glColorPointer(3, gl.GL_FLOAT, 0, colors)
    if with_flags:
        gl.glEdgeFlagPointer(0, flags)
    if how == "arrays":
        gl.glDrawArrays(getattr(gl, mode), 0, n)
    else:
        indices = rng.integers(0, n, n) if rng.random() < 0.5 else np.arange(n)
        gl.glDrawElements(getattr(gl, mode), n, gl.GL_UNSIGNED_SHORT, indices.astype(np.uint16))
    for array in arrays:
        gl.glDisableClientState(array)


def picture(seed: int, how: str, with_flags: bool, conventions: tuple[str, ...]) -> Callable[[Any], np.ndarray]:
    """Return a program that draws four primitives with random polygon modes, offsets, stipples and culling.

    With a display list it draws one: Mesa culls unfilled polygons of lists by edge flags of earlier draws, too.
    """

    def program(gl: Any) -> np.ndarray:
        rng = np.random.default_rng(seed)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glEnable(gl.GL_DEPTH_TEST)
        for _ in range(1 if how == "list" else 4):
            gl.glProvokingVertex(getattr(gl, str(rng.choice(conventions))))
            gl.glShadeModel(gl.GL_FLAT if rng.random() < 0.5 else gl.GL_SMOOTH)
            gl.glPolygonMode(gl.GL_FRONT, int(rng.choice((gl.GL_POINT, gl.GL_LINE, gl.GL_FILL))))
            gl.glPolygonMode(gl.GL_BACK, int(rng.choice((gl.GL_POINT, gl.GL_LINE, gl.GL_FILL))))
            for cap in (gl.GL_POLYGON_OFFSET_LINE, gl.GL_CULL_FACE, gl.GL_LINE_STIPPLE):
                (gl.glEnable if rng.random() < 0.3 else gl.glDisable)(cap)
            gl.glPolygonOffset(1, 2)
            gl.glLineStipple(1, 0x0F0F)
            gl.glEdgeFlag(rng.random() < 0.7)
            gl.glPushAttrib(gl.GL_CURRENT_BIT | gl.GL_LIGHTING_BIT)
            if rng.random() < 0.3:
                gl.glEdgeFlag(False)
                gl.glProvokingVertex(gl.GL_FIRST_VERTEX_CONVENTION)
            gl.glPopAttrib()
            draw(gl, rng, str(rng.choice(MODES)), how, with_flags)
        names = (gl.GL_PROVOKING_VERTEX, gl.GL_EDGE_FLAG, gl.GL_QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION)
        return np.array([int(gl.glGetIntegerv(name)) for name in names])

    return program


@pytest.mark.parametrize("how", ["immediate", "list", "arrays", "elements"])
def test_edges_with_false_flags_are_left_out_as_by_mesa(how: str) -> None:
    for seed in range(3):
        compared = compare(picture(seed, how, True, CONVENTIONS[1:]), SIZE)
        assert compared, f"seed {seed}: {compared}"


@pytest.mark.parametrize("how", ["immediate", "elements"])
def test_the_first_vertex_provokes_as_in_mesa(how: str) -> None:
    for seed in range(3):
        compared = compare(picture(100 + seed, how, False, CONVENTIONS[:1]), SIZE)
        assert compared, f"seed {seed}: {compared}"


@pytest.mark.slow
@pytest.mark.parametrize("how", ["immediate", "list", "arrays", "elements"])
@pytest.mark.parametrize("with_flags", [False, True])
def test_many_pictures_with_edge_flags_and_both_conventions_are_those_of_mesa(how: str, with_flags: bool) -> None:
    for seed in range(200, 300):
        compared = compare(picture(seed, how, with_flags, CONVENTIONS), SIZE)
        assert compared, f"seed {seed}: {compared}"


def test_a_byte_that_is_not_1_is_no_edge() -> None:
    def program(gl: Any) -> None:
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_EDGE_FLAG_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float32) * 0.8)
        gl.glEdgeFlagPointer(0, np.array([1, 2, 255, 1], np.uint8))
        gl.glDrawArrays(gl.GL_QUADS, 0, 4)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    drawn = compared.ours.color[..., 0] > 0
    assert drawn[1:-1, :4].any()
    assert not drawn[4:-4, -4:].any()


def test_the_provoking_vertex_gives_the_colour_of_a_flat_triangle() -> None:
    gl, colors = softshadow_gl, {}
    for convention in CONVENTIONS:
        with gl.create_context(8, 8):
            gl.glShadeModel(gl.GL_FLAT)
            gl.glProvokingVertex(getattr(gl, convention))
            gl.glBegin(gl.GL_TRIANGLES)
            for color, corner in (((1, 0, 0), (-1, -1)), ((0, 1, 0), (3, -1)), ((0, 0, 1), (-1, 3))):
                gl.glColor3f(*color)
                gl.glVertex2f(*corner)
            gl.glEnd()
            colors[convention] = gl.glReadPixels(4, 4, 1, 1, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)[0, 0].tolist()
    assert colors == {"GL_FIRST_VERTEX_CONVENTION": [255, 0, 0], "GL_LAST_VERTEX_CONVENTION": [0, 0, 255]}
