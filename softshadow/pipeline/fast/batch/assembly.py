"""The triangles of many draws; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

The patterns are those of `geometry.assembly`; how quads are cut depends on the clip codes of their segment
(`mesa.segments`).
"""

from collections.abc import Sequence

from softshadow.jit import kernel
from softshadow.pipeline.alike_draws import AlikeDraws, parts_of
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.vertices import (
    ACROSS,
    END,
    IN_STAGES,
    INDEX_END,
    INDEX_START,
    INDEXED,
    JOINED_STRIPS,
    MODE,
    START,
)
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.mesa.segments import INDEXED_SEGMENT, QUADS_OF_SEGMENT, SEGMENT
from softshadow.tokens import (
    GL_LINE_LOOP,
    GL_LINE_STRIP,
    GL_LINES,
    GL_POINTS,
    GL_POLYGON,
    GL_QUAD_STRIP,
    GL_QUADS,
    GL_TRIANGLE_FAN,
    GL_TRIANGLE_STRIP,
    GL_TRIANGLES,
)

POLYGONS = (GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS, GL_QUAD_STRIP, GL_POLYGON)
MODES = (*POLYGONS, *LINES, GL_POINTS)
WIDTH_OF_LINES, WIDTH_OF_POLYGONS = 2, 3


def width_of(mode: int) -> int:
    """Return how many vertices a primitive has that reaches the setup: 3 for polygons, which are cut into triangles."""
    return WIDTH_OF_POLYGONS if mode in POLYGONS else 1 if mode == GL_POINTS else WIDTH_OF_LINES


def primitive_count(mode: int, n: int) -> int:
    """Return the number of triangles, lines or points that `n` vertices or indices make."""
    if mode == GL_TRIANGLES:
        return n // 3
    if mode == GL_QUADS:
        return n // 4 * 2
    if mode == GL_LINES:
        return n // 2
    if mode in LINES and n < 2:
        return 0
    if mode not in POLYGONS:
        return n - 1 if mode == GL_LINE_STRIP else n
    return max(n // 2 - 1, 0) * 2 if mode == GL_QUAD_STRIP else max(n - 2, 0)


def primitives_of(draw: Draw) -> int:
    """Return the number of triangles, lines or points that a draw makes, before clipping."""
    return primitive_count(draw.mode, len(draw.vertices.position if draw.indices is None else draw.indices))


def primitive_counts(draws: Sequence[Draw]) -> list[int]:
    """Return what `primitives_of` returns of each draw."""
    counts: list[int] = []
    for part in parts_of(draws):
        if type(part) is AlikeDraws:
            counts += [primitive_count(part.like.mode, n) for n in part.counts]
        else:
            counts += map(primitives_of, part)
    return counts


@kernel
def vertex_at(numbers, indices, d, i):
    """Return the row of the i-th vertex that a draw names."""
    if numbers[d, INDEXED]:
        return numbers[d, START] + indices[numbers[d, INDEX_START] + i]
    return numbers[d, START] + i


@kernel
def write_triangle(numbers, indices, d, triangles, provoking, row, a, b, c, last):
    """Write the triangle of three vertices of a draw; `last` gives the flat colours."""
    triangles[row, 0] = vertex_at(numbers, indices, d, a)
    triangles[row, 1] = vertex_at(numbers, indices, d, b)
    triangles[row, 2] = vertex_at(numbers, indices, d, c)
    provoking[row] = vertex_at(numbers, indices, d, last)


@kernel
def assemble_draws(numbers, indices, codes, triangles, provoking):
    """Write the triangles (T, 3) of all draws in order and their provoking vertices (T,); return how many they are."""
    row = 0
    for d in range(numbers.shape[0]):
        mode = numbers[d, MODE]
        n = numbers[d, INDEX_END] - numbers[d, INDEX_START] if numbers[d, INDEXED] else (
            numbers[d, END] - numbers[d, START]
        )  # fmt: skip
        if mode == GL_TRIANGLES:
            for i in range(0, n - 2, 3):
                write_triangle(numbers, indices, d, triangles, provoking, row, i, i + 1, i + 2, i + 2)
                row += 1
        elif mode == GL_TRIANGLE_STRIP:
            for i in range(n - 2):
                odd = i & 1
                write_triangle(numbers, indices, d, triangles, provoking, row, i + odd, i + 1 - odd, i + 2, i + 2)
                row += 1
        elif mode == GL_TRIANGLE_FAN:
            for i in range(1, n - 1):
                write_triangle(numbers, indices, d, triangles, provoking, row, 0, i, i + 1, i + 1)
                row += 1
        elif mode == GL_POLYGON:
            for i in range(1, n - 1):
                write_triangle(numbers, indices, d, triangles, provoking, row, i, i + 1, 0, 0)
                row += 1
        elif mode == JOINED_STRIPS:
            corners = indices[numbers[d, INDEX_START] : numbers[d, INDEX_END]].reshape((n // 3, 3))
            in_stages = numbers[d, ACROSS] == IN_STAGES
            row = write_joined_strips(corners, numbers[d, START], in_stages, codes, triangles, provoking, row)
        else:
            row = write_quads(numbers, indices, codes, d, mode, n, triangles, provoking, row)
    return row


@kernel
def let_first_provoke(numbers, counts, codes, triangles, provoking):
    """Put the provoking vertex of assembled triangles first (GL_FIRST_VERTEX_CONVENTION), and write which it is.

    `counts` (D,) are the numbers of triangles of the draws, whose quads are cut as with this convention. llvmpipe tries
    a fan of two triangles as a rectangle, and then its last vertex provokes.
    """
    row = 0
    for d in range(numbers.shape[0]):
        mode, end = numbers[d, MODE], row + counts[d]
        tries_rectangle = mode == GL_TRIANGLE_FAN and counts[d] == 2 and not numbers[d, ACROSS]
        for v in range(numbers[d, START], numbers[d, END]):
            tries_rectangle = tries_rectangle and codes[v] == 0
        if tries_rectangle:
            row = end
            continue
        for t in range(row, end):
            a, b, c = triangles[t]
            if mode in (GL_QUADS, GL_QUAD_STRIP, GL_POLYGON):
                a, b, c = c, a, b
            elif mode == GL_TRIANGLE_FAN or (mode == GL_TRIANGLE_STRIP and (t - row) & 1):
                a, b, c = b, c, a
            triangles[t, 0], triangles[t, 1], triangles[t, 2], provoking[t] = a, b, c, a
        row = end


@kernel
def is_quad_of_strip(corners, t):
    """Return whether triangles t and t + 1 of (T, 3) are a quad of a strip (`geometry.assembly`)."""
    return t + 1 < corners.shape[0] and corners[t, 0] == corners[t + 1, 1] and corners[t, 2] == corners[t + 1, 2]


@kernel
def write_joined_strips(corners, start, in_stages, codes, triangles, provoking, row):
    """Write the triangles (T, 3) of strips in a row, whose corners are those without clipping; return the next row.

    Equals `geometry.assembly.order_of_joined_strips`. `start` is added to the corners.
    """
    t, n, segment_end, is_clipped, goes_on = 0, corners.shape[0], 0, False, False
    while t < n:
        if not is_quad_of_strip(corners, t):
            write_corners(corners, t, start, triangles, provoking, row)
            t, row, goes_on = t + 1, row + 1, False
            continue
        if t >= segment_end or not goes_on:
            segment_end, is_clipped = t, False
            while True:
                for k in range(3):
                    is_clipped |= codes[start + corners[segment_end, k]] != 0
                is_clipped |= codes[start + corners[segment_end + 1, 0]] != 0
                segment_end += 2
                if segment_end == t + 2 * QUADS_OF_SEGMENT or not continues_strip(corners, segment_end):
                    break
        swapped = is_clipped or in_stages
        write_corners(corners, t + swapped, start, triangles, provoking, row)
        write_corners(corners, t + 1 - swapped, start, triangles, provoking, row + 1)
        t, row = t + 2, row + 2
        goes_on = continues_strip(corners, t)
    return row


@kernel
def continues_strip(corners, t):
    """Return whether triangles t and t + 1 are a quad that goes on where the quad before them ends."""
    if not is_quad_of_strip(corners, t):
        return False
    return corners[t - 1, 0] == corners[t, 0] and corners[t - 1, 2] == corners[t, 1]


@kernel
def write_corners(corners, t, start, triangles, provoking, row):
    """Write a triangle, of which the last corner gives the flat colours."""
    for k in range(3):
        triangles[row, k] = start + corners[t, k]
    provoking[row] = triangles[row, 2]


@kernel
def write_quads(numbers, indices, codes, d, mode, n, triangles, provoking, row):
    """Write the triangles of the quads of one draw; return the row after them."""
    is_strip = mode == GL_QUAD_STRIP
    stride = 2 if is_strip else 4
    n_quads = max(n // 2 - 1, 0) if is_strip else n // 4
    if n_quads == 0:
        return row
    overlap = 4 - stride  # vertices that neighbouring segments of a strip share
    n_used, step = n_quads * stride + overlap, (INDEXED_SEGMENT if numbers[d, INDEXED] else SEGMENT) - overlap
    whole_range, range_is_clipped = False, False
    if numbers[d, INDEXED] and n_used <= INDEXED_SEGMENT:
        first, last = vertex_at(numbers, indices, d, 0), vertex_at(numbers, indices, d, 0)
        for i in range(n):
            v = vertex_at(numbers, indices, d, i)
            first, last = min(first, v), max(last, v)
        whole_range = last - first < n_used
        if whole_range:
            for v in range(first, last + 1):
                range_is_clipped = range_is_clipped or codes[v] != 0
    segment_end, is_clipped = 0, range_is_clipped
    for quad in range(n_quads):
        at = quad * stride
        if at >= segment_end and not whole_range:
            start = at // step * step
            segment_end, is_clipped = start + step, False
            for i in range(start, min(start + step + overlap, n_used)):
                is_clipped = is_clipped or codes[vertex_at(numbers, indices, d, i)] != 0
        one, two, three = at + 1, at + 2, at + 3
        if is_strip:
            if is_clipped or numbers[d, ACROSS] == IN_STAGES:
                write_triangle(numbers, indices, d, triangles, provoking, row, two, at, three, three)
                write_triangle(numbers, indices, d, triangles, provoking, row + 1, at, one, three, three)
            else:
                write_triangle(numbers, indices, d, triangles, provoking, row, at, one, three, three)
                write_triangle(numbers, indices, d, triangles, provoking, row + 1, two, at, three, three)
        elif is_clipped or numbers[d, ACROSS]:
            write_triangle(numbers, indices, d, triangles, provoking, row, at, one, three, three)
            write_triangle(numbers, indices, d, triangles, provoking, row + 1, one, two, three, three)
        else:
            write_triangle(numbers, indices, d, triangles, provoking, row, at, one, two, three)
            write_triangle(numbers, indices, d, triangles, provoking, row + 1, at, two, three, three)
        row += 2
    return row


@kernel
def assemble_lines_and_points(numbers, indices, primitives):
    """Write the lines (L, 2) or points (P, 1) of all draws in order; return how many they are."""
    row = 0
    for d in range(numbers.shape[0]):
        mode = numbers[d, MODE]
        n = numbers[d, INDEX_END] - numbers[d, INDEX_START] if numbers[d, INDEXED] else (
            numbers[d, END] - numbers[d, START]
        )  # fmt: skip
        for i in range(0, n if mode == GL_POINTS else n - 1, 2 if mode == GL_LINES else 1):
            for k in range(primitives.shape[1]):
                primitives[row, k] = vertex_at(numbers, indices, d, i + k)
            row += 1
        if mode == GL_LINE_LOOP and n >= 2:
            primitives[row, 0] = vertex_at(numbers, indices, d, n - 1)
            primitives[row, 1] = vertex_at(numbers, indices, d, 0)
            row += 1
    return row
