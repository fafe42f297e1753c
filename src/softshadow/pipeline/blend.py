"""Writing colours: rounding to 8 bits, blending, logic operations and the colour mask."""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.fragments import Fragments
from softshadow.state import Blend, State

RGB, ALPHA = 0, 1


class BlendOps(NamedTuple):
    """Blend state as plain ints: factors and equations of (rgb, alpha), constant colour 0-255, logic op or 0."""

    src_rgb: int
    dst_rgb: int
    src_alpha: int
    dst_alpha: int
    equation_rgb: int
    equation_alpha: int
    red: int
    green: int
    blue: int
    alpha: int
    logic_op: int


def to_unorm8(values: np.ndarray) -> np.ndarray:
    """Return colours as bytes: clamped to [0, 1], times 255, rounded half to even in the precision of `values`."""
    real = values.dtype.type
    return np.rint(np.minimum(np.maximum(values, real(0)), real(1)) * real(255)).astype(np.uint8)


def blend_ops(blend: Blend) -> BlendOps:
    """Return the blend state as numbers; a logic op takes the place of blending (GL 2.1, sec. 4.1.10)."""
    red, green, blue, alpha = (int(c) for c in to_unorm8(np.array(blend.color, np.float32)))
    factors = (blend.src_rgb, blend.dst_rgb, blend.src_alpha, blend.dst_alpha)
    logic_op = blend.logic_op if blend.logic_enabled else 0
    return BlendOps(*factors, blend.equation_rgb, blend.equation_alpha, red, green, blue, alpha, logic_op)


def needs_order(state: State) -> bool:
    """Return whether a draw's colours depend on the order of its fragments, or its fragments on their colours."""
    tests_alpha = state.alpha.enabled and state.alpha.func != gl.GL_ALWAYS
    return tests_alpha or state.blend.enabled or state.blend.logic_enabled


@kernel
def multiply(a, b):
    """Return a * b of two bytes that stand for 0..1, as llvmpipe rounds it."""
    product = a * b
    return (product + (product >> 8) + 128) >> 8


@kernel
def factor(name, channel, source, target, source_alpha, target_alpha, constant, constant_alpha):
    """Return a blend factor of one channel, 0-255 (GL 2.1, table 4.2)."""
    if name == gl.GL_ZERO:
        return 0
    if name == gl.GL_ONE:
        return 255
    if name == gl.GL_SRC_COLOR:
        return source
    if name == gl.GL_ONE_MINUS_SRC_COLOR:
        return 255 - source
    if name == gl.GL_DST_COLOR:
        return target
    if name == gl.GL_ONE_MINUS_DST_COLOR:
        return 255 - target
    if name == gl.GL_SRC_ALPHA:
        return source_alpha
    if name == gl.GL_ONE_MINUS_SRC_ALPHA:
        return 255 - source_alpha
    if name == gl.GL_DST_ALPHA:
        return target_alpha
    if name == gl.GL_ONE_MINUS_DST_ALPHA:
        return 255 - target_alpha
    if name == gl.GL_CONSTANT_COLOR:
        return constant
    if name == gl.GL_ONE_MINUS_CONSTANT_COLOR:
        return 255 - constant
    if name == gl.GL_CONSTANT_ALPHA:
        return constant_alpha
    if name == gl.GL_ONE_MINUS_CONSTANT_ALPHA:
        return 255 - constant_alpha
    return min(source_alpha, 255 - target_alpha) if channel < 3 else 255  # GL_SRC_ALPHA_SATURATE


@kernel
def equation(name, source, target, source_factor, target_factor):
    """Return the blended byte of one channel (GL 2.1, table 4.1)."""
    if name == gl.GL_MIN:
        return min(source, target)
    if name == gl.GL_MAX:
        return max(source, target)
    a, b = multiply(source, source_factor), multiply(target, target_factor)
    if name == gl.GL_FUNC_ADD:
        return min(a + b, 255)
    return max(a - b, 0) if name == gl.GL_FUNC_SUBTRACT else max(b - a, 0)


@kernel
def logic(op, s, d):
    """Return the bitwise operation of two bytes; its truth table is the low four bits of the token."""
    ones = 255
    out = (s & d) if op & 1 else 0
    out |= (s & (ones ^ d)) if op & 2 else 0
    out |= ((ones ^ s) & d) if op & 4 else 0
    out |= ((ones ^ s) & (ones ^ d)) if op & 8 else 0
    return out


@kernel
def blend_fragment(ops, source, target, blended):
    """Write the bytes that replace `target` (4,) when a fragment of colour `source` (4,) is blended with it."""
    # int() of a byte is unsigned once compiled, and unsigned and signed branches together become float64
    source_alpha, target_alpha = np.int64(source[3]), np.int64(target[3])
    for c in range(4):
        s, d = np.int64(source[c]), np.int64(target[c])
        if ops.logic_op:
            blended[c] = logic(ops.logic_op, s, d)
            continue
        constant = ops.red if c == 0 else ops.green if c == 1 else ops.blue if c == 2 else ops.alpha
        source_name, target_name = (ops.src_rgb, ops.dst_rgb) if c < 3 else (ops.src_alpha, ops.dst_alpha)
        a = factor(source_name, c, s, d, source_alpha, target_alpha, constant, ops.alpha)
        b = factor(target_name, c, s, d, source_alpha, target_alpha, constant, ops.alpha)
        blended[c] = equation(ops.equation_rgb if c < 3 else ops.equation_alpha, s, d, a, b)


@kernel
def blend_fragments(ops, rows, columns, colors, mask, cells):
    """Blend fragments into `cells` (H, pitch, 4) one after the other, under the colour mask (4,)."""
    blended = np.zeros(4, np.uint8)
    for n in range(rows.shape[0]):
        target = cells[rows[n], columns[n]]
        blend_fragment(ops, colors[n], target, blended)
        for c in range(4):
            if mask[c]:
                target[c] = blended[c]


def write_colors(state: State, color: Image, fragments: Fragments, values: np.ndarray) -> None:
    """Write shaded colours (n, 4) in order, blended where the state says so.

    Without blending the last fragment of a pixel wins, so the writes need no loop.
    """
    rows, columns = fragments.row, fragments.column
    mask = np.array(state.color.mask) & np.array(color.format.written)
    if color.format.kind == "float":
        stored = values.astype(np.float32)
    else:
        stored = to_unorm8(values)
        if state.blend.enabled or state.blend.logic_enabled:
            blend_fragments(blend_ops(state.blend), rows, columns, stored, mask, color.cells)
            return
    if mask.all():
        color.cells[rows, columns] = stored
    else:
        channels = np.flatnonzero(mask)
        color.cells[rows[:, None], columns[:, None], channels] = stored[:, channels]
