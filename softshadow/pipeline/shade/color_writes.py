"""Write the colours of spans into a buffer: rounded to its format, blended, under the colour mask.

Fragments are written one after the other: without blending, the last one of a pixel wins.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Format, Image
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ZERO
from softshadow.pipeline.records import Spans
from softshadow.pipeline.shade.blend import (
    ALPHA,
    FOUR_BYTES,
    BlendOps,
    blend_fragment,
    blend_ops,
    to_unorm8,
)
from softshadow.pipeline.shade.float_writes import float_writer
from softshadow.state import State

LARGEST_BYTE, INT32_END = np.float32(255), np.float32(2.0**31)
GREEN, BLUE, UPPERMOST = np.int32(8), np.int32(16), np.int32(24)  # bits below the byte of a channel


def color_writer(state: State, color: Image) -> Callable[[Spans, np.ndarray], None]:
    """Return the function that writes colours (n, 4) of spans into a buffer, in order, blended as the state says."""
    if color.format.kind == "float":
        return float_writer(state, color)
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


def writable_bits(state: State, color: Image) -> Any:
    """Return a pixel of 32 bits; the bits that the colour mask and the format of the buffer let through are set."""
    return _writable_bits(state.color.mask, color.format.written)


@cache
def _writable_bits(mask: tuple[bool, ...], written: tuple[bool, ...]) -> Any:
    return as_pixels(np.where(np.array(mask) & np.array(written), np.uint8(255), np.uint8(0)))[()]


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
