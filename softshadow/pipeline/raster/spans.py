"""One row of one triangle: depth and `process_fragment` from its first column to its last.

The ends of a row cost divisions (`coverage.row_span`); between them no pixel needs a coverage test, and the loop is
vectorised.
"""

import numpy as np

from softshadow.jit import inlined
from softshadow.pipeline.raster.depth import depth_at, depth_units
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, process_fragment
from softshadow.pipeline.records import NO_TRIANGLE, PASSED, SEVERAL_TRIANGLES

LAST, ONLY = 1, 2  # what `ids` receives of the triangles that pass at a pixel: the last one, or the only one


@inlined
def id_after(writes_ids, passed, triangle, before):
    """Return the id of a pixel after a fragment: that of the last triangle that passed, or SEVERAL_TRIANGLES."""
    if writes_ids == ONLY:
        triangle = triangle if before == NO_TRIANGLE else SEVERAL_TRIANGLES
    return triangle if passed else before


@inlined
def fill_span(ops, writes_ids, plane, depth_range, columns, row_at, left, right, triangle, depth, stencil, ids):
    """Process the fragments of one row of one triangle; `plane` is (z at pixel (0, 0), dz/di, dz/dj, offset)."""
    z0, dz, dz_row, offset = plane[0], plane[1], plane[2], plane[3]
    for column in range(left, right):
        i = np.uint64(column)  # unsigned: no wrap-around of negative indices is compiled in
        z = depth_units(depth_at(z0, dz, dz_row, offset, columns[i], row_at), depth_range, ops.depth_largest)
        verdict, s, stored_z = process_fragment(ops, True, NO_ALPHA, z, depth[i], stencil[i])
        if ops.stencil_test:
            stencil[i] = s
        if ops.depth_write:
            depth[i] = stored_z
        if writes_ids:
            ids[i] = id_after(writes_ids, verdict == PASSED, triangle, ids[i])


@inlined
def count_span(ops, plane, depth_range, columns, row_at, left, right, depth, stencil, counts):
    """Count the verdicts of one row of fragments; called before they are processed."""
    for i in range(left, right):
        z = depth_at(plane[0], plane[1], plane[2], plane[3], columns[i], row_at)
        z = depth_units(z, depth_range, ops.depth_largest)
        verdict, s, _ = process_fragment(ops, True, NO_ALPHA, z, depth[i], stencil[i])
        counts.verdicts[verdict] += 1
        counts.stencil_updates[0] += 1 if s != stencil[i] else 0
