"""Writes the colours of a block as floats; equals `shade.float_writes.float_writer`, see fast/test_span_shading.py.

Half floats are stored as floats with as many bits. Blending is a weighted sum (`float_writes.is_weighted_sum`).
"""

import numpy as np

from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.constants import ONE
from softshadow.pipeline.fast.fragment_block import MASK, NEXT, ROW, SPAN_LEFT, SPAN_ROW, SPAN_START
from softshadow.pipeline.fast.span_state import (
    BLENDING,
    BLENDS,
    HALVES,
    SOURCE_TERMS,
    STORED_AS,
    TARGET_TERMS,
    WRITABLE,
)
from softshadow.pipeline.shade.float_writes import truncated_to_half

CHANNELS, ALPHA_ROW = np.uint64(4), np.uint64(3) * ROW


def pixels_of(image: Image) -> np.ndarray:
    """Return the cells of a colour buffer for kernels: (H, pitch) int32 of bytes, (H, 4 pitch) int32 of floats."""
    cells = image.cells
    pixels: np.ndarray = cells.reshape(len(cells), -1).view(np.int32)
    return pixels


@kernel
def write_float_block(spans, n_spans, switches, is_masked, room, whole, pixels):
    """Write the first four rows of `room` into `pixels`, blended span by span; if `is_masked`, where MASK is set."""
    values, blends, is_half = pixels.view(np.float32), switches[BLENDS] == BLENDING, switches[STORED_AS] == HALVES
    weighs_source, weighs_target = switches[SOURCE_TERMS] != 0, switches[TARGET_TERMS] != 0
    for s in range(np.uint64(n_spans)):
        start, length = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT] - spans[SPAN_START, s])
        row, left = np.uint64(spans[SPAN_ROW, s]), np.uint64(spans[SPAN_LEFT, s])
        for c in range(4):
            if not (switches[WRITABLE] >> (8 * c)) & 1:
                continue
            channel, source = CHANNELS * left + np.uint64(c), np.uint64(c) * ROW + start
            for n in range(length):
                at = channel + CHANNELS * n
                value, before = room[source + n], values[row, at]
                if blends:
                    alpha = room[ALPHA_ROW + start + n]
                    value *= alpha if weighs_source else ONE
                    value += before * (ONE - alpha if weighs_target else ONE)
                value = truncated_to_half(value) if is_half else value
                values[row, at] = value if not is_masked or whole[MASK + start + n] else before
