"""Triangle setup: snapped corners, depth plane and polygon offset of the triangles that are drawn."""

from typing import NamedTuple

import numpy as np

from softshadow.image import Image
from softshadow.jit import inlined, kernel, read_only
from softshadow.pipeline.constants import HALF, ONE, SUBPIXELS, ZERO
from softshadow.pipeline.geometry.clip import Clipped
from softshadow.pipeline.geometry.facing import (
    culling,
    facing_and_area,
    leave_out_culled,
    snap_vertices,
    vertices_of,
)
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import PART_SIZE, parts_of, share
from softshadow.pipeline.mesa.polygon_rules import offset_is_on
from softshadow.pipeline.records import Setup
from softshadow.state import Cull, Polygon

SLOPES = {"max": 0, "length": 1, "slide": 2}
MAX_SLOPE, LENGTH_SLOPE = 0, 1
MANTISSA_BITS = 23

NO_TRIANGLES = Setup(
    np.empty((0, 6), np.int32),
    np.empty((0, 3), np.int32),
    np.empty((0, 4), np.float32),
    np.empty(0, np.uint8),
    np.empty(0, np.int32),
)


class Offset(NamedTuple):
    """Polygon offset, slope * factor + constant.

    `downwards`: stored rows grow downwards, so GL's dz/dy is the negative of dz/dj.
    """

    slope: int
    factor: np.floating
    constant: np.floating
    downwards: int


def offset_of(polygon: Polygon, depth: Image | None, real: type, slope: str, unit: str, flipped: bool) -> Offset:
    """Return the polygon offset of filled polygons for the depth format that is drawn to.

    llvmpipe adds it where the offset of any mode is enabled, also that of lines or points (`offset_is_on`). With `unit`
    "mesa" a unit is two steps of a fixed-point format, as in llvmpipe; with "spec" one (GL 2.1, sec. 3.5.5).
    The constant of float depth depends on the triangle: `add_float_units`.
    """
    factor, units = (polygon.factor, polygon.units) if offset_is_on(polygon) else (0.0, 0.0)
    largest = depth.format.largest if depth else 0
    constant = units * (1.0 / largest) * (2 if unit == "mesa" else 1) if largest else 0.0
    return Offset(SLOPES[slope], real(factor), real(constant), int(flipped))


def add_float_units(offsets: np.ndarray, window_z: np.ndarray, units: float) -> None:
    """Add `units` last places of each triangle's largest abs(z) to its offset: the unit of float depth formats.

    window_z (n, 3), the depths of the corners.
    """
    largest = np.abs(window_z).max(axis=1)
    _, exponent = np.frexp(largest)
    step = np.ldexp(offsets.dtype.type(1), exponent - 1 - MANTISSA_BITS)
    tiny = (step < np.finfo(np.float32).tiny) | (largest == 0)  # frexp gives 0 the exponent of 1/2
    offsets += offsets.dtype.type(units) * np.where(tiny, offsets.dtype.type(0), step)


def merge_by_id(setups: list[Setup]) -> Setup:
    """Return triangles, lines and points in one `Setup`, in the order of their ids, which each of them has, too."""
    drawn = [setup for setup in setups if len(setup.ids)]
    if len(drawn) < 2:
        return drawn[0] if drawn else setups[0]
    joined = Setup(*(np.concatenate(arrays) for arrays in zip(*drawn, strict=True)))
    order = np.argsort(joined.ids, kind="stable")
    return Setup(*(array[order] for array in joined))


def set_up(window: np.ndarray, triangles: np.ndarray, cull: Cull, offset: Offset, flipped: bool) -> Setup:
    """Return the triangles with an area that are not culled.

    Parameters
    ----------
    window : (V, 4) window x, y (stored rows), z, 1/w
    triangles : (T, 3) int32
    """
    facing, (snapped, _) = stored_culling(cull, flipped), snapped_vertices(window)
    triangles, parts = read_only(triangles), parts_of(len(triangles))
    setup = empty_setup(len(triangles), window.dtype)
    ends = share(
        lambda n: set_up_triangles(window, snapped, triangles, *parts[n], *facing, offset, parts[n][0], *setup),
        len(parts),
    )
    n_drawn = int(ends[0][0])
    for (first, _), (end, _) in zip(parts[1:], ends[1:], strict=True):  # over those that are not drawn
        rows = slice(n_drawn, n_drawn + int(end) - first)
        if rows.start != first:
            for array in setup:
                array[rows] = array[first:end]
        n_drawn = rows.stop
    return Setup(*(array[:n_drawn] for array in setup))


def left_by_cull_stage(window: np.ndarray, clipped: Clipped, cull: Cull, flipped: bool) -> np.ndarray:
    """Return the triangles (T', 3) of a draw, without an area those that Mesa's cull stage leaves out."""
    culled, positive_is_front = stored_culling(cull, flipped)
    if not culled or clipped.in_stages is None or not len(clipped.in_stages):
        return clipped.triangles
    triangles = clipped.triangles.copy()
    leave_out_culled(window, triangles, clipped.in_stages, culled, positive_is_front)
    return triangles


def stored_culling(cull: Cull, flipped: bool) -> tuple[int, int]:
    """Return which faces are culled, see `culling`, and whether triangles of positive area face the front.

    Stored rows that grow downwards mirror the picture: there, a positive area is counter-clockwise.
    """
    culled, ccw_is_front = culling(cull)
    return culled, int(ccw_is_front == flipped)


def snapped_vertices(window: np.ndarray) -> tuple[np.ndarray, tuple[int, int]]:
    """Return the snapped x and y (V, 2) int32 of all vertices, and the first and end row of samples that they span."""
    snapped, parts = scratch((len(window), 2), np.int32), parts_of(len(window), 2 * PART_SIZE)
    lows, highs = zip(*share(lambda n: snap_vertices(window, *parts[n], snapped), len(parts)), strict=True)
    return snapped, ((min(lows) + 255) >> 8, (max(highs) >> 8) + 1)


def empty_setup(n_triangles: int, real: np.dtype) -> Setup:
    """Return the arrays of a `Setup`, not yet filled."""
    return Setup(
        scratch((n_triangles, 6), np.int32),
        scratch((n_triangles, 3), np.int32),
        scratch((n_triangles, 4), real),
        scratch(n_triangles, np.uint8),
        scratch(n_triangles, np.int32),
    )


@inlined
def snap_away(coordinate):
    """Return a coordinate in 1/256 pixel, a half rounded away from zero.

    Mesa 22.3 rounds coordinates of lines and points in this way (util_iround: add a half, then truncate); for triangles
    it uses an instruction that rounds a half to even.
    """
    fixed = coordinate * SUBPIXELS
    return int(np.trunc(fixed + np.copysign(HALF, fixed)))


@kernel
def plane(x0, y0, dx01, dy01, dx20, dy20, a0, a1, a2):
    """Return (value at pixel (0, 0), d/di, d/dj) of the plane through three vertices.

    The operations are in llvmpipe's order. dx.. and dy.. are differences of the unsnapped positions, divided by twice
    the area.
    """
    da01, da20 = a0 - a1, a2 - a0
    di = da01 * dy20 - da20 * dy01
    dj = da20 * dx01 - da01 * dx20
    return a0 - (di * (x0 - HALF) + dj * (y0 - HALF)), di, dj


@inlined
def line_gradient(window, a, b):
    """Return (dx, dy, 1 / length**2) of a line, for the gradients in `line_plane`.

    Values change along the major direction only.
    """
    dx, dy = window[a, 0] - window[b, 0], window[a, 1] - window[b, 1]
    over_area = ONE / (dx * dx + dy * dy)
    if abs(dx) >= abs(dy):
        slope = dy / dx
        return dx * (ONE + slope * slope), ZERO * dy, over_area
    slope = dx / dy
    return ZERO * dx, dy * (ONE + slope * slope), over_area


@inlined
def line_plane(x, y, dx, dy, over_area, a0, a1):
    """Return (value at pixel (0, 0), d/di, d/dj) for values at the two ends of a line; the first end is (x, y)."""
    di, dj = (a0 - a1) * dx * over_area, (a0 - a1) * dy * over_area
    return a0 - (di * (x - HALF) + dj * (y - HALF)), di, dj


@kernel
def edge_differences(window, v0, v1, v2):
    """Return dx01, dy01, dx20, dy20 of a triangle, and 1 / (twice its area)."""
    dx01, dy01 = window[v0, 0] - window[v1, 0], window[v0, 1] - window[v1, 1]
    dx20, dy20 = window[v2, 0] - window[v0, 0], window[v2, 1] - window[v0, 1]
    return dx01, dy01, dx20, dy20, ONE / (dx01 * dy20 - dy01 * dx20)


@inlined
def polygon_offset(offset, dx01, dy01, dz01, dx20, dy20, dz20, over_area):
    """Return the polygon offset of z (GL 2.1, eq. (3.12)), in the slope form and the unit of the context."""
    di = -((dz20 * dy01 - dy20 * dz01) * over_area)
    dj = -((dx20 * dz01 - dz20 * dx01) * over_area)
    if offset.slope == MAX_SLOPE:
        slope = max(abs(di), abs(dj))
    elif offset.slope == LENGTH_SLOPE:
        slope = np.sqrt(di * di + dj * dj)
    else:
        slope = max(di, -dj if offset.downwards else dj)
    return offset.constant + slope * offset.factor


@kernel
def set_up_triangles(
    window, snapped, triangles, first, end, culled, positive_is_front, offset, first_row, corners, vertices, depth,
    front, ids,
):  # fmt: skip
    """Fill the arrays of `Setup` from `first_row` on with the triangles of [first, end) that are drawn.

    Return the row after the last one, and the sum of their areas in 1/256 pixel.
    """
    row, total_area = np.uint64(first_row), 0
    for t in range(first, end):
        v0, v1, v2 = vertices_of(triangles, t)
        facing, area = facing_and_area(snapped, v0, v1, v2, culled, positive_is_front)
        if facing < 0:
            continue
        if area < 0:
            v0, v1 = v1, v0
        corners[row, 0], corners[row, 1] = snapped[v0, 0], snapped[v0, 1]
        corners[row, 2], corners[row, 3] = snapped[v1, 0], snapped[v1, 1]
        corners[row, 4], corners[row, 5] = snapped[v2, 0], snapped[v2, 1]
        vertices[row, 0], vertices[row, 1], vertices[row, 2] = v0, v1, v2
        dx01, dy01, dx20, dy20, over_area = edge_differences(window, v0, v1, v2)
        z0, z1, z2 = window[v0, 2], window[v1, 2], window[v2, 2]
        at_origin, di, dj = plane(
            window[v0, 0], window[v0, 1], dx01 * over_area, dy01 * over_area, dx20 * over_area, dy20 * over_area,
            z0, z1, z2,
        )  # fmt: skip
        depth[row, 0], depth[row, 1], depth[row, 2] = at_origin, di, dj
        depth[row, 3] = polygon_offset(offset, dx01, dy01, z0 - z1, dx20, dy20, z2 - z0, over_area)
        front[row] = facing
        ids[row] = t
        row += np.uint64(1)
        total_area += abs(area) >> 9
    return row, total_area
