"""The vertex stage of many draws; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

`prepare_draws` computes what the vertices of a draw share; `process_vertices` walks over the vertices of all draws.
"""

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.fast.batch.light_block import light_vertices
from softshadow.pipeline.fast.batch.lighting import (
    N_LIGHTS,
    NEEDS_EYE,
    NORMALIZES,
    OBJECT_SPACE,
    RESCALES,
    clamped,
    dot3,
    place_lights,
    root_of,
)
from softshadow.pipeline.fast.batch.matrices import invert, multiply
from softshadow.pipeline.geometry.clip import outcode, write_outcodes
from softshadow.pipeline.geometry.vertex import clip_position, window_position
from softshadow.programs.inverse import LENGTH_PRESERVING
from softshadow.programs.lighting import SMALLEST_SCALE

# columns of a draw's row: matrices, constant attributes; the product and the inverse are written by `prepare_draws`
MODELVIEW, PROJECTION, COLOR, NORMAL, PRODUCT, INVERSE, FLOATS = 0, 16, 32, 36, 40, 56, 72
# columns of a draw's numbers: vertices and indices [start, end), how its modelview matrix is inverted; ACROSS: 1 if
# all its quads are cut along the other diagonal, IN_STAGES if all are cut like clipped ones; VIEW: its viewport;
# rows [FIRST_PLANE, END_PLANE): its clip planes
# MODE is JOINED_STRIPS for separate triangles of several strips, with quad strips among them
START, END, MODE, INDEX_START, INDEX_END, INDEXED, KIND, LIGHTING, ACROSS, VIEW, FIRST_PLANE, END_PLANE = range(12)
NUMBERS = 12
IN_STAGES = 2
JOINED_STRIPS = -1
# columns of a texture unit of a draw: its matrix, the constant coordinates, whether the matrix is the identity
UNIT_MATRIX, UNIT_CONSTANT, UNIT_IS_IDENTITY, UNIT_COLUMNS = 0, 16, 20, 21
# how a texture coordinate is generated; from EYE_LINEAR on from the eye position, from SPHERE_MAP on from the normal
SPECIFIED, OBJECT_LINEAR, EYE_LINEAR, SPHERE_MAP, REFLECTION_MAP, NORMAL_MAP = range(6)
GENERATED = {
    gl.GL_OBJECT_LINEAR: OBJECT_LINEAR, gl.GL_EYE_LINEAR: EYE_LINEAR, gl.GL_SPHERE_MAP: SPHERE_MAP,
    gl.GL_REFLECTION_MAP: REFLECTION_MAP, gl.GL_NORMAL_MAP: NORMAL_MAP,
}  # fmt: skip
HAS_ARRAY = 4  # the column after those of the four coordinates: whether a unit has an array of them
NO_FOG, BY_DISTANCE, BY_COORDINATE = range(3)


class Layout(NamedTuple):
    """What all draws of a table have in common, as plain numbers.

    lit, two_side: the state; separate: lighting has a secondary colour; secondary: there are columns for one; fog:
    NO_FOG, BY_DISTANCE or BY_COORDINATE; colors, normals: whether they are arrays; units: how many are in use;
    in_eye_space: a unit generates coordinates there; maps_normals: from normals; reflects_r: see
    `texture_coordinates.Normals`; repeats_primary: see `fixed_function.repeats_primary`; ignored: clip codes that do
    not clip.
    """

    lit: int
    separate: int
    secondary: int
    two_side: int
    fog: int
    colors: int
    normals: int
    units: int
    in_eye_space: int
    maps_normals: int
    reflects_r: int
    repeats_primary: int
    ignored: int


@inlined
def matrix_at(row, column):
    """Return a matrix (4, 4) in a draw's row."""
    return row[column : column + 16].reshape(4, 4)


@kernel
def prepare_draws(layout, numbers, rows, lights, flags, placed):
    """Write the product, the inverse and the placed lights of each draw."""
    for d in range(rows.shape[0]):
        row, kind = rows[d], numbers[d, KIND]
        modelview = matrix_at(row, MODELVIEW)
        multiply(matrix_at(row, PROJECTION), modelview, matrix_at(row, PRODUCT))
        to_object, lighting = matrix_at(row, INVERSE), numbers[d, LIGHTING]
        if layout.lit or layout.maps_normals:
            invert(modelview, kind, to_object)
        if layout.lit:
            place_lights(
                lights[lighting], flags[lighting, N_LIGHTS], modelview, to_object,
                in_object_space(layout, flags[lighting], kind), placed[d],
            )  # fmt: skip


@inlined
def in_object_space(layout, flags, kind):
    """Return whether the lighting of a draw works in object space."""
    return flags[OBJECT_SPACE] != 0 and not layout.in_eye_space and not kind & ~LENGTH_PRESERVING


@kernel
def plane_dot(m, i, x, y, z, w):
    """Return the dot product of row i of a matrix with a vector, added from the last component to the first."""
    return ((w * m[i, 3] + z * m[i, 2]) + y * m[i, 1]) + x * m[i, 0]


@kernel
def transformed(m, i, x, y, z, w):
    """Return component i of matrix times vector, added from x to w."""
    return ((x * m[i, 0] + y * m[i, 1]) + z * m[i, 2]) + w * m[i, 3]


@kernel
def process_vertices(
    begin, end, layout, numbers, rows, lights, materials, flags, placed, generated, planes, user_planes, unit_rows,
    positions, colors, normals, reflectances, secondaries, fog_coordinates, texcoords, scales, shifts, clip, codes,
    window, values, back,
):  # fmt: skip
    """Write clip position, clip code, window position and varyings of the vertices [begin, end) of all draws."""
    for d in range(numbers.shape[0]):
        first, last = max(numbers[d, START], begin), min(numbers[d, END], end)
        if first >= last:
            continue
        row, scale, shift = rows[d], scales[numbers[d, VIEW]], shifts[numbers[d, VIEW]]
        modelview, product = matrix_at(row, MODELVIEW), matrix_at(row, PRODUCT)
        for vertex in range(first, last):
            v = np.uint64(vertex)
            clip_position(product, positions, v, clip)
            codes[v] = outcode(clip[v, 0], clip[v, 1], clip[v, 2], clip[v, 3]) & ~layout.ignored
            window_position(clip, v, scale, shift, window)
        first_plane, end_plane = numbers[d, FIRST_PLANE], numbers[d, END_PLANE]
        if first_plane < end_plane:
            own_planes = user_planes[first_plane:end_plane]
            write_outcodes(clip[first:last], own_planes, layout.ignored, codes[first:last])
        lighting, kind = numbers[d, LIGHTING], numbers[d, KIND]
        if layout.lit:
            light_vertices(
                first, last, layout.two_side, layout.separate, in_object_space(layout, flags[lighting], kind),
                not kind & ~LENGTH_PRESERVING, modelview, matrix_at(row, INVERSE), row[NORMAL:PRODUCT],
                row[COLOR:NORMAL], lights[lighting], materials[lighting], flags[lighting], placed[d], positions,
                colors, normals, reflectances, values, back,
            )  # fmt: skip
        else:
            for vertex in range(first, last):
                v = np.uint64(vertex)
                for c in range(4):
                    values[v, c] = clamped(colors[v, c] if layout.colors else row[COLOR + c])
        if layout.secondary and not layout.separate:
            for vertex in range(first, last):
                v = np.uint64(vertex)
                for c in range(3):  # Mesa's vertex program of lighting writes none, which reads as 0
                    values[v, 4 + c] = ZERO if layout.lit else clamped(secondaries[v, c])
        column = 7 if layout.secondary else 4
        for unit in range(layout.units):
            write_coordinates(
                first, last, generated[unit], planes[unit], unit_rows[d, unit], modelview, matrix_at(row, INVERSE),
                flags[lighting, NORMALIZES], flags[lighting, RESCALES] and kind & ~LENGTH_PRESERVING,
                layout.reflects_r, row[NORMAL:PRODUCT], positions, normals, texcoords[unit], values, column,
            )  # fmt: skip
            column += 4
        if layout.fog == BY_COORDINATE:
            for vertex in range(first, last):
                v = np.uint64(vertex)
                values[v, column] = abs(fog_coordinates[v])
        elif layout.fog:
            from_eye = layout.lit and flags[numbers[d, LIGHTING], NEEDS_EYE]
            for vertex in range(first, last):
                v = np.uint64(vertex)
                x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
                distance = transformed(modelview, 2, x, y, z, w) if from_eye else plane_dot(modelview, 2, x, y, z, w)
                values[v, column] = abs(distance)
        if layout.fog:
            column += 1
        if layout.repeats_primary:
            for vertex in range(first, last):
                v = np.uint64(vertex)
                for c in range(4):
                    values[v, column + c] = values[v, c]
        if layout.two_side:
            for vertex in range(first, last):
                for c in range(7 if layout.separate else 4, column):
                    back[vertex, c] = values[vertex, c]


@kernel
def write_coordinates(
    first, last, generated, planes, unit_row, modelview, to_object, normalizes, rescales, reflects_r, normal,
    positions, normals, texcoords, values, column,
):  # fmt: skip
    """Write the texture coordinates of vertices in one unit: specified or generated, times the texture matrix.

    `normal` is that of all vertices where `normals` has no rows.
    """
    matrix = unit_row[UNIT_MATRIX : UNIT_MATRIX + 16].reshape(4, 4)
    most = max(max(generated[0], generated[1]), max(generated[2], generated[3]))
    if most >= SPHERE_MAP:
        write_mapped(
            first, last, generated, modelview, to_object, normalizes, rescales, reflects_r, normal, positions, normals,
            values, column,
        )  # fmt: skip
    for vertex in range(first, last):
        v = np.uint64(vertex)
        x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
        for c in range(4):
            if generated[c] == SPECIFIED:
                values[v, column + c] = texcoords[v, c] if generated[HAS_ARRAY] else unit_row[UNIT_CONSTANT + c]
            elif generated[c] == OBJECT_LINEAR:
                values[v, column + c] = plane_dot(planes, c, x, y, z, w)
            elif generated[c] == EYE_LINEAR:
                values[v, column + c] = plane_dot(
                    planes, c, transformed(modelview, 0, x, y, z, w), transformed(modelview, 1, x, y, z, w),
                    transformed(modelview, 2, x, y, z, w), transformed(modelview, 3, x, y, z, w),
                )  # fmt: skip
        if unit_row[UNIT_IS_IDENTITY] == ZERO:
            s, t, r, q = values[v, column], values[v, column + 1], values[v, column + 2], values[v, column + 3]
            for c in range(4):
                values[v, column + c] = transformed(matrix, c, s, t, r, q)


@kernel
def write_mapped(
    first, last, generated, modelview, to_object, normalizes, rescales, reflects_r, normal, positions, normals, values,
    column,
):  # fmt: skip
    """Write the coordinates that are generated from normals, as `texture_coordinates.generate_coordinate`."""
    m = to_object
    squared = (m[2, 0] * m[2, 0] + m[2, 1] * m[2, 1]) + m[2, 2] * m[2, 2]
    scale = ONE / np.sqrt(squared if squared >= SMALLEST_SCALE else ONE)
    has_normals = normals.shape[0] != 0
    for vertex in range(first, last):
        v = np.uint64(vertex)
        a, b, c = normal[0], normal[1], normal[2]
        if has_normals:
            a, b, c = normals[v, 0], normals[v, 1], normals[v, 2]
        nx = dot3(a, b, c, m[0, 0], m[1, 0], m[2, 0])
        ny = dot3(a, b, c, m[0, 1], m[1, 1], m[2, 1])
        nz = dot3(a, b, c, m[0, 2], m[1, 2], m[2, 2])
        factor = ONE
        if normalizes:
            factor = root_of(dot3(nx, ny, nz, nx, ny, nz))
        elif rescales:
            factor = scale
        if normalizes or rescales:
            nx, ny, nz = nx * factor, ny * factor, nz * factor
        x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
        ux = transformed(modelview, 0, x, y, z, w)
        uy = transformed(modelview, 1, x, y, z, w)
        uz = transformed(modelview, 2, x, y, z, w)
        factor = root_of(dot3(ux, uy, uz, ux, uy, uz))
        ux, uy, uz = ux * factor, uy * factor, uz * factor
        cosine = dot3(nx, ny, nz, ux, uy, uz)
        turn = -(cosine + cosine)
        turn_z = turn * nz
        rx, ry, rz = turn * nx + ux, turn * ny + uy, turn_z + uz
        half_way = rz + ONE if reflects_r else (turn_z + ONE) + uz
        over = root_of(dot3(rx, ry, half_way, rx, ry, half_way)) * HALF
        for k in range(4):
            mapped = nx if k == 0 else ny if k == 1 else nz
            if generated[k] == SPHERE_MAP:
                mapped = (rx if k == 0 else ry if k == 1 else rz) * over + HALF
            elif generated[k] == REFLECTION_MAP:
                mapped = rx if k == 0 else ry if k == 1 else rz
            if generated[k] >= SPHERE_MAP:
                values[v, column + k] = mapped
