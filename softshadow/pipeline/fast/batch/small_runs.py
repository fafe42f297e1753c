"""A small run in one call of a kernel, or two; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

One call sets up the triangles of all draws, unless clipping has to cut some: then another sets up what it leaves.
"""

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.fast.batch.assembly import assemble_draws
from softshadow.pipeline.fast.batch.vertices import prepare_draws, process_vertices
from softshadow.pipeline.geometry.facing import leave_out_culled, snap_vertices
from softshadow.pipeline.geometry.triangle_setup import set_up_triangles
from softshadow.pipeline.geometry.vertex import window_position


@kernel
def set_up_run(
    layout, numbers, rows, lights, materials, flags, placed, generated, planes, user_planes, unit_rows, positions,
    colors, normals, reflectances, secondaries, fog_coordinates, texcoords, scales, shifts, clip, codes, window,
    values, back, indices, triangles, triangles_read, provoking, snapped, culled, positive_is_front, offset, corners,
    vertices, depth, front, ids,
):  # fmt: skip
    """Process the vertices of all draws and set their triangles up, unless any of them must be clipped.

    Return the numbers of triangles and of those that are drawn, the latter -1 where a vertex needs clipping, and the
    sum of their areas in 1/256 pixel. `triangles_read` is `triangles`, read-only.
    """
    n = positions.shape[0]
    prepare_draws(layout, numbers, rows, lights, flags, placed)
    process_vertices(
        0, n, layout, numbers, rows, lights, materials, flags, placed, generated, planes, user_planes, unit_rows,
        positions, colors, normals, reflectances, secondaries, fog_coordinates, texcoords, scales, shifts, clip, codes,
        window, values, back,
    )  # fmt: skip
    n_triangles = assemble_draws(numbers, indices, codes, triangles, provoking)
    any_code = 0
    for v in range(n):
        any_code |= codes[v]
    if any_code:
        return n_triangles, np.int64(-1), np.int64(0)
    snap_vertices(window, 0, n, snapped)
    n_drawn, area = set_up_triangles(
        window, snapped, triangles_read, 0, n_triangles, culled, positive_is_front, offset, 0, corners, vertices, depth,
        front, ids,
    )  # fmt: skip
    return n_triangles, np.int64(n_drawn), np.int64(area)


@kernel
def set_up_pieces(
    clip, known_window, views, scales, shifts, window, snapped, triangles, triangles_read, in_stages, culled,
    positive_is_front, offset, corners, vertices, depth, front, ids,
):  # fmt: skip
    """Set up the triangles over vertices of which the first ones have known window positions, as `set_up_run` does.

    Return the number of triangles that are drawn, and the sum of their areas in 1/256 pixel. For `views` see
    `place_new`.
    """
    n, n_known = clip.shape[0], known_window.shape[0]
    for v in range(n_known):
        for k in range(4):
            window[v, k] = known_window[v, k]
    place_new(clip[n_known:], views, scales, shifts, window[n_known:])
    snap_vertices(window, 0, n, snapped)
    if culled and in_stages.shape[0]:
        leave_out_culled(window, triangles, in_stages, culled, positive_is_front)
    n_drawn, area = set_up_triangles(
        window, snapped, triangles_read, 0, triangles.shape[0], culled, positive_is_front, offset, 0, corners, vertices,
        depth, front, ids,
    )  # fmt: skip
    return np.int64(n_drawn), np.int64(area)


@kernel
def place_new(clip, views, scales, shifts, window):
    """Write the window positions of vertices that clipping has made; `views` are the rows of their viewports."""
    for v in range(clip.shape[0]):
        window_position(clip, v, scales[views[v]], shifts[views[v]], window)
