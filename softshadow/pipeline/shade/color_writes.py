"""Write the colours of spans into a buffer: rounded to its format, blended, under the colour mask.

Fragments are written one after the other: without blending, the last one of a pixel wins.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Format, Image
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.records import Spans
from softshadow.pipeline.shade.blend import (
    ALPHA,
    FOUR_BYTES,
    BlendOps,
    blend_float_fragment,
    blend_fragment,
    blend_ops,
    to_unorm8,
)
from softshadow.state import State

LARGEST_BYTE, INT32_END = np.float32(255), np.float32(2.0**31)
SMALLEST_NORMAL_HALF = np.float32(2.0**-14)
HALF_STEP, HALF_STEPS = np.float32(2.0**-24), np.float32(2.0**24)  # of smaller numbers; how many steps are 1
LARGEST_HALF, INFINITE = np.float32(65504), np.float32(np.inf)
KEPT_BY_HALVES = np.int32(~0x1FFF)  # of the bits of a float
GREEN, BLUE, UPPERMOST = np.int32(8), np.int32(16), np.int32(24)  # bits below the byte of a channel


def color_writer(state: State, color: Image) -> Callable[[Spans, np.ndarray], None]:
    """Return the function that writes colours (n, 4) of spans into a buffer, in order, blended as the state says."""
    if color.format.kind == "float":
        return _float_writer(state, color)
    mask = np.array(state.color.mask) & np.array(color.format.written)
    ops, cells = blend_ops(state.blend, color.format), color.cells
    blends = state.blend.enabled or state.blend.logic_enabled
    pixels, writable = as_pixels(cells), writable_bits(state, color)

    def write(spans: Spans, values: np.ndarray) -> None:
        place, colors = (spans.row, spans.left, spans.start), colors_to_bytes(values, color.format)
        if not blends:
            write_pixels(*place, as_pixels(colors), writable, pixels)
        elif is_additive(ops):
            as_pixels(colors)[:] &= writable
            add_bytes(*place, colors.reshape(-1), cells.reshape(len(cells), -1))
        else:
            blend_bytes(ops, *place, colors, mask, cells)

    return write


def _float_writer(state: State, color: Image) -> Callable[[Spans, np.ndarray], None]:
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


def writable_bits(state: State, color: Image) -> Any:
    """Return a pixel of 32 bits; the bits that the colour mask and the format of the buffer let through are set."""
    mask = np.array(state.color.mask) & np.array(color.format.written)
    return as_pixels(np.where(mask, np.uint8(255), np.uint8(0)))[()]


def as_pixels(cells: np.ndarray) -> np.ndarray:
    """Return cells (..., 4) of bytes as a view of numbers (...) of 32 bits, one per pixel."""
    pixels: np.ndarray = cells.view(np.uint32)[..., 0]
    return pixels


def colors_to_bytes(values: np.ndarray, format: Format) -> np.ndarray:
    """Return colours (n, 4) of fragments as bytes: `to_unorm8`, but 0 from 2**31 / 255 on.

    llvmpipe converts them to int32 before it clamps them; numbers that do not fit, infinity too, become the lowest
    integer (cvtps2dq; lp_bld_conv.c). A colour is infinite where its triangle's 1/w is 0. An alpha without room in the
    buffer, which only serves blending, is clamped first.
    """
    packed = np.empty(len(values), np.int32)
    pack_bytes(np.ascontiguousarray(values.T), packed)
    cells = packed.view(np.uint8).reshape(-1, 4)
    if format.base not in FOUR_BYTES:
        cells[:, ALPHA] = to_unorm8(values[:, ALPHA])
    return cells


@inlined
def byte_of(value):
    """Return one number as a byte, see `colors_to_bytes`."""
    scaled = value * LARGEST_BYTE
    scaled = scaled if scaled > ZERO else ZERO  # a maximum, NaN becomes 0; the last line has a minimum
    scaled = scaled if scaled < INT32_END else ZERO
    return np.int32(np.rint(scaled if scaled < LARGEST_BYTE else LARGEST_BYTE))


@kernel
def pack_bytes(columns, packed):
    """Write columns (4, n) as pixels (n,) of four bytes, red in the lowest.

    One number per pixel is written: with four bytes the loop is not vectorised and takes 11 times as long.
    """
    for n in range(columns.shape[1]):
        red, green, blue, alpha = columns[0, n], columns[1, n], columns[2, n], columns[3, n]
        low = byte_of(red) | byte_of(green) << GREEN
        packed[n] = low | byte_of(blue) << BLUE | byte_of(alpha) << UPPERMOST


def rounded_floats(values: np.ndarray) -> np.ndarray:
    """Return float32 numbers as bytes, one by one, as `colors_to_bytes` does."""
    rounded = np.empty(values.shape, np.uint8)
    round_floats(np.ascontiguousarray(values).reshape(-1), rounded.reshape(-1))
    return rounded


@kernel
def round_floats(values, rounded):
    """Write numbers (n,) as bytes."""
    for n in range(values.shape[0]):
        rounded[n] = byte_of(values[n])


@kernel
def write_pixels(rows, lefts, starts, colors, writable, pixels):
    """Write colours (n,) of 32 bits into `pixels` (H, pitch), where the bits of `writable` are set."""
    for r in range(rows.shape[0]):
        source = colors[starts[r] : starts[r + 1]]
        target = pixels[rows[r], lefts[r] : lefts[r] + source.shape[0]]
        for i in range(source.shape[0]):
            target[i] = (target[i] & ~writable) | (source[i] & writable)


@kernel
def write_floats(rows, lefts, starts, columns, mask, cells):
    """Write colours (4, n) into `cells` (H, pitch, 4) under the colour mask (4,)."""
    for r in range(rows.shape[0]):
        row, left = rows[r], lefts[r] - starts[r]
        for c in range(4):
            if mask[c]:
                for n in range(starts[r], starts[r + 1]):
                    cells[row, left + n, c] = columns[c, n]


def is_additive(ops: BlendOps) -> bool:
    """Return whether blending is the clamped sum of source and target, as for adding light."""
    factors = (ops.src_rgb, ops.dst_rgb, ops.src_alpha, ops.dst_alpha)
    equations = (ops.equation_rgb, ops.equation_alpha)
    return factors == (gl.GL_ONE,) * 4 and equations == (gl.GL_FUNC_ADD,) * 2 and not ops.logic_op


@kernel
def add_bytes(rows, lefts, starts, colors, cells):
    """Add channels (4 n,) to `cells` (H, 4 pitch), clamped; equal to `blend_bytes` where masked channels are 0."""
    for r in range(rows.shape[0]):
        source = colors[4 * starts[r] : 4 * starts[r + 1]]
        target = cells[rows[r], 4 * lefts[r] : 4 * lefts[r] + source.shape[0]]
        for i in range(source.shape[0]):
            target[i] = min(np.int32(target[i]) + np.int32(source[i]), np.int32(255))


@kernel
def blend_bytes(ops, rows, lefts, starts, colors, mask, cells):
    """Blend colours (n, 4) with `cells` (H, pitch, 4) of bytes under the colour mask (4,)."""
    for r in range(rows.shape[0]):
        for n in range(starts[r], starts[r + 1]):
            blend_fragment(ops, colors[n], mask, cells[rows[r], lefts[r] + n - starts[r]])


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
    sums = (ops.equation_rgb, ops.equation_alpha) == (gl.GL_FUNC_ADD,) * 2 and not ops.logic_op
    of_source = source in ((gl.GL_ONE,) * 2, (gl.GL_SRC_ALPHA,) * 2)
    return (
        sums and of_source and target in ((gl.GL_ONE,) * 2, (gl.GL_ONE_MINUS_SRC_ALPHA,) * 2) and not ops.single_channel
    )


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
