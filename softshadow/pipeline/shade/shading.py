"""Shading: from fragments to written colours, a chunk of fragments at a time.

The values of a chunk stay in the cache from interpolation to the write. All fragments of a full screen at once would
take 100 MB of fresh memory for every draw.
"""

from collections.abc import Callable

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import kernel
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.records import NO_VERTEX, Geometry, Spans, Sprites
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.interpolate import AttributePlanes, inputs_at, planes_of
from softshadow.pipeline.shade.pixel_blocks import in_blocks
from softshadow.pipeline.shade.visible_spans import fragments_of, spans_of
from softshadow.state import State

SPAN = 16  # fragments that take as long as the beginning of a span
# plain fragments from which several threads shade them: these take some 800 us, and dividing them 350
WORTH_SHARING = 350_000
LOOKED_UP = 5  # plain fragments that take as long as one with a texture
PARTS_PER_THREAD = 1  # more would balance the threads better, but a triangle is interpolated anew in each part
CHUNK = 32 * 2091  # fragments; an odd number of cache lines per column, so that columns do not share cache sets


def shade(geometry: Geometry, spans: Spans) -> np.ndarray:
    """Return the colours (n, 4) of fragments, unclamped."""
    planes = attribute_planes_of(geometry, spans)
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
    ordered : several fragments may belong to one pixel, and all are written in order. Otherwise several threads write
        chunks in any order.
    """
    writers = [color_writer(state, image) for image in target.colors]
    if ordered:
        colors = shade(geometry, spans)
        for write in writers:
            write(spans, colors)
        return
    planes = attribute_planes_of(geometry, spans)
    cuts = spans.chunks(CHUNK)

    def chunk(n: int) -> None:
        part = spans.part(cuts[n], cuts[n + 1])
        colors = _shade_chunk(geometry, planes, part)
        for write in writers:
            write(part, colors)

    share(chunk, len(cuts) - 1)


def shade_in_parts(
    geometry: Geometry, spans: Spans, shade_part: Callable[[Spans, AttributePlanes], None], weight: int = LOOKED_UP
) -> None:
    """Shade spans that do not overlap, in parts where several threads draw and there is enough to do.

    Parameters
    ----------
    weight : how many plain fragments take as long as one of these, about
    """
    n_threads = threads()
    if n_threads == 1 or weight * spans.fragments + len(spans.row) * SPAN < WORTH_SHARING:
        shade_part(spans, attribute_planes_of(geometry, spans))
        return
    parts = spans.equal_parts(PARTS_PER_THREAD * n_threads, SPAN)

    def shade_one(n: int) -> None:
        part = spans.part(*parts[n])
        shade_part(part, attribute_planes_of(geometry, part))

    share(shade_one, len(parts))


def attribute_planes_of(geometry: Geometry, spans: Spans) -> AttributePlanes:
    """Return the planes of the vertex outputs, for the triangles of the spans."""
    values = (geometry.values, geometry.back, geometry.flat, geometry.provoking)
    planes = planes_of(spans, geometry.triangles, geometry.window, *values)
    if geometry.sprites is not None:
        write_sprite_planes(geometry, geometry.sprites, planes)
    return planes


def write_sprite_planes(geometry: Geometry, sprites: Sprites, planes: AttributePlanes) -> None:
    """Write the planes of the coordinates of point sprites (GL 2.1, sec. 3.3.1), in llvmpipe's order of operations."""
    columns = np.array(sprites.columns, np.int64)
    arrays = geometry.window, geometry.triangles.vertices, sprites.widths
    replace_planes(*arrays, columns, sprites.upwards, planes.place, planes.values)


@kernel
def replace_planes(window, vertices, widths, columns, upwards, place, planes):
    """Write the planes (P, 3, k + 1) of the columns s, t, r, q that begin at `columns` (n,), of all points."""
    for t in range(vertices.shape[0]):
        if place[t] < 0 or vertices[t, 1] != NO_VERTEX:
            continue
        point, p = vertices[t, 0], place[t]
        x, y, over_w, step = window[point, 0] - HALF, window[point, 1] - HALF, window[point, 3], ONE / widths[point]
        down = step if upwards else -step
        for n in range(columns.shape[0]):
            s, r = columns[n], columns[n] + 2
            planes[p, 0, s] = (HALF - (step * x + ZERO * y)) * over_w
            planes[p, 1, s], planes[p, 2, s] = step * over_w, ZERO
            planes[p, 0, s + 1] = (HALF - (ZERO * x + down * y)) * over_w
            planes[p, 1, s + 1], planes[p, 2, s + 1] = ZERO, down * over_w
            planes[p, 0, r], planes[p, 1, r], planes[p, 2, r] = ZERO, ZERO, ZERO
            planes[p, 0, r + 1], planes[p, 1, r + 1], planes[p, 2, r + 1] = over_w, ZERO, ZERO


def _shade_chunk(geometry: Geometry, planes: AttributePlanes, spans: Spans) -> np.ndarray:
    """Return the colours (n, 4) of spans: interpolate, then call the program; cut 2x2 blocks are completed."""
    places = None
    if geometry.program.blocks:
        complete, places = in_blocks(fragments_of(spans))
        spans = spans_of(complete)
    inputs = inputs_at(spans, planes, geometry.flat)
    out = scratch((4, len(inputs)), inputs.dtype).T
    with np.errstate(all="ignore"):  # set per thread
        geometry.program.shade(inputs, geometry.uniforms, out)
    return out if places is None else out[places]
