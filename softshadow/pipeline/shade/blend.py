"""Blending and logic operations of single colours, and the bytes that the alpha test compares.

Bytes are blended as bytes, floats as floats and never clamped, both in the order of operations of llvmpipe
(lp_bld_blend.c), which has formulas of its own for equal and for complementary factors.
"""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.image import Format, Image
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE
from softshadow.state import Blend, State

ALPHA = 3
FOUR_BYTES = (gl.GL_RGB, gl.GL_RGBA)  # the formats of 8-bit buffers that have room for an alpha
PASSING = {gl.GL_LESS: 0, gl.GL_NOTEQUAL: 0, gl.GL_GREATER: 2}  # the alpha that passes a test against 1; else 1
OF_ALPHA_ONE = {gl.GL_DST_ALPHA: gl.GL_ONE, gl.GL_ONE_MINUS_DST_ALPHA: gl.GL_ZERO}
# a factor and its complement in pairs, the plain one first
COMPLEMENTS = (
    (gl.GL_ONE, gl.GL_ZERO), (gl.GL_SRC_COLOR, gl.GL_ONE_MINUS_SRC_COLOR), (gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA),
    (gl.GL_DST_COLOR, gl.GL_ONE_MINUS_DST_COLOR), (gl.GL_CONSTANT_COLOR, gl.GL_ONE_MINUS_CONSTANT_COLOR),
    (gl.GL_CONSTANT_ALPHA, gl.GL_ONE_MINUS_CONSTANT_ALPHA),
)  # fmt: skip


class BlendOps(NamedTuple):
    """Blend state as plain numbers: factors and equations of (rgb, alpha), constant colour, logic op or 0.

    The constant colour is 0-255 for bytes, float32 for floats; `single_channel`: the buffer has one
    channel; `same_factor`: source and target have equal factors.
    """

    src_rgb: int
    dst_rgb: int
    src_alpha: int
    dst_alpha: int
    equation_rgb: int
    equation_alpha: int
    red: int | np.float32
    green: int | np.float32
    blue: int | np.float32
    alpha: int | np.float32
    logic_op: int
    single_channel: int
    same_factor: int


def to_unorm8(values: np.ndarray) -> np.ndarray:
    """Return colours as bytes: clamped to [0, 1], times 255, rounded half to even in the precision of `values`.

    NaN becomes 0, as in llvmpipe.
    """
    real = values.dtype.type
    return np.rint(np.minimum(np.fmax(values, real(0)), real(1)) * real(255)).astype(np.uint8)


def compared_alpha(state: State, color: Image | None, alpha: np.ndarray) -> tuple[np.ndarray, int]:
    """Return alpha values (n,) uint8 and the reference that the alpha test compares them with.

    Both are 0-255 for a buffer of 8-bit RGB or RGBA. For every other one llvmpipe compares them unrounded: then 0, 1, 2
    stand for an alpha less than, equal to and greater than the reference, which is 1. NaN is compared as 1, though
    it is written as 0. A reference that is NaN is 255 for bytes; compared unrounded, every alpha passes.
    """
    if color is not None and color.format.kind == "unorm8" and color.format.base in FOUR_BYTES:
        return to_unorm8(np.fmin(alpha, alpha.dtype.type(1))), int(
            to_unorm8(np.fmin(np.float32(state.alpha.ref), np.float32(1)))
        )
    ref = alpha.dtype.type(state.alpha.ref)
    if np.isnan(ref):
        return np.full(alpha.shape, PASSING.get(state.alpha.func, 1), np.uint8), 1
    return (alpha >= ref).astype(np.uint8) + (alpha > ref).astype(np.uint8), 1


def blend_ops(blend: Blend, format: Format) -> BlendOps:
    """Return the blend state as numbers for a buffer of this format.

    A logic op takes the place of blending (GL 2.1, sec. 4.1.10). GL_MIN and GL_MAX have no factors; a buffer without
    alpha is read as alpha 1, and blended with the factors and the equation of the colours.
    """
    constant = np.array(blend.color, np.float32)
    red, green, blue, alpha = (int(c) for c in to_unorm8(constant)) if format.kind == "unorm8" else constant
    colors = _factors(blend.equation_rgb, blend.src_rgb, blend.dst_rgb)
    alphas = _factors(blend.equation_alpha, blend.src_alpha, blend.dst_alpha)
    equations = (blend.equation_rgb, blend.equation_alpha)
    if not format.written[ALPHA]:
        colors = OF_ALPHA_ONE.get(colors[0], colors[0]), OF_ALPHA_ONE.get(colors[1], colors[1])
        alphas, equations = colors, (blend.equation_rgb, blend.equation_rgb)
    same_factor = colors[0] == colors[1] and alphas[0] == alphas[1]
    logic_op = blend.logic_op if blend.logic_enabled else 0
    single_channel = int(format.base == gl.GL_RED)
    return BlendOps(*colors, *alphas, *equations, red, green, blue, alpha, logic_op, single_channel, int(same_factor))


def _factors(equation: int, source: int, target: int) -> tuple[int, int]:
    return (gl.GL_ONE, gl.GL_ONE) if equation in (gl.GL_MIN, gl.GL_MAX) else (source, target)


@inlined
def multiply(a, b):
    """Return a * b of two bytes that stand for 0..1, as llvmpipe rounds it."""
    product = a * b
    return (product + (product >> 8) + 128) >> 8


@kernel
def factor(name, channel, source, target, source_alpha, target_alpha, constant, constant_alpha, one):
    """Return a blend factor of one channel (GL 2.1, table 4.2); `one` is 255 for bytes."""
    if name == gl.GL_ZERO:
        return one - one
    if name == gl.GL_ONE:
        return one
    if name == gl.GL_SRC_COLOR:
        return source
    if name == gl.GL_ONE_MINUS_SRC_COLOR:
        return one - source
    if name == gl.GL_DST_COLOR:
        return target
    if name == gl.GL_ONE_MINUS_DST_COLOR:
        return one - target
    if name == gl.GL_SRC_ALPHA:
        return source_alpha
    if name == gl.GL_ONE_MINUS_SRC_ALPHA:
        return one - source_alpha
    if name == gl.GL_DST_ALPHA:
        return target_alpha
    if name == gl.GL_ONE_MINUS_DST_ALPHA:
        return one - target_alpha
    if name == gl.GL_CONSTANT_COLOR:
        return constant
    if name == gl.GL_ONE_MINUS_CONSTANT_COLOR:
        return one - constant
    if name == gl.GL_CONSTANT_ALPHA:
        return constant_alpha
    if name == gl.GL_ONE_MINUS_CONSTANT_ALPHA:
        return one - constant_alpha
    return min(source_alpha, one - target_alpha) if channel < ALPHA else one  # GL_SRC_ALPHA_SATURATE


@inlined
def factors_of(ops, channel, source, target, source_alpha, target_alpha, one):
    """Return the factors of source and target for one channel."""
    constant = ops.red if channel == 0 else ops.green if channel == 1 else ops.blue if channel == 2 else ops.alpha
    source_name, target_name = (ops.src_rgb, ops.dst_rgb) if channel < ALPHA else (ops.src_alpha, ops.dst_alpha)
    return (
        factor(source_name, channel, source, target, source_alpha, target_alpha, constant, ops.alpha, one),
        factor(target_name, channel, source, target, source_alpha, target_alpha, constant, ops.alpha, one),
    )


@inlined
def complement_of(source_name, target_name):
    """Return 1 where the target's factor is 1 minus the source's, -1 where it is the other way round, else 0."""
    for plain, inverse in COMPLEMENTS:
        if source_name == plain and target_name == inverse:
            return 1
        if source_name == inverse and target_name == plain:
            return -1
    return 0


@inlined
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


@inlined
def logic(op, s, d):
    """Return the bitwise operation of two bytes; its truth table is the low four bits of the token."""
    ones = 255
    out = (s & d) if op & 1 else 0
    out |= (s & (ones ^ d)) if op & 2 else 0
    out |= ((ones ^ s) & d) if op & 4 else 0
    out |= ((ones ^ s) & (ones ^ d)) if op & 8 else 0
    return out


@inlined
def mix_bytes(weight, a, b):
    """Return the byte between `a` and `b` by a weight of 0 to 255, as llvmpipe blends a buffer of one channel."""
    scaled = weight + (weight >> 7)
    return (a + ((scaled * (b - a) * 128 + 16384) >> 15)) & 255


@inlined
def blend_fragment(ops, source, mask, target):
    """Blend a fragment of colour `source` (4,) with the bytes `target` (4,) under the colour mask (4,)."""
    # int() of a byte is unsigned once compiled, and unsigned and signed branches together become float64
    source_alpha, target_alpha = np.int64(source[ALPHA]), np.int64(target[ALPHA])
    complement = (
        complement_of(ops.src_rgb, ops.dst_rgb) if ops.single_channel and ops.equation_rgb == gl.GL_FUNC_ADD else 0
    )
    for c in range(4):
        if not mask[c]:
            continue
        s, d = np.int64(source[c]), np.int64(target[c])
        if ops.logic_op:
            target[c] = logic(ops.logic_op, s, d)
            continue
        a, b = factors_of(ops, c, s, d, source_alpha, target_alpha, 255)
        if complement:
            target[c] = mix_bytes(a, d, s) if complement > 0 else mix_bytes(b, s, d)
        else:
            target[c] = equation(ops.equation_rgb if c < ALPHA else ops.equation_alpha, s, d, a, b)


@inlined
def float_equation(name, s, d, a, b, same_factor, complement):
    """Return the blended float32 of one channel, never clamped.

    `a` and `b` are the factors; `same_factor`: they are equal; `complement`: see `complement_of`.
    """
    if name == gl.GL_MIN:
        return s if s < d else d
    if name == gl.GL_MAX:
        return s if s > d else d
    if complement:
        if name == gl.GL_FUNC_ADD:
            return d + a * (s - d) if complement > 0 else s + b * (d - s)
        if name == gl.GL_FUNC_SUBTRACT:
            return (s + d) * a - d if complement > 0 else s - (s + d) * b
        return d - (s + d) * a if complement > 0 else (s + d) * b - s
    if same_factor:
        both = s + d if name == gl.GL_FUNC_ADD else s - d if name == gl.GL_FUNC_SUBTRACT else d - s
        return both * a
    if name == gl.GL_FUNC_ADD:
        return s * a + d * b
    return s * a - d * b if name == gl.GL_FUNC_SUBTRACT else d * b - s * a


@inlined
def blend_float_fragment(ops, source, mask, target):
    """Blend a fragment of colour `source` (4,) with the floats `target` (4,) under the colour mask (4,)."""
    target_alpha = target[ALPHA]
    complement = complement_of(ops.src_rgb, ops.dst_rgb) if ops.single_channel else 0
    for c in range(4):
        if not mask[c]:
            continue
        s, d = source[c], target[c]
        a, b = factors_of(ops, c, s, d, source[ALPHA], target_alpha, ONE)
        name = ops.equation_rgb if c < ALPHA else ops.equation_alpha
        target[c] = float_equation(name, s, d, a, b, ops.same_factor, complement)
