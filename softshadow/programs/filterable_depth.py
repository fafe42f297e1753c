"""Maps that may be filtered: what a light's camera writes as colours in place of depths, and their blur.

The texture coordinates of all these programs are those of the map, with a depth in r that is linear from 0 at the near
plane to 1 at the far plane. "depth-moments" writes this depth and its square, "depth-exponential" a power of two that
grows with it. "box-blur" averages the texels of a row or a column around each texel.

References: Donnelly & Lauritzen 2006, "Variance shadow maps"; Annen et al. 2008, "Exponential shadow maps".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.programs.fog import exp2
from softshadow.programs.map_visibility import VERTEX, vertex
from softshadow.programs.program import Program
from softshadow.programs.sampling import sample

MOMENTS = """#version 120
varying vec4 texCoord;

void main()
{
    gl_FragColor = vec4(texCoord.p, texCoord.p * texCoord.p, 0.0, 1.0);
}
"""

EXPONENTIAL = """#version 120
uniform float steepness;
varying vec4 texCoord;

void main()
{
    gl_FragColor = vec4(exp2(steepness * texCoord.p), 0.0, 0.0, 1.0);
}
"""

BLUR = """#version 120
uniform sampler2D source;
uniform int radius;
uniform float stepS;  // from texel to texel: 1 / side along the row, or along the column
uniform float stepT;
varying vec4 texCoord;

void main()
{
    vec4 sum = vec4(0.0);
    for (int i = -radius; i <= radius; i++)
        sum += texture2D(source, texCoord.st + float(i) * vec2(stepS, stepT));
    gl_FragColor = sum / float(2 * radius + 1);
}
"""


def shade_moments(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with depth and squared depth."""
    depth = inputs[:, 2]
    out[:, 0], out[:, 1], out[:, 2], out[:, 3] = depth, depth * depth, 0, 1


def shade_exponential(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with two to the power of the depth times the steepness."""
    out[:, 0], out[:, 1], out[:, 2], out[:, 3] = exp2(inputs.dtype.type(uniforms["steepness"]) * inputs[:, 2]), 0, 0, 1


def shade_blur(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the mean of the texels around each place, on one axis."""
    real, radius = inputs.dtype.type, uniforms["radius"]
    place = np.zeros((len(inputs), 3), inputs.dtype, order="F")
    texels = np.empty((len(inputs), 4), inputs.dtype, order="F")
    out[:] = 0
    for i in range(-radius, radius + 1):
        place[:, 0] = inputs[:, 0] + real(i) * real(uniforms["stepS"])
        place[:, 1] = inputs[:, 1] + real(i) * real(uniforms["stepT"])
        sample(uniforms["source"], place, texels)
        out += texels
    out /= real(2 * radius + 1)


DEPTH_MOMENTS = Program("depth-moments", vertex, shade_moments, glsl_vertex=VERTEX, glsl_fragment=MOMENTS)
DEPTH_EXPONENTIAL = Program(
    "depth-exponential",
    vertex,
    shade_exponential,
    uniforms={"steepness": 1.0},
    glsl_vertex=VERTEX,
    glsl_fragment=EXPONENTIAL,
)
BOX_BLUR = Program(
    "box-blur",
    vertex,
    shade_blur,
    uniforms={"source": 0, "radius": 0, "stepS": 0.0, "stepT": 0.0},
    samplers=("source",),
    glsl_vertex=VERTEX,
    glsl_fragment=BLUR,
)
