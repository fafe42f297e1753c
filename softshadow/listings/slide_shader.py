"""The shaders of CA:577-637 as a program: "shadow-map" without its test of the light's frustum and its model matrix.

The GLSL is the slide's, written for version 1.20, with the two colours that the slide leaves out.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.programs import Program, Varyings, VertexInputs, register
from softshadow.programs.sampling import project, sample
from softshadow.programs.shadow_map import SHADOW_MAP
from softshadow.programs.texture_coordinates import transform

NAME = "slide-shadow-map"
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
    vec2 st = texCoord.st / texCoord.q;
    float trueDepth = texCoord.p / texCoord.q;
    float storedDepth = texture2D(shadowMap, st).r;
    if (trueDepth - bias <= storedDepth)
        gl_FragColor = color;
    else
        gl_FragColor = color * ambient;
}
"""


def vertex(vertices: VertexInputs) -> Varyings:
    """Return color and texCoord; E66: the slide has no model matrix, so vertices have to be in world space."""
    in_map = transform(vertices.uniforms["lightMatrix"], vertices.position)
    return Varyings(np.concatenate([vertices.color, in_map], axis=1), np.zeros(8, bool))


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Write the colour in light or in shadow into `out` (N, 4)."""
    projected = project(inputs[:, 4:])
    stored = np.empty_like(out)
    sample(uniforms["shadowMap"], projected, stored)
    lit = projected[:, 2] - inputs.dtype.type(uniforms["bias"]) <= stored[:, 0]
    out[:] = np.where(lit[:, None], inputs[:, :4], inputs[:, :4] * np.array(uniforms["ambient"], inputs.dtype))


# registered on import of the listings: in this process, and in the one that Mesa runs in
register(
    Program(
        NAME, vertex, shade, {name: value for name, value in SHADOW_MAP.uniforms.items() if name != "modelMatrix"},
        SHADOW_MAP.samplers, glsl_vertex=VERTEX, glsl_fragment=FRAGMENT,
    )
)  # fmt: skip
