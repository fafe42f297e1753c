"""Three triangles of which the last has no height: llvmpipe takes them for a rectangle, and draws no others.

A desktop once drew its windows like that: two triangles that make a rectangle, and a third without area. Where the
first two make none, llvmpipe leaves out all three (lp_setup_analysis.c). We follow it.
"""

from __future__ import annotations

import numpy as np

from softshadow.pipeline.mesa.quad_cuts import SEGMENT

CORNERS, ALL = 3, 9
WHOLE_TRIANGLES = SEGMENT - SEGMENT % CORNERS  # vertices of whole triangles in a segment
# which vertices of a rectangle have the same x, and which the same y
SAME_X, SAME_Y = ((0, 1), (0, 5), (2, 3), (2, 4)), ((0, 3), (0, 5), (1, 2), (1, 4))


def segment_of_three(count: int) -> int:
    """Return the number of the first of nine vertices that are handled by themselves, or -1 where there are none."""
    used = count - count % CORNERS
    return used - ALL if used % WHOLE_TRIANGLES == ALL else -1


def is_left_out(window: np.ndarray) -> bool:
    """Return whether llvmpipe draws none of three triangles with the window positions (9, 4).

    A rectangle is drawn if it turns the one way, whatever is culled; y is that of the stored rows.
    """
    x, y = window[:, 0], window[:, 1]
    if not (y[6] == y[7] == y[8]):
        return False
    rectangle = all(x[a] == x[b] for a, b in SAME_X) and all(y[a] == y[b] for a, b in SAME_Y)
    return not rectangle or bool((x[2] < x[1]) != (y[0] < y[2]))
