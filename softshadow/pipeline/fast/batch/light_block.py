"""Lighting of blocks of vertices; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

The operations are those of `softshadow.programs.lighting`, in the same order for each vertex. A block of vertices goes
through all of them in the first-level cache. Each step is a loop over the whole block, and the state decides which
loops run: so no loop contains a branch, and all are vectorised. A block always has `LANES` vertices, since loops of a
constant length need no remainder; what the lanes behind the last vertex hold is not read.
"""

import numpy as np

from softshadow.jit import allocating_kernel, inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO
from softshadow.pipeline.fast.batch.lighting import (
    AMBIENT,
    CONSTANT,
    COSINE,
    DIFFUSE,
    EMISSION,
    FOLLOWS_AMBIENT,
    FOLLOWS_BACK,
    FOLLOWS_DIFFUSE,
    FOLLOWS_EMISSION,
    FOLLOWS_FRONT,
    FOLLOWS_SPECULAR,
    HALF_VECTOR,
    HAS_POLYNOMIAL,
    HAS_SPOT,
    HIGHLIGHTS,
    LINEAR,
    LOCAL_VIEWER,
    MATERIAL_AMBIENT,
    MATERIAL_DIFFUSE,
    MATERIAL_SPECULAR,
    MODEL_AMBIENT,
    N_LIGHTS,
    NEEDS_EYE,
    NORMALIZES,
    PLACED,
    POSITION,
    QUADRATIC,
    REFLECTANCES,
    RESCALES,
    SHININESS,
    SPECULAR,
    SPOT_DIRECTION,
    SPOT_EXPONENT,
    clamped_lit,
    dot3,
    positive,
    root_of,
)
from softshadow.programs.lighting import LARGEST_SHININESS, SMALLEST_SCALE
from softshadow.programs.llvmpipe_math import power

BLOCK = 64  # vertices; shorter loops are unrolled before they can be vectorised
LANES = np.uint64(BLOCK)
# rows of LANES numbers: the normal, the eye position, the direction to the light, the half vector
NORMAL, EYE, TO_LIGHT, HALF = (np.uint64(row * BLOCK) for row in (0, 3, 6, 9))
Y, Z, W = (np.uint64(row * BLOCK) for row in (1, 2, 3))  # from the first row of a vector or of a colour on
SQUARED, ATTENUATION, BASE, EXPONENT, RAISED, TOWARDS = (np.uint64(row * BLOCK) for row in range(12, 18))
# the vertex colour; the material, with emission and the light model's part; the results
COLOR, OWN_AMBIENT, OWN_DIFFUSE, OWN_SPECULAR, LIT, HIGHLIGHT = (np.uint64(row * BLOCK) for row in range(18, 42, 4))
OWN_SHININESS = np.uint64(41 * BLOCK)
ROWS = 42


@allocating_kernel
def light_vertices(
    first, last, two_side, separate, object_space, keeps_length, modelview, to_object, normal, color, lights,
    materials, flags, placed, positions, colors, normals, reflectances, values, back,
):  # fmt: skip
    """Write the lit colours of the vertices [first, last), which belong to one draw, and their separate highlights.

    `normal`, `color` and `materials` are those of all vertices where `normals`, `colors` and `reflectances` have no
    rows.
    """
    room = np.empty(ROWS * BLOCK, np.float32)
    for begin in range(first, last, BLOCK):
        start, count = np.uint64(begin), np.uint64(min(last - begin, BLOCK))
        read_vectors(start, count, normal, normals, NORMAL, room)
        if flags[NEEDS_EYE]:
            write_eye_positions(start, count, modelview, positions, room)
        else:
            for n in range(LANES):
                room[EYE + n] = room[EYE + Y + n] = room[EYE + Z + n] = ZERO
        read_vectors(start, count, color, colors, COLOR, room)
        for n in range(count):
            room[COLOR + W + n] = colors[start + n, 3] if colors.shape[0] else color[3]
        write_unit_normals(flags, to_object, object_space, keeps_length, room)
        for side in range(2 if two_side else 1):
            if side == 1:
                for n in range(LANES):
                    room[NORMAL + n] = -room[NORMAL + n]
                    room[NORMAL + Y + n] = -room[NORMAL + Y + n]
                    room[NORMAL + Z + n] = -room[NORMAL + Z + n]
            follows = flags[FOLLOWS_BACK if side else FOLLOWS_FRONT]
            begin_colors(start, count, materials[side], follows, reflectances, side * REFLECTANCES, room)
            for light in range(flags[N_LIGHTS]):
                add_light(lights[light], placed[light], flags, separate, room)
            write_colors(start, count, separate, room, back if side else values)


@kernel
def read_vectors(start, count, constant, vectors, row, room):
    """Write the first three columns of vertices to the rows from `row` on, or a constant if there are none."""
    if vectors.shape[0]:
        for n in range(count):
            room[row + n], room[row + Y + n] = vectors[start + n, 0], vectors[start + n, 1]
            room[row + Z + n] = vectors[start + n, 2]
    else:
        x, y, z = constant[0], constant[1], constant[2]
        for n in range(LANES):
            room[row + n], room[row + Y + n], room[row + Z + n] = x, y, z


@inlined
def write_eye_positions(start, count, modelview, positions, room):
    """Write EYE, the positions of vertices in eye space."""
    for c in range(3):
        row = EYE + np.uint64(c) * LANES
        by_x, by_y, by_z, by_w = modelview[c, 0], modelview[c, 1], modelview[c, 2], modelview[c, 3]
        for n in range(count):
            v = start + n
            x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
            room[row + n] = ((x * by_x + y * by_y) + z * by_z) + w * by_w


@inlined
def write_unit_normals(flags, to_object, object_space, keeps_length, room):
    """Turn the normals into eye space, unless the lights are in object space; normalize or rescale them."""
    m = to_object
    if not object_space:
        a, b, c, d, e, f, g, h, i = m[0, 0], m[1, 0], m[2, 0], m[0, 1], m[1, 1], m[2, 1], m[0, 2], m[1, 2], m[2, 2]
        for n in range(LANES):
            x, y, z = room[NORMAL + n], room[NORMAL + Y + n], room[NORMAL + Z + n]
            room[NORMAL + n] = dot3(x, y, z, a, b, c)
            room[NORMAL + Y + n] = dot3(x, y, z, d, e, f)
            room[NORMAL + Z + n] = dot3(x, y, z, g, h, i)
    if flags[NORMALIZES]:
        normalize_rows(NORMAL, room)
    elif flags[RESCALES] and not object_space and not keeps_length:
        squared = (m[2, 0] * m[2, 0] + m[2, 1] * m[2, 1]) + m[2, 2] * m[2, 2]
        factor = ONE / np.sqrt(squared if squared >= SMALLEST_SCALE else ONE)
        for n in range(LANES):
            room[NORMAL + n] *= factor
            room[NORMAL + Y + n] *= factor
            room[NORMAL + Z + n] *= factor


@kernel
def normalize_rows(row, room):
    """Normalize the vectors in the rows from `row` on."""
    for n in range(LANES):
        x, y, z = room[row + n], room[row + Y + n], room[row + Z + n]
        factor = root_of(dot3(x, y, z, x, y, z))
        room[row + n], room[row + Y + n], room[row + Z + n] = x * factor, y * factor, z * factor


@inlined
def begin_colors(start, count, material, follows, reflectances, first_column, room):
    """Write the material, whose colours follow the vertex colour or do not; LIT begins with what needs no light.

    The columns of this side begin in `reflectances` with `first_column`.
    """
    own = start, count, material, reflectances, first_column
    write_reflectance(follows & FOLLOWS_AMBIENT, 4, MATERIAL_AMBIENT, own, OWN_AMBIENT, room)
    write_reflectance(follows & FOLLOWS_DIFFUSE, 4, MATERIAL_DIFFUSE, own, OWN_DIFFUSE, room)
    write_reflectance(follows & FOLLOWS_SPECULAR, 4, MATERIAL_SPECULAR, own, OWN_SPECULAR, room)
    write_reflectance(follows & FOLLOWS_EMISSION, 4, EMISSION, own, LIT, room)
    write_reflectance(0, 1, SHININESS, own, OWN_SHININESS, room)
    for c in range(3):
        row, model = np.uint64(c) * LANES, material[MODEL_AMBIENT + c]
        for n in range(LANES):
            room[LIT + row + n] = model * room[OWN_AMBIENT + row + n] + room[LIT + row + n]
            room[HIGHLIGHT + row + n] = ZERO


@kernel
def write_reflectance(follows, n_columns, column, own, row, room):
    """Write columns of the material of each vertex to the rows from `row` on, or its colour where they follow it.

    `own`: the first vertex and the number of vertices, the material of all that have none, `reflectances` and the first
    of their columns.
    """
    start, count, material, reflectances, first_column = own
    for c in range(n_columns):
        at, constant, component = np.uint64(first_column + column + c), material[column + c], np.uint64(c) * LANES
        if follows:
            for n in range(LANES):
                room[row + component + n] = room[COLOR + component + n]
        elif reflectances.shape[0]:
            for n in range(count):
                room[row + component + n] = reflectances[start + n, at]
        else:
            for n in range(LANES):
                room[row + component + n] = constant


@kernel
def add_light(light, placed, flags, separate, room):
    """Add what one light contributes to LIT and HIGHLIGHT."""
    is_positional, highlights = light[POSITION + 3] != ZERO, flags[HIGHLIGHTS] != 0
    is_local = flags[LOCAL_VIEWER] != 0 and highlights
    write_directions(placed, is_positional, is_local, room)
    attenuates = write_attenuation(light, room)
    for n in range(LANES):
        towards = dot3(
            room[NORMAL + n], room[NORMAL + Y + n], room[NORMAL + Z + n], room[TO_LIGHT + n], room[TO_LIGHT + Y + n],
            room[TO_LIGHT + Z + n],
        )  # fmt: skip
        room[TOWARDS + n] = room[BASE + n] = room[EXPONENT + n] = towards
    if highlights:
        for n in range(LANES):
            room[BASE + n] = dot3(
                room[NORMAL + n], room[NORMAL + Y + n], room[NORMAL + Z + n], room[HALF + n], room[HALF + Y + n],
                room[HALF + Z + n],
            )  # fmt: skip
            room[EXPONENT + n] = room[OWN_SHININESS + n]
    if highlights or attenuates:
        for n in range(LANES):
            exponent = room[EXPONENT + n]
            exponent = -LARGEST_SHININESS if exponent < -LARGEST_SHININESS else exponent
            room[EXPONENT + n] = LARGEST_SHININESS if exponent > LARGEST_SHININESS else exponent
            room[BASE + n] = positive(room[BASE + n])
        raise_rows(room)
        for n in range(LANES):
            room[RAISED + n] = ZERO if room[TOWARDS + n] <= ZERO else room[RAISED + n]
    else:
        for n in range(LANES):
            room[RAISED + n] = ONE if room[TOWARDS + n] > ZERO else ZERO
    for n in range(LANES):
        room[TOWARDS + n] = positive(room[TOWARDS + n]) * room[ATTENUATION + n]
        room[RAISED + n] *= room[ATTENUATION + n]
    for c in range(3):
        row, ambient, diffuse = np.uint64(c) * LANES, light[AMBIENT + c], light[DIFFUSE + c]
        specular, sum_row = light[SPECULAR + c], (HIGHLIGHT if separate else LIT) + np.uint64(c) * LANES
        for n in range(LANES):
            rgb = room[ATTENUATION + n] * (ambient * room[OWN_AMBIENT + row + n]) + room[LIT + row + n]
            room[LIT + row + n] = room[TOWARDS + n] * (diffuse * room[OWN_DIFFUSE + row + n]) + rgb
            room[BASE + n] = room[RAISED + n] * (specular * room[OWN_SPECULAR + row + n])
        for n in range(LANES):
            room[sum_row + n] = room[BASE + n] + room[sum_row + n]


@inlined
def write_directions(placed, is_positional, is_local, room):
    """Write TO_LIGHT, SQUARED (the distance, 0 for directional lights) and HALF."""
    x, y, z = placed[PLACED], placed[PLACED + 1], placed[PLACED + 2]
    if is_positional:
        for n in range(LANES):
            i, j, k = x - room[EYE + n], y - room[EYE + Y + n], z - room[EYE + Z + n]
            squared = dot3(i, j, k, i, j, k)
            factor = root_of(squared)
            i, j, k, room[SQUARED + n] = i * factor, j * factor, k * factor, squared
            room[TO_LIGHT + n], room[TO_LIGHT + Y + n], room[TO_LIGHT + Z + n] = i, j, k
            room[HALF + n], room[HALF + Y + n], room[HALF + Z + n] = i, j, k + ONE
    else:
        half_x, half_y, half_z = placed[HALF_VECTOR], placed[HALF_VECTOR + 1], placed[HALF_VECTOR + 2]
        for n in range(LANES):
            room[SQUARED + n] = ZERO
            room[TO_LIGHT + n], room[TO_LIGHT + Y + n], room[TO_LIGHT + Z + n] = x, y, z
            room[HALF + n], room[HALF + Y + n], room[HALF + Z + n] = half_x, half_y, half_z
    if is_local:
        for n in range(LANES):
            i, j, k = room[EYE + n], room[EYE + Y + n], room[EYE + Z + n]
            factor = root_of(dot3(i, j, k, i, j, k))
            room[HALF + n] = room[TO_LIGHT + n] - i * factor
            room[HALF + Y + n] = room[TO_LIGHT + Y + n] - j * factor
            room[HALF + Z + n] = room[TO_LIGHT + Z + n] - k * factor
    if is_positional or is_local:
        normalize_rows(HALF, room)


@inlined
def write_attenuation(light, room):
    """Write ATTENUATION, by the angle and the distance, else 1; return whether the light has one."""
    has_spot, has_polynomial = light[HAS_SPOT] != ZERO, light[HAS_POLYNOMIAL] != ZERO
    if has_spot:
        x, y, z = light[SPOT_DIRECTION], light[SPOT_DIRECTION + 1], light[SPOT_DIRECTION + 2]
        cosine, exponent = light[COSINE], light[SPOT_EXPONENT]
        for n in range(LANES):
            spot = dot3(-room[TO_LIGHT + n], -room[TO_LIGHT + Y + n], -room[TO_LIGHT + Z + n], x, y, z)
            room[ATTENUATION + n] = ONE if cosine < spot else ZERO
            room[BASE + n], room[EXPONENT + n] = abs(spot), exponent
        raise_rows(room)
        for n in range(LANES):
            room[ATTENUATION + n] = room[RAISED + n] if room[ATTENUATION + n] != ZERO else ZERO
    else:
        for n in range(LANES):
            room[ATTENUATION + n] = ONE
    if has_polynomial:
        constant, linear, quadratic = light[CONSTANT], light[LINEAR], light[QUADRATIC]
        for n in range(LANES):
            squared = room[SQUARED + n]
            distance = np.sqrt(squared)
            one = root_of(squared) * distance
            polynomial = (quadratic * squared + linear * distance) + constant * one
            room[ATTENUATION + n] = (ONE / polynomial) * room[ATTENUATION + n]
    return has_spot or has_polynomial


@kernel
def raise_rows(room):
    """Write RAISED, BASE to the power of EXPONENT, as llvmpipe approximates it."""
    for n in range(LANES):
        room[RAISED + n] = power(room[BASE + n], room[EXPONENT + n])


@kernel
def write_colors(start, count, separate, room, values):
    """Write the colours and highlights of a block to the rows of `values`, clamped."""
    for n in range(count):
        v = start + n
        values[v, 0], values[v, 1] = clamped_lit(room[LIT + n]), clamped_lit(room[LIT + Y + n])
        values[v, 2], values[v, 3] = clamped_lit(room[LIT + Z + n]), clamped_lit(room[OWN_DIFFUSE + W + n])
    if separate:
        for n in range(count):
            v = start + n
            values[v, 4], values[v, 5] = clamped_lit(room[HIGHLIGHT + n]), clamped_lit(room[HIGHLIGHT + Y + n])
            values[v, 6] = clamped_lit(room[HIGHLIGHT + Z + n])
