"""Three triangles, the last without height: llvmpipe takes them for a rectangle, or leaves them out.

A desktop once drew its windows like that: two triangles that make a rectangle, and a third without area. If the first
two make no rectangle, llvmpipe leaves out all three (lp_setup_analysis.c), and so do we.
"""

from __future__ import annotations

import numpy as np

from softshadow.pipeline.mesa.segments import SEGMENT

TRIANGLE, LAST_NINE = 3, 9  # vertices of one and of three triangles
WHOLE_TRIANGLES = SEGMENT - SEGMENT % TRIANGLE  # vertices of whole triangles in a segment
# pairs of vertices that have the same x, and the same y, in a rectangle
SAME_X, SAME_Y = ((0, 1), (0, 5), (2, 3), (2, 4)), ((0, 3), (0, 5), (1, 2), (1, 4))


def start_of_last_nine(n_vertices: int) -> int:
    """Return the first of the last nine vertices if these are a segment of their own, else -1."""
    n_used = n_vertices - n_vertices % TRIANGLE
    return n_used - LAST_NINE if n_used % WHOLE_TRIANGLES == LAST_NINE else -1


def is_left_out(window: np.ndarray) -> bool:
    """Return whether llvmpipe leaves out three triangles with the window positions (9, 4).

    A rectangle is drawn only in one winding, whatever is culled; y is that of the stored rows.
    """
    x, y = window[:, 0], window[:, 1]
    if not (y[6] == y[7] == y[8]):
        return False
    rectangle = all(x[a] == x[b] for a, b in SAME_X) and all(y[a] == y[b] for a, b in SAME_Y)
    return not rectangle or bool((x[2] < x[1]) != (y[0] < y[2]))
