"""GL_COMBINE for a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

The operations are those of `softshadow.programs.texture_combine`, channel by channel: the arguments of a function are
copied into rows, and each function is one loop over them.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.constants import HALF, ONE, TWO, ZERO
from softshadow.pipeline.fast.combine_numbers import (
    CONSTANT_COLOR,
    DIFFERENCE,
    DOT_PRODUCT,
    FIRST_ARGUMENT,
    FUNCTION,
    IS_CLAMPED,
    IS_INVERTED,
    MIXTURE,
    ONLY,
    PRODUCT,
    SAME,
    SCALED_SUM,
    SECOND_ARGUMENT,
    SIGNED_SUM,
    SOURCE,
    SUM,
    SWITCHES_OF_FUNCTION,
    TAKES_ALPHA,
    THIRD_ARGUMENT,
)
from softshadow.pipeline.fast.fragment_block import OTHER_TEXEL, PRIMARY, RED, ROW, SIZE, TEXEL, R, S, T, W
from softshadow.pipeline.fast.span_state import COMBINED, CONSTANT, SCALES
from softshadow.programs.filtering import clamp_to_unit

FIRST, SECOND, THIRD, RESULT = S, T, R, W  # rows that are free after the textures are sampled


@kernel
def keep_primary(count, room):
    """Copy the colours to the rows from PRIMARY on."""
    for c in range(4):
        row, kept = RED + np.uint64(c) * ROW, PRIMARY + np.uint64(c) * ROW
        for n in range(np.uint64(count)):
            room[kept + n] = room[row + n]


@kernel
def swap_texels(count, room):
    """Exchange the texels of the unit and those of the other unit."""
    for c in range(4):
        row, other = TEXEL + np.uint64(c) * ROW, OTHER_TEXEL + np.uint64(c) * ROW
        for n in range(np.uint64(count)):
            room[row + n], room[other + n] = room[other + n], room[row + n]


@kernel
def combine_block(switches, numbers, unit, number, count, room):
    """Replace the colours by the combined ones of a unit, as `texture_combine.combine`."""
    rgb, alpha = unit + COMBINED, unit + COMBINED + SWITCHES_OF_FUNCTION
    if switches[rgb + FUNCTION] == DOT_PRODUCT or switches[rgb + FUNCTION] == SCALED_SUM:
        write_dot_product(switches, numbers, rgb, number, count, room)
        for c in range(3):
            write_scaled(numbers[number + SCALES], switches[rgb + IS_CLAMPED], c, count, room)
    else:
        for c in range(3):
            write_function(switches, numbers, rgb, number, c, count, room)
            write_scaled(numbers[number + SCALES], switches[rgb + IS_CLAMPED], c, count, room)
    if switches[alpha + FUNCTION] != SAME:
        write_function(switches, numbers, alpha, number, 3, count, room)
    write_scaled(numbers[number + SCALES + 1], switches[alpha + IS_CLAMPED], 3, count, room)


@kernel
def write_function(switches, numbers, function, number, c, count, room):
    """Write RESULT, a combine function of channel `c`; `function` is where its switches begin."""
    kind = switches[function + FUNCTION]
    shift = HALF if kind == SIGNED_SUM else ZERO
    write_argument(switches, numbers, function + FIRST_ARGUMENT, number, c, shift, FIRST, count, room)
    if kind == ONLY:
        for n in range(np.uint64(count)):
            room[RESULT + n] = room[FIRST + n]
        return
    write_argument(switches, numbers, function + SECOND_ARGUMENT, number, c, ZERO, SECOND, count, room)
    if kind == PRODUCT:
        for n in range(np.uint64(count)):
            room[RESULT + n] = room[FIRST + n] * room[SECOND + n]
    elif kind == SUM or kind == SIGNED_SUM:
        for n in range(np.uint64(count)):
            room[RESULT + n] = room[FIRST + n] + room[SECOND + n]
    elif kind == DIFFERENCE:
        for n in range(np.uint64(count)):
            room[RESULT + n] = room[FIRST + n] - room[SECOND + n]
    elif kind == MIXTURE:
        write_argument(switches, numbers, function + THIRD_ARGUMENT, number, c, ZERO, THIRD, count, room)
        for n in range(np.uint64(count)):
            weight = room[THIRD + n]
            room[RESULT + n] = room[FIRST + n] * weight + room[SECOND + n] * (ONE - weight)


@kernel
def write_dot_product(switches, numbers, function, number, count, room):
    """Write RESULT, the dot product of two arguments, or the first one's alpha times the sum of the second."""
    by_scalar = switches[function + FUNCTION] == SCALED_SUM
    for c in range(2, -1, -1):
        write_argument(switches, numbers, function + FIRST_ARGUMENT, number, c, ZERO, FIRST, count, room)
        write_argument(switches, numbers, function + SECOND_ARGUMENT, number, c, ZERO, SECOND, count, room)
        for n in range(np.uint64(count)):
            room[FIRST + n] = room[FIRST + n] * TWO - ONE
            second = room[SECOND + n] * TWO - ONE
            room[SECOND + n] = second if by_scalar else room[FIRST + n] * second
        if c == 2:
            for n in range(np.uint64(count)):
                room[RESULT + n] = room[SECOND + n]
        else:
            for n in range(np.uint64(count)):
                room[RESULT + n] += room[SECOND + n]
    if by_scalar:
        for n in range(np.uint64(count)):
            room[RESULT + n] *= room[FIRST + n]


@kernel
def write_argument(switches, numbers, argument, number, c, shift, row, count, room):
    """Write channel `c` of an argument to a row, minus `shift`, where Mesa subtracts it from the first one."""
    source = switches[argument + SOURCE]
    channel = 3 if switches[argument + TAKES_ALPHA] else c
    if source < 0:
        value = numbers[number + CONSTANT + channel] if source == CONSTANT_COLOR else ZERO
        for n in range(np.uint64(count)):
            room[row + n] = value
    else:
        column = np.uint64(source + channel * SIZE)
        for n in range(np.uint64(count)):
            room[row + n] = room[column + n]
    if switches[argument + IS_INVERTED]:
        full = ONE - shift
        for n in range(np.uint64(count)):
            room[row + n] = full - room[row + n]
    elif shift != ZERO:
        for n in range(np.uint64(count)):
            room[row + n] -= shift


@kernel
def write_scaled(scale, is_clamped, c, count, room):
    """Write channel `c` of the colours: RESULT times a scale, clamped or not."""
    row = RED + np.uint64(c) * ROW
    if not is_clamped:
        for n in range(np.uint64(count)):
            room[row + n] = room[RESULT + n]
        return
    for n in range(np.uint64(count)):
        room[row + n] = clamp_to_unit(room[RESULT + n] * scale)
