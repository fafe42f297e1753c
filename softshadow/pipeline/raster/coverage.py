"""Coverage: which pixel centres of a row a triangle covers, in integers.

An edge function of snapped corners is exact in int64, so every sample on an edge that two triangles share belongs to
one of them: left and bottom edges are inside, right and top edges outside (docs/exactness.md, 4).
"""

import numpy as np

from softshadow.jit import kernel

FARTHEST = np.int64(1 << 30)  # typed: for a literal, `narrow` would be compiled a second time
EXACT = 1 << 50  # for quotients of whole numbers below this, see `narrow_rows`


@kernel
def samples_between(a, b, c):
    """Return first and end of the samples from the least to the largest of three coordinates (end exclusive)."""
    return (min(a, min(b, c)) + 255) >> 8, (max(a, max(b, c)) >> 8) + 1


@kernel
def bounds(corners, t):
    """Return first and end row of a triangle's samples (end exclusive)."""
    return samples_between(int(corners[t, 1]), int(corners[t, 3]), int(corners[t, 5]))


@kernel
def extent(corners, begin, end):
    """Return first and end row and column of the triangles [begin, end), and the sum of their areas in 1/256 pixel."""
    first_row, end_row, left, right, area = FARTHEST, -FARTHEST, FARTHEST, -FARTHEST, 0
    for number in range(begin, end):
        t = np.uint64(number)  # unsigned: no wrap-around of negative indices is compiled in
        low, high = bounds(corners, t)
        first_row, end_row = min(first_row, low), max(end_row, high)
        x0, y0 = int(corners[t, 0]), int(corners[t, 1])
        x1, y1 = int(corners[t, 2]), int(corners[t, 3])
        x2, y2 = int(corners[t, 4]), int(corners[t, 5])
        low, high = samples_between(x0, x1, x2)
        left, right = min(left, low), max(right, high)
        # in 1/256 pixels, so that the sum of millions of the largest triangles stays within 64 bits
        area += abs((x0 - x1) * (y2 - y0) - (x2 - x0) * (y0 - y1)) >> 9
    return first_row, end_row, left, right, area


@kernel
def edge(x0, y0, x1, y1, downwards):
    """Return (across, along, at) of the edge from corner 0 to corner 1.

    Inside are the samples with ``at + along * 256 row - across * 256 column >= 0``; those on the edge itself only where
    it is inclusive.
    """
    across, along = int(y0) - int(y1), int(x0) - int(x1)
    inclusive = across < 0 or (across == 0 and ((along < 0) == (downwards == 1)))
    return across, along, across * int(x0) - along * int(y0) + (0 if inclusive else -1)


@kernel
def narrow(x0, y0, x1, y1, row, downwards, first, end):
    """Return the columns of [first, end) that lie inside the edge from corner 0 to corner 1."""
    across, along, at = edge(x0, y0, x1, y1, downwards)
    value = at + along * (row << 8)
    if across > 0:
        end = min(end, value // (across << 8) + 1)
    elif across < 0:
        first = max(first, -(value // (-across << 8)))
    elif value < 0:
        end = min(end, first)
    return first, end


@kernel
def row_span(corners, t, row, downwards):
    """Return first and end column (end exclusive) of triangle `t` in a row; `downwards`: 1 if rows grow downwards."""
    x0, y0 = int(corners[t, 0]), int(corners[t, 1])
    x1, y1 = int(corners[t, 2]), int(corners[t, 3])
    x2, y2 = int(corners[t, 4]), int(corners[t, 5])
    first, end = narrow(x0, y0, x1, y1, row, downwards, -FARTHEST, FARTHEST)
    first, end = narrow(x1, y1, x2, y2, row, downwards, first, end)
    return narrow(x2, y2, x0, y0, row, downwards, first, end)


@kernel
def narrow_rows(x0, y0, x1, y1, first, end, downwards, lefts, rights):
    """Apply `narrow` in those of the rows [first, end) that the edge from corner 0 to corner 1 reaches.

    The quotients are computed in float64, of a number that lies 1/2 above a whole one: so they are at least half of
    1/divisor away from all whole numbers. For numbers below 2^50, the product with the rounded reciprocal of the
    divisor is closer to the quotient than this, and its floor is exact; a division takes much longer. Eight rows are
    one vector. Larger numbers, which no viewport produces, are handled row by row.
    """
    first, end = max(first, (min(y0, y1) + 255) >> 8), min(end, (max(y0, y1) >> 8) + 1)
    if first >= end:
        return
    across, along, at = edge(x0, y0, x1, y1, downwards)
    value, step, divisor = at + along * (first << 8), along << 8, abs(across) << 8
    if max(abs(value), abs(value + step * (end - first))) >= EXACT:
        for row in range(first, end):
            left, right = narrow(x0, y0, x1, y1, row, downwards, np.int64(lefts[row]), np.int64(rights[row]))
            lefts[row], rights[row] = left, right
        return
    if across == 0:
        if value < 0:  # along the row, the only one it can reach
            rights[first] = min(rights[first], lefts[first])  # not beyond `right`, where the left end may be
        return
    start, slope, over = float(value) + 0.5, float(step), 1.0 / float(divisor)
    if across > 0:
        for k in range(end - first):
            j = np.uint64(first + k)
            rights[j] = min(rights[j], np.int32(np.floor((start + slope * k) * over)) + np.int32(1))
    else:
        for k in range(end - first):
            j = np.uint64(first + k)
            lefts[j] = max(lefts[j], -np.int32(np.floor((start + slope * k) * over)))


@kernel
def row_spans(corners, t, first, end, downwards, left, right, lefts, rights):
    """Write first and end column (end exclusive) of triangle `t` in its rows [first, end), within [left, right).

    The same columns as those of `row_span`. An edge is evaluated only between its corners: in the other rows of the
    triangle, columns inside the other two edges lie strictly inside this one.
    """
    for row in range(first, end):
        j = np.uint64(row)
        lefts[j], rights[j] = left, right
    x0, y0 = int(corners[t, 0]), int(corners[t, 1])
    x1, y1 = int(corners[t, 2]), int(corners[t, 3])
    x2, y2 = int(corners[t, 4]), int(corners[t, 5])
    narrow_rows(x0, y0, x1, y1, first, end, downwards, lefts, rights)
    narrow_rows(x1, y1, x2, y2, first, end, downwards, lefts, rights)
    narrow_rows(x2, y2, x0, y0, first, end, downwards, lefts, rights)


@kernel
def triangles_at(corners, column, row, downwards, numbers):
    """Write the numbers of the triangles that cover one pixel to `numbers`; return how many they are."""
    n = 0
    for t in range(corners.shape[0]):
        first, end = bounds(corners, np.uint64(t))
        if first <= row < end:
            left, right = row_span(corners, np.uint64(t), row, downwards)
            if left <= column < right:
                numbers[n] = t
                n += 1
    return n
