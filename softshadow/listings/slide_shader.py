"""The shaders of CA:577-637 as a program: the program "shadow-map" without its test of the light's frustum.

The GLSL is the slide's, written for version 1.20, with the two colours that the slide leaves out.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.programs import Program, register
from softshadow.programs.sampling import project, sample
from softshadow.programs.shadow_map import SHADOW_MAP

NAME = "slide-shadow-map"
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
        NAME, SHADOW_MAP.vertex, shade, SHADOW_MAP.uniforms, SHADOW_MAP.samplers,
        glsl_vertex=SHADOW_MAP.glsl_vertex, glsl_fragment=FRAGMENT,
    )
)  # fmt: skip
