"""How llvmpipe cuts quads into triangles depends on the vertices that it processes together: a segment.

In a segment with a vertex that needs clipping, quads are cut along the other diagonal (draw_decompose_tmp.h).
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl

SEGMENT, INDEXED_SEGMENT = 4096, 1024  # vertices that llvmpipe processes together (draw_pt_vsplit.c)


def quads_of(mode: int, count: int) -> tuple[int, int]:
    """Return how many quads `count` vertices make, and how many vertices apart they start."""
    return (count // 4, 4) if mode == gl.GL_QUADS else (max(count // 2 - 1, 0), 2)


def in_clipped_segment(mode: int, needs_clipping: np.ndarray, indices: np.ndarray | None) -> np.ndarray:
    """Return, per quad, whether its segment has a vertex that needs clipping.

    Parameters
    ----------
    needs_clipping : (V,) bool, for every vertex of the arrays
    indices : (N,) int32 or None
        With indices whose range is no longer than their number, llvmpipe handles the whole range of vertices, also
        those that no index names.
    """
    in_order = needs_clipping if indices is None else needs_clipping[indices]
    quads, stride = quads_of(mode, len(in_order))
    used = quads * stride + 4 - stride if quads else 0
    if indices is not None and 0 < used <= INDEXED_SEGMENT:
        first, last = int(indices.min()), int(indices.max())
        if last - first < used:
            return np.full(quads, needs_clipping[first : last + 1].any())
    step = (SEGMENT if indices is None else INDEXED_SEGMENT) - (4 - stride)  # segments of a strip share two vertices
    clipped = np.array([in_order[at : min(at + step + 4 - stride, used)].any() for at in range(0, max(used, 1), step)])
    return clipped[np.arange(quads) * stride // step]
