"""Shading: from fragments to written colours, a batch at a time.

What a batch carries from interpolation to the write stays in the cache. In one piece, the inputs of a full screen are
100 MB of memory that is new to the process each time.
"""

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.fast.shadow_map_kernel import shadow_map_shader
from softshadow.pipeline.geometry.geometry import Geometry
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.raster.ordered import in_blocks
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.interpolate import Planes, inputs_at, planes_of
from softshadow.pipeline.shade.visible_spans import Spans, fragments_of, spans_of
from softshadow.state import State

PART = 1 << 14  # fragments that a thread takes of a draw that one thread does in one go
CHUNK = 32 * 2091  # fragments: columns of an odd number of cache lines, which do not fall on each other in the cache


def shade(geometry: Geometry, spans: Spans) -> np.ndarray:
    """Return the colours (n, 4) of fragments, unclamped."""
    planes = _planes_of(geometry, spans)
    cuts = spans.chunks(CHUNK)
    colors = scratch((4, spans.fragments), geometry.window.dtype).T

    def chunk(n: int) -> None:
        first, end = spans.start[cuts[n]], spans.start[cuts[n + 1]]
        colors[first:end] = _shade_chunk(geometry, planes, spans.part(cuts[n], cuts[n + 1]))

    share(chunk, len(cuts) - 1)
    return colors


def shade_and_write(state: State, target: Framebuffer, geometry: Geometry, spans: Spans, *, ordered: bool) -> None:
    """Shade fragments and write their colours to all colour buffers.

    Parameters
    ----------
    ordered : several fragments may belong to one pixel, and are written one after the other. Otherwise batches may be
        written in any order, by several threads.
    """
    shade_map = None if ordered else shadow_map_shader(state, target, geometry)
    if shade_map is not None:
        planes = _planes_of(geometry, spans)
        if threads() == 1:
            shade_map(spans, planes)
        else:
            parts = spans.chunks(PART)
            share(lambda n: shade_map(spans.part(parts[n], parts[n + 1]), planes), len(parts) - 1)
        return
    writers = [color_writer(state, image) for image in target.colors]
    if ordered:
        colors = shade(geometry, spans)
        for write in writers:
            write(spans, colors)
        return
    planes = _planes_of(geometry, spans)
    cuts = spans.chunks(CHUNK)

    def chunk(n: int) -> None:
        part = spans.part(cuts[n], cuts[n + 1])
        colors = _shade_chunk(geometry, planes, part)
        for write in writers:
            write(part, colors)

    share(chunk, len(cuts) - 1)


def _planes_of(geometry: Geometry, spans: Spans) -> Planes:
    values = (geometry.values, geometry.back, geometry.flat, geometry.provoking)
    return planes_of(spans, geometry.triangles, geometry.window, *values)


def _shade_chunk(geometry: Geometry, planes: Planes, spans: Spans) -> np.ndarray:
    """Return colours (n, 4): interpolate, then call the program. Blocks that a batch cuts are completed in both."""
    own = None
    if geometry.program.blocks:
        complete, own = in_blocks(fragments_of(spans))
        spans = spans_of(complete)
    inputs = inputs_at(spans, planes, geometry.flat)
    out = scratch((4, len(inputs)), inputs.dtype).T
    with np.errstate(all="ignore"):  # set per thread
        geometry.program.shade(inputs, geometry.uniforms, out)
    return out if own is None else out[own]
