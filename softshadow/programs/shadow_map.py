"""The course's shadow map lookup per pixel: project, compare the depth, and take the lit or the shadowed colour.

`lightMatrix` takes world space into the map. An object that a model matrix places needs this matrix as `modelMatrix`.
By default it is the identity, for vertices in world space. The slide leaves it out (E66).

Outside the light's frustum and behind the light a pixel is lit, because there is no depth to compare with. The depth
offset is either the polygon offset of the first pass or `bias` here, not both.

References: Williams 1978, "Casting curved shadows on curved surfaces"; slides CA:577-637.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.jit import allocating_kernel
from softshadow.programs.program import Program, Varyings, VertexInputs
from softshadow.programs.reads import note_depths
from softshadow.programs.sampling import divide, sample
from softshadow.programs.texture_coordinates import transform

ZERO, ONE = np.float32(0.0), np.float32(1.0)

VERTEX = """#version 120
uniform mat4 lightMatrix;
uniform mat4 modelMatrix = mat4(1.0);
varying vec4 color;
varying vec4 texCoord;

void main()
{
    color = gl_Color;
    texCoord = lightMatrix * (modelMatrix * gl_Vertex);
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
    values = np.concatenate([vertices.color, in_map(vertices)], axis=1)
    return Varyings(values, np.zeros(8, bool))


def in_map(vertices: VertexInputs) -> np.ndarray:
    """Return the vertices (V, 4) in the light's texture space: to world space by the model matrix, then on."""
    world = transform(vertices.uniforms["modelMatrix"], vertices.position)
    return transform(vertices.uniforms["lightMatrix"], world)


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit or the shadowed colours."""
    projected = divide(inputs[:, 4:])
    stored = np.empty((len(out), 1), out.dtype)
    ambient, bias = np.array(uniforms["ambient"], inputs.dtype), inputs.dtype.type(uniforms["bias"])
    note_depths(uniforms["shadowMap"], projected[:, 2] - bias, bias)
    sample(uniforms["shadowMap"], projected, stored)
    compare(np.ascontiguousarray(inputs.T), projected.T, stored[:, 0], ambient, bias, out.T)


@allocating_kernel
def compare(inputs, projected, stored, ambient, bias, out):
    """Write the lit or shadowed colours to `out` (4, N) from inputs (8, N), projected (3, N) and stored depths (N,)."""
    lit = np.empty(len(stored), np.bool_)
    for n in range(len(stored)):
        s, t, true_depth = projected[0, n], projected[1, n], projected[2, n]
        outside = (inputs[7, n] <= ZERO) | (s < ZERO) | (s > ONE) | (t < ZERO) | (t > ONE)
        lit[n] = outside | (true_depth - bias <= stored[n])
    for c in range(4):
        in_shadow = ambient[c]
        for n in range(len(stored)):
            out[c, n] = inputs[c, n] if lit[n] else inputs[c, n] * in_shadow


SHADOW_MAP = Program(
    "shadow-map",
    vertex,
    shade,
    uniforms={
        "lightMatrix": np.eye(4, dtype=np.float32),
        "modelMatrix": np.eye(4, dtype=np.float32),
        "shadowMap": 0,
        "ambient": (0.3, 0.3, 0.3, 1.0),
        "bias": 0.0,
    },
    samplers=("shadowMap",),
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT,
)
