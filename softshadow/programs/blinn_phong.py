"""Blinn-Phong lighting per pixel with one light; the fixed function computes the same per vertex.

References: Blinn 1977, "Models of light reflection for computer synthesized pictures"; Phong 1975, "Illumination for
computer generated pictures" (interpolated normals).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.jit import kernel
from softshadow.programs.inverse import inverse
from softshadow.programs.llvmpipe_math import power
from softshadow.programs.program import Program, Varyings, VertexInputs
from softshadow.programs.texture_coordinates import transform

ZERO, ONE = np.float32(0.0), np.float32(1.0)

VERTEX = """#version 120
varying vec4 color;
varying vec3 eyePosition;
varying vec3 normal;

void main()
{
    color = gl_Color;
    eyePosition = (gl_ModelViewMatrix * gl_Vertex).xyz;
    normal = gl_NormalMatrix * gl_Normal;
    gl_Position = ftransform();
}
"""

FRAGMENT = """#version 120
uniform vec4 lightPosition;  // eye space; w = 0: a direction towards the light
uniform vec3 ambient;
uniform vec3 diffuse;
uniform vec3 specular;
uniform float shininess;
varying vec4 color;
varying vec3 eyePosition;
varying vec3 normal;

void main()
{
    vec3 n = normalize(normal);
    vec3 towardsLight = normalize(lightPosition.xyz - lightPosition.w * eyePosition);
    vec3 halfway = normalize(towardsLight - normalize(eyePosition));
    float facing = max(dot(n, towardsLight), 0.0);
    float highlight = facing > 0.0 ? pow(max(dot(n, halfway), 0.0), shininess) : 0.0;
    gl_FragColor = vec4(color.rgb * (ambient + facing * diffuse) + highlight * specular, color.a);
}
"""


def vertex(vertices: VertexInputs) -> Varyings:
    """Return color, eyePosition and normal."""
    eye = transform(vertices.modelview, vertices.position)[:, :3]
    normal_matrix = inverse(vertices.modelview)[:3, :3].T
    values = np.concatenate([vertices.color, eye, transform(normal_matrix, vertices.normal)], axis=1)
    return Varyings(values, np.zeros(10, bool))


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit colours."""
    shade_visible(inputs, uniforms, np.ones(len(inputs), inputs.dtype), out)


def shade_visible(inputs: np.ndarray, uniforms: Mapping[str, Any], visible: np.ndarray, out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the lit colours; `visible` (N,) is the fraction of the light that each pixel sees."""
    names = ("lightPosition", "ambient", "diffuse", "specular")
    light, ambient, diffuse, specular = (tuple(map(inputs.dtype.type, uniforms[name])) for name in names)
    shininess = inputs.dtype.type(uniforms["shininess"])
    light_pixels(np.ascontiguousarray(inputs.T), visible, light, ambient, diffuse, specular, shininess, out.T)


@kernel
def dot(a, b):
    """Return the dot product of two 3-tuples, summed from z to x as in llvmpipe."""
    return (a[2] * b[2] + a[1] * b[1]) + a[0] * b[0]


@kernel
def normalize(v):
    """Return a vector of length 1 in the same direction."""
    scale = ONE / np.sqrt(dot(v, v))
    return v[0] * scale, v[1] * scale, v[2] * scale


@kernel
def mix_light(color, ambient, diffuse, specular, facing, highlight):
    """Return one channel of a pixel."""
    return color * (ambient + facing * diffuse) + highlight * specular


@kernel
def light_pixels(inputs, visible, light, ambient, diffuse, specular, shininess, out):
    """Write the lit colours of pixels to `out` (4, N).

    `inputs` (10 or more, N) are color, eye position and normal; `visible` (N,) is the visible fraction of the light.
    Each component is stored contiguously, so that the loop is vectorised.
    """
    w = light[3]
    for n in range(inputs.shape[1]):
        eye = (inputs[4, n], inputs[5, n], inputs[6, n])
        normal = normalize((inputs[7, n], inputs[8, n], inputs[9, n]))
        towards_light = normalize((light[0] - w * eye[0], light[1] - w * eye[1], light[2] - w * eye[2]))
        view = normalize(eye)
        halfway = normalize((towards_light[0] - view[0], towards_light[1] - view[1], towards_light[2] - view[2]))
        facing = max(dot(normal, towards_light), ZERO)
        shine = power(max(dot(normal, halfway), ZERO), shininess)
        highlight = visible[n] * (shine if facing > ZERO else ZERO)
        facing = visible[n] * facing
        out[0, n] = mix_light(inputs[0, n], ambient[0], diffuse[0], specular[0], facing, highlight)
        out[1, n] = mix_light(inputs[1, n], ambient[1], diffuse[1], specular[1], facing, highlight)
        out[2, n] = mix_light(inputs[2, n], ambient[2], diffuse[2], specular[2], facing, highlight)
        out[3, n] = inputs[3, n]


BLINN_PHONG = Program(
    "blinn-phong",
    vertex,
    shade,
    uniforms={
        "lightPosition": (0.0, 0.0, 1.0, 0.0),
        "ambient": (0.2, 0.2, 0.2),
        "diffuse": (0.8, 0.8, 0.8),
        "specular": (0.0, 0.0, 0.0),
        "shininess": 1.0,
    },
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT,
)
