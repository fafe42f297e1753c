"""Blended draws without overlaps; equals `raster.ordered.process_fragments`, see fast/test_unordered_blend.py.

Where each pixel takes at most one fragment, drawing order does not matter: light added upon a surface is such a draw,
since the depth test passes on that surface alone. Where the tests change neither depth nor stencil, a dry-run fill
flags pixels where a second fragment passes.
"""

from collections.abc import Callable

import numpy as np

from softshadow.pipeline.raster.fill import no_ids
from softshadow.pipeline.records import SEVERAL_TRIANGLES, Region


def triangles_without_overlaps(dry_run: Callable[[np.ndarray], None], region: Region, pitch: int) -> np.ndarray | None:
    """Return the triangle of the only fragment that passes at each pixel, or None where a pixel has several.

    Parameters
    ----------
    dry_run : fills the triangles and writes ids as ONLY says; it changes neither depth nor stencil
    region, pitch : rows of the ids, and their length

    Returns
    -------
    (rows of the region, pitch) int32, NO_TRIANGLE where no fragment passes; any numbers outside of the region's columns
    """
    ids = no_ids(region, pitch)
    dry_run(ids)
    return None if (ids[:, region.left : region.right] == SEVERAL_TRIANGLES).any() else ids
