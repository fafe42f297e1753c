"""Lighting per pixel by the half vector, with one light: what the fixed function does per vertex.

References: Blinn 1977, "Models of light reflection for computer synthesized pictures"; Phong 1975, "Illumination for
computer generated pictures" (interpolated normals).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.jit import kernel
from softshadow.programs import Program, Varyings, VertexInputs
from softshadow.programs.approximations import power
from softshadow.programs.inverse import inverse
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
    names = ("lightPosition", "ambient", "diffuse", "specular")
    light, ambient, diffuse, specular = (np.array(uniforms[name], inputs.dtype) for name in names)
    facing, highlight = lit_by(inputs, light, inputs.dtype.type(uniforms["shininess"]))
    light_pixels(np.ascontiguousarray(inputs.T), facing, highlight, ambient, diffuse, specular, out.T)


@kernel
def dot(a, b):
    """Return the dot product of 3-vectors as tuples, added from z to x as llvmpipe adds."""
    return (a[2] * b[2] + a[1] * b[1]) + a[0] * b[0]


@kernel
def normalize(v):
    scale = ONE / np.sqrt(dot(v, v))
    return v[0] * scale, v[1] * scale, v[2] * scale


def lit_by(inputs: np.ndarray, light: np.ndarray, shininess: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return (facing, highlight) (N,) of pixels: the weights of the diffuse and of the specular light."""
    eye_and_normal = np.ascontiguousarray(inputs.T[4:10])
    facing, highlight = np.empty(len(inputs), inputs.dtype), np.empty(len(inputs), inputs.dtype)
    weigh(eye_and_normal, light, shininess, facing, highlight)
    return facing, highlight


@kernel
def weigh(eye_and_normal, light, shininess, facings, highlights):
    """Write both weights (N,) of pixels; `eye_and_normal` (6, N): each component by itself, so that it vectorises."""
    w = light[3]
    for n in range(eye_and_normal.shape[1]):
        eye = (eye_and_normal[0, n], eye_and_normal[1, n], eye_and_normal[2, n])
        normal = normalize((eye_and_normal[3, n], eye_and_normal[4, n], eye_and_normal[5, n]))
        towards_light = normalize((light[0] - w * eye[0], light[1] - w * eye[1], light[2] - w * eye[2]))
        view = normalize(eye)
        halfway = normalize((towards_light[0] - view[0], towards_light[1] - view[1], towards_light[2] - view[2]))
        facing = max(dot(normal, towards_light), ZERO)
        highlight = power(max(dot(normal, halfway), ZERO), shininess)
        facings[n] = facing
        highlights[n] = highlight if facing > ZERO else ZERO


@kernel
def light_pixels(inputs, facings, highlights, ambient, diffuse, specular, out):
    """Light pixels with inputs (4 or more, N), of which the first are the color, by their weights (N,)."""
    for c in range(3):
        from_scene, from_light, shine = ambient[c], diffuse[c], specular[c]
        for n in range(inputs.shape[1]):
            out[c, n] = inputs[c, n] * (from_scene + facings[n] * from_light) + highlights[n] * shine
    out[3, :] = inputs[3]


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
