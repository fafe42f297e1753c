"""Programs that look up what an earlier pass has stored for the pixel, and the first pass: the points that are visible.

"position" stores the texture coordinates, which a technique sets to positions. "volume-side" counts the sides of shadow
volumes. Whether a side lies between eye and surface is decided not by depths but by the side's plane, which has the eye
on one side and the stored point on the other. The wedge of an edge asks for the same sign, so the two cannot disagree.

A texture of edges holds their ends in two texels, one above the other; a draw's texture coordinates are the place of
the lower one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.programs.program import Program, Varyings, VertexInputs
from softshadow.programs.sampling import sample
from softshadow.programs.texture_coordinates import transform
from softshadow.texture import Texture

ZERO = np.float32(0.0)

VERTEX = """#version 120
varying vec3 window;   // place in the window, whose width and height are 1, times the last component
varying vec4 texCoord;

void main()
{
    vec4 clip = gl_ProjectionMatrix * (gl_ModelViewMatrix * gl_Vertex);
    window = vec3(0.5 * (clip.x + clip.w), 0.5 * (clip.y + clip.w), clip.w);
    texCoord = gl_TextureMatrix[0] * gl_MultiTexCoord0;
    gl_Position = ftransform();
}
"""

POSITION_FRAGMENT = """#version 120
varying vec4 texCoord;

void main()
{
    gl_FragColor = vec4(texCoord.stp, 1.0);
}
"""

# negative where the point is on the caster's side of the edge's plane; all relative to the light's centre
TRIPLE = """
float triple(vec3 a, vec3 b, vec3 c)
{
    return (a.y * b.z - a.z * b.y) * c.x + (a.z * b.x - a.x * b.z) * c.y + (a.x * b.y - a.y * b.x) * c.z;
}"""

SIDE_FRAGMENT = f"""#version 120
uniform sampler2D positions;
uniform sampler2D edges;
uniform float edgeRow;  // height of a texel
uniform float outside;  // what is counted for points on the outer side of the plane of edge and light,
uniform float inside;   // and for those on the inner side
varying vec3 window;
varying vec4 texCoord;
{TRIPLE}

void main()
{{
    vec3 point = texture2D(positions, window.st / window.p).rgb;
    vec3 start = texture2D(edges, texCoord.st).rgb;
    vec3 end = texture2D(edges, texCoord.st + vec2(0.0, edgeRow)).rgb;
    gl_FragColor = vec4(triple(start, end, point) < 0.0 ? inside : outside);
}}
"""


def vertex(vertices: VertexInputs) -> Varyings:
    """Return window and texCoord."""
    clip = transform(vertices.projection, transform(vertices.modelview, vertices.position))
    half, w = clip.dtype.type(0.5), clip[:, 3]
    window = np.stack([half * (clip[:, 0] + w), half * (clip[:, 1] + w), w], axis=1)
    placed = transform(vertices.texture_matrices[0], vertices.texcoords[0])
    return Varyings(np.concatenate([window, placed], axis=1), np.zeros(7, bool))


def shade_position(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the texture coordinates s, t, r, and 1."""
    out[:, :3] = inputs[:, 3:6]
    out[:, 3] = 1


def shade_side(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4) with the counts."""
    point = at_window_place(uniforms["positions"], inputs)
    start, end = edge_ends(inputs, uniforms)
    real = inputs.dtype.type
    count_sides(point.T, start.T, end.T, real(uniforms["outside"]), real(uniforms["inside"]), out.T)


@kernel
def count_sides(points, starts, ends, outside, inside, out):
    """Write to `out` (4, N) one number for points (4, N) inside the planes of edge and light, another for the rest."""
    for n in range(points.shape[1]):
        count = inside if triple(starts, ends, points, n) < ZERO else outside
        for channel in range(4):
            out[channel, n] = count


@inlined
def triple(a, b, c, n):
    """Return the triple product of the n-th vectors of three arrays (3 or more, N)."""
    return (
        (a[1, n] * b[2, n] - a[2, n] * b[1, n]) * c[0, n]
        + (a[2, n] * b[0, n] - a[0, n] * b[2, n]) * c[1, n]
        + (a[0, n] * b[1, n] - a[1, n] * b[0, n]) * c[2, n]
    )


def at_window_place(texture: Texture, inputs: np.ndarray) -> np.ndarray:
    """Return the texels (N, 4) of a texture as large as the window, at the place of each fragment."""
    coordinates = np.zeros((len(inputs), 3), inputs.dtype, order="F")
    with np.errstate(all="ignore"):
        coordinates[:, :2] = inputs[:, :2] / inputs[:, 2:3]
    return _texels(texture, coordinates)


def edge_ends(inputs: np.ndarray, uniforms: Mapping[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return the two ends of each fragment's edge, (N, 4) each."""
    coordinates = np.zeros((len(inputs), 3), inputs.dtype, order="F")
    coordinates[:, :2] = inputs[:, 3:5]
    start = _texels(uniforms["edges"], coordinates)
    coordinates[:, 1] += inputs.dtype.type(uniforms["edgeRow"])
    return start, _texels(uniforms["edges"], coordinates)


def _texels(texture: Texture, coordinates: np.ndarray) -> np.ndarray:
    texels = np.empty((4, len(coordinates)), coordinates.dtype).T  # stored column by column, as `sample` expects
    sample(texture, coordinates, texels)
    return texels


POSITION = Program("position", vertex, shade_position, glsl_vertex=VERTEX, glsl_fragment=POSITION_FRAGMENT)
VOLUME_SIDE = Program(
    "volume-side",
    vertex,
    shade_side,
    uniforms={"positions": 0, "edges": 1, "edgeRow": 0.5, "outside": 0.0, "inside": 1.0},
    samplers=("positions", "edges"),
    glsl_vertex=VERTEX,
    glsl_fragment=SIDE_FRAGMENT,
)
