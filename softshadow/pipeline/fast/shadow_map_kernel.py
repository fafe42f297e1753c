"""The program "shadow-map" in one kernel; equals `shade.shading.shade_and_write`, see fast/test_shadow_map_kernel.py.

Soft shadows by light samples draw everything once for each of many lights with this program. Step by step, a fragment
takes 80 bytes from kernel to kernel, and a chunk large enough to pay for the calls does not fit into the cache; here a
few hundred fragments at a time go through the same functions and stay in the first-level cache.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.jit import allocating_kernel
from softshadow.pipeline.memory.threads import share, threads
from softshadow.pipeline.records import Geometry, Spans
from softshadow.pipeline.shade.blend import FOUR_BYTES
from softshadow.pipeline.shade.color_writes import as_pixels, pack_bytes, writable_bits, write_pixels
from softshadow.pipeline.shade.interpolate import AttributePlanes, coordinates_of, interpolate
from softshadow.pipeline.shade.shading import attribute_planes_of
from softshadow.programs.filtering import gather_texels, sources_of, texels_of, wraps_of
from softshadow.programs.sampling import divide_all, is_complete
from softshadow.programs.shadow_map import SHADOW_MAP, compare
from softshadow.programs.wrapping import nearest_texels
from softshadow.state import State
from softshadow.texture import Texture

PART = 1 << 14  # fragments that one thread shades in one go where several threads draw
AT_A_TIME = 384  # fragments; 30 KB from planes to pixels
VARYINGS = 8  # color and texCoord


def shadow_map_shader(state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None] | None:
    """Return the function that shades and writes spans of a draw, or None where `shade_and_write_spans` cannot.

    It can for float32, a depth map with GL_NEAREST and without GL's own comparison, and one colour buffer of bytes
    without blending.
    """
    map_ = geometry.uniforms.get("shadowMap")
    if geometry.program.shade is not SHADOW_MAP.shade or not isinstance(map_, Texture) or not _is_plain(map_):
        return None
    image, real = map_.base(), geometry.window.dtype
    blends = state.blend.enabled or state.blend.logic_enabled
    if blends or real != np.float32 or len(target.colors) != 1 or image is None or image.cells.dtype != real:
        return None
    color = target.colors[0]
    if color.format.kind != "unorm8" or color.format.base not in FOUR_BYTES:
        return None
    sources = sources_of(image, map_.sampler)[:1]
    texels = texels_of(image, map_.sampler, real)
    sizes_and_wraps = (image.width, image.height, *wraps_of(map_.sampler, map_.images.get((0, 0)) or image))
    ambient, bias = np.array(geometry.uniforms["ambient"], real), real.type(geometry.uniforms["bias"])
    writable, pixels = writable_bits(state, color), as_pixels(color.cells)

    def shade_part(spans: Spans, planes: AttributePlanes) -> None:
        shade_and_write_spans(
            planes.values, planes.place, *spans, coordinates_of(spans, real), geometry.flat, *texels, sources,
            sizes_and_wraps, ambient, bias, writable, pixels,
        )  # fmt: skip

    def shade(spans: Spans) -> None:
        planes = attribute_planes_of(geometry, spans)
        if threads() == 1:
            shade_part(spans, planes)
        else:
            parts = spans.chunks(PART)
            share(lambda n: shade_part(spans.part(parts[n], parts[n + 1]), planes), len(parts) - 1)

    return shade


def _is_plain(texture: Texture) -> bool:
    """Return whether a lookup reads the nearest texel of the base level."""
    sampler, image = texture.sampler, texture.base()
    nearest = sampler.min_filter == sampler.mag_filter == gl.GL_NEAREST and sampler.compare_mode == gl.GL_NONE
    return nearest and image is not None and image.format.kind == "depth" and is_complete(texture)


@allocating_kernel
def shade_and_write_spans(
    planes, place, rows, lefts, triangles, starts, coordinates, flat, cells, border, unit, sources, sizes_and_wraps,
    ambient, bias, writable, pixels,
):  # fmt: skip
    """Interpolate, look up the map, compare, and write the spans' pixels (H, pitch) of 32 bits.

    `sources` (1,) says where the red of a texel comes from, `sizes_and_wraps` are width, height and a wrap code each;
    the others are those of the kernels that are called.
    """
    width, height, wrap_s, wrap_t = sizes_and_wraps
    room = np.empty((VARYINGS + 1) * AT_A_TIME, planes.dtype)
    own_rows, own_lefts, own_triangles = (
        np.empty(AT_A_TIME, np.int32),
        np.empty(AT_A_TIME, np.int32),
        np.empty(AT_A_TIME, np.int32),
    )
    own_starts = np.zeros(AT_A_TIME + 1, np.int64)
    places, depths = np.empty(3 * AT_A_TIME, planes.dtype), np.empty(AT_A_TIME, planes.dtype)
    columns_of_texels, rows_of_texels = np.empty(AT_A_TIME, np.int32), np.empty(AT_A_TIME, np.int32)
    colors, packed = np.empty(4 * AT_A_TIME, planes.dtype), np.empty(AT_A_TIME, np.int32)
    r, done = 0, np.int64(0)  # the next span, and how many of its fragments are done
    while r < rows.shape[0]:
        count, n = 0, np.int64(0)
        while r < rows.shape[0] and n < AT_A_TIME:  # as many spans as there is room for; the last may go on afterwards
            length = min(starts[r + 1] - starts[r] - done, AT_A_TIME - n)
            own_rows[count], own_lefts[count], own_triangles[count] = rows[r], lefts[r] + done, triangles[r]
            done, n, count = done + length, n + length, count + 1
            own_starts[count] = n
            if done == starts[r + 1] - starts[r]:
                r, done = r + 1, np.int64(0)
        where = own_rows[:count], own_lefts[:count], own_starts[: count + 1]
        inputs = room[: (VARYINGS + 1) * n].reshape(VARYINGS + 1, n)
        projected, stored, shaded = places[: 3 * n].reshape(3, n), depths[:n], colors[: 4 * n].reshape(4, n)
        interpolate(planes, place, where[0], where[1], own_triangles[:count], where[2], coordinates, flat, inputs)
        divide_all(inputs[4:8], projected)
        nearest_texels(projected[0], width, wrap_s, columns_of_texels[:n])
        nearest_texels(projected[1], height, wrap_t, rows_of_texels[:n])
        gather_texels(
            columns_of_texels[:n], rows_of_texels[:n], cells, width, border, unit, sources, stored.reshape(1, n)
        )
        compare(inputs, projected, stored, ambient, bias, shaded)
        pack_bytes(shaded, packed[:n])
        write_pixels(where[0], where[1], where[2], packed[:n].view(np.uint32), writable, pixels)
