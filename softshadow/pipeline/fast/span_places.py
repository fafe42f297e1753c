"""Places of texels of a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

From texture coordinates to the numbers of texels on each axis, with the operations of `softshadow.programs.wrapping`.
Coordinates of rectangles are texels: then the wrap mode is negated.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.fast.fragment_block import (
    CORNER_00,
    CORNER_01,
    CORNER_10,
    CORNER_11,
    FIRST,
    FRACTION,
    LENGTH,
    LEVEL,
    OFFSET,
    PITCH,
    R_AXIS,
    SECOND,
    T_AXIS,
)
from softshadow.pipeline.fast.span_state import HEIGHT, LEVEL_OFFSETS, PACKED_LEVELS, ROW_LENGTH, SLICES, WIDTH
from softshadow.programs.wrapping import BELOW_ONE, FIXED_ONE, ONE, REPEAT_BY_MASK, mirror, to_int32
from softshadow.tokens import GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_REPEAT

HALF_TEXEL, STEPS_PER_TEXEL = np.int32(128), np.int32(256)
NOTHING, ONE_TEXEL = np.int32(0), np.int32(1)


@kernel
def write_places(switches, unit, count, whole):
    """Write LENGTH of all axes, OFFSET and PITCH: the sizes of each fragment's LEVEL and where it begins."""
    if switches[unit + SLICES]:
        slices, is_packed = np.int32(switches[unit + SLICES]), switches[unit + PACKED_LEVELS] != 0
        for n in range(np.uint64(count)):
            whole[R_AXIS + LENGTH + n] = max(np.int32(slices >> whole[LEVEL + n]), ONE_TEXEL) if is_packed else slices
    width, height = np.int32(switches[unit + WIDTH]), np.int32(switches[unit + HEIGHT])
    pitch, offset, is_packed = np.int32(switches[unit + ROW_LENGTH]), NOTHING, switches[unit + PACKED_LEVELS] != 0
    low = high = whole[LEVEL]
    if is_packed:
        for n in range(np.uint64(count)):
            low, high = min(low, whole[LEVEL + n]), max(high, whole[LEVEL + n])
    if is_packed and low == high:  # as in most blocks
        width, height = max(np.int32(width >> low), ONE_TEXEL), max(np.int32(height >> low), ONE_TEXEL)
        pitch, offset = width, np.int32(switches[unit + LEVEL_OFFSETS + low])
    if not is_packed or low == high:
        for n in range(np.uint64(count)):
            whole[LENGTH + n], whole[T_AXIS + LENGTH + n] = width, height
            whole[OFFSET + n], whole[PITCH + n] = offset, pitch
        return
    for n in range(np.uint64(count)):
        across, along = np.int32(width >> whole[LEVEL + n]), np.int32(height >> whole[LEVEL + n])
        across, along = max(across, ONE_TEXEL), max(along, ONE_TEXEL)
        whole[LENGTH + n], whole[T_AXIS + LENGTH + n], whole[PITCH + n] = across, along, across
    for n in range(np.uint64(count)):
        whole[OFFSET + n] = switches[unit + LEVEL_OFFSETS + whole[LEVEL + n]]


@kernel
def move_by_slices(row, count, whole):
    """Move OFFSET by as many slices of a 3-D image as `row` says."""
    for n in range(np.uint64(count)):
        rows = np.int32(whole[row + n] * whole[T_AXIS + LENGTH + n])
        whole[OFFSET + n] += np.int32(rows * whole[PITCH + n])


@kernel
def write_corners(count, whole):
    """Write CORNER_00 to CORNER_11: the places of the texels at FIRST and SECOND of s and t."""
    for n in range(np.uint64(count)):
        upper = np.int32(whole[OFFSET + n] + np.int32(whole[T_AXIS + FIRST + n] * whole[PITCH + n]))
        lower = np.int32(whole[OFFSET + n] + np.int32(whole[T_AXIS + SECOND + n] * whole[PITCH + n]))
        whole[CORNER_00 + n], whole[CORNER_10 + n] = upper + whole[FIRST + n], upper + whole[SECOND + n]
        whole[CORNER_01 + n], whole[CORNER_11 + n] = lower + whole[FIRST + n], lower + whole[SECOND + n]


@kernel
def linear_places(coordinate, axis, wrap, count, room, whole):
    """Write FIRST, SECOND and FRACTION of an axis, as `wrapping.fixed_point_texels`."""
    length, first, second, fraction = axis + LENGTH, axis + FIRST, axis + SECOND, axis + FRACTION
    if wrap == GL_REPEAT:
        for n in range(np.uint64(count)):
            c, last = room[coordinate + n], np.int32(whole[length + n] - 1)
            part = (c - np.floor(c)) * np.float32(whole[length + n])
            position = np.int32(to_int32(np.rint(part * FIXED_ONE)) - HALF_TEXEL)
            i = np.int32(position >> 8)
            i = last if i < NOTHING or i > last else i
            whole[first + n] = i
            whole[second + n] = NOTHING if i == last else np.int32(i + 1)
            whole[fraction + n] = position & 255
    elif wrap == REPEAT_BY_MASK:
        for n in range(np.uint64(count)):
            last, steps = np.int32(whole[length + n] - 1), np.float32(np.int32(whole[length + n] * STEPS_PER_TEXEL))
            position = np.int32(to_int32(np.rint(room[coordinate + n] * steps)) - HALF_TEXEL)
            i = np.int32(position >> 8)
            whole[first + n] = i & last
            whole[second + n] = np.int32(i + 1) & last
            whole[fraction + n] = position & 255
    else:
        in_texels = wrap < 0
        for n in range(np.uint64(count)):
            last, side = np.int32(whole[length + n] - 1), ONE_TEXEL if in_texels else whole[length + n]
            steps = np.float32(np.int32(side * STEPS_PER_TEXEL))
            position = np.int32(to_int32(np.rint(room[coordinate + n] * steps)) - HALF_TEXEL)
            i = np.int32(position >> 8)
            after = np.int32(i + 1)
            whole[first + n] = min(max(i, NOTHING), last)
            whole[second + n] = min(max(after, NOTHING), last)
            whole[fraction + n] = position & 255


@kernel
def nearest_places(coordinate, axis, wrap, place, count, room, whole):
    """Write the nearest texels of an axis to the row `place` of the axis, as `wrapping.nearest_texel`."""
    length, nearest = axis + LENGTH, axis + place
    if wrap == REPEAT_BY_MASK:
        for n in range(np.uint64(count)):
            last = np.int32(whole[length + n] - 1)
            whole[nearest + n] = to_int32(np.floor(room[coordinate + n] * np.float32(whole[length + n]))) & last
    elif wrap == GL_REPEAT:
        for n in range(np.uint64(count)):
            part = room[coordinate + n] - np.floor(room[coordinate + n])
            whole[nearest + n] = to_int32((part if part < BELOW_ONE else BELOW_ONE) * np.float32(whole[length + n]))
    elif abs(wrap) == GL_CLAMP_TO_BORDER:
        in_texels = wrap < 0
        for n in range(np.uint64(count)):
            side = ONE if in_texels else np.float32(whole[length + n])
            whole[nearest + n] = to_int32(np.floor(room[coordinate + n] * side))
    elif wrap == GL_MIRRORED_REPEAT:
        for n in range(np.uint64(count)):
            last, distance = np.int32(whole[length + n] - 1), mirror(room[coordinate + n])
            whole[nearest + n] = min(to_int32(distance * np.float32(whole[length + n])), last)
    else:
        in_texels = wrap < 0
        for n in range(np.uint64(count)):
            last, side = np.int32(whole[length + n] - 1), ONE if in_texels else np.float32(whole[length + n])
            whole[nearest + n] = min(max(to_int32(room[coordinate + n] * side), NOTHING), last)
