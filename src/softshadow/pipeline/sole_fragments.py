"""Blended draws without overlaps: where each pixel takes at most one fragment, drawing order does not matter.

Light added upon a surface is such a draw: the depth test passes on that surface alone. Where the tests change neither
depth nor stencil, the fill stage may be asked twice: in drawing order the last fragment that passes leaves its triangle
at a pixel, in reverse order the first one. If these agree everywhere there is no second one.
"""

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import kernel
from softshadow.pipeline.binding import fill
from softshadow.pipeline.fill import Region
from softshadow.pipeline.fragment_ops import FragmentOps
from softshadow.pipeline.setup import Setup
from softshadow.pipeline.spans import DepthRange


def sole_fragments(
    front: FragmentOps,
    back: FragmentOps,
    triangles: Setup,
    fragments: int,
    region: Region,
    depth_range: DepthRange,
    depth: np.ndarray,
    stencil: np.ndarray,
) -> np.ndarray | None:
    """Return the triangle of each pixel's only fragment that passes, or None where a pixel may have several.

    Returns
    -------
    (rows of the region, pitch) int32, -1 where no fragment passes
    """
    if region.first_row >= region.end_row or not (picks_surface(front) and picks_surface(back)):
        return None
    shape = (region.end_row - region.first_row, depth.shape[1])
    last, first = np.full(shape, -1, np.int32), np.full(shape, -1, np.int32)
    fill(front, back, triangles, fragments, region, depth_range, depth, stencil, last)
    backwards = Setup(*(np.ascontiguousarray(part[::-1]) for part in triangles))
    fill(front, back, backwards, fragments, region, depth_range, depth, stencil, first)
    return last if agree(last, first, len(triangles.ids)) else None


def picks_surface(ops: FragmentOps) -> bool:
    """Return whether fragments leave depth and stencil as they are, and are likely those of a surface drawn before."""
    keeps_stencil = ops.write_mask == 0 or (ops.sfail, ops.zfail, ops.zpass) == (gl.GL_KEEP,) * 3
    return keeps_stencil and not ops.depth_write and ops.depth_func in (gl.GL_EQUAL, gl.GL_LEQUAL)


@kernel
def agree(last, first, count):
    """Return whether two planes name the same triangles; `first` numbers them from the last of `count`."""
    for row in range(last.shape[0]):
        for column in range(last.shape[1]):
            if last[row, column] >= 0 and last[row, column] != count - 1 - first[row, column]:
                return False
    return True
