"""The vertex stage: the same in parts as in one piece, and the same as in NumPy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.geometry.clip import FRUSTUM, outcodes
from softshadow.pipeline.geometry.vertex import append_rows, process_vertices, to_clip, to_window
from softshadow.pipeline.memory import threads as pool
from softshadow.state import Viewport

pytestmark = pytest.mark.interpreted
VIEWPORT = Viewport(x=3, y=5, width=37, height=23, near=0.25, far=0.75)


def random_positions(rng: np.random.Generator, n: int, real: type) -> np.ndarray:
    """Return homogeneous positions inside, outside and on the frustum, some infinite, NaN, or with w near 0."""
    special = [0, 1, -1, np.inf, -np.inf, np.nan, 1e38, 1e-40]
    return np.where(rng.random((n, 4)) < 0.2, rng.choice(special, (n, 4)), rng.normal(0, 1, (n, 4))).astype(real)


@pytest.mark.parametrize("real", [np.float32, np.float64])
@given(seed=st.integers(0, 2**32 - 1), flipped=st.booleans(), clamp=st.booleans(), planes=st.integers(0, 3))
def test_vertices_in_parts_are_processed_as_all_at_once(real, seed, flipped, clamp, planes):
    rng = np.random.default_rng(seed)
    matrix, positions = rng.normal(0, 1, (4, 4)).astype(real), random_positions(rng, 20, real)
    user_planes = rng.normal(0, 1, (planes, 4)).astype(np.float32)
    before = threads()
    with np.errstate(all="ignore"), pytest.MonkeyPatch.context() as patch:
        patch.setattr(pool, "PART_SIZE", 7)
        set_threads(2)
        try:
            clip, codes, window = process_vertices(matrix, positions, user_planes, clamp, VIEWPORT, 40, flipped)
        finally:
            set_threads(before)
        expected = to_clip(matrix, positions)
        np.testing.assert_array_equal(clip.view(np.uint8), expected.view(np.uint8))
        np.testing.assert_array_equal(codes, outcodes(expected, clamp, user_planes))
        np.testing.assert_array_equal(window, to_window(expected, VIEWPORT, 40, flipped))


@given(seed=st.integers(0, 2**32 - 1), planes=st.integers(0, 3))
def test_a_vertex_has_a_bit_for_each_plane_that_it_is_not_inside_of(seed, planes):
    rng = np.random.default_rng(seed)
    clip = random_positions(rng, 20, np.float32)
    user_planes = rng.normal(0, 1, (planes, 4)).astype(np.float32)
    with np.errstate(all="ignore"):
        x, y, z, w = clip.T
        inside = [x <= w, x + w >= 0, y <= w, y + w >= 0, z + w >= 0, z <= w]
        inside += [((x * p[0] + y * p[1]) + z * p[2]) + w * p[3] >= 0 for p in user_planes]
        codes = outcodes(clip, False, user_planes)
    assert len(inside) == len(FRUSTUM) + planes
    np.testing.assert_array_equal(codes, sum((~test).astype(int) << bit for bit, test in enumerate(inside)))


@given(seed=st.integers(0, 2**32 - 1))
def test_window_positions_are_scaled_and_shifted_quotients_with_denormal_1_over_w_flushed(seed):
    clip = random_positions(np.random.default_rng(seed), 20, np.float32)
    with np.errstate(all="ignore"):
        window = to_window(clip, VIEWPORT, 40, False)
        over_w = np.float32(1) / clip[:, 3:]
        over_w = np.where(abs(over_w) < np.finfo(np.float32).tiny, np.float32(0), over_w)
        scale = np.array([18.5, 11.5, 0.25], np.float32)
        shift = np.array([21.5, 16.5, 0.5], np.float32)
        np.testing.assert_array_equal(window, np.hstack([(clip[:, :3] * over_w) * scale + shift, over_w]))


@pytest.mark.parametrize("n_rows", [0, 1, 2, 3])
def test_rows_are_appended(n_rows):
    positions = np.random.default_rng(0).normal(0, 1, (17, 4)).astype(np.float32)
    matrix = np.eye(4, dtype=np.float32)
    window = process_vertices(matrix, positions, np.empty((0, 4), np.float32), False, VIEWPORT, 40, False)[2]
    rows = np.arange(4 * n_rows, dtype=np.float32).reshape(n_rows, 4)
    expected = np.concatenate([window, rows])
    np.testing.assert_array_equal(append_rows(window, rows), expected)
