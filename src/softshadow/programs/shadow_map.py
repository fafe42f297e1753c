"""The shadow map lookup of the course, per pixel: project, compare the depth, choose the lit or the shaded colour.

Outside the light's frustum, and behind the light, a pixel counts as lit: there is no depth to compare with. The offset
is either the polygon offset of the first pass or `bias` here, not both.

References: Williams 1978, "Casting curved shadows on curved surfaces"; slides CA:577-637.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.jit import kernel
from softshadow.programs import Program, Varyings, VertexInputs
from softshadow.programs.sampling import divide, sample
from softshadow.programs.texture_coordinates import transform

ZERO, ONE = np.float32(0.0), np.float32(1.0)

VERTEX = """#version 120
uniform mat4 lightMatrix;
varying vec4 color;
varying vec4 texCoord;

void main()
{
    color = gl_Color;
    texCoord = lightMatrix * gl_Vertex;
    gl_Position = ftransform();
}
"""

FRAGMENT = """#version 120
uniform sampler2D shadowMap;
uniform vec4 ambient;
uniform float bias;
varying vec4 color;
varying vec4 texCoord;

void main()
{
    vec3 projected = texCoord.stp / texCoord.q;
    float storedDepth = texture2D(shadowMap, projected.st).r;
    bool outside = texCoord.q <= 0.0
        || projected.s < 0.0 || projected.s > 1.0 || projected.t < 0.0 || projected.t > 1.0;
    float trueDepth = projected.p;
    gl_FragColor = outside || trueDepth - bias <= storedDepth ? color : color * ambient;
}
"""


def vertex(vertices: VertexInputs) -> Varyings:
    """Return color and texCoord: the vertex in the light's texture space."""
    light_matrix = vertices.uniforms["lightMatrix"]
    values = np.concatenate([vertices.color, transform(light_matrix, vertices.position)], axis=1)
    return Varyings(values, np.zeros(8, bool))


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit or the shaded colour."""
    projected = divide(inputs[:, 4:])
    stored = np.empty((len(out), 1), out.dtype)
    sample(uniforms["shadowMap"], projected, stored)
    ambient = np.array(uniforms["ambient"], inputs.dtype)
    compare(inputs, projected, stored, ambient, inputs.dtype.type(uniforms["bias"]), out)


@kernel
def compare(inputs, projected, stored, ambient, bias, out):
    """Choose the colours of pixels with inputs (N, 8), projected coordinates (N, 3) and stored depths (N, 1)."""
    for n in range(len(inputs)):
        s, t, true_depth = projected[n, 0], projected[n, 1], projected[n, 2]
        outside = inputs[n, 7] <= ZERO or s < ZERO or s > ONE or t < ZERO or t > ONE
        lit = outside or true_depth - bias <= stored[n, 0]
        for c in range(4):
            out[n, c] = inputs[n, c] if lit else inputs[n, c] * ambient[c]


SHADOW_MAP = Program(
    "shadow-map",
    vertex,
    shade,
    uniforms={
        "lightMatrix": np.eye(4, dtype=np.float32),
        "shadowMap": 0,
        "ambient": (0.3, 0.3, 0.3, 1.0),
        "bias": 0.0,
    },
    samplers=("shadowMap",),
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT,
)
