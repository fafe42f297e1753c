"""Clipping in homogeneous space, before the division: left, right, bottom, top, near, far.

There is no guard band: x and y are clipped exactly to the frustum, as llvmpipe does, because the last bits of
interpolated values depend on the corners of the pieces (docs/exactness.md, 2).
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import inlined, kernel, read_only
from softshadow.pipeline.constants import SMALLEST_NORMAL, ZERO
from softshadow.pipeline.geometry.facing import vertices_of
from softshadow.pipeline.memory.scratch import scratch
from softshadow.state import ClipPlanes

# plane k keeps a x + b y + c z + d w >= 0; the order is the order of clipping
FRUSTUM = np.array([[-1, 0, 0, 1], [1, 0, 0, 1], [0, -1, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [0, 0, -1, 1]], np.float32)
NEAR_FAR = 0b110000
FRUSTUM_PLANES = len(FRUSTUM)
MOST_PLANES = FRUSTUM_PLANES + len(ClipPlanes().enabled)  # that cut a primitive
INSIDE, CUT, OUTSIDE = 0, 1, 2  # sides of triangles
NO_EDGES = np.empty((0, 3), np.uint8)
NO_STAGES = np.empty(0, np.uint8)
NO_STARTS = np.empty(0, np.int32)
ADDED_PER_PLANE = 2  # a plane cuts a convex polygon in two new vertices


class Clipped(NamedTuple):
    """The pieces that clipping leaves.

    clip (V', 4) and values (V', k): the vertices, the old ones first and unchanged; triangles (T', 3) int32, lines
    (T', 2), points (T', 1); source (T',) int32: which input primitive each is a piece of; edges (T', 3) uint8: which
    edges of triangles, from corner i to corner i + 1, are edges of the drawn primitives; in_stages (T',) uint8: which
    triangles pass Mesa's cull stage, empty for none, or None where nobody has asked (`facing.leave_out_culled`).
    """

    clip: np.ndarray
    values: np.ndarray
    triangles: np.ndarray
    source: np.ndarray
    edges: np.ndarray = NO_EDGES
    in_stages: np.ndarray | None = None

    def passing_stages(self, in_stages: np.ndarray) -> "Clipped":
        """Return the same pieces, those of input primitives that pass the cull stage marked; none in an empty array."""
        return self._replace(in_stages=in_stages[self.source] if len(in_stages) else NO_STAGES)


def clip_triangles(
    clip: np.ndarray,
    values: np.ndarray,
    triangles: np.ndarray,
    codes: np.ndarray,
    user_planes: np.ndarray,
    edges: np.ndarray = NO_EDGES,
    linear: bool = False,
    starts: np.ndarray = NO_STARTS,
) -> Clipped:
    """Return the parts of the triangles inside the frustum and the user planes, in drawing order.

    Parameters
    ----------
    clip : (V, 4) clip positions
    values : (V, k) vertex outputs, interpolated like the positions
    triangles : (T, 3) int32
    codes : (V,) int32, the `outcodes` of the vertices
    user_planes : (P, 4) in clip space; a vertex is kept where its dot product is not negative
    starts : (T,) int32, the row of the first user plane of each triangle, where not all have the same; else empty
    edges : (T, 3) uint8, which edges of unfilled polygons are drawn; no rows for filled ones
    linear : whether values change linearly in the window, instead of in perspective
    """
    triangles = read_only(triangles)
    if not codes.any():
        return Clipped(clip, values, triangles, np.arange(len(triangles), dtype=np.int32), edges, NO_STAGES)
    sides = scratch(len(triangles), np.uint8)
    write_sides(triangles, codes, 0, len(triangles), sides)
    n_inside, n_cut = int(np.count_nonzero(sides == INSIDE)), int(np.count_nonzero(sides == CUT))
    planes = all_clip_planes(user_planes, clip.dtype)
    most_added = min(len(planes), MOST_PLANES) * ADDED_PER_PLANE
    all_clip, all_values = clip, np.ascontiguousarray(values)  # always in C order: one compiled kernel
    if n_cut:
        all_clip = scratch((len(clip) + n_cut * most_added, 4), clip.dtype)
        all_values = scratch((len(clip) + n_cut * most_added, values.shape[1]), values.dtype)
        all_clip[: len(clip)], all_values[: len(clip)] = clip, values
    pieces = scratch((n_inside + n_cut * (most_added + 1), 3), np.int32)
    source = scratch(len(pieces), np.int32)
    piece_edges = scratch((len(pieces) if len(edges) else 0, 3), np.uint8)
    n_pieces, n_vertices = cut_triangles(
        triangles, edges, codes, planes, starts, all_clip, all_values, len(clip), pieces, source, piece_edges,
        np.zeros((2, most_added + 3), np.int32), np.zeros((2, most_added + 3), np.uint8), int(linear),
    )  # fmt: skip
    return Clipped(
        all_clip[:n_vertices], all_values[:n_vertices], pieces[:n_pieces], source[:n_pieces], piece_edges[:n_pieces]
    )


def all_clip_planes(user_planes: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """Return all planes in the order of their clip codes, (6 + P, 4)."""
    return np.concatenate([FRUSTUM, user_planes]).astype(dtype)


def outcodes(clip: np.ndarray, depth_clamp: bool, user_planes: np.ndarray) -> np.ndarray:
    """Return the clip code of each vertex: a bit for each plane that it is outside of.

    The boundary is inside, NaN is outside. With `depth_clamp` near and far do not clip.
    """
    codes = np.empty(len(clip), np.int32)
    write_outcodes(clip, user_planes.astype(clip.dtype), NEAR_FAR if depth_clamp else 0, codes)
    return codes


@inlined
def outcode(x, y, z, w):
    """Return the clip code of one vertex for the frustum; NaN fails every test."""
    code = 0 if x <= w else 1
    code |= 0 if x + w >= ZERO else 2
    code |= 0 if y <= w else 4
    code |= 0 if y + w >= ZERO else 8
    code |= 0 if z + w >= ZERO else 16
    code |= 0 if z <= w else 32
    return code


@kernel
def write_outcodes(clip, user_planes, ignored, codes):
    """Write `outcodes` without the ignored bits; the loop for each user plane is vectorised."""
    for v in range(clip.shape[0]):
        codes[v] = outcode(clip[v, 0], clip[v, 1], clip[v, 2], clip[v, 3]) & ~ignored
    for p in range(user_planes.shape[0]):
        a, b, c, d = user_planes[p, 0], user_planes[p, 1], user_planes[p, 2], user_planes[p, 3]
        for v in range(clip.shape[0]):
            inside = (clip[v, 0] * a + clip[v, 1] * b) + clip[v, 2] * c + clip[v, 3] * d >= ZERO
            codes[v] |= 0 if inside else 1 << (FRUSTUM_PLANES + p)


@kernel
def write_sides(triangles, codes, first, end, sides):
    """Write INSIDE, OUTSIDE (of one plane) or CUT for each of the triangles [first, end)."""
    for t in range(first, end):
        v0, v1, v2 = vertices_of(triangles, t)
        a, b, c = codes[v0], codes[v1], codes[v2]
        sides[t] = INSIDE if (a | b | c) == 0 else OUTSIDE if a & b & c else CUT


@inlined
def plane_row(p, starts, primitive):
    """Return the row, among `all_clip_planes`, of the plane of bit `p` of a primitive's clip codes."""
    return p + starts[primitive] if p >= FRUSTUM_PLANES and starts.shape[0] else p


@kernel
def distance(plane, position):
    """Return the distance of a position from a plane, times the length of the plane's normal."""
    return ((position[0] * plane[0] + position[1] * plane[1]) + position[2] * plane[2]) + position[3] * plane[3]


@inlined
def weight_in_window(clip, first, second, new, t):
    """Return the interpolation weight of a new vertex between two others in the window.

    It is computed from x where theirs differ, else from y; else it is `t`, the weight in clip space. Mesa does so for
    values that are interpolated without perspective (draw_pipe_clip.c).
    """
    for k in range(2):
        if clip[first, k] != clip[second, k]:
            start, end = clip[first, k] / clip[first, 3], clip[second, k] / clip[second, 3]
            return (clip[new, k] / clip[new, 3] - start) / (end - start)
    return t


@kernel
def cut_triangles(
    triangles, edges, codes, planes, starts, clip, values, n_vertices, pieces, source, piece_edges, polygons, flags,
    linear,
):  # fmt: skip
    """Clip triangle by triangle (Sutherland & Hodgman 1974); new vertices are appended from row `n_vertices` on.

    Return the number of pieces and the number of vertices. For `planes` and `starts` see `plane_row`. `polygons` and
    `flags` are scratch: two lists of vertex numbers, and whether the edge that starts at each of them is drawn.
    """
    n_pieces, with_edges = 0, edges.shape[0] > 0
    for t in range(triangles.shape[0]):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        code_a, code_b, code_c = codes[np.uint64(a)], codes[np.uint64(b)], codes[np.uint64(c)]
        if code_a & code_b & code_c:
            continue
        union = code_a | code_b | code_c
        if union == 0:
            pieces[n_pieces, 0], pieces[n_pieces, 1], pieces[n_pieces, 2] = a, b, c
            source[n_pieces] = t
            if with_edges:
                for i in range(3):  # one by one: an assignment of rows takes two seconds to compile
                    piece_edges[n_pieces, i] = edges[t, i]
            n_pieces += 1
            continue
        polygons[0, 0], polygons[0, 1], polygons[0, 2] = a, b, c
        if with_edges:
            flags[0, 0], flags[0, 1], flags[0, 2] = edges[t, 0], edges[t, 1], edges[t, 2]
        corners, current = np.int64(3), 0  # typed: for a literal, the cut would be compiled a second time
        for p in range(min(planes.shape[0], MOST_PLANES)):
            if union >> p & 1:
                corners, n_vertices = cut_polygon(
                    planes[plane_row(p, starts, t)], p >= FRUSTUM_PLANES, polygons[current], flags[current], corners,
                    polygons[1 - current], flags[1 - current], clip, values, n_vertices, linear,
                )  # fmt: skip
                current = 1 - current
        for i in range(2, corners):
            pieces[n_pieces, 0], pieces[n_pieces, 1] = polygons[current, i - 1], polygons[current, i]
            pieces[n_pieces, 2] = polygons[current, 0]
            source[n_pieces] = t
            if with_edges:
                # only the outline of the fan, not the edges between its triangles
                piece_edges[n_pieces, 0] = flags[current, i - 1]
                piece_edges[n_pieces, 1] = flags[current, i] if i == corners - 1 else 0
                piece_edges[n_pieces, 2] = flags[current, 0] if i == 2 else 0
            n_pieces += 1
    return n_pieces, n_vertices


@inlined
def cut_polygon(plane, draws_cut, polygon, edges, corners, out, out_edges, clip, values, n_vertices, linear):
    """Cut off the part of a convex polygon behind a plane; return the numbers of its corners and of all vertices.

    A polygon with a distance that is not finite is dropped. `draws_cut` says whether the new edge along the plane is
    drawn: as in Mesa, along a user plane it is, along the frustum it is not.
    """
    if corners < 3:
        return 0, n_vertices
    n_out = 0
    previous, edge = polygon[0], edges[0]
    d_previous = distance(plane, clip[previous])
    if not np.isfinite(d_previous):
        return 0, n_vertices
    for i in range(1, corners + 1):
        current = polygon[i] if i < corners else polygon[0]
        d_current = distance(plane, clip[current])
        if not np.isfinite(d_current):
            return 0, n_vertices
        if d_previous >= ZERO:
            out[n_out], out_edges[n_out] = previous, edge
            n_out += 1
        if (d_previous >= ZERO) != (d_current >= ZERO):
            # from the vertex that is nearer to the plane, for the better conditioned t
            span = d_current - d_previous
            if (-d_current < d_previous) if d_current < ZERO else (-d_previous >= d_current):
                first, second, t = current, previous, d_current / span
            else:
                first, second, t = previous, current, -d_previous / span
            t = t if t >= SMALLEST_NORMAL else ZERO  # llvmpipe runs with denormal results flushed to 0
            for k in range(4):
                clip[n_vertices, k] = clip[first, k] + t * (clip[second, k] - clip[first, k])
            if linear:
                t = weight_in_window(clip, first, second, n_vertices, t)
            for k in range(values.shape[1]):
                values[n_vertices, k] = values[first, k] + t * (values[second, k] - values[first, k])
            out[n_out] = n_vertices
            out_edges[n_out] = edge if d_current >= ZERO else 1 if draws_cut else 0
            n_out += 1
            n_vertices += 1
        previous, d_previous = current, d_current
        edge = edges[i] if i < corners else edges[0]
    return n_out, n_vertices
