"""Clipping in homogeneous space, before the division: left, right, bottom, top, near, far.

There is no guard band: x and y are clipped exactly to the frustum, as llvmpipe does, because the last bits of what is
interpolated depend on where the pieces end (docs/exactness.md, 2).
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel, read_only
from softshadow.pipeline.constants import SMALLEST_NORMAL, ZERO
from softshadow.pipeline.geometry.facing import vertices_of
from softshadow.pipeline.memory.scratch import scratch

# plane k keeps a x + b y + c z + d w >= 0; the order is the order of clipping
FRUSTUM = np.array([[-1, 0, 0, 1], [1, 0, 0, 1], [0, -1, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [0, 0, -1, 1]], np.float32)
NEAR_FAR = 0b110000
FRUSTUM_PLANES = len(FRUSTUM)
INSIDE, CUT, OUTSIDE = 0, 1, 2  # sides of triangles
NO_EDGES = np.empty((0, 3), np.uint8)
ADDED_PER_PLANE = 2  # a plane cuts a convex polygon in two new vertices


class Clipped(NamedTuple):
    """What is left after clipping.

    clip (V', 4) and values (V', k): the vertices, the old ones first and unchanged; triangles (T', 3) int32, lines
    (T', 2), points (T', 1); source (T',) int32: which input primitive each is a piece of; edges (T', 3) uint8: which
    edges of triangles, from corner i to corner i + 1, are edges of what was drawn.
    """

    clip: np.ndarray
    values: np.ndarray
    triangles: np.ndarray
    source: np.ndarray
    edges: np.ndarray = NO_EDGES


def clip_triangles(
    clip: np.ndarray,
    values: np.ndarray,
    triangles: np.ndarray,
    codes: np.ndarray,
    user_planes: np.ndarray,
    edges: np.ndarray = NO_EDGES,
    linear: bool = False,
) -> Clipped:
    """Return the parts of the triangles inside the frustum and the user planes, in drawing order.

    Parameters
    ----------
    clip : (V, 4) clip positions
    values : (V, k) what is interpolated along with them
    triangles : (T, 3) int32
    codes : (V,) int32, what each vertex is outside of: `outcodes`
    user_planes : (P, 4) in clip space; a vertex is kept where its dot product is not negative
    edges : (T, 3) uint8, for polygons that are not filled: the edges to be drawn; none: nobody asks which
    linear : whether values change linearly in the window, instead of in perspective
    """
    triangles = read_only(triangles)
    if not codes.any():
        return Clipped(clip, values, triangles, np.arange(len(triangles), dtype=np.int32), edges)
    sides = scratch(len(triangles), np.uint8)
    write_sides(triangles, codes, 0, len(triangles), sides)
    whole, cut = np.count_nonzero(sides == INSIDE), np.count_nonzero(sides == CUT)
    planes = frustum_and(user_planes, clip.dtype)
    room = len(planes) * ADDED_PER_PLANE
    more_clip, more_values = clip, np.ascontiguousarray(values)  # one memory order, one compiled kernel
    if cut:
        more_clip = scratch((len(clip) + cut * room, 4), clip.dtype)
        more_values = scratch((len(clip) + cut * room, values.shape[1]), values.dtype)
        more_clip[: len(clip)], more_values[: len(clip)] = clip, values
    pieces = scratch((whole + cut * (room + 1), 3), np.int32)
    source = scratch(len(pieces), np.int32)
    piece_edges = scratch((len(pieces) if len(edges) else 0, 3), np.uint8)
    count, vertices = cut_triangles(
        triangles, edges, codes, planes, more_clip, more_values, len(clip), pieces, source, piece_edges,
        np.zeros((2, room + 3), np.int32), np.zeros((2, room + 3), np.uint8), int(linear),
    )  # fmt: skip
    return Clipped(more_clip[:vertices], more_values[:vertices], pieces[:count], source[:count], piece_edges[:count])


def frustum_and(user_planes: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """Return all planes in the order of their clip codes, (6 + P, 4)."""
    return np.concatenate([FRUSTUM, user_planes]).astype(dtype)


def outcodes(clip: np.ndarray, depth_clamp: bool, user_planes: np.ndarray) -> np.ndarray:
    """Return, per vertex, a bit for each plane it is outside of; on the boundary counts as inside, NaN as outside.

    With `depth_clamp` near and far do not clip.
    """
    codes = np.empty(len(clip), np.int32)
    write_outcodes(clip, user_planes.astype(clip.dtype), NEAR_FAR if depth_clamp else 0, codes)
    return codes


@inlined
def outcode(x, y, z, w):
    """Return the bits of the frustum's planes for one vertex. Each test is one that NaN fails."""
    code = 0 if x <= w else 1
    code |= 0 if x + w >= ZERO else 2
    code |= 0 if y <= w else 4
    code |= 0 if y + w >= ZERO else 8
    code |= 0 if z + w >= ZERO else 16
    code |= 0 if z <= w else 32
    return code


@kernel
def write_outcodes(clip, user_planes, ignored, codes):
    """Write `outcodes`, without the bits that are ignored: plane after plane of the user's, for loops of vectors."""
    for v in range(clip.shape[0]):
        codes[v] = outcode(clip[v, 0], clip[v, 1], clip[v, 2], clip[v, 3]) & ~ignored
    for p in range(user_planes.shape[0]):
        a, b, c, d = user_planes[p, 0], user_planes[p, 1], user_planes[p, 2], user_planes[p, 3]
        for v in range(clip.shape[0]):
            kept = (clip[v, 0] * a + clip[v, 1] * b) + clip[v, 2] * c + clip[v, 3] * d >= ZERO
            codes[v] |= 0 if kept else 1 << (FRUSTUM_PLANES + p)


@kernel
def write_sides(triangles, codes, first, end, sides):
    """Write which of the triangles [first, end) are inside of all planes, outside of one, or have to be cut."""
    for t in range(first, end):
        v0, v1, v2 = vertices_of(triangles, t)
        a, b, c = codes[v0], codes[v1], codes[v2]
        sides[t] = INSIDE if (a | b | c) == 0 else OUTSIDE if a & b & c else CUT


@kernel
def distance(plane, position):
    return ((position[0] * plane[0] + position[1] * plane[1]) + position[2] * plane[2]) + position[3] * plane[3]


@inlined
def part_in_window(clip, first, second, between, t):
    """Return how far a vertex lies between two others in the window, by its x if they differ in that; `t` is in space.

    As Mesa does it for what is interpolated without perspective (draw_pipe_clip.c).
    """
    for k in range(2):
        if clip[first, k] != clip[second, k]:
            start, end = clip[first, k] / clip[first, 3], clip[second, k] / clip[second, 3]
            return (clip[between, k] / clip[between, 3] - start) / (end - start)
    return t


@kernel
def cut_triangles(
    triangles, edges, codes, planes, clip, values, vertices, pieces, source, piece_edges, polygons, drawn, linear
):
    """Clip triangle by triangle (Sutherland & Hodgman 1974); new vertices are appended from row `vertices` on.

    Returns the number of pieces and the number of vertices. `polygons` and `drawn` are scratch: two lists of vertex
    numbers, and whether the edge that starts at each of them is to be drawn.
    """
    count, with_edges = 0, edges.shape[0] > 0
    for t in range(triangles.shape[0]):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        code_a, code_b, code_c = codes[np.uint64(a)], codes[np.uint64(b)], codes[np.uint64(c)]
        if code_a & code_b & code_c:
            continue
        union = code_a | code_b | code_c
        if union == 0:
            pieces[count, 0], pieces[count, 1], pieces[count, 2] = a, b, c
            source[count] = t
            if with_edges:
                for i in range(3):  # one by one: an assignment of rows takes two seconds to compile
                    piece_edges[count, i] = edges[t, i]
            count += 1
            continue
        polygons[0, 0], polygons[0, 1], polygons[0, 2] = a, b, c
        if with_edges:
            drawn[0, 0], drawn[0, 1], drawn[0, 2] = edges[t, 0], edges[t, 1], edges[t, 2]
        corners, now = np.int64(3), 0  # not a literal, for which the cut would be compiled once more
        for p in range(planes.shape[0]):
            if union >> p & 1:
                corners, vertices = cut_polygon(
                    planes[p], p >= FRUSTUM_PLANES, polygons[now], drawn[now], corners, polygons[1 - now],
                    drawn[1 - now], clip, values, vertices, linear,
                )  # fmt: skip
                now = 1 - now
        for i in range(2, corners):
            pieces[count, 0], pieces[count, 1] = polygons[now, i - 1], polygons[now, i]
            pieces[count, 2] = polygons[now, 0]
            source[count] = t
            if with_edges:
                # only the outline of the fan, not the cuts between its triangles
                piece_edges[count, 0] = drawn[now, i - 1]
                piece_edges[count, 1] = drawn[now, i] if i == corners - 1 else 0
                piece_edges[count, 2] = drawn[now, 0] if i == 2 else 0
            count += 1
    return count, vertices


@inlined
def cut_polygon(plane, draws_cut, polygon, drawn, corners, out, out_drawn, clip, values, vertices, linear):
    """Keep the part of a convex polygon on the positive side of a plane; returns its corners and the vertex count.

    A distance that is not finite drops the polygon. The new edge along the plane is to be drawn where `draws_cut`: that
    of a user plane is, that of the frustum is not (as Mesa does it).
    """
    if corners < 3:
        return 0, vertices
    kept = 0
    previous, edge = polygon[0], drawn[0]
    before = distance(plane, clip[previous])
    if not np.isfinite(before):
        return 0, vertices
    for i in range(1, corners + 1):
        current = polygon[i] if i < corners else polygon[0]
        now = distance(plane, clip[current])
        if not np.isfinite(now):
            return 0, vertices
        if before >= ZERO:
            out[kept], out_drawn[kept] = previous, edge
            kept += 1
        if (before >= ZERO) != (now >= ZERO):
            # from the vertex that is nearer to the plane, for the better conditioned t
            span = now - before
            if (-now < before) if now < ZERO else (-before >= now):
                first, second, t = current, previous, now / span
            else:
                first, second, t = previous, current, -before / span
            t = t if t >= SMALLEST_NORMAL else ZERO  # llvmpipe runs with denormal results flushed to 0
            for k in range(4):
                clip[vertices, k] = clip[first, k] + t * (clip[second, k] - clip[first, k])
            if linear:
                t = part_in_window(clip, first, second, vertices, t)
            for k in range(values.shape[1]):
                values[vertices, k] = values[first, k] + t * (values[second, k] - values[first, k])
            out[kept] = vertices
            out_drawn[kept] = edge if now >= ZERO else 1 if draws_cut else 0
            kept += 1
            vertices += 1
        previous, before = current, now
        edge = drawn[i] if i < corners else drawn[0]
    return kept, vertices
