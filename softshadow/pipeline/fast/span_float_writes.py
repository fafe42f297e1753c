"""Writes the colours of a block as floats; equals `shade.float_writes.float_writer`, see fast/test_span_shading.py.

Half floats are stored as floats with as many bits.
"""

import numpy as np

from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE
from softshadow.pipeline.fast.fragment_block import MASK, NEXT, ROW, SPAN_LEFT, SPAN_ROW, SPAN_START
from softshadow.pipeline.fast.span_state import (
    AS_HALVES,
    BLEND_COLOR,
    BLENDING,
    BLENDS,
    EQUATION_ALPHA,
    EQUATION_RGB,
    SOURCE_TERMS,
    STORED_AS,
    TARGET_TERMS,
    WEIGHTED_SUM,
    WRITABLE,
)
from softshadow.pipeline.shade.blend import BlendOps, blend_float_fragment
from softshadow.pipeline.shade.float_writes import truncated_to_half

CHANNELS, ALPHA_ROW = np.uint64(4), np.uint64(3) * ROW


def pixels_of(image: Image) -> np.ndarray:
    """Return the cells of a colour buffer for kernels: (H, pitch) int32 of bytes, (H, 4 pitch) int32 of floats."""
    cells = image.cells
    pixels: np.ndarray = cells.reshape(len(cells), -1).view(np.int32)
    return pixels


@kernel
def write_float_block(spans, n_spans, switches, numbers, is_masked, room, whole, pixels):
    """Write the first four rows of `room` into `pixels`, blended span by span; if `is_masked`, where MASK is set."""
    values = pixels.view(np.float32)
    for s in range(np.uint64(n_spans)):
        start, length = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT] - spans[SPAN_START, s])
        target = values[np.uint64(spans[SPAN_ROW, s])]
        first = CHANNELS * np.uint64(spans[SPAN_LEFT, s])
        if switches[BLENDS] == BLENDING:
            blend_span(start, length, switches, numbers, is_masked, room, whole, target[first:])
        else:
            write_span(start, length, switches, is_masked, room, whole, target[first:])


@kernel
def write_span(start, length, switches, is_masked, room, whole, target):
    """Write the colours of fragments from `start` on as they are, or as weighted sums."""
    is_sum, is_half = switches[BLENDS] == WEIGHTED_SUM, switches[STORED_AS] == AS_HALVES
    weighs_source, weighs_target = switches[SOURCE_TERMS] != 0, switches[TARGET_TERMS] != 0
    for c in range(4):
        if not has_channel(switches, c):
            continue
        source, channel = np.uint64(c) * ROW + start, np.uint64(c)
        for n in range(length):
            value, before = room[source + n], target[CHANNELS * n + channel]
            if is_sum:
                alpha = room[ALPHA_ROW + start + n]
                value *= alpha if weighs_source else ONE
                value += before * (ONE - alpha if weighs_target else ONE)
            value = truncated_to_half(value) if is_half else value
            target[CHANNELS * n + channel] = value if not is_masked or whole[MASK + start + n] else before


@kernel
def blend_span(start, length, switches, numbers, is_masked, room, whole, target):
    """Blend the colours of fragments from `start` on with any factors."""
    ops = BlendOps(
        switches[SOURCE_TERMS], switches[TARGET_TERMS], switches[SOURCE_TERMS + 1], switches[TARGET_TERMS + 1],
        switches[EQUATION_RGB], switches[EQUATION_ALPHA], numbers[BLEND_COLOR], numbers[BLEND_COLOR + 1],
        numbers[BLEND_COLOR + 2], numbers[BLEND_COLOR + 3], 0, switches[SOURCE_TERMS + 2], switches[TARGET_TERMS + 2],
    )  # fmt: skip
    mask = has_channel(switches, 0), has_channel(switches, 1), has_channel(switches, 2), has_channel(switches, 3)
    for n in range(length):
        if is_masked and not whole[MASK + start + n]:
            continue
        at, pixel = start + n, target[CHANNELS * n : CHANNELS * n + CHANNELS]
        source = room[at], room[ROW + at], room[ROW + ROW + at], room[ALPHA_ROW + at]
        blend_float_fragment(ops, source, mask, pixel)
        if switches[STORED_AS] == AS_HALVES:
            for c in range(4):
                pixel[c] = truncated_to_half(pixel[c])


@kernel
def has_channel(switches, c):
    """Return whether a channel is written."""
    return (switches[WRITABLE] >> (8 * c)) & 1 != 0
