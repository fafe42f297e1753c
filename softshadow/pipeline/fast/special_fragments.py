"""Stipple and smoothing of a block of fragments; equals `shade.discards.without_discarded`, see fast/test_special.py.

The fragments that polygon stipple and smooth points leave out are shaded with the others, and masked. Smoothing
multiplies alpha by the coverage (`geometry.smooth`).
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import kernel, read_only
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import ALPHA, MASK, NEXT, ROW, SPAN_LEFT, SPAN_ROW, SPAN_START
from softshadow.pipeline.geometry.smooth import PLACE_COLUMNS
from softshadow.pipeline.records import Geometry

# in the numbers of `special_numbers`; the places are columns of values, -1 for none
POINT_PLACES, LINE_PLACES, IS_STIPPLED, STIPPLE = range(4)
SIDE = 32  # rows and columns of a polygon stipple
NO_SPECIAL = read_only(np.array([-1, -1, *[0] * (SIDE + 1)], np.int32))
LOW_BITS = np.int32(SIDE - 1)


def special_numbers(geometry: Geometry) -> np.ndarray:
    """Return what decides about the fragments of a draw (35,) int32; each row of the stipple is a number of 32 bits."""
    discards = geometry.discards
    if discards is None and geometry.line_places < 0:
        return NO_SPECIAL
    numbers = NO_SPECIAL.copy()
    numbers[LINE_PLACES] = geometry.line_places
    if discards is not None:
        numbers[POINT_PLACES] = discards.places
        if discards.pattern is not None:
            numbers[IS_STIPPLED] = 1
            numbers[STIPPLE:] = np.packbits(discards.pattern, axis=1, bitorder="little").view(np.int32)[:, 0]
    return read_only(numbers)


def discards_some(special: np.ndarray) -> bool:
    """Return whether fragments are left out."""
    return bool(special[IS_STIPPLED] or special[POINT_PLACES] >= 0)


def needed_places(special: np.ndarray) -> int:
    """Return the columns that are needed for the coverage, as bits."""
    every = (1 << PLACE_COLUMNS) - 1
    return sum(every << place for place in special[[POINT_PLACES, LINE_PLACES]].tolist() if place >= 0)


@kernel
def cover_block(special, count, room):
    """Multiply the alphas of a block by the coverages, as `smooth.point_coverage` and then `smooth.line_coverage`."""
    if special[POINT_PLACES] >= 0:
        first = np.uint64(special[POINT_PLACES]) * ROW
        second, third, fourth = first + ROW, first + ROW + ROW, first + ROW + ROW + ROW
        for n in range(np.uint64(count)):
            x, y, k, one = room[first + n], room[second + n], room[third + n], room[fourth + n]
            distance = x * x + y * y
            inner = (ONE / (one - k)) * (one - distance)
            room[ALPHA + n] *= inner if k >= distance else one
    if special[LINE_PLACES] >= 0:
        first = np.uint64(special[LINE_PLACES]) * ROW
        second, third, fourth = first + ROW, first + ROW + ROW, first + ROW + ROW + ROW
        for n in range(np.uint64(count)):
            across, along = room[second + n] - abs(room[first + n]), room[fourth + n] - abs(room[third + n])
            across, along = ZERO if across <= ZERO else across, ZERO if along <= ZERO else along  # NaN stays
            room[ALPHA + n] *= (ONE if across > ONE else across) * (ONE if along > ONE else along)


@kernel
def discard_from_block(special, spans, n_spans, count, room, whole):
    """Clear MASK where fragments are left out: by the polygon stipple, or outside of their smooth points."""
    if special[IS_STIPPLED]:
        for s in range(np.uint64(n_spans)):
            start, end = np.uint64(spans[SPAN_START, s]), np.uint64(spans[SPAN_START, s + NEXT])
            bits = special[np.uint64(STIPPLE + (spans[SPAN_ROW, s] & LOW_BITS))]
            shift = np.int32(spans[SPAN_LEFT, s] - spans[SPAN_START, s])
            for n in range(start, end):
                column = np.int32(np.int32(n) + shift)
                whole[MASK + n] &= np.int32(-np.int32(np.int32(bits >> (column & LOW_BITS)) & 1))
    if special[POINT_PLACES] >= 0:
        first = np.uint64(special[POINT_PLACES]) * ROW
        second, fourth = first + ROW, first + ROW + ROW + ROW
        for n in range(np.uint64(count)):
            x, y, one = room[first + n], room[second + n], room[fourth + n]
            whole[MASK + n] = 0 if x * x + y * y > one else whole[MASK + n]
