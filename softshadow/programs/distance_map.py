"""Maps of distances: how far casters are from the light, in world units, compared with how far a point is from it.

The texture coordinates of both programs are positions in the light's view: x to the right, y up, -z forward. The
distance of a light at infinity is measured along its rays, from the plane of its camera. "light-distance" writes the
distance; "distance-visibility" compares it with the distance that the map stores for the same direction.

References: Brabec, Annen & Seidel 2002, "Practical shadow mapping"; slide SK:331.
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

DISTANCE = """#version 120
uniform float parallel;  // 1: the light is at infinity
varying vec4 texCoord;

float distanceFromLight()
{
    vec3 position = texCoord.stp;
    return parallel > 0.0 ? -position.p : sqrt(dot(position, position));
}
"""

STORE = """
void main()
{
    gl_FragColor = vec4(distanceFromLight(), 0.0, 0.0, 1.0);
}
"""

COMPARE = """
uniform sampler2D shadowMap;
uniform float scale;     // of the map's side 1: x of the light's view, at forward distance 1 if the light is a point
uniform float farthest;  // what the map stores where nothing was drawn
uniform float bias;
uniform float behind;    // visibility behind the light
uniform float cone;      // squared radius of a spot light's disc in the map

void main()
{
    float forward = parallel > 0.0 ? 1.0 : -texCoord.p;
    vec2 off = texCoord.st * scale / forward;
    float stored = texture2D(shadowMap, off + 0.5).r;
    float distance = min(distanceFromLight() - bias, farthest);
    float visible = distance <= stored ? 1.0 : 0.0;
    if (off.s * off.s + off.t * off.t > cone)
        visible = 0.0;
    gl_FragColor = forward > 0.0 ? vec4(stored, distance, 0.0, visible) : vec4(0.0, 0.0, 0.0, behind);
}
"""


def distance_from_light(inputs: np.ndarray, parallel: float) -> np.ndarray:
    """Return the distances (N,) of positions (N, 4) in the light's view."""
    position = inputs[:, :3]
    distance: np.ndarray = -position[:, 2] if parallel > 0 else np.sqrt(dot(position, position))
    return distance


def store(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the distance in red."""
    out[:, 0], out[:, 1], out[:, 2], out[:, 3] = distance_from_light(inputs, uniforms["parallel"]), 0, 0, 1


def compare(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the stored distance, the one compared with it, 0, and the visibility."""
    real = inputs.dtype.type
    texture, farthest, bias = uniforms["shadowMap"], real(uniforms["farthest"]), real(uniforms["bias"])
    forward = np.ones(len(inputs), inputs.dtype) if uniforms["parallel"] > 0 else -inputs[:, 2]
    place, stored = np.zeros((len(inputs), 3), inputs.dtype, order="F"), np.empty((len(inputs), 1), inputs.dtype)
    with np.errstate(all="ignore"):  # beside the light forward is 0, which gives infinities, as in GL
        off = inputs[:, :2] * real(uniforms["scale"]) / forward[:, None]
        place[:, :2] = off + real(0.5)
        distance = np.minimum(distance_from_light(inputs, uniforms["parallel"]) - bias, farthest)
        note_depths(texture, distance, bias, measure="distance", farthest=float(farthest))
        sample(texture, place, stored)
        visible = (distance <= stored[:, 0]) & ~(off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1] > real(uniforms["cone"]))
    out[:, 0], out[:, 1], out[:, 2], out[:, 3] = stored[:, 0], distance, 0, visible
    out[~(forward > 0)] = (0, 0, 0, uniforms["behind"])


LIGHT_DISTANCE = Program(
    "light-distance",
    vertex,
    store,
    uniforms={"parallel": 0.0},
    glsl_vertex=VERTEX,
    glsl_fragment=DISTANCE + STORE,
)
DISTANCE_VISIBILITY = Program(
    "distance-visibility",
    vertex,
    compare,
    uniforms={
        "parallel": 0.0,
        "shadowMap": 0,
        "scale": 1.0,
        "farthest": 1.0,
        "bias": 0.0,
        "behind": 1.0,
        "cone": float("inf"),
    },
    samplers=("shadowMap",),
    glsl_vertex=VERTEX,
    glsl_fragment=DISTANCE + COMPARE,
)
