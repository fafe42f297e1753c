"""Shading: from fragments to written colours, a batch at a time.

What a batch carries from interpolation to the write stays in the cache. In one piece, the inputs of a full screen are
100 MB of memory that is new to the process each time.
"""

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.bands import share, threads
from softshadow.pipeline.color_writes import color_writer
from softshadow.pipeline.fragments import in_blocks
from softshadow.pipeline.geometry import Geometry
from softshadow.pipeline.interpolate import Planes, inputs_at, planes_of
from softshadow.pipeline.lent import lent
from softshadow.pipeline.map_shading import map_shader
from softshadow.pipeline.runs import Runs, fragments_of, runs_of
from softshadow.state import State

PART = 1 << 14  # fragments that a thread takes of a draw that one thread does in one go
BATCH = 32 * 2091  # fragments: columns of an odd number of cache lines, which do not fall on each other in the cache


def shade(geometry: Geometry, runs: Runs) -> np.ndarray:
    """Return the colours (n, 4) of fragments, unclamped."""
    planes = _planes_of(geometry, runs)
    cuts = runs.batches(BATCH)
    colors = lent((4, runs.fragments), geometry.window.dtype).T

    def batch(n: int) -> None:
        first, end = runs.start[cuts[n]], runs.start[cuts[n + 1]]
        colors[first:end] = _shade_batch(geometry, planes, runs.part(cuts[n], cuts[n + 1]))

    share(batch, len(cuts) - 1)
    return colors


def shade_and_write(state: State, target: Framebuffer, geometry: Geometry, runs: Runs, *, ordered: bool) -> None:
    """Shade fragments and write their colours to all colour buffers.

    Parameters
    ----------
    ordered : several fragments may belong to one pixel, and are written one after the other. Otherwise batches may be
        written in any order, by several threads.
    """
    shade_map = None if ordered else map_shader(state, target, geometry)
    if shade_map is not None:
        planes = _planes_of(geometry, runs)
        if threads() == 1:
            shade_map(runs, planes)
        else:
            parts = runs.batches(PART)
            share(lambda n: shade_map(runs.part(parts[n], parts[n + 1]), planes), len(parts) - 1)
        return
    writers = [color_writer(state, image) for image in target.colors]
    if ordered:
        colors = shade(geometry, runs)
        for write in writers:
            write(runs, colors)
        return
    planes = _planes_of(geometry, runs)
    cuts = runs.batches(BATCH)

    def batch(n: int) -> None:
        part = runs.part(cuts[n], cuts[n + 1])
        colors = _shade_batch(geometry, planes, part)
        for write in writers:
            write(part, colors)

    share(batch, len(cuts) - 1)


def _planes_of(geometry: Geometry, runs: Runs) -> Planes:
    values = (geometry.values, geometry.back, geometry.flat, geometry.provoking)
    return planes_of(runs, geometry.triangles, geometry.window, *values)


def _shade_batch(geometry: Geometry, planes: Planes, runs: Runs) -> np.ndarray:
    """Return colours (n, 4): interpolate, then call the program. Blocks that a batch cuts are completed in both."""
    own = None
    if geometry.program.blocks:
        complete, own = in_blocks(fragments_of(runs))
        runs = runs_of(complete)
    inputs = inputs_at(runs, planes, geometry.flat)
    out = lent((4, len(inputs)), inputs.dtype).T
    with np.errstate(all="ignore"):  # set per thread
        geometry.program.shade(inputs, geometry.uniforms, out)
    return out if own is None else out[own]
