"""What a chain of edges winds around, cut into triangles."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from softshadow.techniques.plane_sweep import triangulate_nonzero

# products of numbers up to 8 in double precision, over some hundred triangles; levels within 1e-12 of the range are
# taken for one, and a strip between them may be lost
ROUNDING = 1e-9

points = st.tuples(st.integers(0, 8), st.integers(0, 8))
loops = st.lists(st.lists(points, min_size=3, max_size=7), min_size=1, max_size=3)


def chain_of(polygons: list) -> np.ndarray:
    return np.array(
        [(a, b) for polygon in polygons for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True)], float
    )


def areas(triangles: np.ndarray) -> np.ndarray:
    (ux, uy), (vx, vy) = (triangles[:, 1] - triangles[:, 0]).T, (triangles[:, 2] - triangles[:, 0]).T
    return (ux * vy - uy * vx) / 2


def winding(chain: np.ndarray, x: float, y: float) -> int:
    """Return how often a chain winds around a point, by the edges that cross the ray to the right of it."""
    total = 0
    for (ax, ay), (bx, by) in chain:
        if (ay > y) != (by > y) and ax + (y - ay) / (by - ay) * (bx - ax) > x:
            total += 1 if by > ay else -1
    return total


def holds(triangles: np.ndarray, x: float, y: float) -> int:
    """Return how many triangles hold a point."""
    a = triangles
    b = np.roll(triangles, -1, axis=1)
    left = (b[..., 0] - a[..., 0]) * (y - a[..., 1]) - (b[..., 1] - a[..., 1]) * (x - a[..., 0])
    return int((left > 0).all(axis=1).sum())


@given(loops, st.integers(0, 10**6))
def test_a_point_is_covered_once_where_the_chain_winds_around_it_and_not_elsewhere(polygons: list, seed: int) -> None:
    chain = chain_of(polygons)
    triangles = triangulate_nonzero(chain, 0, 8)
    assert (areas(triangles) >= -ROUNDING).all()
    for x, y in np.random.default_rng(seed).uniform(0, 8, (20, 2)):  # on no edge, almost surely
        assert holds(triangles, x, y) == (winding(chain, x, y) != 0)


@given(loops, st.integers(0, 8), st.integers(0, 8))
def test_the_part_between_two_levels_is_cut_out(polygons: list, one: int, other: int) -> None:
    low, high = sorted((one, other))
    chain = chain_of(polygons)
    parts = [areas(triangulate_nonzero(chain, a, b)).sum() for a, b in ((0, low), (low, high), (high, 8)) if a < b]
    assert abs(sum(parts) - areas(triangulate_nonzero(chain, 0, 8)).sum()) <= ROUNDING


@given(loops)
def test_turning_every_loop_round_covers_the_same(polygons: list) -> None:
    turned = [polygon[::-1] for polygon in polygons]
    assert (
        abs(
            areas(triangulate_nonzero(chain_of(polygons), 0, 8)).sum()
            - areas(triangulate_nonzero(chain_of(turned), 0, 8)).sum()
        )
        <= ROUNDING
    )


def test_a_hole_that_runs_the_other_way_stays_open() -> None:
    square, hole = [(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (1, 3), (3, 3), (3, 1)]
    assert areas(triangulate_nonzero(chain_of([square, hole]), 0, 4)).sum() == 16 - 4
    assert areas(triangulate_nonzero(chain_of([square, hole[::-1]]), 0, 4)).sum() == 16


def test_triangles_share_all_corners_on_a_level() -> None:
    # the notch from above ends on the level where the lower half is whole: its corner must be one of the lower half
    notched = [(0, 0), (6, 0), (6, 4), (4, 4), (3, 2), (2, 4), (0, 4)]
    triangles = triangulate_nonzero(chain_of([notched]), 0, 4)
    below = triangles[triangles[:, :, 1].min(axis=1) < 2].reshape(-1, 2).tolist()
    assert [3.0, 2.0] in below


def test_an_empty_chain_covers_nothing() -> None:
    assert triangulate_nonzero(np.zeros((0, 2, 2)), 0, 1).shape == (0, 3, 2)
