"""Clipping: the pieces are inside and cover the same as the triangle; triangles inside keep their vertices."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.pipeline.geometry.clip import FRUSTUM, Clipped, clip_triangles, outcodes

pytestmark = pytest.mark.interpreted

NO_PLANES = np.empty((0, 4), np.float32)
# a new vertex is interpolated in float32 and rounded: it may miss its plane by a few last places of the two ends
LAST_PLACES = 8 * np.finfo(np.float32).eps


def clip_one(clip: np.ndarray, depth_clamp: bool = False, planes: np.ndarray = NO_PLANES) -> Clipped:
    values = np.eye(3, dtype=np.float32)  # barycentric coordinates of the vertices
    codes = outcodes(clip, depth_clamp, planes)
    return clip_triangles(clip, values, np.array([[0, 1, 2]], np.int32), codes, planes)


def random_clip(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    clip = rng.normal(0, 1, (3, 4)).astype(np.float32)
    clip[:, 3] = rng.choice(np.float32([1, 1, 2, -1, 0, 0.01]), 3)
    return clip


@given(st.integers(0, 2**32 - 1))
def test_pieces_lie_inside_the_frustum(seed):
    clip = random_clip(seed)
    clipped = clip_one(clip)
    corners = clipped.clip[clipped.triangles.ravel()]
    assert (corners @ FRUSTUM.T >= -LAST_PLACES * np.abs(clip).max()).all()


@given(st.integers(0, 2**32 - 1))
def test_values_are_interpolated_like_positions(seed):
    clip = random_clip(seed)
    clipped = clip_one(clip)
    vertices = np.unique(clipped.triangles)
    np.testing.assert_allclose(
        clipped.values[vertices] @ clip, clipped.clip[vertices], atol=6 * LAST_PLACES * np.abs(clip).max()
    )


@given(st.integers(0, 2**32 - 1))
def test_a_point_of_the_triangle_inside_the_frustum_is_in_one_piece(seed):
    rng = np.random.default_rng(seed)
    clip = random_clip(seed)
    clipped = clip_one(clip)
    weights = rng.dirichlet(np.ones(3))
    margin = (weights @ clip @ FRUSTUM.T).min()
    if abs(margin) < 1e-3:  # nearer to a plane, rounding decides
        return
    n_pieces = 0
    for piece in clipped.triangles:
        try:
            piece_weights = np.linalg.solve(clipped.values[piece].T.astype(np.float64), weights)
        except np.linalg.LinAlgError:
            continue
        if np.abs(piece_weights).min() < 1e-4 and margin > 0:  # on the seam between two pieces
            return
        n_pieces += (piece_weights >= 0).all()
    assert n_pieces == (margin > 0)


@given(st.integers(0, 2**32 - 1))
def test_a_triangle_inside_keeps_its_vertices_unchanged(seed):
    clip = random_clip(seed)
    clip[:, 3] = np.abs(clip[:, :3]).max() + 1
    clipped = clip_one(clip)
    assert clipped.clip is clip
    assert clipped.triangles.tolist() == [[0, 1, 2]]


def test_vertices_on_the_boundary_are_inside():
    clip = np.array([[-1, -1, -1, 1], [1, -1, 1, 1], [-1, 1, 0, 1]], np.float32)
    assert clip_one(clip).triangles.tolist() == [[0, 1, 2]]


def test_a_triangle_outside_one_plane_is_dropped():
    clip = np.array([[2, 0, 0, 1], [3, 0, 0, 1], [2, 1, 0, 1]], np.float32)
    assert len(clip_one(clip).triangles) == 0


def test_vertices_behind_the_eye_and_at_infinity_are_outside():
    clip = np.array([[0, 0, 0, -1], [1, 0, 0, 0], [0, 1, -1, 0]], np.float32)
    assert len(clip_one(clip).triangles) == 0


def test_with_depth_clamp_near_and_far_do_not_clip():
    clip = np.array([[0, 0, -3, 1], [0.5, 0, 3, 1], [0, 0.5, 0, 1]], np.float32)
    assert clip_one(clip, depth_clamp=True).triangles.tolist() == [[0, 1, 2]]
    assert len(clip_one(clip).clip) > 3


def test_a_user_plane_cuts_like_a_frustum_plane():
    clip = np.array([[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.5, 0, 1]], np.float32)
    clipped = clip_one(clip, planes=np.array([[1, 0, 0, 0]], np.float32))
    assert (clipped.clip[clipped.triangles.ravel(), 0] >= 0).all()


def test_source_is_the_triangle_of_each_piece():
    clip = np.array(
        [[0, 0, 0, 1], [3, 0, 0, 1], [0, 3, 0, 1], [5, 5, 0, 1], [0.1, 0, 0, 1], [0, 0.1, 0, 1]], np.float32
    )
    triangles = np.array([[0, 4, 5], [1, 3, 2], [0, 1, 2]], np.int32)
    clipped = clip_triangles(clip, np.empty((6, 0), np.float32), triangles, outcodes(clip, False, NO_PLANES), NO_PLANES)
    assert clipped.source[0] == 0
    assert set(clipped.source) <= {0, 1, 2}
    assert (np.diff(clipped.source) >= 0).all()


@pytest.mark.parametrize("column", range(4))
def test_a_vertex_with_nan_is_outside(column):
    vertex = np.array([[0.1, 0.2, 0.3, 1.0]], np.float32)
    assert outcodes(vertex, False, NO_PLANES)[0] == 0
    vertex[0, column] = np.nan
    assert outcodes(vertex, False, NO_PLANES)[0] != 0
