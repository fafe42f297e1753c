"""Segments: the vertices that Mesa processes together. Where one of them needs clipping, all go through its stages.

The stages (draw_pipe.c) cut quads along the other diagonal (draw_decompose_tmp.h), and cull by the unsnapped corners of
triangles (draw_pipe_cull.c) before llvmpipe culls by the snapped ones.
"""

from __future__ import annotations

import numpy as np
from numpy.lib.stride_tricks import as_strided

from softshadow import tokens as gl

SEGMENT, INDEXED_SEGMENT = 4096, 1024  # vertices that llvmpipe processes together (draw_pt_vsplit.c)
QUADS_OF_SEGMENT = SEGMENT // 2 - 1  # of a strip without indices: segments share two vertices
SPLIT = {  # mode: vertices of the first primitive, and of each one more (draw_pt_split_prim)
    gl.GL_TRIANGLES: (3, 3), gl.GL_TRIANGLE_STRIP: (3, 1), gl.GL_TRIANGLE_FAN: (3, 1), gl.GL_POLYGON: (3, 1),
    gl.GL_QUADS: (4, 4), gl.GL_QUAD_STRIP: (4, 2),
}  # fmt: skip
# all their segments have the first vertex; where there are several, these are as short as with indices
AROUND_FIRST = (gl.GL_TRIANGLE_FAN, gl.GL_POLYGON)


def quads_and_stride(mode: int, n_vertices: int) -> tuple[int, int]:
    """Return the number of quads that vertices make, and the distance in vertices between their starts."""
    return (n_vertices // 4, 4) if mode == gl.GL_QUADS else (max(n_vertices // 2 - 1, 0), 2)


def in_clipped_segment(mode: int, needs_clipping: np.ndarray, indices: np.ndarray | None) -> np.ndarray:
    """Return, per quad or triangle, whether its segment has a vertex that needs clipping.

    Parameters
    ----------
    needs_clipping : (V,) bool, for every vertex of the arrays
    indices : (N,) int32 or None
        If the range of the indices is not longer than their number, llvmpipe processes the whole range of vertices,
        also those that no index names.
    """
    in_order = needs_clipping if indices is None else needs_clipping[indices]
    of_first, stride = SPLIT[mode]
    n_primitives = max((len(in_order) - of_first) // stride + 1, 0)
    n_used = (n_primitives - 1) * stride + of_first if n_primitives else 0
    if indices is not None and 0 < n_used <= INDEXED_SEGMENT:
        first, last = int(indices.min()), int(indices.max())
        if last - first < n_used:
            return np.full(n_primitives, needs_clipping[first : last + 1].any())
    shared = of_first - stride  # vertices of one segment that the next one has, too
    around_first = mode in AROUND_FIRST
    longest = SEGMENT if indices is None and (n_used <= SEGMENT or not around_first) else INDEXED_SEGMENT
    if n_used <= longest:
        return np.full(n_primitives, in_order[:n_used].any())
    step = (longest - shared) // stride * stride
    n_segments = -(-n_used // step)
    padded = np.zeros(n_segments * step + shared, bool)
    padded[:n_used] = in_order[:n_used]
    windows = as_strided(padded, (n_segments, step + shared), (step, 1))
    clipped = np.any(windows[:, int(around_first) :], axis=1)
    if around_first:
        clipped |= in_order[0]
    return clipped[np.arange(n_primitives) * stride // step]
