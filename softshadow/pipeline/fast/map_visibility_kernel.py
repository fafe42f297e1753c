"""Visibility by maps in one kernel; equals `shade.shading.shade_and_write`, see fast/test_visibility_kernel.py.

Soft shadows from many points of a light draw the picture with "map-visibility" or "map-visibility-8", into a buffer
of floats. As in `shadow_map_kernel`, a few hundred fragments at a time go through all steps in the first-level cache.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import allocating_kernel, kernel
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.constants import HALF, ONE, ZERO
from softshadow.pipeline.fast.shadow_map_kernel import (
    AT_A_TIME,
    look_up,
    plain_map,
    take_spans,
    writes_one_buffer,
)
from softshadow.pipeline.records import Geometry, Spans
from softshadow.pipeline.shade.interpolate import AttributePlanes, coordinates_of, interpolate
from softshadow.pipeline.shade.shading import shade_in_parts
from softshadow.programs.eight_maps import MAP_VISIBILITY_8, MOST_MAPS, SAMPLERS
from softshadow.programs.map_visibility import MAP_VISIBILITY
from softshadow.state import State

# it takes three seconds to compile, and gains some 20 ns a comparison
VISIBILITY_KERNEL = KernelGroup("map visibility", pays_after=50_000_000)


def map_visibility_shader(state: State, target: Framebuffer, geometry: Geometry) -> Callable[[Spans], None] | None:
    """Return the function that shades and writes spans of a draw, or None where `write_visibilities` cannot.

    It can for a single comparison with each of several plain depth maps (`plain_map`), and one buffer of floats with
    four channels that all are written, without blending.
    """
    uniforms = geometry.uniforms
    if geometry.program.shade is MAP_VISIBILITY.shade and uniforms["radius"] == 0:
        names, cone = ["shadowMap"], uniforms["cone"]
    elif geometry.program.shade is MAP_VISIBILITY_8.shade:
        names, cone = list(SAMPLERS[: len(geometry.flat) // 4]), float("inf")
    else:
        return None
    if not writes_one_buffer(state, target, "float"):
        return None
    maps = [plain_map(geometry, name) for name in names]
    color, real = target.colors[0], geometry.window.dtype.type
    if not maps or None in maps or not all(state.color.mask) or not all(color.format.written):
        return None
    texels = tuple(maps + maps[-1:] * (MOST_MAPS - len(maps)))  # always as many: one compiled kernel
    numbers = (real(uniforms["bias"]), real(uniforms["behind"]), real(cone))
    cells = color.cells

    def shade_part(spans: Spans, planes: AttributePlanes) -> None:
        coordinates = coordinates_of(spans, geometry.window.dtype)
        write_visibilities(*planes, *spans, coordinates, geometry.flat, texels, *numbers, cells)

    return lambda spans: shade_in_parts(geometry, spans, shade_part)


@allocating_kernel
def write_visibilities(
    planes, place, rows, lefts, triangles, starts, coordinates, flat, texels, bias, behind, cone, cells
):
    """Interpolate, look up each map, compare, and write the sum of the visibilities to all channels of `cells`.

    `texels` are those of eight maps; `flat` (4 n,) says how many of them are in use.
    """
    columns = len(flat) + 1
    room = np.empty(columns * AT_A_TIME, planes.dtype)
    block, own_starts = np.empty((3, AT_A_TIME), np.int32), np.zeros(AT_A_TIME + 1, np.int64)
    places, depths = np.empty(3 * AT_A_TIME, planes.dtype), np.empty(AT_A_TIME, planes.dtype)
    sums = np.empty(AT_A_TIME, planes.dtype)
    r, done = 0, np.int64(0)
    while r < rows.shape[0]:
        r, done, count, n = take_spans(rows, lefts, triangles, starts, r, done, block, own_starts)
        inputs, projected = room[: columns * n].reshape(columns, n), places[: 3 * n].reshape(3, n)
        stored, total = depths[:n], sums[:n]
        interpolate(
            planes, place, block[0, :count], block[1, :count], block[2, :count], own_starts[: count + 1], coordinates,
            flat, inputs,
        )  # fmt: skip
        total[:] = ZERO
        for m in range(len(flat) // 4):
            look_up(inputs[4 * m : 4 * m + 4], texels[m], projected, stored)
            add_visibility(inputs[4 * m + 3], projected, stored, bias, behind, cone, total)
        write_gray(block[0, :count], block[1, :count], own_starts[: count + 1], total, cells)


@kernel
def add_visibility(q, projected, stored, bias, behind, cone, total):
    """Add visibilities (N,): 1 where a point's depth is at most the stored one, in the cone; `behind` for q <= 0."""
    for n in range(len(stored)):
        depth, s, t = projected[2, n] - bias, projected[0, n] - HALF, projected[1, n] - HALF
        depth = ONE if depth > ONE else depth  # NaN stays, and compares as in shadow
        visible = ONE if depth <= stored[n] else ZERO
        visible = ZERO if s * s + t * t > cone else visible
        total[n] += visible if q[n] > ZERO else behind


@kernel
def write_gray(rows, lefts, starts, values, cells):
    """Write values (n,) of spans to all channels of `cells` (H, pitch, 4)."""
    for r in range(rows.shape[0]):
        source = values[starts[r] : starts[r + 1]]
        target = cells[rows[r], lefts[r] : lefts[r] + source.shape[0]]
        for i in range(source.shape[0]):
            target[i, 0] = target[i, 1] = target[i, 2] = target[i, 3] = source[i]
