"""Fragments one by one, in drawing order: for draws with alpha test, blending or logic op, and for pixel histories.

Their colours must be known first (alpha test) or combined in drawing order (blending). So the fragments are listed,
shaded together, and then tested one after the other with `process_fragment`.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.raster.coverage import bounds, row_span
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import process_fragment
from softshadow.pipeline.records import Fragments, Region, Setup


def list_fragments(triangles: Setup, region: Region) -> Fragments:
    """Return all fragments of the triangles inside the region, in drawing order, each row from left to right."""
    no_room = np.empty(0, np.int32)
    n_fragments = collect(triangles.corners, region, no_room, no_room, no_room)
    fragments = Fragments(
        np.empty(n_fragments, np.int32), np.empty(n_fragments, np.int32), np.empty(n_fragments, np.int32)
    )
    collect(triangles.corners, region, *fragments)
    return fragments


@kernel
def collect(corners, region, rows, columns, numbers):
    """Write the fragments if the arrays have room; return the number of fragments."""
    n_fragments, room = 0, rows.shape[0]
    for t in range(corners.shape[0]):
        first, end = bounds(corners, np.uint64(t))
        for row in range(max(first, region.first_row), min(end, region.end_row)):
            left, right = row_span(corners, np.uint64(t), row, region.downwards)
            left, right = max(left, region.left), min(right, region.right)
            if room:
                for column in range(left, right):
                    rows[n_fragments], columns[n_fragments], numbers[n_fragments] = row, column, t
                    n_fragments += 1
            else:
                n_fragments += max(right - left, 0)
    return n_fragments


@kernel
def fragment_depth(planes, t, row, column, depth_range, largest):
    """Return the depth of triangle `t` at a pixel, in buffer units."""
    z = depth_at(planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3], column, row)
    return depth_units(z, depth_range, largest)


@kernel
def process_fragments(front, back, fragments, alpha, triangles, depth_range, columns, depth, stencil, verdicts):
    """Process listed fragments in order; return how many stencil values changed.

    Depth and stencil change; `verdicts` (n,) receives the verdict of each fragment. `alpha` (n,) uint8; `columns` holds
    0, 1, 2 ... in the precision of depth.
    """
    changed = 0
    for n in range(fragments.row.shape[0]):
        row, column, t = fragments.row[n], fragments.column[n], fragments.triangle[n]
        ops = front if triangles.front[t] else back
        z = fragment_depth(triangles.depth, t, columns[row], columns[column], depth_range, ops.depth_largest)
        before = stencil[row, column]
        verdict, s, stored_z = process_fragment(ops, True, np.int64(alpha[n]), z, depth[row, column], before)
        verdicts[n] = verdict
        changed += 1 if s != before else 0
        stencil[row, column] = s
        if ops.depth_write:
            depth[row, column] = stored_z
    return changed
