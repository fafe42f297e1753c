"""Shading programs: a vertex stage, a batch fragment stage, and the GLSL twin that real GL compiles.

A program is data: functions and sources, no class hierarchy. `shade` is called with thousands of a draw's fragments
at a time, in several threads where there are several, so it may be plain NumPy; the programs of this package call one
or a few cached kernels each. `inputs` and `out` lie in memory by column: ``inputs[:, 3]`` is one piece, and so are
``inputs.T`` and ``out.T`` as kernels take them, whose loops over fragments are then vectorised.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow.errors import StateError, nearest
from softshadow.programs.inverse import UNKNOWN
from softshadow.texture import Texture
from softshadow.tokens import GL_LINEAR, GL_TEXTURE_CUBE_MAP


@dataclass(frozen=True)
class VertexInputs:
    """What a vertex stage sees: per-vertex arrays in object space, and the matrices (column vectors, ``M @ v``).

    position (V, 4), color (V, 4), normal (V, 3), texcoords one (V, 4) per texture unit; float32 (float64 in "exact").
    `modelview_kind` is what the calls that made the matrix say of it (`softshadow.programs.inverse`); `materials` holds
    what changes from vertex to vertex: "front.diffuse" (V, 4), "back.shininess" (V,) ...
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


@dataclass(frozen=True)
class Varyings:
    """What the vertex stage hands on: values (V, k) to be interpolated, perspective-correct.

    `flat` (k,) bool marks columns that take the provoking vertex's value; `back` (V, k) replaces `values` on
    back-facing triangles (two-sided lighting). `flat_input` says that one of them differs from vertex to vertex and the
    fragment stage takes it: Mesa then cuts quads along the other diagonal.
    """

    values: np.ndarray
    flat: np.ndarray
    back: np.ndarray | None = None
    flat_input: bool = False


@dataclass(frozen=True)
class Program:
    """A program of the register.

    Attributes
    ----------
    vertex : VertexInputs -> Varyings
    shade : (inputs (N, k), uniforms, out (N, 4)) -> None
        Fill `out` with RGBA, unclamped; a sampler's uniform is the `Texture` that is bound to its unit.
    uniforms : name -> initial value
        Ints, floats, tuples or (4, 4) float32 matrices; their shape is the uniform's type.
    samplers : names of the uniforms that are texture units
    cube_samplers : those of them that look up cube maps (samplerCube); the others look up 2-D textures
    blocks : whether `shade` wants complete 2x2 blocks of pixels, because a texture's filters depend on the level of
        detail. Then N is a multiple of 4, each block has one triangle's values at an even row and column of the stored
        rows and at the three pixels right of it, in the next row, and right of that one.
    glsl_vertex, glsl_fragment : GLSL 1.20 sources that compute the same
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


def needs_blocks(texture: Texture) -> bool:
    """Return whether a texture is filtered by blocks of pixels.

    Its filters depend on the level of detail, or they are linear and go over the edges of a cube map.
    """
    sampler = texture.sampler
    over_edges = sampler.seamless and sampler.mag_filter == GL_LINEAR and texture.target == GL_TEXTURE_CUBE_MAP
    return over_edges or sampler.min_filter != sampler.mag_filter


_REGISTER: dict[str, Program] = {}


def register(program: Program) -> Program:
    """Make a program known by its name to `gl.program`; a later one of the same name replaces it."""
    _REGISTER[program.name] = program
    return program


def get(name: str) -> Program:
    """Return the program of that name.

    Raises
    ------
    StateError
        There is none; the message names the nearest.
    """
    from softshadow.programs import builtin  # the kernels compile where a program is first asked for

    builtin.load()
    if name not in _REGISTER:
        raise StateError(f"program {name!r} is not known: {nearest(name, sorted(_REGISTER))}")
    return _REGISTER[name]
