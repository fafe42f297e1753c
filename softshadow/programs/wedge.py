"""What the edge of a penumbra wedge takes of an area light or gives back, per fragment of the wedge: an exact area.

The point comes from a texture of visible points, and the edge from a texture of edges; both are relative to the light's
centre. The edge is projected onto the light as the point sees it, clipped to the light's outline, and what lies beyond
it in the sector of its ends is the result, as a share of the light: positive where the edge hides this part from a
point outside the hard shadow, negative where a point inside sees it. A segment has a length in place of an area.
`scene.light_coverage` is the same in float64, and says why the sum over all edges is the covered part of the light.

One program per shape: "wedge-rectangle", "wedge-disc", "wedge-sphere" and "wedge-segment". "wedge-visibility" is the
last pass: 1 less what is covered, from 0 to 1, and 0 outside the cone of a spot light.

References: Assarsson & Akenine-Möller 2003, "A geometry-based soft shadow volume algorithm using graphics hardware";
Abramowitz & Stegun 1964, 4.4.49 (arctangent).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.programs.program import Program
from softshadow.programs.wedge_glsl import (
    FLAT_FRAME,
    FRAGMENT,
    ROUND_OUTLINE,
    SEGMENT_FRAME,
    SHARE_OF_AREA,
    SHARE_OF_SEGMENT,
    SPHERE_FRAME,
    SQUARE_OUTLINE,
    VISIBILITY_FRAGMENT,
)
from softshadow.programs.window_lookup import VERTEX, at_window_place, edge_ends, triple, vertex

ZERO, HALF, ONE, TWO, FOUR, SIX, EIGHT = (np.float32(c) for c in (0, 0.5, 1, 2, 4, 6, 8))
QUARTER_TURN, HALF_TURN, PER_TURN = (np.float32(c) for c in (np.pi / 2, np.pi, 0.5 / np.pi))
SMALLEST, STEEP = np.float32(1e-30), np.float32(0.6)
EMPTY = TWO  # begin of a part that is empty
# arctangent from 0 to 1: coefficients of x^3, x^5, ..., error below 2e-8
A3, A5, A7, A9, A11, A13, A15, A17 = (
    np.float32(c)
    for c in (
        -0.3333314528, 0.1999355085, -0.1420889944, 0.1065626393, -0.0752896400, 0.0429096138, -0.0161657367,
        0.0028662257,
    )
)  # fmt: skip

RECTANGLE, DISC, SPHERE, SEGMENT = range(4)


def shade_shape(kind: int) -> Callable[[np.ndarray, Mapping[str, Any], np.ndarray], None]:
    """Return a fragment stage that fills `out` (N, 4): share taken, share given back, 1 if any, difference."""

    def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
        real = inputs.dtype.type
        light = np.array([uniforms["axisU"], uniforms["axisV"], uniforms["normal"]], inputs.dtype)
        points = at_window_place(uniforms["positions"], inputs)
        starts, ends = edge_ends(inputs, uniforms)
        view = np.empty((4, 3), out.dtype)
        add_shares(kind, light, real(uniforms["radius"]), points.T, starts.T, ends.T, view, out.T)

    return shade


@kernel
def add_shares(kind, light, radius, points, starts, ends, view, out):
    """Write the results to `out` (4, N) for points, starts and ends of edges (4, N); `view` (4, 3) is scratch."""
    for n in range(points.shape[1]):
        point = (points[0, n], points[1, n], points[2, n])
        share, meets = ZERO, False
        if points[3, n] > ZERO:
            set_view(kind, light, radius, point, view)
            start = (starts[0, n], starts[1, n], starts[2, n])
            end = (ends[0, n], ends[1, n], ends[2, n])
            share, meets = share_beyond(kind, view, point, start, end)
        inside = triple(starts, ends, points, n) < ZERO
        out[0, n] = ZERO if inside else share
        out[1, n] = share if inside else ZERO
        out[2, n] = ONE if meets else ZERO
        out[3, n] = -share if inside else share


@inlined
def along(a, b):
    """Return the product of two vectors, summed from x to z."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def set_view(kind, light, radius, point, view):
    """Write how the point sees the light: u, v and normal, and the height in the last row; see `LightView`."""
    u, v, normal = view[0], view[1], view[2]
    if kind <= DISC:
        height = along(light[2], point)
        for axis in range(3):
            u[axis], v[axis] = light[0, axis], light[1, axis]
            normal[axis] = -light[2, axis] if height < ZERO else light[2, axis]
        view[3, 0] = -height if height < ZERO else height
        return
    if kind == SPHERE:
        squared = along(point, point)
        height = np.sqrt(squared)
        n = (point[0] / height, point[1] / height, point[2] / height)
        outline = squared - radius * radius
        scale = np.sqrt(outline if outline > ZERO else ZERO) / (radius * height)
        c = (ZERO, -n[2], n[1]) if abs(n[0]) < STEEP else (n[2], ZERO, -n[0])
        scale /= np.sqrt(along(c, c))
        u[0], u[1], u[2] = c[0] * scale, c[1] * scale, c[2] * scale
        v[0], v[1], v[2] = n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]
        normal[0], normal[1], normal[2] = n[0], n[1], n[2]
        view[3, 0] = height if outline > ZERO else ZERO
        return
    share = along(light[0], point) / along(light[0], light[0])
    x, y, z = point[0] - share * light[0, 0], point[1] - share * light[0, 1], point[2] - share * light[0, 2]
    height = np.sqrt(x * x + y * y + z * z)
    normal[0], normal[1], normal[2] = x / height, y / height, z / height
    for axis in range(3):
        u[axis] = light[0, axis]
    v[0] = normal[1] * u[2] - normal[2] * u[1]
    v[1] = normal[2] * u[0] - normal[0] * u[2]
    v[2] = normal[0] * u[1] - normal[1] * u[0]
    view[3, 0] = height


@kernel
def share_beyond(kind, view, point, start, end):
    """Return the share of the light beyond an edge in its sector, and whether the edge's image meets the light."""
    u, v, normal, height = view[0], view[1], view[2], view[3, 0]
    if not height > ZERO:
        return ZERO, False
    x0, x1 = along(normal, start), along(normal, end)
    w0, w1 = height - x0, height - x1
    point_u, point_v = along(u, point), along(v, point)
    u0, u1 = along(u, start) * height - point_u * x0, along(u, end) * height - point_u * x1
    v0, v1 = along(v, start) * height - point_v * x0, along(v, end) * height - point_v * x1
    if kind == SEGMENT:
        return share_of_segment(u0, v0, w0, x0, u1, v1, w1, x1)
    first, last = clip(x0, x1, ZERO, ONE)
    first, last = clip(w0 - u0, w1 - u1, first, last)
    first, last = clip(w0 + u0, w1 + u1, first, last)
    if not first < last:
        return ZERO, False
    first, last = clip(w0 - v0, w1 - v1, first, last)
    first, last = clip(w0 + v0, w1 + v1, first, last)
    pw = w0 + first * (w1 - w0)
    qw = w0 + last * (w1 - w0) if last < ONE else w1
    if not (first < last and pw > ZERO and qw > ZERO):
        return ZERO, False
    pu, pv = (u0 + first * (u1 - u0)) / pw, (v0 + first * (v1 - v0)) / pw
    qu = (u0 + last * (u1 - u0) if last < ONE else u1) / qw
    qv = (v0 + last * (v1 - v0) if last < ONE else v1) / qw
    if kind in (DISC, SPHERE):
        share, meets = share_of_disc(pu, pv, qu, qv)
    else:
        share, meets = share_of_square(pu, pv, qu, qv), True
    return (share if meets and share > ZERO else ZERO), meets


@inlined
def clip(start, end, first, last):
    """Return the part of an edge, within first to last, where a linear function from start to end is not negative."""
    zero = start / (start - end)
    if start < ZERO:
        first = EMPTY if end < ZERO else (zero if zero > first else first)
    if end < ZERO:
        last = zero if zero < last else last
    return first, last


@kernel
def share_of_segment(u0, v0, w0, x0, u1, v1, w1, x1):
    """Return the share of the segment v = 0, -1 < u < 1, beyond an edge, and whether the edge crosses it."""
    near0, near1 = abs(v1), abs(v0)  # where the edge crosses v = 0 is the mean of its ends with these weights
    u, w, height = abs(near0 * u0 + near1 * u1), near0 * w0 + near1 * w1, near0 * x0 + near1 * x1
    if (v0 < ZERO) == (v1 < ZERO) or height < ZERO or not u < w:
        return ZERO, False
    return HALF - HALF * (u / w), True


@kernel
def share_of_square(pu, pv, qu, qv):
    """Return the share of the square from -1 to 1 beyond the segment from p to q in its sector."""
    between = abs(square_angle(pu, pv) - square_angle(qu, qv))
    sector = EIGHT - between if between > FOUR else between
    return (sector - abs(pu * qv - pv * qu)) / EIGHT


@kernel
def square_angle(x, y):
    """Return the length, from -1 to 7, along the square's outline to the direction of a point."""
    if abs(x) < abs(y):
        return (SIX if y < ZERO else TWO) - x / y
    return ZERO if x == ZERO else (FOUR if x < ZERO else ZERO) + y / x


@kernel
def share_of_disc(pu, pv, qu, qv):
    """Return the share of the unit disc beyond the segment from p to q in its sector, and whether they meet."""
    du, dv = qu - pu, qv - pv
    squared = du * du + dv * dv
    middle = -(pu * du + pv * dv) / squared
    radicand = middle * middle - ((pu * pu - ONE) + pv * pv) / squared
    if not radicand > ZERO:
        return ZERO, False
    root = np.sqrt(radicand)
    first = middle - root if middle - root > ZERO else ZERO
    last = middle + root
    if not first < (last if last < ONE else ONE):
        return ZERO, False
    ru, rv = pu + first * du, pv + first * dv
    su, sv = pu + last * du if last < ONE else qu, pv + last * dv if last < ONE else qv
    triangle = abs(ru * sv - rv * su)
    return (angle(triangle, ru * su + rv * sv) - triangle) * PER_TURN, True


@kernel
def angle(sine, cosine):
    """Return the angle from 0 to half a turn with this sine and cosine, both times the same number; sine >= 0."""
    size = abs(cosine)
    larger = sine if sine > size else size
    x = (size if sine > size else sine) / (larger if larger > SMALLEST else SMALLEST)
    y = x * x
    total = ((((((A17 * y + A15) * y + A13) * y + A11) * y + A9) * y + A7) * y + A5) * y + A3
    turn = x + x * (y * total)
    turn = QUARTER_TURN - turn if sine > size else turn
    return HALF_TURN - turn if cosine < ZERO else turn


def shade_visibility(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the visible share of the light."""
    covered = at_window_place(uniforms["coverage"], inputs)
    visible = np.clip(inputs.dtype.type(1) - covered[:, 3], 0, 1)
    squared = inputs.dtype.type(uniforms["squared"])
    if squared >= 0:
        x, y, z = inputs[:, 3:6].T
        a, b, c = np.array(uniforms["axis"], inputs.dtype)
        forward = x * a + y * b + z * c
        visible[(forward < 0) | (forward * forward < squared * (x * x + y * y + z * z))] = 0
    out[:] = visible[:, None]


def _program(shape: str, kind: int, frame: str, outline: str, share: str = SHARE_OF_AREA) -> Program:
    origin = (0.0, 0.0, 0.0)
    return Program(
        f"wedge-{shape}",
        vertex,
        shade_shape(kind),
        uniforms={
            "positions": 0, "edges": 1, "edgeRow": 0.5, "axisU": origin, "axisV": origin, "normal": origin,
            "radius": 1.0,
        },
        samplers=("positions", "edges"),
        glsl_vertex=VERTEX,
        glsl_fragment=FRAGMENT.replace("OUTLINE", outline.strip())
        .replace("FRAME", frame.strip())
        .replace("SHARE", share.strip()),
    )  # fmt: skip


WEDGE_RECTANGLE = _program("rectangle", RECTANGLE, FLAT_FRAME, SQUARE_OUTLINE)
WEDGE_DISC = _program("disc", DISC, FLAT_FRAME, ROUND_OUTLINE)
WEDGE_SPHERE = _program("sphere", SPHERE, SPHERE_FRAME, ROUND_OUTLINE)
WEDGE_SEGMENT = _program("segment", SEGMENT, SEGMENT_FRAME, "", SHARE_OF_SEGMENT)
WEDGE_VISIBILITY = Program(
    "wedge-visibility",
    vertex,
    shade_visibility,
    uniforms={"coverage": 0, "axis": (0.0, 0.0, 0.0), "squared": -1.0},
    samplers=("coverage",),
    glsl_vertex=VERTEX,
    glsl_fragment=VISIBILITY_FRAGMENT,
)
