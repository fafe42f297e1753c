"""Visibility of a light by its cube shadow map: six depth maps, one per side.

The texture coordinates are the vector from the light. Its largest component selects the face and equals the eye-space
distance in that face's view, which gives the window depth under a 90-degree projection.

References: Gerasimov 2004, "Omnidirectional shadow mapping", in GPU Gems.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.programs.map_visibility import VERTEX, vertex
from softshadow.programs.program import Program
from softshadow.programs.reads import note_depths
from softshadow.programs.sampling import sample
from softshadow.programs.texture_coordinates import dot

FRAGMENT = """#version 120
uniform samplerCube shadowMap;
uniform float farthest;  // f / (f - n): window depth at infinity
uniform float nearness;  // n f / (f - n)
uniform float bias;
uniform vec3 axis;       // of a spot light's cone
uniform float cosine;    // of its cutoff; below -1: no cone
varying vec4 texCoord;

void main()
{
    vec3 away = texCoord.stp;
    float distance = max(max(abs(away.x), abs(away.y)), abs(away.z));
    float depth = min(farthest - nearness / distance - bias, 1.0);  // beyond the far plane as on it
    float visible = depth <= textureCube(shadowMap, away).r ? 1.0 : 0.0;
    float size = sqrt(dot(away, away));
    if (dot(away, axis) < cosine * size)
        visible = 0.0;
    gl_FragColor = vec4(visible);
}
"""


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with 1 where the light is visible and 0 in shadow."""
    real = inputs.dtype.type
    away = np.ascontiguousarray(inputs[:, :3])
    stored = np.empty_like(out)
    with np.errstate(all="ignore"):  # the vector is 0 at the light itself
        depth = real(uniforms["farthest"]) - real(uniforms["nearness"]) / np.abs(away).max(axis=1)
        depth = np.minimum(depth - real(uniforms["bias"]), real(1))
        note_depths(uniforms["shadowMap"], depth, uniforms["bias"])
        sample(uniforms["shadowMap"], away, stored)
        visible = depth <= stored[:, 0]
        size = np.sqrt(dot(away, away))
        visible &= ~(dot(away, np.array(uniforms["axis"], inputs.dtype)) < real(uniforms["cosine"]) * size)
    out[:] = visible[:, None]


CUBE_VISIBILITY = Program(
    "cube-visibility",
    vertex,
    shade,
    uniforms={
        "shadowMap": 0,
        "farthest": 1.0,
        "nearness": 0.0,
        "bias": 0.0,
        "axis": (0.0, 0.0, 0.0),
        "cosine": -2.0,
    },
    samplers=("shadowMap",),
    cube_samplers=("shadowMap",),
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT,
)
