"""Materials at the vertices: constant, set per vertex, or tracking the colour (glColorMaterial)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from softshadow import tokens as gl
from softshadow.programs.program import VertexInputs
from softshadow.state import Lighting, LightState, MaterialState

COLOR_MATERIAL: dict[int, tuple[str, ...]] = {
    gl.GL_AMBIENT: ("ambient",),
    gl.GL_DIFFUSE: ("diffuse",),
    gl.GL_SPECULAR: ("specular",),
    gl.GL_EMISSION: ("emission",),
    gl.GL_AMBIENT_AND_DIFFUSE: ("ambient", "diffuse"),
}


def vector(values: tuple[float, ...]) -> np.ndarray:
    """Return values as a float32 array."""
    return np.array(values, np.float32)


def followed(lighting: Lighting, side: str) -> tuple[str, ...]:
    """Return the material colours of "front" or "back" that follow the vertex colour."""
    sides = gl.GL_FRONT_AND_BACK, gl.GL_FRONT if side == "front" else gl.GL_BACK
    follows = lighting.color_material and lighting.color_material_face in sides
    return COLOR_MATERIAL[lighting.color_material_mode] if follows else ()


def varying(lighting: Lighting, side: str, materials: Iterable[str], color: np.ndarray) -> set[str]:
    """Return the parameters of "front" or "back" that may differ between vertices.

    `materials` are the names of those that the vertices have, `color` (V, 4) their colours.
    """
    own = {name.partition(".")[2] for name in materials if name.startswith(side)}
    color_varies = color.strides[0] != 0  # a constant is broadcast with stride 0
    return own | (set(followed(lighting, side)) if color_varies else set())


class Reflectances:
    """The material parameters of one side ("front" or "back") at the vertices.

    Attributes
    ----------
    varying : set of str         parameters that may differ between vertices
    shininess : (V,)
    """

    def __init__(self, lighting: Lighting, vertices: VertexInputs, side: str) -> None:
        self._material: MaterialState = getattr(lighting, side)
        self._vertices, self._side = vertices, side
        self._tracked = followed(lighting, side)
        self.varying = varying(lighting, side, vertices.materials, vertices.color)
        constant = np.float32(self._material.shininess)
        shininess = vertices.materials.get(f"{side}.shininess", constant)
        self.shininess = np.broadcast_to(shininess, len(vertices.position))

    def __call__(self, name: str) -> np.ndarray:
        """Return a parameter, (V, 4) or (1, 4)."""
        if name in self._tracked:
            return self._vertices.color
        per_vertex = self._vertices.materials.get(f"{self._side}.{name}")
        if per_vertex is None:
            return vector(getattr(self._material, name))[np.newaxis]
        return np.asarray(per_vertex, np.float32)

    def product(self, name: str, light: LightState, stale: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return RGB of light times material, (V, 3) or (1, 3), with green and blue replaced by those in `stale`."""
        product: np.ndarray = vector(getattr(light, name))[:3] * self(name)[:, :3]
        if name not in stale:
            return product
        n = len(self._vertices.position)
        red = np.broadcast_to(product, (n, 3))[:, :1]
        return np.concatenate([red, np.broadcast_to(stale[name], (n, 2))], axis=1)
