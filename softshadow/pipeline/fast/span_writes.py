"""Blends and writes the colours of a block; equals `shade.color_writes.blend_bytes`, see fast/test_span_shading.py.

A blend factor of bytes is a few masks (`span_state.factor_terms`), so one loop without branches computes any factor,
many pixels at a time.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.fast.fragment_block import (
    LOWER,
    MASK,
    NEXT,
    OTHER,
    PACKED,
    SOURCE_FACTOR,
    SPAN_LEFT,
    SPAN_PLACE,
    SPAN_ROW,
    SPAN_START,
    TARGET,
    TARGET_FACTOR,
)
from softshadow.pipeline.fast.span_state import (
    BLENDING,
    BLENDS,
    EQUATION_ALPHA,
    EQUATION_RGB,
    LOGIC_OP,
    NO_BLENDING,
    SATURATES,
    SOURCE_TERMS,
    TARGET_TERMS,
    WRITABLE,
)
from softshadow.tokens import GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_MAX, GL_MIN

REPLICATED = np.int32(0x01010101)  # an alpha times this is in all four bytes
COLORS, ALL_BITS = np.int32(0x00FFFFFF), np.int32(-1)
BYTES = np.uint64(4)  # per pixel
LARGEST_BYTE = np.uint8(255)
BYTE, HALF_BYTE, LARGEST = np.int32(255), np.uint16(128), np.uint16(255)


@inlined
def write_block(spans, n_spans, may_overlap, switches, is_masked, whole, pixels):
    """Write PACKED, blended with `pixels` (H, pitch) int32, as if span by span; if `is_masked`, where MASK is set.

    Spans that do not overlap, such as those of one triangle, are blended together.
    """
    if switches[BLENDS] == NO_BLENDING:
        write_spans(spans, 0, n_spans, PACKED, np.int32(switches[WRITABLE]), is_masked, whole, pixels)
        return
    first = 0
    while first < n_spans:
        end, place = n_spans, spans[SPAN_PLACE, np.uint64(first)]
        if may_overlap:
            end = first + 1
            while end < n_spans and spans[SPAN_PLACE, np.uint64(end)] == place:
                end += 1
        read_spans(spans, first, end, whole, pixels)
        blend_pixels(switches, spans[SPAN_START, np.uint64(first)], spans[SPAN_START, np.uint64(end)], whole)
        write_spans(spans, first, end, OTHER, np.int32(switches[WRITABLE]), is_masked, whole, pixels)
        first = end


@kernel
def read_spans(spans, first, end, whole, pixels):
    """Write the pixels of the spans [first, end) to TARGET."""
    for s in range(np.uint64(first), np.uint64(end)):
        start, length = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT] - spans[SPAN_START, s])
        row, left = np.uint64(spans[SPAN_ROW, s]), np.uint64(spans[SPAN_LEFT, s])
        for n in range(length):
            whole[TARGET + start + n] = pixels[row, left + n]


@kernel
def write_spans(spans, first, end, source, writable, is_masked, whole, pixels):
    """Write the row `source` to the pixels of the spans [first, end), the bits of `writable`.

    If `is_masked`, only where MASK is set.
    """
    for s in range(np.uint64(first), np.uint64(end)):
        start, length = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT] - spans[SPAN_START, s])
        row, left = np.uint64(spans[SPAN_ROW, s]), np.uint64(spans[SPAN_LEFT, s])
        if writable == ALL_BITS and not is_masked:
            for n in range(length):
                pixels[row, left + n] = whole[source + start + n]
        else:
            for n in range(length):
                bits = writable & whole[MASK + start + n]
                pixels[row, left + n] = (pixels[row, left + n] & ~bits) | (whole[source + start + n] & bits)


@kernel
def blend_pixels(switches, first, end, whole):
    """Write PACKED blended with TARGET to OTHER, for the fragments [first, end)."""
    begin, stop = np.uint64(first), np.uint64(end)
    if switches[BLENDS] != BLENDING:
        op = switches[LOGIC_OP]
        both, only_source = np.int32(-(op & 1)), np.int32(-(op >> 1 & 1))
        only_target, neither = np.int32(-(op >> 2 & 1)), np.int32(-(op >> 3 & 1))
        for n in range(begin, stop):
            s, d = whole[PACKED + n], whole[TARGET + n]
            whole[OTHER + n] = (s & d & both) | (s & ~d & only_source) | (~s & d & only_target) | (~s & ~d & neither)
        return
    equation = switches[EQUATION_RGB]
    if equation == GL_FUNC_ADD == switches[EQUATION_ALPHA] and is_one(switches, SOURCE_TERMS, 0):
        if is_one(switches, TARGET_TERMS, 2):
            add_pixels(begin, stop, whole)
            return
    write_factors(switches, SOURCE_TERMS, SOURCE_FACTOR, begin, stop, whole)
    write_factors(switches, TARGET_TERMS, TARGET_FACTOR, begin, stop, whole)
    if switches[SATURATES]:
        saturate(switches[SATURATES], SOURCE_FACTOR, begin, stop, whole)
        saturate(switches[SATURATES] >> 2, TARGET_FACTOR, begin, stop, whole)
    blend_channels(equation, begin, stop, whole)
    if switches[EQUATION_ALPHA] != switches[EQUATION_RGB]:
        for n in range(begin, stop):
            whole[LOWER + n] = whole[OTHER + n]
        blend_channels(switches[EQUATION_ALPHA], begin, stop, whole)
        for n in range(begin, stop):
            whole[OTHER + n] = (whole[OTHER + n] & ~COLORS) | (whole[LOWER + n] & COLORS)


@kernel
def is_one(switches, terms, shift):
    """Return whether a factor is 1 for all channels; `shift` says which bits of SATURATES are its own."""
    varying = switches[terms] | switches[terms + 1] | switches[terms + 2] | switches[terms + 3] | switches[terms + 4]
    return varying == 0 and switches[terms + 5] == ALL_BITS and not switches[SATURATES] >> shift & 3


@kernel
def add_pixels(begin, stop, whole):
    """Write PACKED plus TARGET to OTHER, as `blend_channels` with factors of 1: a product of a byte and 255 is it."""
    channels = whole.view(np.uint8)
    source, target, out = BYTES * PACKED, BYTES * TARGET, BYTES * OTHER
    for n in range(BYTES * begin, BYTES * stop):
        a = channels[source + n]
        channels[out + n] = np.uint8(a + min(channels[target + n], np.uint8(LARGEST_BYTE - a)))


@kernel
def write_factors(switches, terms, row, begin, stop, whole):
    """Write the blend factors of all fragments, as `blend.factor`, from the terms of a factor."""
    of_source, of_target = np.int32(switches[terms]), np.int32(switches[terms + 1])
    of_source_alpha, of_target_alpha = np.int32(switches[terms + 2]), np.int32(switches[terms + 3])
    constant, flip = np.int32(switches[terms + 4]), np.int32(switches[terms + 5])
    for n in range(begin, stop):
        s, d = whole[PACKED + n], whole[TARGET + n]
        source_alpha = np.int32(np.int32(np.int32(s >> 24) & BYTE) * REPLICATED)
        target_alpha = np.int32(np.int32(np.int32(d >> 24) & BYTE) * REPLICATED)
        plain = (s & of_source) | (d & of_target) | (source_alpha & of_source_alpha)
        whole[row + n] = (plain | (target_alpha & of_target_alpha) | constant) ^ flip


@kernel
def saturate(which, row, begin, stop, whole):
    """Write GL_SRC_ALPHA_SATURATE into the factors: of the colours if bit 0 of `which` is set, of alpha if bit 1 is."""
    colors = COLORS if which & 1 else np.int32(0)
    alpha = ~COLORS if which & 2 else np.int32(0)
    for n in range(begin, stop):
        s, d = np.int32(whole[PACKED + n] >> 24) & BYTE, BYTE - (np.int32(whole[TARGET + n] >> 24) & BYTE)
        factor = np.int32(np.int32(min(s, d)) * REPLICATED)
        whole[row + n] = (whole[row + n] & ~colors & ~alpha) | (factor & colors) | alpha


@kernel
def blend_channels(name, begin, stop, whole):
    """Write all bytes of PACKED and TARGET, each times its factor, combined by a blend equation to OTHER.

    As `blend.equation`, in 16 bits: a product of two bytes and its rounding fit into them.
    """
    channels = whole.view(np.uint8)
    first, end = BYTES * begin, BYTES * stop
    source, target, out = BYTES * PACKED, BYTES * TARGET, BYTES * OTHER
    by_source, by_target = BYTES * SOURCE_FACTOR, BYTES * TARGET_FACTOR
    if name == GL_MIN:
        for n in range(first, end):
            channels[out + n] = min(channels[source + n], channels[target + n])
    elif name == GL_MAX:
        for n in range(first, end):
            channels[out + n] = max(channels[source + n], channels[target + n])
    elif name == GL_FUNC_ADD:
        for n in range(first, end):
            a = product_of_bytes(channels[source + n], channels[by_source + n])
            b = product_of_bytes(channels[target + n], channels[by_target + n])
            channels[out + n] = np.uint8(min(np.uint16(a + b), LARGEST))
    elif name == GL_FUNC_SUBTRACT:
        for n in range(first, end):
            a = product_of_bytes(channels[source + n], channels[by_source + n])
            b = product_of_bytes(channels[target + n], channels[by_target + n])
            channels[out + n] = np.uint8(np.uint16(a - b) if a > b else np.uint16(0))
    else:
        for n in range(first, end):
            a = product_of_bytes(channels[source + n], channels[by_source + n])
            b = product_of_bytes(channels[target + n], channels[by_target + n])
            channels[out + n] = np.uint8(np.uint16(b - a) if b > a else np.uint16(0))


@kernel
def product_of_bytes(a, b):
    """Return `blend.multiply` of two bytes."""
    product = np.uint16(np.uint16(a) * np.uint16(b))
    return np.uint16(np.uint16(np.uint16(product + np.uint16(product >> np.uint16(8))) + HALF_BYTE) >> np.uint16(8))
