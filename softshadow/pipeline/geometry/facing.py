"""Snap vertices, and tell from them which triangles have an area, which way they face, and which are culled.

Each vertex is snapped once; in a mesh, about six triangles share it.
"""

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF, SUBPIXELS, ZERO
from softshadow.state import Cull

CULL_NONE, CULL_FRONT, CULL_BACK = 0, 1, 2
REACH = np.float32(1 << 22)  # pixels; beyond every vertex that clipping leaves
NOWHERE = -(1 << 31)  # snapped coordinates of a vertex that cannot be drawn


def culling(cull: Cull) -> tuple[int, bool]:
    """Return which faces are culled (CULL_NONE, _FRONT, _BACK or both), and whether counter-clockwise is front."""
    faces = {gl.GL_FRONT: CULL_FRONT, gl.GL_BACK: CULL_BACK, gl.GL_FRONT_AND_BACK: CULL_FRONT | CULL_BACK}
    return (faces[cull.face] if cull.enabled else CULL_NONE), cull.front_face == gl.GL_CCW


@inlined
def snap(coordinate):
    """Return a window coordinate in 1/256 pixel, rounded half to even; samples are multiples of 256."""
    return int(np.rint((coordinate - HALF) * SUBPIXELS))


@kernel
def snap_vertices(window, first, end, snapped):
    """Write the snapped x and y of each vertex; return the smallest and the largest y.

    Vertices with a coordinate that is not finite, or out of `REACH`, get `NOWHERE` and are not in that range.
    """
    low, high = -NOWHERE, NOWHERE
    for v in range(first, end):
        x, y = window[v, 0], window[v, 1]
        if abs(x) < REACH and abs(y) < REACH and np.isfinite(window[v, 2]):
            snapped[v, 0], snapped[v, 1] = snap(x), snap(y)
            low, high = min(low, snapped[v, 1]), max(high, snapped[v, 1])
        else:
            snapped[v, 0], snapped[v, 1] = NOWHERE, NOWHERE
    return low, high


@kernel
def facing_and_area(snapped, v0, v1, v2, culled, positive_is_front):
    """Return 1 for a front face, 0 for a back face, -1 if nothing is drawn; and twice the signed area."""
    x0, y0 = int(snapped[v0, 0]), int(snapped[v0, 1])
    x1, y1 = int(snapped[v1, 0]), int(snapped[v1, 1])
    x2, y2 = int(snapped[v2, 0]), int(snapped[v2, 1])
    area = (x0 - x1) * (y2 - y0) - (x2 - x0) * (y0 - y1)
    if area == 0 or x0 == NOWHERE or x1 == NOWHERE or x2 == NOWHERE:
        return -1, area
    facing = 1 if (area > 0) == (positive_is_front == 1) else 0
    if culled & (CULL_FRONT if facing else CULL_BACK):
        return -1, area
    return facing, area


@kernel
def leave_out_culled(window, triangles, in_stages, culled, positive_is_front):
    """Give the triangles that Mesa's cull stage leaves out three equal corners: so they have no area.

    It tells the facing from the unsnapped corners, and counts a triangle without area as a back face
    (draw_pipe_cull.c). `in_stages` (T,) uint8 says which triangles pass it (`mesa.segments`).
    """
    for t in range(triangles.shape[0]):
        if in_stages[t]:
            v0, v1, v2 = vertices_of(triangles, t)
            e_x, e_y = window[v0, 0] - window[v2, 0], window[v0, 1] - window[v2, 1]
            f_x, f_y = window[v1, 0] - window[v2, 0], window[v1, 1] - window[v2, 1]
            area = e_x * f_y - e_y * f_x
            is_front = area != ZERO and (area < ZERO) == (positive_is_front == 1)
            if culled & (CULL_FRONT if is_front else CULL_BACK):
                triangles[t, 1], triangles[t, 2] = triangles[t, 0], triangles[t, 0]


@kernel
def vertices_of(triangles, t):
    """Return the numbers of a triangle's vertices, unsigned: no wrap-around of negative indices is compiled in."""
    n = np.uint64(t)
    return np.uint64(triangles[n, 0]), np.uint64(triangles[n, 1]), np.uint64(triangles[n, 2])
