"""Number of lights that a surface sees, by up to eight shadow maps at once: "map-visibility-8".

The sum of what "map-visibility" writes with a radius of 0, for maps in the texture units 0 to 7 whose matrices are
those of the units: numbers from 0 to 8 without rounding, so the sum has the bits of eight draws that are added. Soft
shadows from many points of a light need an eighth of the draws with it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.programs.map_visibility import box_share, visibility_in
from softshadow.programs.program import Program, Varyings, VertexInputs
from softshadow.programs.texture_coordinates import transform

MOST_MAPS = 8
MAPS = range(MOST_MAPS)

VERTEX = """#version 120
varying vec4 texCoord[8];

void main()
{
    for (int i = 0; i < 8; i++)
        texCoord[i] = gl_TextureMatrix[i] * gl_MultiTexCoord0;
    gl_Position = ftransform();
}
"""

FRAGMENT = """#version 120
DECLARATIONS
uniform int maps;      // how many of them are in use
uniform float bias;
uniform float behind;  // visibility behind a light
varying vec4 texCoord[8];

float seen(sampler2D shadowMap, vec4 place)
{
    vec3 projected = place.stp / place.q;
    float depth = min(projected.p - bias, 1.0);  // beyond the far plane as on it
    float visible = depth <= texture2D(shadowMap, projected.st).r ? 1.0 : 0.0;
    return place.q > 0.0 ? visible : behind;
}

void main()
{
    float sum = 0.0;
    SUM
    gl_FragColor = vec4(sum);
}
"""

SAMPLERS = tuple(f"shadowMap{i}" for i in MAPS)
DECLARATIONS = "\n".join(f"uniform sampler2D {name};" for name in SAMPLERS)
SUM = "\n    ".join(f"if (maps > {i}) sum += seen({name}, texCoord[{i}]);" for i, name in enumerate(SAMPLERS))
ONE_COMPARISON = {"radius": 0, "side": 1.0, "cone": float("inf")}  # uniforms of "map-visibility"


def vertex(vertices: VertexInputs) -> Varyings:
    """Return texCoord: the texture coordinates of unit 0 by the texture matrix of each unit in use, (V, 4 maps)."""
    maps = vertices.uniforms["maps"]
    values = transform(np.concatenate(vertices.texture_matrices[:maps]), vertices.texcoords[0])
    return Varyings(values, np.zeros(4 * maps, bool))


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the number of maps that see each place."""
    total = np.zeros(len(inputs), inputs.dtype)
    for name, first in zip(SAMPLERS, range(0, inputs.shape[1], 4), strict=False):
        place = inputs[:, first : first + 4]
        total += visibility_in(uniforms[name], box_share, place, {**uniforms, **ONE_COMPARISON})
    out[:] = total[:, None]


MAP_VISIBILITY_8 = Program(
    "map-visibility-8",
    vertex,
    shade,
    uniforms={"maps": 1, "bias": 0.0, "behind": 1.0, **{name: i for i, name in enumerate(SAMPLERS)}},
    samplers=SAMPLERS,
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT.replace("DECLARATIONS", DECLARATIONS).replace("SUM", SUM),
)
