"""The depth of a triangle at a pixel, in the units of the depth buffer: one rule for every loop."""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF_RANGE, TWO
from softshadow.pixels import LARGEST_UINT


@inlined
def depth_at(z0, dz, dz_row, offset, column, row):
    """Return window z of a triangle's plane at a pixel, in this order of operations (docs/exactness.md, 5).

    `z0` is z at pixel (0, 0), `dz` and `dz_row` its steps to the next column and row, `offset` the polygon offset;
    `column` and `row` are numbers in the precision of depth.
    """
    return ((dz * column + z0) + dz_row * row) + offset


@kernel
def depth_units(z, depth_range, largest):
    """Return z clamped, in buffer units: fixed-point formats round half to even, float formats keep z.

    NaN, which a triangle has whose area is 0 before snapping, becomes the upper end, as with llvmpipe's minps. Of 32
    bits llvmpipe fills the upper 31, rounding down (lp_bld_conv.c).
    """
    z = z if z < depth_range.high else depth_range.high
    z = z if z > depth_range.low else depth_range.low
    if largest == LARGEST_UINT:
        return np.floor(z * HALF_RANGE) * TWO
    return np.rint(z * np.float32(largest)) if largest else z
