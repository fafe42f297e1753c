"""Where a draw may write: the scissor box, the range of depth, and the rows that its triangles meet."""

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.memory.threads import PART_SIZE, parts_of, share
from softshadow.pipeline.raster.coverage import extent
from softshadow.pipeline.records import DepthRange, Region, Setup
from softshadow.state import Points, State

NO_ATTENUATION = Points().attenuation
UNIT_RANGES: dict[type, DepthRange] = {real: DepthRange(real(0), real(1)) for real in (np.float32, np.float64)}


def region_of(state: State, target: Framebuffer) -> Region:
    """Return where a draw may write: the buffers, inside the scissor box if that test is on.

    Where sizes of points depend on their distance, wide lines and points end at the viewport, too.
    """
    width, height = target.size
    left, right, bottom, top = 0, width, 0, height
    downwards = int(target.flipped or state.polygon.upper_edges)
    box, attenuation = state.scissor, state.points.attenuation
    if not box.enabled and attenuation == NO_ATTENUATION:
        return Region(left, right, bottom, top, downwards)
    if box.enabled:
        left, right = max(left, box.x), min(right, box.x + box.width)
        bottom, top = max(bottom, box.y), min(top, box.y + box.height)
    if attenuation != NO_ATTENUATION:  # as in llvmpipe, though the specification does not ask for it
        view = state.viewport
        left, right = max(left, view.x), min(right, view.x + view.width)
        bottom, top = max(bottom, view.y), min(top, view.y + view.height)
    left, bottom = min(left, width), min(bottom, height)  # kernels rely on columns and rows within the buffers
    right, top = max(left, right), max(bottom, top)
    first, end = (height - top, height - bottom) if target.flipped else (bottom, top)
    return Region(left, right, first, end, downwards)


def depth_range_of(state: State, real: type) -> DepthRange:
    """Return the range that window z is clamped to.

    It is [0, 1]; with GL_DEPTH_CLAMP, the depth range as the viewport's scale and shift give it.
    """
    if not state.depth.clamp:
        return UNIT_RANGES[real]
    near, far = real(state.viewport.near), real(state.viewport.far)
    scale, shift = real(0.5) * (far - near), real(0.5) * (far + near)
    return DepthRange(min(shift - scale, shift + scale), max(shift - scale, shift + scale))


def covered(triangles: Setup, region: Region) -> tuple[Region, int]:
    """Return the region cut to the rows and columns that the triangles meet, and about how many fragments they have."""
    parts = parts_of(len(triangles.corners), 2 * PART_SIZE)
    extents = share(lambda n: extent(triangles.corners, *parts[n]), len(parts))
    firsts, ends, lefts, rights, areas = zip(*extents, strict=True)
    left = min(max(region.left, min(lefts)), region.right)  # kernels rely on columns within the buffer
    right = max(left, min(region.right, max(rights)))
    rows = max(region.first_row, min(firsts)), min(region.end_row, max(ends))
    return Region(left, right, *rows, region.downwards), sum(areas) >> 8


def buffer_cells(target: Framebuffer, real: np.dtype, *, writes_depth: bool = True) -> tuple[np.ndarray, np.ndarray]:
    """Return depth and stencil cells; a missing buffer, whose test is off, has a stand-in of zeros."""
    shape = padded_shape(target)
    if target.depth is None:
        depth = np.zeros(shape, real)
    else:
        depth = target.depth.cells if writes_depth else target.depth.read_cells
    stencil = target.stencil.cells if target.stencil is not None else np.zeros(shape, np.uint8)
    return depth, stencil


def padded_shape(target: Framebuffer) -> tuple[int, int]:
    """Return how many rows and columns the buffers have, with their padding."""
    shape: tuple[int, int] = next(iter(target.attachments.values())).image.shape
    return shape
