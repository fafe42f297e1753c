"""Fragments one by one: the ordered path of draws with alpha test, blending or logic op, and of pixel histories.

Their colours must be known before (alpha test) or in drawing order (blending), so they are listed, shaded in one batch,
then tested and blended one after the other with the same `process_fragment`.
"""

from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.geometry.triangle_setup import Setup
from softshadow.pipeline.raster.coverage import bounds, row_span
from softshadow.pipeline.raster.fill import Region
from softshadow.pipeline.raster.fragment_ops import process_fragment
from softshadow.pipeline.raster.spans import depth_units


class Fragments(NamedTuple):
    """Fragments in drawing order:

    Row, column (n,) int32 of the stored planes; triangle (n,) int32, a row of `Setup`.
    """

    row: np.ndarray
    column: np.ndarray
    triangle: np.ndarray


def in_blocks(fragments: Fragments) -> tuple[Fragments, np.ndarray]:
    """Return the fragments' 2x2 pixel blocks, each complete (B * 4,), and where in them every fragment is (n,).

    A block begins at an even row and column and belongs to one triangle; its order is: first, right of it, next row,
    right of that. Pixels that the triangle does not cover are there to be shaded and thrown away.
    """
    row, column, triangle = (a.astype(np.int64) for a in fragments)
    side = int(max(row.max(initial=0), column.max(initial=0))) // 2 + 1
    key = (triangle * side + row // 2) * side + column // 2
    blocks, block = np.unique(key, return_inverse=True)
    first = blocks // side**2, blocks // side % side * 2, blocks % side * 2
    rows, columns = first[1][:, None] + (0, 0, 1, 1), first[2][:, None] + (0, 1, 0, 1)
    made = (rows, columns, np.repeat(first[0][:, None], 4, axis=1))
    complete = Fragments(*(a.ravel().astype(np.int32) for a in made))
    return complete, block * 4 + row % 2 * 2 + column % 2


def list_fragments(triangles: Setup, region: Region) -> Fragments:
    """Return all fragments of the triangles inside the region, in drawing order, each row from left to right."""
    nothing = np.empty(0, np.int32)
    count = collect(triangles.corners, region, nothing, nothing, nothing)
    made = Fragments(np.empty(count, np.int32), np.empty(count, np.int32), np.empty(count, np.int32))
    collect(triangles.corners, region, *made)
    return made


@kernel
def collect(corners, region, rows, columns, numbers):
    """Write the fragments, as far as there is room; returns how many there are."""
    count, room = 0, rows.shape[0]
    for t in range(corners.shape[0]):
        first, end = bounds(corners, np.uint64(t))
        for row in range(max(first, region.first_row), min(end, region.end_row)):
            left, right = row_span(corners, np.uint64(t), row, region.downwards)
            left, right = max(left, region.left), min(right, region.right)
            if room:
                for column in range(left, right):
                    rows[count], columns[count], numbers[count] = row, column, t
                    count += 1
            else:
                count += max(right - left, 0)
    return count


@kernel
def fragment_depth(planes, t, row, column, depth_range, largest):
    """Return the depth of triangle `t` at a pixel, in buffer units: the rule of the fill stage for one pixel."""
    z = ((planes[t, 1] * column + planes[t, 0]) + planes[t, 2] * row) + planes[t, 3]
    return depth_units(z, depth_range, largest)


@kernel
def process_fragments(front, back, fragments, alpha, triangles, depth_range, columns, depth, stencil, verdicts):
    """Process listed fragments in order: changes depth and stencil, writes the verdict of each to `verdicts` (n,).

    `alpha` (n,) uint8; `columns` holds 0, 1, 2 ... in the precision of depth. Returns how many stencil values changed.
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
