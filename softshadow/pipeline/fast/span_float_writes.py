"""Writes the colours of a block as floats; equals `shade.float_writes.float_writer`, see fast/test_span_shading.py.

Half floats are stored as floats with as many bits.
"""

import numpy as np

from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE
from softshadow.pipeline.fast.fragment_block import ALPHA, MASK, NEXT, ROW, SPAN_LEFT, SPAN_ROW, SPAN_START, WEIGHT
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

CHANNELS = np.uint64(4)


def pixels_of(image: Image) -> np.ndarray:
    """Return the cells of a colour buffer for kernels: (H, pitch) int32 of bytes, (H, 4 pitch) int32 of floats."""
    cells = image.cells
    pixels: np.ndarray = cells.reshape(len(cells), -1).view(np.int32)
    return pixels


@kernel
def write_float_block(spans, n_spans, switches, numbers, is_masked, room, whole, pixels):
    """Write the first four rows of `room` into `pixels`, blended span by span; if `is_masked`, where MASK is set.

    The rows are overwritten.
    """
    values = pixels.view(np.float32)
    for s in range(np.uint64(n_spans)):
        start, length = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT] - spans[SPAN_START, s])
        row, first = np.uint64(spans[SPAN_ROW, s]), CHANNELS * np.uint64(spans[SPAN_LEFT, s])
        target = values[row, first : first + CHANNELS * length]
        if switches[BLENDS] == BLENDING:
            blend_span(start, length, switches, numbers, is_masked, room, whole, target)
            continue
        if switches[BLENDS] == WEIGHTED_SUM:
            add_target(start, length, switches[SOURCE_TERMS], switches[TARGET_TERMS], room, target)
        for c in range(4):
            if has_channel(switches, c):
                is_half = switches[STORED_AS] == AS_HALVES
                write_channel(start, length, np.uint64(c), is_half, is_masked, room, whole, target)


@kernel
def add_target(start, length, weighs_source, weighs_target, room, target):
    """Replace the colours of fragments from `start` on by weighted sums with the colours in `target`."""
    for n in range(start, start + length):
        room[WEIGHT + n] = room[ALPHA + n]
    for c in range(CHANNELS):
        row = c * ROW + start
        if weighs_source:
            for n in range(length):
                room[row + n] *= room[WEIGHT + start + n]
        if weighs_target:
            for n in range(length):
                room[row + n] += target[CHANNELS * n + c] * (ONE - room[WEIGHT + start + n])
        else:
            for n in range(length):
                room[row + n] += target[CHANNELS * n + c]


@kernel
def write_channel(start, length, c, is_half, is_masked, room, whole, target):
    """Write a channel of the fragments from `start` on."""
    row = c * ROW + start
    if is_half:
        for n in range(length):
            room[row + n] = truncated_to_half(room[row + n])
    for n in range(length):
        is_written = not is_masked or whole[MASK + start + n] != 0
        target[CHANNELS * n + c] = room[row + n] if is_written else target[CHANNELS * n + c]


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
        source = room[at], room[ROW + at], room[ROW + ROW + at], room[ALPHA + at]
        blend_float_fragment(ops, source, mask, pixel)
        if switches[STORED_AS] == AS_HALVES:
            for c in range(4):
                pixel[c] = truncated_to_half(pixel[c])


@kernel
def has_channel(switches, c):
    """Return whether a channel is written."""
    return (switches[WRITABLE] >> (8 * c)) & 1 != 0
