"""glPolygonMode: edges and corners of polygons, a mode for each facing, an offset for each mode."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.pipeline.geometry.assembly import assemble, edge_flags

pytestmark = pytest.mark.interpreted

SIZE = 16
LOW, HIGH = 4.5 / 8 - 1, 12.5 / 8 - 1  # on pixel centres
SQUARE = ((LOW, LOW), (HIGH, LOW), (HIGH, HIGH), (LOW, HIGH))


def draw_polygon(
    *calls: tuple[Any, ...], corners: Any = SQUARE, mode: int = gl.GL_QUADS, depth: bool = False
) -> np.ndarray:
    """Return the covered pixels of a polygon under some GL calls, or its depths; row 0 at the bottom."""
    with gl.create_context(SIZE, SIZE):
        gl.glEnable(gl.GL_DEPTH_TEST)
        for name, *arguments in calls:
            getattr(gl, name)(*arguments)
        gl.glBegin(mode)
        for corner in corners:
            gl.glVertex3f(*corner, 0)
        gl.glEnd()
        depths = gl.glReadPixels(0, 0, SIZE, SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    return depths if depth else depths < 1


@pytest.mark.parametrize("mode", [gl.GL_QUADS, gl.GL_QUAD_STRIP, gl.GL_POLYGON])
def test_the_outline_of_a_polygon_has_no_diagonal(mode):
    corners = SQUARE if mode != gl.GL_QUAD_STRIP else [SQUARE[i] for i in (0, 1, 3, 2)]
    covered = draw_polygon(("glPolygonMode", gl.GL_FRONT_AND_BACK, gl.GL_LINE), corners=corners, mode=mode)
    assert not covered[6:11, 6:11].any()
    assert covered.sum() == 4 * 8


@pytest.mark.parametrize("mode", [gl.GL_QUADS, gl.GL_QUAD_STRIP, gl.GL_POLYGON, gl.GL_TRIANGLE_FAN])
def test_edge_flags_mark_the_edges_of_the_primitives(mode):
    if mode == gl.GL_TRIANGLE_FAN:
        assert edge_flags(mode, 3).all()
        return
    clipped = np.ones(2, bool) if mode != gl.GL_POLYGON else None
    corners = assemble(mode, 8 if mode != gl.GL_QUAD_STRIP else 6, clipped).corners
    flags = edge_flags(mode, len(corners))
    edges = [
        frozenset((int(triangle[i]), int(triangle[(i + 1) % 3])))
        for triangle, triangle_flags in zip(corners, flags, strict=True)
        for i in range(3)
        if triangle_flags[i]
    ]
    expected = {
        gl.GL_QUADS: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)],
        gl.GL_QUAD_STRIP: [(0, 1), (1, 3), (3, 2), (2, 0), (2, 3), (3, 5), (5, 4), (4, 2)],
        gl.GL_POLYGON: [(i, (i + 1) % 8) for i in range(8)],
    }[mode]
    assert sorted(map(sorted, edges)) == sorted(map(sorted, expected))


def test_each_face_has_its_own_mode():
    modes = (("glPolygonMode", gl.GL_FRONT, gl.GL_POINT), ("glPolygonMode", gl.GL_BACK, gl.GL_LINE))
    assert draw_polygon(*modes).sum() == 4
    assert draw_polygon(*modes, corners=SQUARE[::-1]).sum() == 4 * 8


def test_a_culled_face_draws_no_lines():
    cull = (("glEnable", gl.GL_CULL_FACE), ("glPolygonMode", gl.GL_FRONT_AND_BACK, gl.GL_LINE))
    assert draw_polygon(*cull).any()
    assert not draw_polygon(*cull, corners=SQUARE[::-1]).any()


def test_cut_edges_are_drawn_along_user_planes_but_not_along_the_frustum():
    line = ("glPolygonMode", gl.GL_FRONT_AND_BACK, gl.GL_LINE)
    wide = [(4 * x, y) for x, y in SQUARE]
    covered = draw_polygon(line, corners=wide)
    assert not covered[6:11, [0, SIZE - 1]].any()
    cut = draw_polygon(line, ("glClipPlane", gl.GL_CLIP_PLANE0, [1, 0, 0, 0.05]), ("glEnable", gl.GL_CLIP_PLANE0))
    assert cut[6:11].any(axis=0).sum() == 2


@pytest.mark.parametrize("mode", ["LINE", "POINT"])
def test_each_mode_has_its_own_polygon_offset(mode):
    mode_call = ("glPolygonMode", gl.GL_FRONT_AND_BACK, getattr(gl, f"GL_{mode}"))
    offset = ("glPolygonOffset", 0, 1000)
    other = "POINT" if mode == "LINE" else "LINE"
    plain = draw_polygon(mode_call, offset, ("glEnable", getattr(gl, f"GL_POLYGON_OFFSET_{other}")), depth=True)
    moved = draw_polygon(mode_call, offset, ("glEnable", getattr(gl, f"GL_POLYGON_OFFSET_{mode}")), depth=True)
    assert set(np.unique(plain)) == {np.float32(8388608 / 16777215), np.float32(1)}
    assert moved.min() == pytest.approx(plain.min() + 2000 / 2**24, abs=2**-23)  # two steps a unit, rounded twice
