"""Texture lookups of a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py.

Bytes are filtered in integers (`span_bytes`); the nearest depth is compared in a few loops, and everything else goes
texel by texel (`span_floats`).
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import ROW, TEXEL, R, S, T
from softshadow.pipeline.fast.span_bytes import filter_block, unpack_texels
from softshadow.pipeline.fast.span_cubes import project_onto_faces_of_block
from softshadow.pipeline.fast.span_ellipses import average_ellipses_of_block
from softshadow.pipeline.fast.span_floats import compare_nearest_depths, sample_in_float
from softshadow.pipeline.fast.span_levels import select_levels_of_block, write_squared_steps
from softshadow.pipeline.fast.span_state import (
    BY_RECIPROCAL,
    CHANNELS,
    HEIGHT,
    IN_BYTES,
    IN_ELLIPSES,
    IN_FLOAT,
    IS_CUBE,
    IS_LINE,
    IS_SPREAD,
    LOD_MODE,
    NEAREST_DEPTH,
    NO_LEVELS,
    PATH,
    READS_R,
    S_COLUMN,
    SLICES,
    WIDTH,
)
from softshadow.pipeline.fast.span_steps import write_squared_steps_in_space
from softshadow.programs.filtering import CONSTANT_ZERO


@inlined
def sample_block(planes, spans, n_spans, count, flat, switches, numbers, unit, number, texels, room, whole):
    """Write the colours of a unit's texture to the rows from TEXEL on, for all fragments of a block.

    `unit` and `number` are where the unit's switches and numbers begin.
    """
    path = switches[unit + PATH]
    place_block(planes, spans, n_spans, count, flat, switches, numbers, unit, number, room, whole)
    if path == IN_BYTES:
        filter_block(switches, unit, count, texels, room, whole)
        unpack_texels(count, room, whole)
    elif path == NEAREST_DEPTH:
        compare_nearest_depths(switches, numbers, unit, number, count, texels, room, whole)
    elif path == IN_ELLIPSES:
        is_flat = flat[switches[unit + S_COLUMN]]
        average_ellipses_of_block(
            planes, spans, n_spans, is_flat, switches, numbers, unit, number, texels, room, whole
        )  # fmt: skip
    else:
        sample_in_float(switches, numbers, unit, number, count, texels, room, whole)
    if switches[unit + IS_SPREAD]:
        spread_channels(switches, unit, count, room)


@kernel
def place_block(planes, spans, n_spans, count, flat, switches, numbers, unit, number, room, whole):
    """Write where a unit's texture is looked up, and the level of each fragment."""
    column, path = switches[unit + S_COLUMN], switches[unit + PATH]
    has_levels = switches[unit + LOD_MODE] != NO_LEVELS and path != IN_ELLIPSES
    in_space = switches[unit + SLICES] | switches[unit + IS_CUBE]
    if has_levels and in_space:
        write_squared_steps_in_space(planes, spans, n_spans, flat[column], switches, unit, room)
    elif has_levels:
        write_squared_steps(
            planes, spans, n_spans, column, flat[column], switches[unit + IS_LINE] != 0, switches[unit + WIDTH],
            switches[unit + HEIGHT], room,
        )  # fmt: skip
    if has_levels or path == IN_FLOAT:
        select_levels_of_block(switches, numbers, unit, number, count, room, whole)
    project_block(column, count, switches[unit + READS_R] != 0, room)
    if switches[unit + IS_CUBE]:
        project_onto_faces_of_block(switches[unit + BY_RECIPROCAL] != 0, count, room, whole)


@kernel
def project_block(column, count, reads_r, room):
    """Write S, T and, where it is read, R: the coordinates from `column` on, divided by q; W is overwritten."""
    s = np.uint64(column) * ROW
    for n in range(np.uint64(count)):
        over_q = ONE / room[s + ROW + ROW + ROW + n]
        room[S + n] = room[s + n] * over_q
        room[T + n] = room[s + ROW + n] * over_q
    if reads_r:
        for n in range(np.uint64(count)):
            room[R + n] = room[s + ROW + ROW + n] * (ONE / room[s + ROW + ROW + ROW + n])


@kernel
def spread_channels(switches, unit, count, room):
    """Replace the stored channels in the rows from TEXEL on by the sources of the texture's format.

    No source comes after its channel, so the last channel is first.
    """
    for c in range(3, -1, -1):
        source, row = switches[unit + CHANNELS + c], TEXEL + np.uint64(c) * ROW
        if source >= CONSTANT_ZERO:
            value = ZERO if source == CONSTANT_ZERO else ONE
            for n in range(np.uint64(count)):
                room[row + n] = value
        elif source != c:
            other = TEXEL + np.uint64(source) * ROW
            for n in range(np.uint64(count)):
                room[row + n] = room[other + n]
