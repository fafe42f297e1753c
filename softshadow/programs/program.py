"""The records of shading programs: `Program`, its input `VertexInputs`, and its output `Varyings`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow.programs.inverse import UNKNOWN
from softshadow.texture import Texture
from softshadow.tokens import GL_LINEAR, GL_TEXTURE_CUBE_MAP


@dataclass(frozen=True)
class VertexInputs:
    """Input of a vertex stage: per-vertex arrays in object space, and the matrices (column vectors, ``M @ v``).

    position (V, 4), color (V, 4), normal (V, 3), texcoords one (V, 4) per texture unit; float32 (float64 in "exact").
    `modelview_kind` classifies the matrix by the calls that built it (`softshadow.programs.inverse`); `materials` holds
    the material parameters that change from vertex to vertex: "front.diffuse" (V, 4), "back.shininess" (V,) ...
    secondary (V, 4) colours and fog_coordinates (V,) are None where all are 0.
    """

    position: np.ndarray
    color: np.ndarray
    normal: np.ndarray
    texcoords: tuple[np.ndarray, ...]
    modelview: np.ndarray
    projection: np.ndarray
    texture_matrices: tuple[np.ndarray, ...]
    uniforms: Mapping[str, Any]
    modelview_kind: int = UNKNOWN
    materials: Mapping[str, np.ndarray] = field(default_factory=dict)
    secondary: np.ndarray | None = None
    fog_coordinates: np.ndarray | None = None


@dataclass(frozen=True)
class Varyings:
    """Output of the vertex stage: values (V, k) for perspective-correct interpolation.

    `flat` (k,) bool marks columns that take the provoking vertex's value; `back` (V, k) replaces `values` on
    back-facing triangles (two-sided lighting). `flat_input` is True if the fragment stage reads a flat column that
    differs between vertices: Mesa then splits quads along the other diagonal. `point_sizes` (V,) are the sizes of
    points where they depend on the vertex.
    """

    values: np.ndarray
    flat: np.ndarray
    back: np.ndarray | None = None
    flat_input: bool = False
    point_sizes: np.ndarray | None = None


@dataclass(frozen=True)
class Program:
    """A shading program.

    Attributes
    ----------
    vertex : VertexInputs -> Varyings
    shade : (inputs (N, k), uniforms, out (N, 4)) -> None
        Fill `out` with unclamped RGBA; the value of a sampler uniform is the `Texture` bound to its unit.
    uniforms : name -> initial value
        Ints, floats, tuples or (4, 4) float32 matrices; the type of the uniform follows from its initial value.
    samplers : names of the uniforms that are texture units
    cube_samplers : the samplers of cube maps (samplerCube); all others are of 2-D textures
    blocks : whether `shade` needs complete 2x2 blocks of pixels, because a texture's filters depend on the level of
        detail. Then N is a multiple of 4. A block holds the values of one triangle at four pixels: the pixel at an even
        row and column of the stored rows, its right neighbour, and the two pixels of the next row.
    glsl_vertex, glsl_fragment : the same program in GLSL 1.20
    units : for GL's fixed function, the texture units in use
    """

    name: str
    vertex: Callable[[VertexInputs], Varyings]
    shade: Callable[[np.ndarray, Mapping[str, Any], np.ndarray], None]
    uniforms: Mapping[str, Any] = field(default_factory=dict)
    samplers: tuple[str, ...] = ()
    cube_samplers: tuple[str, ...] = ()
    blocks: bool = False
    glsl_vertex: str = ""
    glsl_fragment: str = ""
    units: list[Any] | None = None


def needs_blocks(texture: Texture) -> bool:
    """Return whether a texture is filtered in 2x2 blocks of pixels.

    This is so if its filters depend on the level of detail or are anisotropic, or if a linear filter crosses the edges
    of a cube map.
    """
    sampler = texture.sampler
    over_edges = sampler.seamless and sampler.mag_filter == GL_LINEAR and texture.target == GL_TEXTURE_CUBE_MAP
    return over_edges or texture.is_anisotropic or sampler.min_filter != sampler.mag_filter
