"""The vertex stage of many draws; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

`prepare_draws` computes what the vertices of a draw share; `process_vertices` walks over the vertices of all draws.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ZERO
from softshadow.pipeline.fast.batch.light_block import light_vertices
from softshadow.pipeline.fast.batch.lighting import N_LIGHTS, NEEDS_EYE, OBJECT_SPACE, clamped, place_lights
from softshadow.pipeline.fast.batch.matrices import invert, multiply
from softshadow.pipeline.geometry.clip import outcode
from softshadow.pipeline.geometry.vertex import clip_position, window_position
from softshadow.programs.inverse import LENGTH_PRESERVING

# columns of a draw's row: matrices, constant attributes; the product and the inverse are written by `prepare_draws`
MODELVIEW, PROJECTION, COLOR, NORMAL, PRODUCT, INVERSE, FLOATS = 0, 16, 32, 36, 40, 56, 72
# columns of a draw's numbers: vertices and indices [start, end), how its modelview matrix is inverted; ACROSS: whether
# all its quads are cut along the other diagonal
START, END, MODE, INDEX_START, INDEX_END, INDEXED, KIND, LIGHTING, ACROSS, NUMBERS = range(10)
# columns of a texture unit of a draw: its matrix, the constant coordinates, whether the matrix is the identity
UNIT_MATRIX, UNIT_CONSTANT, UNIT_IS_IDENTITY, UNIT_COLUMNS = 0, 16, 20, 21
SPECIFIED, OBJECT_LINEAR, EYE_LINEAR = range(3)  # how a texture coordinate is generated
HAS_ARRAY = 4  # the column after those of the four coordinates: whether a unit has an array of them


class Layout(NamedTuple):
    """What all draws of a table have in common, as plain numbers.

    lit, separate, two_side, fog: the state; colors, normals: whether they are arrays; units: how many are in use;
    in_eye_space: a unit generates coordinates there; ignored: clip codes that do not clip.
    """

    lit: int
    separate: int
    two_side: int
    fog: int
    colors: int
    normals: int
    units: int
    in_eye_space: int
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
        if layout.lit:
            to_object, lighting = matrix_at(row, INVERSE), numbers[d, LIGHTING]
            invert(modelview, kind, to_object)
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
    begin, end, layout, numbers, rows, lights, materials, flags, placed, generated, planes, unit_rows, positions,
    colors, normals, texcoords, scale, shift, clip, codes, window, values, back,
):  # fmt: skip
    """Write clip position, clip code, window position and varyings of the vertices [begin, end) of all draws."""
    for d in range(numbers.shape[0]):
        first, last = max(numbers[d, START], begin), min(numbers[d, END], end)
        if first >= last:
            continue
        row = rows[d]
        modelview, product = matrix_at(row, MODELVIEW), matrix_at(row, PRODUCT)
        for vertex in range(first, last):
            v = np.uint64(vertex)
            clip_position(product, positions, v, clip)
            codes[v] = outcode(clip[v, 0], clip[v, 1], clip[v, 2], clip[v, 3]) & ~layout.ignored
            window_position(clip, v, scale, shift, window)
        if layout.lit:
            lighting, kind = numbers[d, LIGHTING], numbers[d, KIND]
            light_vertices(
                first, last, layout.two_side, layout.separate, in_object_space(layout, flags[lighting], kind),
                not kind & ~LENGTH_PRESERVING, modelview, matrix_at(row, INVERSE), row[NORMAL:PRODUCT],
                row[COLOR:NORMAL], lights[lighting], materials[lighting], flags[lighting], placed[d], positions,
                colors, normals, values, back,
            )  # fmt: skip
        else:
            for vertex in range(first, last):
                v = np.uint64(vertex)
                for c in range(4):
                    values[v, c] = clamped(colors[v, c] if layout.colors else row[COLOR + c])
        column = 7 if layout.separate else 4
        for unit in range(layout.units):
            write_coordinates(
                first, last, generated[unit], planes[unit], unit_rows[d, unit], modelview, positions, texcoords[unit],
                values, column,
            )  # fmt: skip
            column += 4
        if layout.fog:
            from_eye = layout.lit and flags[numbers[d, LIGHTING], NEEDS_EYE]
            for vertex in range(first, last):
                v = np.uint64(vertex)
                x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
                distance = transformed(modelview, 2, x, y, z, w) if from_eye else plane_dot(modelview, 2, x, y, z, w)
                values[v, column] = abs(distance)
            column += 1
        if layout.two_side:
            for vertex in range(first, last):
                for c in range(7 if layout.separate else 4, column):
                    back[vertex, c] = values[vertex, c]


@kernel
def write_coordinates(
    first, last, generated, planes, unit_row, modelview, positions, texcoords, values, column
):  # fmt: skip
    """Write the texture coordinates of vertices in one unit: specified or generated, times the texture matrix."""
    matrix = unit_row[UNIT_MATRIX : UNIT_MATRIX + 16].reshape(4, 4)
    for vertex in range(first, last):
        v = np.uint64(vertex)
        x, y, z, w = positions[v, 0], positions[v, 1], positions[v, 2], positions[v, 3]
        for c in range(4):
            if generated[c] == SPECIFIED:
                values[v, column + c] = texcoords[v, c] if generated[HAS_ARRAY] else unit_row[UNIT_CONSTANT + c]
            elif generated[c] == OBJECT_LINEAR:
                values[v, column + c] = plane_dot(planes, c, x, y, z, w)
            else:
                values[v, column + c] = plane_dot(
                    planes, c, transformed(modelview, 0, x, y, z, w), transformed(modelview, 1, x, y, z, w),
                    transformed(modelview, 2, x, y, z, w), transformed(modelview, 3, x, y, z, w),
                )  # fmt: skip
        if unit_row[UNIT_IS_IDENTITY] == ZERO:
            s, t, r, q = values[v, column], values[v, column + 1], values[v, column + 2], values[v, column + 3]
            for c in range(4):
                values[v, column + c] = transformed(matrix, c, s, t, r, q)
