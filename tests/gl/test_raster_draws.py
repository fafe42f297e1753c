"""Quads in window coordinates: one of them, and many."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.gl.raster_draws import MARGIN, corners, positions

SIZE = (40, 30)
WHOLE = st.integers(-2 * MARGIN, 2 * MARGIN).map(float)
SINGLE = st.floats(-1000, 1000, width=32) | st.floats(width=32, allow_nan=False, allow_infinity=False)
EDGES = st.tuples(WHOLE, WHOLE, WHOLE, WHOLE) | st.tuples(*[WHOLE | SINGLE] * 4)


@pytest.mark.parametrize("real", [np.float32, np.float64])
@given(edges=EDGES)
def test_the_corners_of_one_quad_are_those_that_many_have(real, edges):
    left, bottom, right, top = edges
    with np.errstate(over="ignore"):  # of the largest numbers
        one, many = corners(left, bottom, right, top, SIZE, real), positions(np.array([edges], np.float32), SIZE, real)
    np.testing.assert_array_equal(one, many)
    assert one.dtype == many.dtype == real
