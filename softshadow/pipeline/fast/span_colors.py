"""The fixed function on a block of fragments; equals `shade.shading.shade`, see fast/test_span_shading.py."""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.fragment_block import (
    COLUMN,
    FILTERED,
    FOUR_COLUMNS,
    LINE,
    NEXT,
    PACKED,
    ROW,
    SPAN_PLACE,
    SPAN_START,
    TEXEL,
    TEXEL_ALPHA,
    WEIGHT,
    end_of_triangle,
    interpolate_block,
    whole_portions,
    write_pixels,
)
from softshadow.pipeline.fast.span_bytes import BYTE, filter_block
from softshadow.pipeline.fast.span_combine import combine_block, keep_primary, swap_texels
from softshadow.pipeline.fast.span_state import (
    ADD,
    ALPHA_OPERATION,
    AS_BYTES,
    BLEND,
    CHANNELS,
    COMBINE,
    COMBINES,
    CONSTANT,
    DECAL,
    EXP_FOG,
    FOG,
    FOG_COLOR,
    FOG_COLUMN,
    FOG_SHIFT,
    FOG_SLOPE,
    IN_BYTES,
    KEEP,
    LINEAR_FOG,
    MULTIPLY,
    N_UNITS,
    NEEDED,
    NUMBERS_OF_UNIT,
    PATH,
    REPLACE,
    RGB_OPERATION,
    SEPARATE,
    STORED_AS,
    SWITCHES_OF_UNIT,
    UNIT_NUMBERS,
    UNIT_SWITCHES,
    WITH_OTHER,
)
from softshadow.pipeline.fast.span_textures import place_block, sample_block
from softshadow.pipeline.fast.special_fragments import LINE_PLACES, POINT_PLACES, cover_block
from softshadow.pipeline.shade.color_writes import BLUE, GREEN, UPPERMOST, byte_of
from softshadow.programs.filtering import CONSTANT_ONE, UNORM8_STEP, clamp_to_unit
from softshadow.programs.llvmpipe_math import exp2_of_all

RED_ROW, GREEN_ROW, BLUE_ROW, ALPHA_ROW = (np.uint64(n) * ROW for n in range(4))
OPAQUE = np.int32(-1 << 24)  # the largest alpha of a packed colour
SECONDARY = np.uint64(4) * ROW


@inlined
def shade_block(planes, spans, n_spans, count, flat, switches, numbers, textures, own_textures, special, room, whole):
    """Write PACKED, the colours of all fragments of a block as bytes; they stay in the first rows of `room`.

    Colours of a buffer of floats are written there only.

    planes (P, 3, k + 1) are those of `shade.interpolate.attribute_planes`, `spans` and `count` say which fragments;
    `own_textures` (UNITS,) which of the textures the units have.
    """
    in_bytes = switches[STORED_AS] == AS_BYTES
    if in_bytes and switches[NEEDED] == FOUR_COLUMNS:  # nothing but the colours
        if flat[0] and flat[1] and flat[2] and flat[3]:
            write_constant_colors(planes, spans, n_spans, room, whole)
        else:
            write_smooth_colors(planes, spans, n_spans, flat, room, whole)
        return
    if in_bytes and copies_texels(planes, spans, n_spans, flat, switches, special):
        interpolate_block(planes, spans, n_spans, flat, switches[NEEDED] & ~FOUR_COLUMNS, room)
        place_block(
            planes, spans, n_spans, count, flat, switches, numbers, UNIT_SWITCHES, UNIT_NUMBERS, room, whole
        )  # fmt: skip
        filter_block(switches, UNIT_SWITCHES, count, textures[own_textures[0]], room, whole)
        copy_texels(has_no_alpha(switches), count, room, whole)
        return
    interpolate_block(planes, spans, n_spans, flat, switches[NEEDED], room)
    n_units, with_other = switches[N_UNITS], switches[COMBINES] == WITH_OTHER
    if switches[COMBINES]:
        keep_primary(count, room)
    for m in range(n_units):
        u = n_units - 1 - m if with_other else m
        unit, number = UNIT_SWITCHES + u * SWITCHES_OF_UNIT, UNIT_NUMBERS + u * NUMBERS_OF_UNIT
        texels = textures[own_textures[u]]
        sample_block(planes, spans, n_spans, count, flat, switches, numbers, unit, number, texels, room, whole)
        if not with_other:
            apply_unit(switches, numbers, unit, number, count, room)
        elif u:
            swap_texels(count, room)
    if with_other:
        combine_with_other(switches, numbers, n_units, count, room)
    if switches[SEPARATE]:
        for c in range(3):
            row = np.uint64(c) * ROW
            for n in range(np.uint64(count)):
                room[row + n] += room[SECONDARY + row + n]
    if switches[FOG]:
        apply_fog_to_block(switches, numbers, count, room)
    cover_block(special, count, room)
    if in_bytes:
        pack_block(count, room, whole)


@kernel
def write_constant_colors(planes, spans, n_spans, room, whole):
    """Write the colour of each span as the first four planes of its triangle have it, PACKED and alpha."""
    for s in range(np.uint64(n_spans)):
        p, start, end = spans[SPAN_PLACE, s], spans[SPAN_START, s], spans[SPAN_START, s + NEXT]
        red, green, blue, alpha = planes[p, 0, 0], planes[p, 0, 1], planes[p, 0, 2], planes[p, 0, 3]
        packed = byte_of(red) | byte_of(green) << GREEN | byte_of(blue) << BLUE | byte_of(alpha) << UPPERMOST
        for n in range(np.uint64(start), np.uint64(end)):
            whole[PACKED + n], room[ALPHA_ROW + n] = packed, alpha


@kernel
def write_smooth_colors(planes, spans, n_spans, flat, room, whole):
    """Write PACKED and alpha of interpolated colours, as `interpolate_block` and `pack_block` do."""
    n_all, s, k = np.uint64(n_spans), np.uint64(0), np.uint64(flat.shape[0])
    write_pixels(spans, n_all, room)
    while s < n_all:
        p, first, s = np.uint64(spans[SPAN_PLACE, s]), np.uint64(spans[SPAN_START, s]), end_of_triangle(spans, s, n_all)
        count = whole_portions(np.uint64(spans[SPAN_START, s]) - first)
        write_colors_of_triangle(planes[p], k, flat, first, count, room, whole)


@kernel
def write_colors_of_triangle(plane, k, flat, first, count, room, whole):
    """Write PACKED and alpha of the fragments of one triangle with the planes (3, k + 1), from `first` on."""
    w0, wx, wy = plane[0, k], plane[1, k], plane[2, k]
    r0, rx, ry, is_red = plane[0, 0], plane[1, 0], plane[2, 0], flat[0]
    g0, gx, gy, is_green = plane[0, 1], plane[1, 1], plane[2, 1], flat[1]
    b0, bx, by, is_blue = plane[0, 2], plane[1, 2], plane[2, 2], flat[2]
    a0, ax, ay, is_alpha = plane[0, 3], plane[1, 3], plane[2, 3], flat[3]
    for n in range(count):
        x, y = room[COLUMN + first + n], room[LINE + first + n]
        w = ONE / ((wx * x + w0) + wy * y)
        red = r0 if is_red else ((rx * x + r0) + ry * y) * w
        green = g0 if is_green else ((gx * x + g0) + gy * y) * w
        blue = b0 if is_blue else ((bx * x + b0) + by * y) * w
        alpha = a0 if is_alpha else ((ax * x + a0) + ay * y) * w
        low = byte_of(red) | byte_of(green) << GREEN
        whole[PACKED + first + n] = low | byte_of(blue) << BLUE | byte_of(alpha) << UPPERMOST
        room[ALPHA_ROW + first + n] = alpha


@kernel
def copies_texels(planes, spans, n_spans, flat, switches, special):
    """Return whether the colours are the bytes of one texture: it replaces them, or multiplies a constant white."""
    if switches[N_UNITS] != 1 or switches[UNIT_SWITCHES + PATH] != IN_BYTES:
        return False
    for c in range(4):
        source = switches[UNIT_SWITCHES + CHANNELS + c]
        if source != c and not (c == 3 and source == CONSTANT_ONE):
            return False
    if switches[SEPARATE] or switches[FOG] or special[POINT_PLACES] >= 0 or special[LINE_PLACES] >= 0:
        return False
    rgb, alpha = switches[UNIT_SWITCHES + RGB_OPERATION], switches[UNIT_SWITCHES + ALPHA_OPERATION]
    if rgb == REPLACE and alpha == REPLACE:
        return True
    if (rgb != REPLACE and rgb != MULTIPLY) or (alpha != KEEP and alpha != rgb):
        return False
    if not (flat[0] and flat[1] and flat[2] and flat[3]):
        return False
    for s in range(np.uint64(n_spans)):
        p = spans[SPAN_PLACE, s]
        for c in range(4):
            if planes[p, 0, c] != ONE:
                return False
    return True


@inlined
def has_no_alpha(switches):
    """Return whether the alphas of `copies_texels` are all 1: the texture has none, or that of the colour is kept."""
    return switches[UNIT_SWITCHES + CHANNELS + 3] == CONSTANT_ONE or switches[UNIT_SWITCHES + ALPHA_OPERATION] == KEEP


@kernel
def copy_texels(is_opaque, count, room, whole):
    """Write PACKED and alpha by the filtered bytes; with `is_opaque`, all alphas are 1."""
    alphas = OPAQUE if is_opaque else np.int32(0)
    for n in range(np.uint64(count)):
        texel = np.int32(whole[FILTERED + n] | alphas)
        whole[PACKED + n] = texel
        room[ALPHA_ROW + n] = np.float32(np.int32(texel >> 24) & BYTE) * UNORM8_STEP


@kernel
def pack_block(count, room, whole):
    """Write PACKED, the colours as bytes, as `color_writes.pack_bytes`."""
    for n in range(np.uint64(count)):
        low = byte_of(room[RED_ROW + n]) | byte_of(room[GREEN_ROW + n]) << GREEN
        whole[PACKED + n] = low | byte_of(room[BLUE_ROW + n]) << BLUE | byte_of(room[ALPHA_ROW + n]) << UPPERMOST


@kernel
def combine_with_other(switches, numbers, n_units, count, room):
    """Apply the texture functions of up to two units, which read each other's texels; the first one's are in TEXEL."""
    for u in range(n_units):
        unit, number = UNIT_SWITCHES + u * SWITCHES_OF_UNIT, UNIT_NUMBERS + u * NUMBERS_OF_UNIT
        if u:
            swap_texels(count, room)
        apply_unit(switches, numbers, unit, number, count, room)


@kernel
def apply_unit(switches, numbers, unit, number, count, room):
    """Apply a unit's texture function to the colours."""
    if switches[unit + RGB_OPERATION] == COMBINE:
        combine_block(switches, numbers, unit, number, count, room)
    else:
        apply_environment_to_block(switches, numbers, unit, number, count, room)


@kernel
def apply_environment_to_block(switches, numbers, unit, number, count, room):
    """Apply a unit's texture function to the colours, as `texture_environment.apply_environment`."""
    for c in range(4):
        operation = switches[unit + (RGB_OPERATION if c < 3 else ALPHA_OPERATION)]
        row, texel, constant = np.uint64(c) * ROW, TEXEL + np.uint64(c) * ROW, numbers[number + CONSTANT + c]
        if operation == REPLACE:
            for n in range(np.uint64(count)):
                room[row + n] = room[texel + n]
        elif operation == MULTIPLY:
            for n in range(np.uint64(count)):
                room[row + n] *= room[texel + n]
        elif operation == DECAL:
            for n in range(np.uint64(count)):
                weight = room[TEXEL_ALPHA + n]
                room[row + n] = room[texel + n] * weight + room[row + n] * (ONE - weight)
        elif operation == ADD:
            for n in range(np.uint64(count)):
                room[row + n] = clamp_to_unit(room[row + n] + room[texel + n])  # lines and points have colours below 0
        elif operation == BLEND:
            for n in range(np.uint64(count)):
                weight = room[texel + n]
                room[row + n] = constant * weight + room[row + n] * (ONE - weight)


@kernel
def apply_fog_to_block(switches, numbers, count, room):
    """Blend the fog colour into the colours, as `fog.apply_fog`."""
    distance, slope, shift = np.uint64(switches[FOG_COLUMN]) * ROW, numbers[FOG_SLOPE], numbers[FOG_SHIFT]
    if switches[FOG] == LINEAR_FOG:
        for n in range(np.uint64(count)):
            room[WEIGHT + n] = room[distance + n] * slope + shift
    else:
        if switches[FOG] == EXP_FOG:
            for n in range(np.uint64(count)):
                room[TEXEL + n] = -(room[distance + n] * slope)
        else:
            for n in range(np.uint64(count)):
                scaled = room[distance + n] * slope
                room[TEXEL + n] = -(scaled * scaled)
        exp2_of_all(room[TEXEL : TEXEL + np.uint64(count)], room[WEIGHT : WEIGHT + np.uint64(count)])
    for n in range(np.uint64(count)):
        factor = room[WEIGHT + n]
        factor = factor if factor > ZERO else ZERO
        room[WEIGHT + n] = factor if factor < ONE else ONE
    for c in range(3):
        row, color = np.uint64(c) * ROW, numbers[FOG_COLOR + c]
        for n in range(np.uint64(count)):
            factor = room[WEIGHT + n]
            room[row + n] = color * (ONE - factor) + room[row + n] * factor
