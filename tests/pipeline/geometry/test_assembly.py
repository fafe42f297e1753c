"""Primitive assembly in GL's order."""

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.pipeline.geometry.assembly import assemble
from softshadow.pipeline.mesa.segments import in_clipped_segment


@pytest.mark.parametrize(
    ("mode", "n_vertices", "corners", "provoking"),
    [
        (gl.GL_TRIANGLES, 7, [[0, 1, 2], [3, 4, 5]], [2, 5]),
        (gl.GL_TRIANGLE_STRIP, 5, [[0, 1, 2], [2, 1, 3], [2, 3, 4]], [2, 3, 4]),
        (gl.GL_TRIANGLE_FAN, 5, [[0, 1, 2], [0, 2, 3], [0, 3, 4]], [2, 3, 4]),
        (gl.GL_QUADS, 9, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], [3, 3, 7, 7]),
        (gl.GL_QUAD_STRIP, 7, [[0, 1, 3], [2, 0, 3], [2, 3, 5], [4, 2, 5]], [3, 3, 5, 5]),
        (gl.GL_POLYGON, 5, [[1, 2, 0], [2, 3, 0], [3, 4, 0]], [0, 0, 0]),
    ],
)
def test_vertices_make_triangles_in_the_order_of_the_specification(mode, n_vertices, corners, provoking):
    triangles = assemble(mode, n_vertices)
    assert triangles.corners.tolist() == corners
    assert triangles.provoking.tolist() == provoking


def test_quads_of_a_clipped_segment_are_cut_along_the_other_diagonal():
    outside = np.zeros(12, bool)
    outside[9] = True
    assert in_clipped_segment(gl.GL_QUADS, outside, None).tolist() == [True] * 3
    triangles = assemble(gl.GL_QUADS, 8, np.array([False, True]))
    assert triangles.corners.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 7], [5, 6, 7]]


def test_vertices_that_complete_no_quad_do_not_clip_a_segment():
    outside = np.array([False] * 4 + [True])
    assert in_clipped_segment(gl.GL_QUADS, outside, None).tolist() == [False]


def test_segments_end_after_4096_vertices():
    outside = np.zeros(8192, bool)
    outside[4096] = True
    clipped = in_clipped_segment(gl.GL_QUADS, outside, None)
    assert clipped.tolist() == [False] * 1024 + [True] * 1024


@pytest.mark.parametrize(
    ("mode", "n_vertices", "outside", "clipped"),
    [
        (gl.GL_TRIANGLES, 8192, 4096, [False] * 1365 + [True] * 1365),  # 4095 vertices: whole triangles
        (gl.GL_TRIANGLE_STRIP, 8192, 5000, [False] * 4094 + [True] * 4094 + [False] * 2),
        (gl.GL_TRIANGLE_STRIP, 8192, 4095, [True] * 8188 + [False] * 2),  # two segments share it
        (gl.GL_TRIANGLE_FAN, 4096, 4000, [True] * 4094),
        (gl.GL_TRIANGLE_FAN, 5000, 1025, [False] * 1022 + [True] * 1022 + [False] * 2954),
        (gl.GL_POLYGON, 5000, 0, [True] * 4998),  # the first vertex is in all
    ],
)
def test_segments_of_triangles(mode, n_vertices, outside, clipped):
    needs_clipping = np.zeros(n_vertices, bool)
    needs_clipping[outside] = True
    assert in_clipped_segment(mode, needs_clipping, None).tolist() == clipped


def test_a_short_range_of_indices_includes_vertices_that_no_index_names():
    outside = np.array([False] * 4 + [True] + [False] * 4)
    assert in_clipped_segment(gl.GL_QUADS, outside, np.array([0, 1, 2, 3, 5, 6, 7, 8, 0, 1, 2, 3])).all()
    assert not in_clipped_segment(gl.GL_QUADS, outside, np.array([0, 1, 2, 8])).any()


@pytest.mark.parametrize("mode", range(gl.GL_TRIANGLES, gl.GL_POLYGON + 1))
@pytest.mark.parametrize("n_vertices", [0, 1, 2])
def test_too_few_vertices_make_no_triangle(mode, n_vertices):
    assert len(assemble(mode, n_vertices).corners) == 0
