"""Lines: assembly, clipping, and the parallelogram of pixels that each becomes.

A line of width n is n pixels wide across its major direction (GL 2.1, sec. 3.4.1). llvmpipe draws it as a parallelogram
whose ends are moved so that exactly those end pixels are covered that the diamond exit rule asks for. A parallelogram
is two triangles that share a depth plane, so lines need no fill, shading or history of their own.
"""

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF, ONE, SUBPIXEL_BITS, ZERO
from softshadow.pipeline.geometry.clip import MOST_PLANES, NO_STARTS, Clipped, all_clip_planes, distance, plane_row
from softshadow.pipeline.geometry.facing import REACH
from softshadow.pipeline.geometry.triangle_setup import empty_setup, line_gradient, line_plane, snap_away
from softshadow.pipeline.records import NO_VERTEX, Setup

LINES = (gl.GL_LINES, gl.GL_LINE_STRIP, gl.GL_LINE_LOOP)
WIDEST_LINE = 255


def assemble_lines(mode: int, n_vertices: int) -> np.ndarray:
    """Return the lines (L, 2) int32 that a number of vertices make; the second vertex gives flat colours.

    References
    ----------
    GL 2.1, sec. 2.6.1 (primitives) and 2.14.7 (flat shading).
    """
    first = np.arange(0, max(n_vertices - 1, 0), 2 if mode == gl.GL_LINES else 1, dtype=np.int32)
    lines = np.stack([first, first + 1], axis=1)
    if mode == gl.GL_LINE_LOOP and n_vertices >= 2:
        lines = np.concatenate([lines, np.array([[n_vertices - 1, 0]], np.int32)])
    return lines


def clip_lines(
    clip: np.ndarray,
    values: np.ndarray,
    lines: np.ndarray,
    codes: np.ndarray,
    user_planes: np.ndarray,
    starts: np.ndarray = NO_STARTS,
) -> Clipped:
    """Return the parts of the lines (L, 2) inside the frustum and the user planes, as `clip_triangles` does."""
    if not codes.any():
        return Clipped(clip, values, lines, np.arange(len(lines), dtype=np.int32))
    n_cut = int(np.count_nonzero(codes[lines].any(axis=1)))
    most_vertices = len(clip) + 2 * n_cut
    all_clip, all_values = (
        np.empty((most_vertices, 4), clip.dtype),
        np.empty((most_vertices, values.shape[1]), values.dtype),
    )
    all_clip[: len(clip)], all_values[: len(clip)] = clip, values
    pieces, source = np.empty((len(lines), 2), np.int32), np.empty(len(lines), np.int32)
    planes = all_clip_planes(user_planes, clip.dtype)
    n_pieces, n_vertices = cut_lines(
        np.ascontiguousarray(lines), codes, planes, starts, all_clip, all_values, len(clip), pieces, source
    )
    return Clipped(
        np.ascontiguousarray(all_clip[:n_vertices]),
        np.ascontiguousarray(all_values[:n_vertices]),
        pieces[:n_pieces].copy(),
        source[:n_pieces].copy(),
    )


@kernel
def cut_lines(lines, codes, planes, starts, clip, values, n_vertices, pieces, source):
    """Clip line by line (Liang & Barsky 1984); new vertices are appended from row `n_vertices` on.

    Return the number of pieces and the number of vertices. Each end is moved once, along the whole line. For `planes`
    and `starts` see `plane_row`.
    """
    n_pieces = 0
    for n in range(lines.shape[0]):
        a, b = lines[n, 0], lines[n, 1]
        union = codes[a] | codes[b]
        visible = codes[a] & codes[b] == 0
        from_a = from_b = ZERO
        for p in range(min(planes.shape[0], MOST_PLANES)):
            if visible and union >> p & 1:
                plane = planes[plane_row(p, starts, n)]
                distance_a, distance_b = distance(plane, clip[a]), distance(plane, clip[b])
                if not (np.isfinite(distance_a) and np.isfinite(distance_b)):
                    visible = False
                if distance_b < ZERO:
                    from_b = max(from_b, distance_b / (distance_b - distance_a))
                if distance_a < ZERO:
                    from_a = max(from_a, distance_a / (distance_a - distance_b))
                visible = visible and from_a + from_b < ONE
        if not visible:
            continue
        pieces[n_pieces, 0], pieces[n_pieces, 1] = a, b
        for end in range(2):
            start, other, t = (a, b, from_a) if end == 0 else (b, a, from_b)
            if codes[start]:
                for k in range(4):
                    clip[n_vertices, k] = clip[start, k] + t * (clip[other, k] - clip[start, k])
                for k in range(values.shape[1]):
                    values[n_vertices, k] = values[start, k] + t * (values[other, k] - values[start, k])
                pieces[n_pieces, end] = n_vertices
                n_vertices += 1
        source[n_pieces] = n
        n_pieces += 1
    return n_pieces, n_vertices


def set_up_lines(window: np.ndarray, lines: np.ndarray, ids: np.ndarray, widths: np.ndarray) -> Setup:
    """Return the two triangles of each line that has an area.

    Parameters
    ----------
    window : (V, 4) window x, y (stored rows), z, 1/w
    lines : (L, 2) int32
    ids : (L,) int32, copied to the triangles
    widths : (L,) float64, in pixels, see `whole_width`
    """
    setup = empty_setup(2 * len(lines), window.dtype)
    n_triangles = line_triangles(window, lines, ids, widths, *setup, np.empty(8, np.int64))
    return Setup(*[array[:n_triangles] for array in setup])


@kernel
def line_triangles(window, lines, ids, widths, corners, vertices, depth, front, triangle_ids, quad):
    """Fill the arrays of `Setup`; return the number of triangles. `quad` (8,) is scratch."""
    t = 0
    for n in range(lines.shape[0]):
        a, b = lines[n, 0], lines[n, 1]
        finite = True
        for k in range(3):
            finite = finite and np.isfinite(window[a, k]) and np.isfinite(window[b, k])
        for k in range(2):  # farther away, numbers of 1/256 pixel have no room in 32 bits
            finite = finite and abs(window[a, k]) < REACH and abs(window[b, k]) < REACH
        dx, dy, over_area = line_gradient(window, a, b)
        if not finite or not np.isfinite(over_area):
            continue
        line_corners(window, a, b, whole_width(widths[n]) << SUBPIXEL_BITS, quad)
        # ends that were moved past each other leave nothing of the line
        if (quad[0] - quad[2]) * (quad[5] - quad[1]) - (quad[4] - quad[0]) * (quad[1] - quad[3]) <= 0:
            continue
        z = line_plane(window[a, 0], window[a, 1], dx, dy, over_area, window[a, 2], window[b, 2])
        for half in range(2):
            corners[t, 0], corners[t, 1] = quad[0], quad[1]
            for k in range(4):
                corners[t, 2 + k] = quad[2 + 2 * half + k]
            vertices[t, 0], vertices[t, 1], vertices[t, 2] = a, b, NO_VERTEX
            depth[t, 0], depth[t, 1], depth[t, 2] = z
            depth[t, 3], front[t], triangle_ids[t] = ZERO, 1, ids[n]
            t += 1
    return t


@inlined
def whole_width(width):
    """Return the width of a drawn line in pixels: rounded, a half up, 1 to 255; NaN counts as 1, as in Mesa."""
    return max(1, int(min(width + 0.5, WIDEST_LINE))) if width > 0 else 1


@kernel
def line_corners(window, a, b, across, quad):
    """Write the snapped corners x0 y0 ... x3 y3 of a line's parallelogram; its ends follow the diamond exit rule."""
    x_major = abs(window[a, 0] - window[b, 0]) >= abs(window[a, 1] - window[b, 1])
    # u runs along the major direction, v across it
    u, v = (0, 1) if x_major else (1, 0)
    du, dv = window[a, u] - window[b, u], window[a, v] - window[b, v]
    slope = dv / du
    start_u, start_v = offset_from_center(window[a, u]), offset_from_center(window[a, v])
    end_u, end_v = offset_from_center(window[b, u]), offset_from_center(window[b, v])
    if end_v == -HALF and dv < ZERO:
        end_v = HALF
    # where the line crosses the middle of the pixels that its ends lie in, across the major direction
    start_at, end_at = fraction(window[a, v]) + start_u * slope, fraction(window[b, v]) + end_u * slope
    turn = ONE if x_major else -ONE  # the rule for steep lines is mirrored
    draws_start = draws_start_pixel(start_u * turn, start_v * turn, du * turn, dv * turn, start_at)
    draws_end = draws_end_pixel(end_u * turn, end_v * turn, du * turn, dv * turn, end_at, not x_major)
    # Mesa's rule for the end pixels that are covered without moving; where it errs, on a pixel centre, nothing changes
    backwards = du < ZERO
    start_covered = (start_u < ZERO) == backwards if start_u != ZERO else backwards == x_major
    end_covered = end_u >= ZERO if backwards else end_u <= ZERO
    to = -HALF if backwards else HALF
    move_start = to - start_u if start_covered != draws_start else ZERO
    move_end = to - end_u if end_covered != draws_end else ZERO
    first, first_move, last, last_move = a, move_start, b, move_end
    # corners 0 and 3 lie at one end, 1 and 2 at the other: turned so that the area is positive
    if backwards == x_major:
        first, first_move, last, last_move = b, move_end, a, move_start
    for corner in range(4):
        end, move = (first, first_move) if corner == 0 or corner == 3 else (last, last_move)
        side = -(across // 2) if corner < 2 else across // 2
        quad[2 * corner + u] = snap_end(window[end, u] + move)
        quad[2 * corner + v] = snap_end(window[end, v] + move * slope) + side


@kernel
def snap_end(coordinate):
    """Return a window coordinate in 1/256 pixel, like `snap`, but with a half rounded away from zero."""
    return snap_away(coordinate - HALF)


@kernel
def fraction(coordinate):
    """Return the part of a coordinate after the decimal point, in [0, 1)."""
    return coordinate - np.floor(coordinate)


@kernel
def offset_from_center(coordinate):
    """Return the offset of a coordinate from its pixel's centre, in [-1/2, 1/2)."""
    return fraction(coordinate) - HALF


@kernel
def draws_start_pixel(off_u, off_v, du, dv, crossing):
    """Return whether a line leaves the diamond of its first pixel; it starts at `off_u`, `off_v` from the centre.

    GL 2.1, sec. 3.4.1: a pixel belongs to a line that exits its diamond, abs(u) + abs(v) < 1/2. `du` and `dv` point
    from the end of the line to its start.
    """
    if abs(off_u) + abs(off_v) < HALF:
        return True
    if (off_u >= ZERO) == (-du >= ZERO):
        return False
    if (-off_v >= ZERO) != (dv >= ZERO):
        return True
    return crossing > ZERO and crossing < ONE


@kernel
def draws_end_pixel(off_u, off_v, du, dv, crossing, closed):
    """Return whether a line leaves the diamond of its last pixel; `closed`: also through its lower corner."""
    if abs(off_u) + abs(off_v) < HALF:
        return False
    if (off_u >= ZERO) != (-du >= ZERO):
        return False
    if (-off_v >= ZERO) == (dv >= ZERO):
        return True
    return (crossing > ZERO or (closed and crossing == ZERO)) and crossing < ONE
