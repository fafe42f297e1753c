"""Visibility of a light by a shadow map whose shadow edges follow a piecewise linear silhouette.

Four adjacent texel centres of the shadow map are the corners of a cell. Each cell has one point: the point stored in
the silhouette map, or the middle of the cell. Lines from this point to the points of the four neighbouring cells cut
the cell into four quarters with one corner each, and the depth comparison at the corner holds for its whole quarter. If
all four comparisons agree, the cell is not cut.

The quarters never overlap: each neighbour's point lies on its own side of the cell, so the directions to the four
points keep their order.

References: Sen, Cammarano & Hanrahan 2003, "Shadow silhouette maps".
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from softshadow.programs.map_visibility import VERTEX, vertex
from softshadow.programs.program import Program
from softshadow.programs.reads import note_depths
from softshadow.programs.sampling import divide, sample
from softshadow.texture import Texture

FRAGMENT = """#version 120
uniform sampler2D shadowMap;
uniform sampler2D silhouetteMap;  // s and t of the point in its cell; whether one is stored
uniform float side;               // of both, in texels
uniform float bias;
uniform float behind;
uniform float cone;
varying vec4 texCoord;

float cross2(vec2 u, vec2 v)
{
    return u.x * v.y - u.y * v.x;
}

bool between(vec2 from, vec2 to, vec2 way)  // counter-clockwise
{
    bool after = cross2(from, way) >= 0.0;
    bool before = cross2(way, to) >= 0.0;
    return cross2(from, to) >= 0.0 ? after && before : after || before;
}

void main()
{
    vec3 projected = texCoord.stp / texCoord.q;
    float depth = min(projected.p - bias, 1.0);
    float texel = 1.0 / side;
    vec2 place = projected.st * side - 0.5;
    vec2 cell = floor(place);
    vec2 low = (cell + 0.5) * texel;
    vec2 high = (cell + 1.5) * texel;
    float lit0 = depth <= texture2D(shadowMap, low).r ? 1.0 : 0.0;
    float lit1 = depth <= texture2D(shadowMap, vec2(high.s, low.t)).r ? 1.0 : 0.0;
    float lit2 = depth <= texture2D(shadowMap, vec2(low.s, high.t)).r ? 1.0 : 0.0;
    float lit3 = depth <= texture2D(shadowMap, high).r ? 1.0 : 0.0;
    float corners = lit0 + lit1 + lit2 + lit3;

    vec3 own = texture2D(silhouetteMap, low).rgb;
    vec2 right = texture2D(silhouetteMap, vec2(high.s, low.t)).rg + vec2(1.0, 0.0) - own.st;
    vec2 above = texture2D(silhouetteMap, vec2(low.s, high.t)).rg + vec2(0.0, 1.0) - own.st;
    vec2 left = texture2D(silhouetteMap, vec2((cell.s - 0.5) * texel, low.t)).rg - vec2(1.0, 0.0) - own.st;
    vec2 below = texture2D(silhouetteMap, vec2(low.s, (cell.t - 0.5) * texel)).rg - vec2(0.0, 1.0) - own.st;
    vec2 way = place - cell - own.st;
    float quarter = 1.0;
    if (between(right, above, way)) quarter = 3.0;
    else if (between(above, left, way)) quarter = 2.0;
    else if (between(left, below, way)) quarter = 0.0;

    bool same = corners == 0.0 || corners == 4.0;
    float visible = same || quarter == 0.0 ? lit0 : (quarter == 1.0 ? lit1 : (quarter == 2.0 ? lit2 : lit3));
    vec2 off = projected.st - 0.5;
    if (off.s * off.s + off.t * off.t > cone)
        visible = 0.0;
    bool before = texCoord.q > 0.0;
    gl_FragColor = vec4(
        before && !same ? quarter : 4.0, before && !same && own.p == 0.0 ? 1.0 : 0.0, 0.0, before ? visible : behind);
}
"""

NO_QUARTER = 4.0


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4): quarter 0 to 3, or 4 for none; 1 if a cut cell stores no point; 0; the visibility."""
    real = inputs.dtype.type
    with np.errstate(all="ignore"):  # q = 0 gives infinities, as in GL
        projected = divide(inputs)
        depth = np.minimum(projected[:, 2] - real(uniforms["bias"]), real(1))
        note_depths(uniforms["shadowMap"], depth, uniforms["bias"])
        side = real(uniforms["side"])
        place = projected[:, :2] * side - real(0.5)
        cell = np.floor(place)
        lit = np.array([depth <= look_up_texels(uniforms["shadowMap"], cell, side, *at)[:, 0] for at in CORNERS])
        own, *beside = (look_up_texels(uniforms["silhouetteMap"], cell, side, *at) for at in ((0, 0), *BESIDE))
        ways = [
            point[:, :2] + np.array(at, inputs.dtype) - own[:, :2] for point, at in zip(beside, BESIDE, strict=True)
        ]
        quarter = quarters(ways, place - cell - own[:, :2])
        off = projected[:, :2] - real(0.5)
        in_cone = ~(off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1] > real(uniforms["cone"]))
    same, before = (lit == lit[0]).all(axis=0), inputs[:, 3] > 0
    visible = np.where(same, lit[0], np.take_along_axis(lit, quarter[None], axis=0)[0]) & in_cone
    cut = before & ~same
    out[:, 0] = np.where(cut, quarter, NO_QUARTER)
    out[:, 1] = cut & (own[:, 2] == 0)
    out[:, 2] = 0
    out[:, 3] = np.where(before, visible, real(uniforms["behind"]))


CORNERS = ((0, 0), (1, 0), (0, 1), (1, 1))
BESIDE = ((1, 0), (0, 1), (-1, 0), (0, -1))


def look_up_texels(texture: Texture, cell: np.ndarray, side: Any, i: int, j: int) -> np.ndarray:
    """Return RGB (N, 3) of the texels i columns to the right of and j rows above the cells' own."""
    real = cell.dtype.type
    coordinates = np.zeros((len(cell), 3), cell.dtype)
    coordinates[:, :2] = (cell + np.array([i + 0.5, j + 0.5], cell.dtype)) * (real(1) / side)
    texels = np.empty((4, len(cell)), cell.dtype).T  # stored column by column, as `sample` expects
    sample(texture, coordinates, texels)
    return texels[:, :3]


def quarters(beside: Sequence[np.ndarray], way: np.ndarray) -> np.ndarray:
    """Return the quarter (N,) that a direction from the cell's point leads into, by its corner in `CORNERS`.

    Parameters
    ----------
    beside : four (N, 2)         the directions to the points of the cells in `BESIDE`
    way : (N, 2)                 the direction
    """
    right, above, left, below = beside
    quarter = np.ones(len(way), np.int64)
    quarter[between(left, below, way)] = 0
    quarter[between(above, left, way)] = 2
    quarter[between(right, above, way)] = 3
    return quarter


def between(start: np.ndarray, end: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Return whether a direction lies between two others, counter-clockwise from the first to the second."""
    after, before = cross(start, way) >= 0, cross(way, end) >= 0
    inside: np.ndarray = np.where(cross(start, end) >= 0, after & before, after | before)
    return inside


def cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Return the cross products of vectors (N, 2): twice the signed areas of triangles."""
    product: np.ndarray = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    return product


SILHOUETTE_VISIBILITY = Program(
    "silhouette-visibility",
    vertex,
    shade,
    uniforms={"shadowMap": 0, "silhouetteMap": 1, "side": 1.0, "bias": 0.0, "behind": 1.0, "cone": float("inf")},
    samplers=("shadowMap", "silhouetteMap"),
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT,
)
