"""The shaders of CA:577-637 as a program: like the program "shadow-map", without its test for the light's frustum.

Its GLSL is the slide's, in the spelling of version 1.20, with the two colours that the slide leaves open.
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
    """Fill `out` (N, 4) with the lit or the shaded colour."""
    projected = project(inputs[:, 4:])
    stored = np.empty_like(out)
    sample(uniforms["shadowMap"], projected, stored)
    lit = projected[:, 2] - inputs.dtype.type(uniforms["bias"]) <= stored[:, 0]
    out[:] = np.where(lit[:, None], inputs[:, :4], inputs[:, :4] * np.array(uniforms["ambient"], inputs.dtype))


# registered where the listings are imported: here, and in the process that Mesa runs in
register(
    Program(
        NAME, SHADOW_MAP.vertex, shade, SHADOW_MAP.uniforms, SHADOW_MAP.samplers,
        glsl_vertex=SHADOW_MAP.glsl_vertex, glsl_fragment=FRAGMENT,
    )
)  # fmt: skip
