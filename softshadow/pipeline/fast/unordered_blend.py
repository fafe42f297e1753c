"""Blended draws without overlaps: where each pixel takes at most one fragment, drawing order does not matter.

Light added upon a surface is such a draw: the depth test passes on that surface alone. Where the tests change neither
depth nor stencil, the fill stage finds out without doing harm: it leaves a mark where a second fragment passes.
"""

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.fast.specialize import fill
from softshadow.pipeline.geometry.triangle_setup import Setup
from softshadow.pipeline.raster.fill import Region, no_ids
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.spans import SEVERAL, SOLE, DepthRange


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
    ids = no_ids(region, depth.shape[1])
    fill(front, back, triangles, fragments, region, depth_range, depth, stencil, ids, writes=SOLE)
    return None if ids.min() == SEVERAL else ids


def picks_surface(ops: FragmentOps) -> bool:
    """Return whether fragments leave depth and stencil as they are, and are likely those of a surface drawn before."""
    keeps_stencil = ops.write_mask == 0 or (ops.sfail, ops.zfail, ops.zpass) == (gl.GL_KEEP,) * 3
    return keeps_stencil and not ops.depth_write and ops.depth_func in (gl.GL_EQUAL, gl.GL_LEQUAL)
