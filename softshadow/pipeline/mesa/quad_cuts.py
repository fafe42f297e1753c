"""The diagonals along which llvmpipe cuts quads: they depend on the segment of vertices that is processed together.

In a segment with a vertex that needs clipping, quads are cut along the other diagonal (draw_decompose_tmp.h).
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl

SEGMENT, INDEXED_SEGMENT = 4096, 1024  # vertices that llvmpipe processes together (draw_pt_vsplit.c)
QUADS_OF_SEGMENT = SEGMENT // 2 - 1  # of a strip without indices: segments share two vertices


def quads_and_stride(mode: int, n_vertices: int) -> tuple[int, int]:
    """Return the number of quads that vertices make, and the distance in vertices between their starts."""
    return (n_vertices // 4, 4) if mode == gl.GL_QUADS else (max(n_vertices // 2 - 1, 0), 2)


def in_clipped_segment(mode: int, needs_clipping: np.ndarray, indices: np.ndarray | None) -> np.ndarray:
    """Return, per quad, whether its segment has a vertex that needs clipping.

    Parameters
    ----------
    needs_clipping : (V,) bool, for every vertex of the arrays
    indices : (N,) int32 or None
        If the range of the indices is not longer than their number, llvmpipe processes the whole range of vertices,
        also those that no index names.
    """
    in_order = needs_clipping if indices is None else needs_clipping[indices]
    n_quads, stride = quads_and_stride(mode, len(in_order))
    n_used = n_quads * stride + 4 - stride if n_quads else 0
    if indices is not None and 0 < n_used <= INDEXED_SEGMENT:
        first, last = int(indices.min()), int(indices.max())
        if last - first < n_used:
            return np.full(n_quads, needs_clipping[first : last + 1].any())
    step = (SEGMENT if indices is None else INDEXED_SEGMENT) - (4 - stride)  # segments of a strip share two vertices
    clipped = np.array(
        [in_order[start : min(start + step + 4 - stride, n_used)].any() for start in range(0, max(n_used, 1), step)]
    )
    return clipped[np.arange(n_quads) * stride // step]
