"""The program "shadow-map" in one kernel; equals `shade.shading.shade_and_write`, see fast/test_shadow_map_kernel.py.

Soft shadows by light samples draw everything once for each of many lights with this program. Step by step, a fragment
takes 80 bytes from kernel to kernel, and a chunk large enough to pay for the calls does not fit into the cache; here a
few hundred fragments at a time go through the same functions and stay in the first-level cache.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.jit import allocating_kernel, kernel
from softshadow.pipeline.records import Geometry, Spans
from softshadow.pipeline.shade.blend import FOUR_BYTES
from softshadow.pipeline.shade.color_writes import as_pixels, pack_bytes, writable_bits, write_pixels
from softshadow.pipeline.shade.interpolate import AttributePlanes, coordinates_of, interpolate
from softshadow.pipeline.shade.shading import shade_in_parts
from softshadow.programs.filtering import gather_texels, sources_of, texels_of, wraps_of
from softshadow.programs.sampling import divide_all, is_complete
from softshadow.programs.shadow_map import SHADOW_MAP, compare
from softshadow.programs.wrapping import nearest_texels
from softshadow.state import State
from softshadow.texture import Texture

AT_A_TIME = 384  # fragments; 30 KB from planes to pixels
VARYINGS = 8  # color and texCoord


class MapTexels(NamedTuple):
    """The texels of a map, the arguments of `gather_texels` and `nearest_texels`; `sources` (1,): that of the red."""

    cells: np.ndarray
    border: np.ndarray
    unit: Any
    sources: np.ndarray
    width: int
    height: int
    wrap_s: int
    wrap_t: int


def shadow_map_shader(state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None] | None:
    """Return the function that shades and writes spans of a draw, or None where `shade_and_write_spans` cannot.

    It can for float32, a depth map with GL_NEAREST and without GL's own comparison, and one colour buffer of bytes
    without blending.
    """
    if geometry.program.shade is not SHADOW_MAP.shade or not writes_one_buffer(state, target, "unorm8"):
        return None
    texels, real, color = plain_map(geometry), geometry.window.dtype, target.colors[0]
    if texels is None or color.format.base not in FOUR_BYTES:
        return None
    ambient, bias = np.array(geometry.uniforms["ambient"], real), real.type(geometry.uniforms["bias"])
    writable, pixels = writable_bits(state, color), as_pixels(color.cells)

    def shade_part(spans: Spans, planes: AttributePlanes) -> None:
        shade_and_write_spans(
            *planes, *spans, coordinates_of(spans, real), geometry.flat, texels, ambient, bias, writable, pixels
        )

    return lambda spans: shade_in_parts(geometry, spans, shade_part)


def writes_one_buffer(state: State, target: Framebuffer, kind: str) -> bool:
    """Return whether a draw writes a single colour buffer of a kind, and does not blend."""
    blends = state.blend.enabled or state.blend.logic_enabled
    formats = [image.format for image in target.colors]
    return not blends and len(formats) == 1 and formats[0].kind == kind and not formats[0].encoding


def plain_map(geometry: Geometry, name: str = "shadowMap") -> MapTexels | None:
    """Return the texels of a sampler's map if a lookup reads the nearest depth of its base level in float32."""
    map_, real = geometry.uniforms.get(name), geometry.window.dtype
    if not isinstance(map_, Texture):
        return None
    image, sampler = map_.base(), map_.sampler
    nearest = sampler.min_filter == sampler.mag_filter == gl.GL_NEAREST and sampler.compare_mode == gl.GL_NONE
    if not nearest or image is None or image.format.kind != "depth" or not is_complete(map_):
        return None
    if real != np.float32 or image.format.dtype != real:
        return None
    wraps = wraps_of(sampler, map_.images.get((0, 0)) or image)
    sources = sources_of(image, sampler)[:1]
    return MapTexels(*texels_of(image, sampler, real), sources, image.width, image.height, *wraps)


@allocating_kernel
def shade_and_write_spans(
    planes, place, rows, lefts, triangles, starts, coordinates, flat, texels, ambient, bias, writable, pixels
):
    """Interpolate, look up the map, compare, and write the spans' pixels (H, pitch) of 32 bits."""
    room = np.empty((VARYINGS + 1) * AT_A_TIME, planes.dtype)
    block, own_starts = np.empty((3, AT_A_TIME), np.int32), np.zeros(AT_A_TIME + 1, np.int64)
    places, depths = np.empty(3 * AT_A_TIME, planes.dtype), np.empty(AT_A_TIME, planes.dtype)
    colors, packed = np.empty(4 * AT_A_TIME, planes.dtype), np.empty(AT_A_TIME, np.int32)
    r, done = 0, np.int64(0)
    while r < rows.shape[0]:
        r, done, count, n = take_spans(rows, lefts, triangles, starts, r, done, block, own_starts)
        where = block[0, :count], block[1, :count], own_starts[: count + 1]
        inputs = room[: (VARYINGS + 1) * n].reshape(VARYINGS + 1, n)
        projected, stored, shaded = places[: 3 * n].reshape(3, n), depths[:n], colors[: 4 * n].reshape(4, n)
        interpolate(planes, place, where[0], where[1], block[2, :count], where[2], coordinates, flat, inputs)
        look_up(inputs[4:8], texels, projected, stored)
        compare(inputs, projected, stored, ambient, bias, shaded)
        pack_bytes(shaded, packed[:n])
        write_pixels(where[0], where[1], where[2], packed[:n].view(np.uint32), writable, pixels)


@kernel
def take_spans(rows, lefts, triangles, starts, r, done, block, own_starts):
    """Write the next spans to `block` (3, AT_A_TIME): row, first column, triangle; and where they start, from 0 on.

    `r` is the next span, `done` how many of its fragments are done. Return both for the block after this one, and the
    numbers of spans and fragments: as many as there is room for.
    """
    count, n = 0, np.int64(0)
    while r < rows.shape[0] and n < AT_A_TIME:  # the last span may go on in the next block
        length = min(starts[r + 1] - starts[r] - done, AT_A_TIME - n)
        block[0, count], block[1, count], block[2, count] = rows[r], lefts[r] + done, triangles[r]
        done, n, count = done + length, n + length, count + 1
        own_starts[count] = n
        if done == starts[r + 1] - starts[r]:
            r, done = r + 1, np.int64(0)
    return r, done, count, n


@allocating_kernel
def look_up(coordinates, texels, projected, stored):
    """Write s / q, t / q and r / q of coordinates (4, N), and the map's depth there (N,)."""
    columns, rows = np.empty(len(stored), np.int32), np.empty(len(stored), np.int32)
    divide_all(coordinates, projected)
    nearest_texels(projected[0], texels.width, texels.wrap_s, columns)
    nearest_texels(projected[1], texels.height, texels.wrap_t, rows)
    gather_texels(
        columns, rows, texels.cells, texels.width, texels.border, texels.unit, texels.sources,
        stored.reshape(1, len(stored)),
    )  # fmt: skip
