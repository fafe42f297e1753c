"""Texels that lie side by side are loaded together; the mixture is that of four texels, loaded one by one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.pipeline.fast.fragment_block import (
    FILTERED,
    FIRST,
    FRACTION,
    OFFSET,
    PITCH,
    SECOND,
    SIZE,
    T_AXIS,
    WHOLE_ROWS,
)
from softshadow.pipeline.fast.span_bytes import are_side_by_side, mix_bytes_of, mix_corners

WIDTH, HEIGHT, COUNT = 9, 7, 40


def row(start: np.uint64) -> slice:
    return slice(int(start), int(start) + COUNT)


@pytest.mark.interpreted
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_the_mixture_is_that_of_four_texels(seed, wraps):
    rng = np.random.default_rng(seed)
    texels = rng.integers(-(2**31), 2**31, WIDTH * HEIGHT, dtype=np.int32)
    whole = np.zeros(WHOLE_ROWS * SIZE, np.int32)
    s, t = rng.integers(0, WIDTH - 1, COUNT), rng.integers(0, HEIGHT - 1, COUNT)
    s[0], t[0] = WIDTH - 2, HEIGHT - 2  # the last two texels of the image are among them
    after, below = s + 1, rng.permutation(t + 1)
    if wraps:
        after[rng.integers(COUNT)] = 0
    x, y = rng.integers(0, 256, (2, COUNT), dtype=np.int32)
    whole[row(FIRST)], whole[row(SECOND)], whole[row(FRACTION)] = s, after, x
    whole[row(T_AXIS + FIRST)], whole[row(T_AXIS + SECOND)], whole[row(T_AXIS + FRACTION)] = t, below, y
    whole[row(OFFSET)], whole[row(PITCH)] = 0, WIDTH
    assert are_side_by_side(COUNT, whole) != wraps
    with np.errstate(over="ignore"):  # as the kernels do: 32 bits are all that is kept
        mix_corners(COUNT, texels, whole)
        upper, lower = (
            [mix_bytes_of(x[n], texels[j[n] * WIDTH + s[n]], texels[j[n] * WIDTH + after[n]]) for n in range(COUNT)]
            for j in (t, below)
        )
        assert whole[row(FILTERED)].tolist() == [mix_bytes_of(y[n], upper[n], lower[n]) for n in range(COUNT)]
