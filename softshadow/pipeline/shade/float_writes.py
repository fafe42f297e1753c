"""Write colours into a buffer of floats or half floats: blended, under the colour mask, each half float truncated."""

from collections.abc import Callable

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.records import Spans
from softshadow.pipeline.shade.blend import ALPHA, BlendOps, blend_float_fragment, blend_ops
from softshadow.state import State

# factors of RGB and alpha, see `is_weighted_sum`
SOURCE_WEIGHTS = ((gl.GL_ONE,) * 2, (gl.GL_SRC_ALPHA,) * 2)
TARGET_WEIGHTS = ((gl.GL_ONE,) * 2, (gl.GL_ONE_MINUS_SRC_ALPHA,) * 2)
SMALLEST_NORMAL_HALF = np.float32(2.0**-14)
HALF_STEP, HALF_STEPS = np.float32(2.0**-24), np.float32(2.0**24)  # of smaller numbers; how many steps are 1
LARGEST_HALF, INFINITE = np.float32(65504), np.float32(np.inf)
KEPT_BY_HALVES = np.int32(~0x1FFF)  # of the bits of a float


def float_writer(state: State, color: Image) -> Callable[[Spans, np.ndarray], None]:
    """Return the function that writes colours into a buffer of floats or half floats, which have no logic operations.

    Where one is enabled, colours are written as they are.
    """
    mask = np.array(state.color.mask) & np.array(color.format.written)
    ops, cells, is_half = blend_ops(state.blend, color.format), color.cells, color.format.encoding == "half"
    blends = state.blend.enabled and not state.blend.logic_enabled

    def write(spans: Spans, values: np.ndarray) -> None:
        place, columns = (spans.row, spans.left, spans.start), np.ascontiguousarray(values.T, np.float32)
        if not blends:
            write_floats(*place, halves_of(columns) if is_half else columns, mask, cells)
        elif is_weighted_sum(ops):
            add_weighted(*place, columns, mask, ops.src_rgb != gl.GL_ONE, ops.dst_rgb != gl.GL_ONE, is_half, cells)
        else:
            blend_floats(ops, *place, columns, mask, is_half, cells)

    return write


def halves_of(values: np.ndarray) -> np.ndarray:
    """Return float32 numbers (c, n) with the precision of half floats, as `texel_codes.as_halves`, truncated."""
    halves = np.empty_like(values)
    truncate_all(values.reshape(-1), halves.reshape(-1))
    return halves


@kernel
def write_floats(rows, lefts, starts, columns, mask, cells):
    """Write colours (4, n) into `cells` (H, pitch, 4) under the colour mask (4,)."""
    for r in range(rows.shape[0]):
        row, left = rows[r], lefts[r] - starts[r]
        for c in range(4):
            if mask[c]:
                for n in range(starts[r], starts[r + 1]):
                    cells[row, left + n, c] = columns[c, n]


@kernel
def blend_floats(ops, rows, lefts, starts, columns, mask, is_half, cells):
    """Blend colours (4, n) with `cells` (H, pitch, 4) of float32 under the colour mask (4,).

    Where they stand for half floats, each result is truncated, as in llvmpipe.
    """
    for r in range(rows.shape[0]):
        for n in range(starts[r], starts[r + 1]):
            target = cells[rows[r], lefts[r] + n - starts[r]]
            blend_float_fragment(ops, columns[:, n], mask, target)
            if is_half:
                for c in range(4):
                    target[c] = truncated_to_half(target[c])


def is_weighted_sum(ops: BlendOps) -> bool:
    """Return whether blending adds source and target, each as it is or weighted by the source's alpha.

    The source's weight is 1 or alpha, the target's 1 or 1 - alpha.
    """
    source, target = (ops.src_rgb, ops.src_alpha), (ops.dst_rgb, ops.dst_alpha)
    is_sum = (ops.equation_rgb, ops.equation_alpha) == (gl.GL_FUNC_ADD,) * 2 and not ops.logic_op
    return is_sum and source in SOURCE_WEIGHTS and target in TARGET_WEIGHTS and not ops.single_channel


@kernel
def add_weighted(rows, lefts, starts, columns, mask, weighs_source, weighs_target, is_half, cells):
    """Add colours (4, n) to `cells` (H, pitch, 4), weighted or not; equal to `blend_floats` for `is_weighted_sum`."""
    for r in range(rows.shape[0]):
        row, left = rows[r], lefts[r] - starts[r]
        for c in range(4):
            if mask[c]:
                for n in range(starts[r], starts[r + 1]):
                    alpha = columns[ALPHA, n]
                    source = columns[c, n] * (alpha if weighs_source else ONE)
                    total = source + cells[row, left + n, c] * (ONE - alpha if weighs_target else ONE)
                    cells[row, left + n, c] = truncated_to_half(total) if is_half else total


@inlined
def truncated_to_half(value):
    """Return a float32 with the precision of a half float, as `texel_codes.as_halves`; loops of it have no branches."""
    size = abs(value)
    half = np.int32(np.float32(value).view(np.int32) & KEPT_BY_HALVES).view(np.float32)
    half = np.trunc(value * HALF_STEPS) * HALF_STEP if size < SMALLEST_NORMAL_HALF else half
    largest = LARGEST_HALF if value > ZERO else -LARGEST_HALF
    half = largest if size > LARGEST_HALF else half
    return half if size < INFINITE else value  # infinity and NaN stay


@kernel
def truncate_all(values, halves):
    """Write numbers (n,) with the precision of half floats."""
    for n in range(values.shape[0]):
        halves[n] = truncated_to_half(values[n])
