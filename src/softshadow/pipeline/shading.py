"""Shading: from fragments to written colours, a batch at a time.

What a batch carries from interpolation to the write stays in the cache. In one piece, the inputs of a full screen are
100 MB of memory that is new to the process each time.
"""

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import kernel
from softshadow.pipeline.bands import in_batches
from softshadow.pipeline.blend import write_colors
from softshadow.pipeline.fragments import Fragments, in_blocks
from softshadow.pipeline.geometry import Geometry
from softshadow.pipeline.interpolate import inputs_at, planes_of
from softshadow.state import State

BATCH = 1 << 15  # fragments; measured flat within 10 % from 2^13 to 2^17, and 30 % slower in one piece


def shade(geometry: Geometry, fragments: Fragments) -> np.ndarray:
    """Return the colours (n, 4) of fragments, unclamped."""
    planes = _planes_of(geometry, fragments)
    colors = np.empty((len(fragments.row), 4), geometry.window.dtype)

    def batch(first: int, end: int) -> None:
        colors[first:end] = _shade_batch(geometry, planes, _part(fragments, first, end))

    in_batches(batch, len(fragments.row), BATCH)
    return colors


def shade_and_write(
    state: State, target: Framebuffer, geometry: Geometry, fragments: Fragments, *, ordered: bool
) -> None:
    """Shade fragments and write their colours to all colour buffers.

    Parameters
    ----------
    ordered : several fragments may belong to one pixel, and are written one after the other. Otherwise batches may be
        written in any order, by several threads.
    """
    if ordered:
        colors = shade(geometry, fragments)
        for image in target.colors:
            write_colors(state, image, fragments, colors)
        return
    planes = _planes_of(geometry, fragments)

    def batch(first: int, end: int) -> None:
        part = _part(fragments, first, end)
        colors = _shade_batch(geometry, planes, part)
        for image in target.colors:
            write_colors(state, image, part, colors)

    in_batches(batch, len(fragments.row), BATCH)


def list_visible(ids: np.ndarray, first_row: int) -> Fragments:
    """Return the fragments that are left per pixel.

    Parameters
    ----------
    ids : (rows, pitch) int32, the triangle of each pixel or -1
    first_row : of the stored planes, which row 0 of `ids` is
    """
    count = count_visible(ids)
    made = Fragments(np.empty(count, np.int32), np.empty(count, np.int32), np.empty(count, np.int32))
    collect_visible(ids, first_row, *made)
    return made


@kernel
def count_visible(ids):
    count = 0
    for number in ids.ravel():
        count += 1 if number >= 0 else 0
    return count


@kernel
def collect_visible(ids, first_row, rows, columns, numbers):
    """Write row, column and triangle of all pixels that have one."""
    count = 0
    for row in range(ids.shape[0]):
        for column in range(ids.shape[1]):
            if ids[row, column] >= 0:
                rows[count], columns[count], numbers[count] = row + first_row, column, ids[row, column]
                count += 1


def _planes_of(geometry: Geometry, fragments: Fragments) -> np.ndarray:
    values = (geometry.values, geometry.back, geometry.flat, geometry.provoking)
    return planes_of(fragments.triangle, geometry.triangles, geometry.window, *values)


def _part(fragments: Fragments, first: int, end: int) -> Fragments:
    return Fragments(*(part[first:end] for part in fragments))


def _shade_batch(geometry: Geometry, planes: np.ndarray, fragments: Fragments) -> np.ndarray:
    """Return colours (n, 4): interpolate, then call the program. Blocks that a batch cuts are completed in both."""
    shaded, own = in_blocks(fragments) if geometry.program.blocks else (fragments, None)
    inputs = inputs_at(shaded, planes, geometry.flat)
    out = np.empty((len(inputs), 4), inputs.dtype)
    with np.errstate(all="ignore"):  # set per thread
        geometry.program.shade(inputs, geometry.uniforms, out)
    return out if own is None else out[own]
