"""Blinn-Phong lighting per pixel with a shadow map: one comparison, or the mean of 5x5 (percentage-closer filtering).

The map is a depth texture sampled without GL's own comparison, with equal minification and magnification filters.
Pixels in shadow keep their ambient light.

References: Williams 1978, "Casting curved shadows on curved surfaces"; Reeves, Salesin & Cook 1987, "Rendering
antialiased shadows with depth maps".
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.programs.blinn_phong import BLINN_PHONG, shade_visible
from softshadow.programs.blinn_phong import vertex as blinn_phong_vertex
from softshadow.programs.percentage_closer import count_lit
from softshadow.programs.program import Program, Varyings, VertexInputs
from softshadow.programs.reads import note_depths
from softshadow.programs.sampling import divide
from softshadow.programs.shadow_map import in_map

VERTEX = """#version 120
uniform mat4 lightMatrix;
uniform mat4 modelMatrix = mat4(1.0);
varying vec4 color;
varying vec3 eyePosition;
varying vec3 normal;
varying vec4 texCoord;

void main()
{
    color = gl_Color;
    eyePosition = (gl_ModelViewMatrix * gl_Vertex).xyz;
    normal = gl_NormalMatrix * gl_Normal;
    texCoord = lightMatrix * (modelMatrix * gl_Vertex);
    gl_Position = ftransform();
}
"""

FRAGMENT = """#version 120
uniform vec4 lightPosition;  // eye space; w = 0: a direction towards the light
uniform vec3 ambient;
uniform vec3 diffuse;
uniform vec3 specular;
uniform float shininess;
uniform sampler2D shadowMap;
uniform float texel;  // 1 / the side of the map
uniform float bias;
varying vec4 color;
varying vec3 eyePosition;
varying vec3 normal;
varying vec4 texCoord;

void main()
{
    vec3 n = normalize(normal);
    vec3 towardsLight = normalize(lightPosition.xyz - lightPosition.w * eyePosition);
    vec3 halfway = normalize(towardsLight - normalize(eyePosition));
    float facing = max(dot(n, towardsLight), 0.0);
    float highlight = facing > 0.0 ? pow(max(dot(n, halfway), 0.0), shininess) : 0.0;

    vec3 projected = texCoord.stp / texCoord.q;
    float trueDepth = projected.p - bias;
    float lit = 0.0;
    for (int j = -RADIUS; j <= RADIUS; j++)
        for (int i = -RADIUS; i <= RADIUS; i++)
            lit += trueDepth <= texture2D(shadowMap, projected.st + vec2(i, j) * texel).r ? 1.0 : 0.0;
    float visible = lit * SHARE;
    gl_FragColor = vec4(
        color.rgb * (ambient + (visible * facing) * diffuse) + (visible * highlight) * specular, color.a);
}
"""


def vertex(vertices: VertexInputs) -> Varyings:
    """Return color, eyePosition, normal and texCoord: the vertex in the light's texture space."""
    lighting = blinn_phong_vertex(vertices).values
    return Varyings(np.concatenate([lighting, in_map(vertices)], axis=1), np.zeros(14, bool))


def shade_once(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit colours, with one comparison per pixel."""
    shade(inputs, uniforms, 0, out)


def shade_5x5(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit colours, with 25 comparisons per pixel."""
    shade(inputs, uniforms, 2, out)


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], radius: int, out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit colours, with (2 radius + 1)² comparisons around each pixel's map position."""
    real = inputs.dtype.type
    projected = divide(inputs[:, 10:])
    true_depth = projected[:, 2] - real(uniforms["bias"])
    note_depths(uniforms["shadowMap"], true_depth, uniforms["bias"])
    lit = count_lit(uniforms["shadowMap"], projected, true_depth, radius, real(uniforms["texel"]))
    lit *= real(share(radius))
    shade_visible(inputs, uniforms, lit, out)


def share(radius: int) -> float:
    """Return the weight of one comparison, as written into the GLSL source."""
    return 1.0 / (2 * radius + 1) ** 2


def _program(name: str, radius: int, shade_pixels: Any) -> Program:
    uniforms = {
        **BLINN_PHONG.uniforms,
        "lightMatrix": np.eye(4, dtype=np.float32),
        "modelMatrix": np.eye(4, dtype=np.float32),
        "shadowMap": 0,
        "texel": 0.0,
        "bias": 0.0,
    }
    fragment = FRAGMENT.replace("RADIUS", str(radius)).replace("SHARE", repr(share(radius)))
    return Program(
        name,
        vertex,
        shade_pixels,
        uniforms=uniforms,
        samplers=("shadowMap",),
        glsl_vertex=VERTEX,
        glsl_fragment=fragment,
    )


BLINN_PHONG_SHADOWED = _program("blinn-phong-shadowed", 0, shade_once)
BLINN_PHONG_SHADOWED_5X5 = _program("blinn-phong-shadowed-5x5", 2, shade_5x5)
