"""Per-fragment operations as numbers; equals `raster.fragment_ops.process_fragment`, see fast/test_any_state.py.

A loop over pixels that asks at every pixel which comparison or which stencil operation it is cannot be vectorised. So
both become numbers, once per draw, and one loop serves all states. A comparison is three or four masks: its results for
less, equal and greater, and for NaN, which is none of these. A stencil operation is ``(s & keep) ^ flip`` and a step up
or down, with the value where it stops.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from softshadow.jit import kernel, read_only
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import (
    ALWAYS,
    CLEAR,
    DECR,
    DECR_WRAP,
    INCR,
    INCR_WRAP,
    KEEP,
    REPLACE,
    FragmentOps,
    compare,
)  # fmt: skip
from softshadow.pipeline.records import BACK, FRONT

ALL, NONE = np.uint8(255), np.uint8(0)  # masks of bytes
# columns of `numbers_of`: where these numbers begin; behind them as they were, for whole tiles
DEPTH_TEST, DEPTH_WRITE, STENCIL_TEST, REF, READ, WRITE, LARGEST, SFAIL, ZFAIL, ZPASS = (
    0,
    4,
    5,
    8,
    9,
    10,
    11,
    12,
    17,
    22,
)
DEPTH_FUNC, ZFAIL_OP, ZPASS_OP, UNMASKED_REF = 27, 28, 29, 30
COLUMNS = 31


class DepthTest(NamedTuple):
    """The depth test's result where z is less than the stored depth, equal, greater, or one is NaN: int32, -1 or 0."""

    less: np.int32
    equal: np.int32
    greater: np.int32
    unordered: np.int32


class StencilTest(NamedTuple):
    """The stencil test's result where the masked reference value is less, equal or greater: uint8, 255 or 0."""

    less: np.uint8
    equal: np.uint8
    greater: np.uint8


class Update(NamedTuple):
    """One stencil operation, done once or several times: five uint8.

    ``(s & keep) ^ flip``, then up by `up` as far as the largest value, down by `down` as far as 0, then plus `step`
    modulo 2**bits.
    """

    keep: np.uint8
    flip: np.uint8
    up: np.uint8
    down: np.uint8
    step: np.uint8


def _plainly(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a kernel as plain Python: to compile it would take longer than all calls."""
    plain: Callable[..., Any] = getattr(function, "py_func", function)
    return plain


@lru_cache(maxsize=256)
def numbers_of(front: FragmentOps, back: FragmentOps) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of both facings, (2, COLUMNS) in row BACK and row FRONT: as int32, and their lowest bytes.

    Bytes that a kernel cuts out of larger numbers make the compiler compute with larger numbers.
    """
    numbers = np.zeros((2, COLUMNS), np.int32)
    for facing, ops in ((FRONT, front), (BACK, back)):
        says, updates = _plainly(compare), _plainly(update_of)
        pairs = ((1.0, 2.0), (1.0, 1.0), (2.0, 1.0), (np.nan, np.nan))
        ref, largest = ops.ref, ops.stencil_largest
        depth_func = ops.depth_func if ops.depth_test else ALWAYS
        stencil_func = ops.stencil_func if ops.stencil_test else ALWAYS
        stencil_ops = (ops.sfail, ops.zfail, ops.zpass) if ops.stencil_test else (KEEP, KEEP, KEEP)
        write_mask = 0 if set(stencil_ops) == {KEEP} else ops.write_mask  # 0 also says that no stencil value changes
        numbers[facing] = (
            *(-int(says(depth_func, *pair)) for pair in pairs), ops.depth_write,
            *(255 * says(stencil_func, *pair) for pair in pairs[:3]),
            ref & ops.read_mask, ops.read_mask, write_mask, largest,
            *(number for op in stencil_ops for number in updates(op, 1, ref, largest)),
            depth_func, *stencil_ops[1:], ref,
        )  # fmt: skip
    return read_only(numbers), read_only(numbers.astype(np.uint8))


@kernel
def update_of(op, n, ref, largest):
    """Return `n` updates by a stencil operation, n > 0, as numbers; of GL_INCR_WRAP, n may be negative, too."""
    if op == KEEP:
        return Update(ALL, NONE, NONE, NONE, NONE)
    if op == CLEAR:
        return Update(NONE, NONE, NONE, NONE, NONE)
    if op == REPLACE:
        return Update(NONE, np.uint8(ref), NONE, NONE, NONE)
    if op == INCR:
        return Update(ALL, NONE, np.uint8(min(n, 255)), NONE, NONE)
    if op == DECR:
        return Update(ALL, NONE, NONE, np.uint8(min(n, 255)), NONE)
    if op == INCR_WRAP:
        return Update(ALL, NONE, NONE, NONE, np.uint8(n & 255))
    if op == DECR_WRAP:
        return Update(ALL, NONE, NONE, NONE, np.uint8(-n & 255))
    return Update(ALL, np.uint8(largest if n & 1 else 0), NONE, NONE, NONE)


@kernel
def depth_test_of(numbers, f):
    """Return the depth test of facing `f`."""
    return DepthTest(
        numbers[f, DEPTH_TEST], numbers[f, DEPTH_TEST + 1], numbers[f, DEPTH_TEST + 2], numbers[f, DEPTH_TEST + 3]
    )


@kernel
def stencil_test_of(numbers, f):
    """Return the stencil test of facing `f`; `numbers` are bytes."""
    return StencilTest(numbers[f, STENCIL_TEST], numbers[f, STENCIL_TEST + 1], numbers[f, STENCIL_TEST + 2])


@kernel
def stencil_update_of(numbers, f, which):
    """Return one of the stencil operations of facing `f`: SFAIL, ZFAIL or ZPASS; `numbers` are bytes."""
    return Update(
        numbers[f, which], numbers[f, which + 1], numbers[f, which + 2], numbers[f, which + 3], numbers[f, which + 4]
    )  # fmt: skip


@kernel
def depth_of(z0, dz, dz_row, offset, column, row, depth_range, largest):
    """Return the depth of a plane at a pixel, in buffer units; `column` and `row` are float32.

    Loops over the columns of a chunk add two floats, its first column and the place in it. The sum is exact. With sums
    of integers, the compiler puts each vector of columns together from single numbers.
    """
    return depth_units(depth_at(z0, dz, dz_row, offset, column, row), depth_range, largest)


@kernel
def depth_passes(test, z, stored):
    """Return -1 where a depth passes the depth test, else 0."""
    result = test.less if z < stored else test.unordered
    result = test.equal if z == stored else result
    return test.greater if z > stored else result


@kernel
def stencil_passes(test, ref, s):
    """Return 255 where a masked stencil value passes the stencil test, else 0."""
    result = test.less if ref < s else test.equal
    return test.greater if ref > s else result


@kernel
def updated(update, s, largest):
    """Return the stencil value after an update; all numbers are bytes, so that a vector has 32 of them."""
    s = np.uint8(np.uint8(s & update.keep) ^ update.flip)
    s = np.uint8(s + min(np.uint8(largest - s), update.up))
    s = np.uint8(s - min(s, update.down))
    return np.uint8(np.uint8(s + update.step) & largest)
