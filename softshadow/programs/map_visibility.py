"""Visibility of a light by its shadow map: the share of depth comparisons that are lit, written as a colour.

"map-visibility" compares the (2 radius + 1)² texels around the pixel's map position, all with equal weight.
"map-visibility-bilinear" centers a square of that size on the exact position and weights each texel by the part of it
inside the square, so the visibility changes continuously; with radius 0 these are the four texels and weights of
GL_LINEAR. Depths are never averaged, only the results of comparisons (E46).

References: Reeves, Salesin & Cook 1987, "Rendering antialiased shadows with depth maps".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from softshadow.programs.percentage_closer import count_lit
from softshadow.programs.program import Program, Varyings, VertexInputs
from softshadow.programs.reads import note_depths, note_weights
from softshadow.programs.sampling import divide, sample
from softshadow.programs.texture_coordinates import transform
from softshadow.texture import Texture

VERTEX = """#version 120
varying vec4 texCoord;

void main()
{
    texCoord = gl_TextureMatrix[0] * gl_MultiTexCoord0;
    gl_Position = ftransform();
}
"""

FRAGMENT = """#version 120
uniform sampler2D shadowMap;
uniform float side;    // of the map, in texels
uniform int radius;
uniform float bias;
uniform float behind;  // visibility behind the light
uniform float cone;    // squared radius of a spot light's disc in the map
varying vec4 texCoord;

float share(vec2 place, float depth)
{
    SHARE
}

void main()
{
    vec3 projected = texCoord.stp / texCoord.q;
    float visible = share(projected.st, min(projected.p - bias, 1.0));  // beyond the far plane as on it
    vec2 off = projected.st - 0.5;
    if (off.s * off.s + off.t * off.t > cone)
        visible = 0.0;
    gl_FragColor = vec4(texCoord.q > 0.0 ? visible : behind);
}
"""

BOX = """
    float texel = 1.0 / side;
    float lit = 0.0;
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++)
            lit += depth <= texture2D(shadowMap, place + vec2(i, j) * texel).r ? 1.0 : 0.0;
    float width = float(2 * radius + 1);
    return lit / (width * width);"""

BILINEAR = """
    float texel = 1.0 / side;
    vec2 centers = place * side - 0.5;
    vec2 first = floor(centers);
    vec2 part = centers - first;
    int width = 2 * radius + 1;
    float lit = 0.0;
    for (int j = 0; j <= width; j++) {
        float row = 0.0;
        for (int i = 0; i <= width; i++) {
            vec2 center = (first + vec2(i - radius, j - radius) + 0.5) * texel;
            float weight = i == 0 ? 1.0 - part.s : (i == width ? part.s : 1.0);
            row += depth <= texture2D(shadowMap, center).r ? weight : 0.0;
        }
        lit += (j == 0 ? 1.0 - part.t : (j == width ? part.t : 1.0)) * row;
    }
    return lit / float(width * width);"""

Share = Callable[[Texture, np.ndarray, np.ndarray, int, Any], np.ndarray]


def vertex(vertices: VertexInputs) -> Varyings:
    """Return texCoord: the texture coordinates of unit 0, transformed by its texture matrix."""
    values = transform(vertices.texture_matrices[0], vertices.texcoords[0])
    return Varyings(values, np.zeros(4, bool))


def visibility_by(share: Share) -> Callable[[np.ndarray, Mapping[str, Any], np.ndarray], None]:
    """Return a fragment stage that fills `out` (N, 4) with the share of lit comparisons."""

    def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
        out[:] = visibility_in(uniforms["shadowMap"], share, inputs, uniforms)[:, None]

    return shade


def visibility_in(texture: Texture, share: Share, inputs: np.ndarray, uniforms: Mapping[str, Any]) -> np.ndarray:
    """Return the visibility (N,) of places (N, 4) in a map."""
    real = inputs.dtype.type
    with np.errstate(all="ignore"):  # q = 0 gives infinities, as in GL
        projected = divide(inputs)
        depth = np.minimum(projected[:, 2] - real(uniforms["bias"]), real(1))
        note_depths(texture, depth, uniforms["bias"])
        visible = share(texture, projected, depth, uniforms["radius"], real(uniforms["side"]))
        off = projected[:, :2] - real(0.5)
        visible[off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1] > real(uniforms["cone"])] = 0
    return np.where(inputs[:, 3] > 0, visible, real(uniforms["behind"]))


def box_share(texture: Texture, projected: np.ndarray, depth: np.ndarray, radius: int, side: Any) -> np.ndarray:
    """Return the share (N,) of lit texels, all with equal weight."""
    real = projected.dtype.type
    lit = count_lit(texture, projected, depth, radius, real(1) / side)
    lit /= real((2 * radius + 1) ** 2)
    return lit


def bilinear_share(texture: Texture, projected: np.ndarray, depth: np.ndarray, radius: int, side: Any) -> np.ndarray:
    """Return the share (N,) of lit texels, each weighted by its part inside the square around the position."""
    real, width = projected.dtype.type, 2 * radius + 1
    centers = projected[:, :2] * side - real(0.5)
    first = np.floor(centers)
    part = centers - first
    place, stored = projected.copy(), np.empty((len(projected), 1), projected.dtype)
    lit = np.zeros(len(projected), projected.dtype)
    weights = np.ones((width + 1, len(projected), 2), projected.dtype)
    weights[0], weights[width] = real(1) - part, part
    for j in range(width + 1):
        row = np.zeros_like(lit)
        for i in range(width + 1):
            at = np.array([i - radius, j - radius], projected.dtype)
            place[:, :2] = (first + at + real(0.5)) * (real(1) / side)
            note_weights(texture, weights[i, :, 0], weights[j, :, 1])
            sample(texture, place, stored)
            row += np.where(depth <= stored[:, 0], weights[i, :, 0], real(0))
        lit += weights[j, :, 1] * row
    lit /= real(width * width)
    return lit


def _program(name: str, share: Share, body: str) -> Program:
    return Program(
        name,
        vertex,
        visibility_by(share),
        uniforms={"shadowMap": 0, "side": 1.0, "radius": 0, "bias": 0.0, "behind": 1.0, "cone": float("inf")},
        samplers=("shadowMap",),
        glsl_vertex=VERTEX,
        glsl_fragment=FRAGMENT.replace("SHARE", body.strip()),
    )


MAP_VISIBILITY = _program("map-visibility", box_share, BOX)
MAP_VISIBILITY_BILINEAR = _program("map-visibility-bilinear", bilinear_share, BILINEAR)
