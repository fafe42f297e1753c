"""The exactly visible part of a light: convex polygons, from which the hidden part of one face after another is cut.

What is left of a polygon outside a convex part is convex again after cuts along the part's edges, one after the other:
at each, the outer side is left, and the inner side is cut further.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.truth.light_view import FROM_0

CORNERS = 24  # of one piece at most
# of the square with the area 4; rounding leaves such slivers between faces with a common edge, and nothing else does
SLIVER = 1e-14
# the share that counts as nothing, or as all: slivers of many faces add up to less
ROUNDING = 1e-12


@kernel
def start_pieces(pieces, sizes):
    """Write the square from -1 to 1 as the only piece; return the number of pieces."""
    sizes[0] = 4
    for corner in range(4):
        pieces[0, corner, 0] = (-1.0, 1.0, 1.0, -1.0)[corner]
        pieces[0, corner, 1] = (-1.0, -1.0, 1.0, 1.0)[corner]
    return 1


@kernel
def cut_away(pieces, sizes, n_pieces, functions, n_functions, work):
    """Cut the part where all functions are positive from all pieces; return their new number, or -1 for no room.

    Parameters
    ----------
    pieces, sizes : (P, CORNERS, 2), (P,)    counter-clockwise polygons and their numbers of corners
    functions : (4, 4)                       as `hidden_part` writes them
    work : (3, CORNERS, 2)                   scratch
    """
    for piece in range(n_pieces - 1, -1, -1):
        if _is_outside(pieces[piece], sizes[piece], functions, n_functions):
            continue
        size = sizes[piece]
        inner, outer, next_inner = work[0], work[1], work[2]
        for corner in range(size):
            inner[corner, 0], inner[corner, 1] = pieces[piece, corner, 0], pieces[piece, corner, 1]
        is_free = True  # the cell of the piece, for the first of its parts
        for number in range(n_functions):
            if functions[number, 0] == 0 and functions[number, 1] == 0 and functions[number, 2] == 0:
                continue  # as `_is_outside` has it
            size, outer_size = _split(inner, size, functions[number], next_inner, outer)
            if size < 0:
                return -1
            inner, next_inner = next_inner, inner
            if outer_size >= 3 and doubled_area(outer, outer_size) > 2 * SLIVER:
                cell = piece if is_free else n_pieces
                if cell == len(pieces):
                    return -1
                for corner in range(outer_size):
                    pieces[cell, corner, 0], pieces[cell, corner, 1] = outer[corner, 0], outer[corner, 1]
                sizes[cell] = outer_size
                if not is_free:
                    n_pieces += 1
                is_free = False
            if size < 3:
                break
        if is_free:  # all of it is hidden: the last piece, which has been cut already, moves here
            n_pieces -= 1
            sizes[piece] = sizes[n_pieces]
            for corner in range(sizes[n_pieces]):
                pieces[piece, corner, 0] = pieces[n_pieces, corner, 0]
                pieces[piece, corner, 1] = pieces[n_pieces, corner, 1]
    return n_pieces


@kernel
def _is_outside(piece, size, functions, n_functions):
    """Return whether one function is nowhere positive on the piece."""
    for number in range(n_functions):
        k, ka, kb = functions[number, 0], functions[number, 1], functions[number, 2]
        if k == 0 and ka == 0 and kb == 0:  # the edge lies in one plane with a segment: one of its two faces has it
            if functions[number, 3] != FROM_0:
                return True
            continue
        is_out = True
        for corner in range(size):
            if k + ka * piece[corner, 0] + kb * piece[corner, 1] > 0:
                is_out = False
                break
        if is_out:
            return True
    return False


@kernel
def _split(polygon, size, function, inner, outer):
    """Write the part of a polygon where a function is positive to `inner`, and the rest to `outer`.

    Return both sizes; the first is -1 if there is no room.
    """
    k, ka, kb = function[0], function[1], function[2]
    inner_size, outer_size = 0, 0
    last_a, last_b = polygon[size - 1, 0], polygon[size - 1, 1]
    last = k + ka * last_a + kb * last_b
    for corner in range(size):
        if max(inner_size, outer_size) + 2 > CORNERS:
            return -1, 0
        a, b = polygon[corner, 0], polygon[corner, 1]
        value = k + ka * a + kb * b
        if (last > 0 and value < 0) or (last < 0 and value > 0):
            share = last / (last - value)
            cut_a, cut_b = last_a + share * (a - last_a), last_b + share * (b - last_b)
            inner[inner_size, 0], inner[inner_size, 1] = cut_a, cut_b
            outer[outer_size, 0], outer[outer_size, 1] = cut_a, cut_b
            inner_size += 1
            outer_size += 1
        if value >= 0:
            inner[inner_size, 0], inner[inner_size, 1] = a, b
            inner_size += 1
        if value <= 0:
            outer[outer_size, 0], outer[outer_size, 1] = a, b
            outer_size += 1
        last_a, last_b, last = a, b, value
    return inner_size, outer_size


@kernel
def doubled_area(polygon, size):
    """Return twice the area of a counter-clockwise polygon."""
    total = 0.0
    for corner in range(size):
        after = corner + 1 if corner + 1 < size else 0
        total += polygon[corner, 0] * polygon[after, 1] - polygon[corner, 1] * polygon[after, 0]
    return total


@kernel
def area_in_disc(polygon, size):
    """Return the area of a counter-clockwise polygon within the unit disc around 0.

    The sum over the edges of the area between edge and centre: triangles where the edge is inside, else sectors.
    """
    total = 0.0
    for corner in range(size):
        after = corner + 1 if corner + 1 < size else 0
        a0, b0, a1, b1 = polygon[corner, 0], polygon[corner, 1], polygon[after, 0], polygon[after, 1]
        da, db = a1 - a0, b1 - b0
        square = da * da + db * db
        if square == 0:
            continue
        # the edge's line is inside the disc between the two solutions of |start + t edge| = 1
        middle = -(a0 * da + b0 * db) / square
        half = middle * middle - (a0 * a0 + b0 * b0 - 1) / square
        if half <= 0:
            total += _sector(a0, b0, a1, b1)
            continue
        low, high = middle - np.sqrt(half), middle + np.sqrt(half)
        if low >= 1 or high <= 0:
            total += _sector(a0, b0, a1, b1)
            continue
        low, high = max(low, 0.0), min(high, 1.0)
        p_a, p_b, q_a, q_b = a0 + low * da, b0 + low * db, a0 + high * da, b0 + high * db
        total += 0.5 * (p_a * q_b - p_b * q_a)
        if low > 0:
            total += _sector(a0, b0, p_a, p_b)
        if high < 1:
            total += _sector(q_a, q_b, a1, b1)
    return total


@kernel
def _sector(a0, b0, a1, b1):
    return 0.5 * np.arctan2(a0 * b1 - b0 * a1, a0 * a1 + b0 * b1)


@kernel
def visible_share(pieces, sizes, n_pieces, is_round):
    """Return the share of the light that the pieces cover, exactly 0 or 1 within rounding."""
    total = 0.0
    for piece in range(n_pieces):
        if is_round:
            total += area_in_disc(pieces[piece], sizes[piece]) / np.pi
        else:
            total += doubled_area(pieces[piece], sizes[piece]) / 8
    if total < ROUNDING:
        return 0.0
    return 1.0 if total > 1 - ROUNDING else total
