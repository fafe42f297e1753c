"""Snapped vertices, and by them: which triangles have an area, which way they face, and which are culled.

A vertex is snapped once, though in a mesh six triangles share it.
"""

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import HALF, SUBPIXELS
from softshadow.state import Cull

CULL_NONE, CULL_FRONT, CULL_BACK = 0, 1, 2
REACH = np.float32(1 << 22)  # pixels; clipping leaves nothing outside of the viewport
NOWHERE = -(1 << 31)


def culling(cull: Cull) -> tuple[int, bool]:
    """Return what is culled (CULL_NONE, _FRONT, _BACK or both) and whether counter-clockwise is front."""
    faces = {gl.GL_FRONT: CULL_FRONT, gl.GL_BACK: CULL_BACK, gl.GL_FRONT_AND_BACK: CULL_FRONT | CULL_BACK}
    return (faces[cull.face] if cull.enabled else CULL_NONE), cull.front_face == gl.GL_CCW


@inlined
def snap(coordinate):
    """Return a window coordinate in 1/256 pixel, samples on multiples of 256 (rounded half to even)."""
    return int(np.rint((coordinate - HALF) * SUBPIXELS))


@kernel
def snap_vertices(window, first, end, snapped):
    """Write snapped x and y of each vertex; x is `NOWHERE` where a coordinate is not finite, or farther off than any
    that clipping leaves.

    Returns the smallest and the largest y of the others.
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
    """Return 1 for a front and 0 for a back face, or -1 where nothing is drawn; and twice the area, with its sign."""
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
def vertices_of(triangles, t):
    """Return the numbers of a triangle's vertices, unsigned: no wrap-around of negative indices is compiled in."""
    n = np.uint64(t)
    return np.uint64(triangles[n, 0]), np.uint64(triangles[n, 1]), np.uint64(triangles[n, 2])


@kernel
def count_kept(snapped, triangles, first, end, culled, positive_is_front):
    """Return how many of the triangles [first, end) are drawn."""
    count = 0
    for t in range(first, end):
        facing, _ = facing_and_area(snapped, *vertices_of(triangles, t), culled, positive_is_front)
        count += 1 if facing >= 0 else 0
    return count
