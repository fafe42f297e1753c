"""Clipping by planes, and the pyramid between a light and the near rectangle."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from softshadow.techniques.clipping import clip_to_planes, clip_triangles, pyramid_between
from strategies import coordinates

points = st.tuples(coordinates(-2, 2), coordinates(-2, 2), coordinates(-2, 2))
triangles = st.lists(st.tuples(points, points, points), min_size=1, max_size=5).map(np.array)
planes = st.tuples(points.filter(any), coordinates(-1, 1)).map(lambda p: np.array([*p[0], p[1]]))

# sums of products of numbers up to 4 in double precision, over a handful of pieces
ROUNDING = 1e-12


def areas(pieces: np.ndarray) -> np.ndarray:
    return np.cross(pieces[:, 1] - pieces[:, 0], pieces[:, 2] - pieces[:, 0]) / 2


@given(triangles, planes)
def test_the_two_sides_of_a_plane_make_up_the_whole(whole: np.ndarray, plane: np.ndarray) -> None:
    front, back = clip_triangles(whole, plane), clip_triangles(whole, -plane)
    lying_in_it = (whole @ plane[:3] + plane[3] == 0).all(axis=1)
    total = areas(whole).sum(axis=0) + areas(whole[lying_in_it]).sum(axis=0)
    assert np.allclose(areas(front).sum(axis=0) + areas(back).sum(axis=0), total, rtol=0, atol=ROUNDING)


@given(triangles, planes)
def test_what_is_kept_is_on_the_positive_side_and_turned_as_before(whole: np.ndarray, plane: np.ndarray) -> None:
    for triangle in whole:
        kept = clip_triangles(triangle[None], plane)
        assert (kept @ plane[:3] + plane[3] >= -ROUNDING).all()
        assert (areas(kept) @ areas(triangle[None])[0] >= -ROUNDING).all()


@given(points, points, points, points, planes)
def test_neighbours_share_the_cut_point_to_the_bit(a, b, c, d, plane) -> None:  # type: ignore[no-untyped-def]
    one, other = clip_triangles(np.array([[a, b, c]]), plane), clip_triangles(np.array([[b, a, d]]), plane)
    height = np.array([a, b]) @ plane[:3] + plane[3]
    if (height[0] >= 0) != (height[1] >= 0):
        inner, outer = (0, 1) if height[0] >= 0 else (1, 0)
        ends = np.array([a, b])
        cut = ends[inner] + height[inner] / (height[inner] - height[outer]) * (ends[outer] - ends[inner])
        for piece in (one, other):
            assert (piece.reshape(-1, 3) == cut).all(axis=1).any()


@given(points, st.sampled_from([0.0, 1.0]), st.floats(0.01, 0.99), st.floats(0.01, 0.99), st.floats(0.01, 0.99))
def test_the_pyramid_holds_the_segments_from_the_light_and_nothing_beyond(place, w, s, t, along) -> None:  # type: ignore[no-untyped-def]
    rectangle = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    light = np.array([place[0], place[1], place[2] + 3, w])  # above the rectangle
    target = np.array([2 * s - 1, 2 * t - 1, 0])
    bounds = pyramid_between(light, rectangle)
    direction = light[:3] - w * target
    tiny = np.array([[-1, -1, 0], [1, 0, 0], [0, 1, 0]]) * 1e-3
    assert len(clip_to_planes((target + along * direction + tiny)[None], bounds)) > 0
    assert len(clip_to_planes((target - (along + 0.01) * direction + tiny)[None], bounds)) == 0
    if w:
        assert len(clip_to_planes((light[:3] + (along + 0.01) * direction + tiny)[None], bounds)) == 0
