"""Materials at the vertices: constant, given from vertex to vertex, or following the colour."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from softshadow import tokens as gl
from softshadow.programs import VertexInputs
from softshadow.state import Lighting, LightState, MaterialState

COLOR_MATERIAL: dict[int, tuple[str, ...]] = {
    gl.GL_AMBIENT: ("ambient",),
    gl.GL_DIFFUSE: ("diffuse",),
    gl.GL_SPECULAR: ("specular",),
    gl.GL_EMISSION: ("emission",),
    gl.GL_AMBIENT_AND_DIFFUSE: ("ambient", "diffuse"),
}


def vector(values: tuple[float, ...]) -> np.ndarray:
    return np.array(values, np.float32)


class Reflectances:
    """The material of one side ("front" or "back") at the vertices.

    Attributes
    ----------
    varying : set of str         parameters that may differ from vertex to vertex
    shininess : (V,)
    """

    def __init__(self, lighting: Lighting, vertices: VertexInputs, side: str) -> None:
        self._material: MaterialState = getattr(lighting, side)
        self._vertices, self._side = vertices, side
        sides = gl.GL_FRONT_AND_BACK, gl.GL_FRONT if side == "front" else gl.GL_BACK
        follows = lighting.color_material and lighting.color_material_face in sides
        self._tracked = COLOR_MATERIAL[lighting.color_material_mode] if follows else ()
        given = {name.partition(".")[2] for name in vertices.materials if name.startswith(side)}
        carried = vertices.color.strides[0] != 0  # a constant is spread with stride 0
        self.varying = given | (set(self._tracked) if carried else set())
        constant = np.float32(self._material.shininess)
        count = len(vertices.position)
        self.shininess = np.broadcast_to(vertices.materials.get(f"{side}.shininess", constant), count)

    def __call__(self, name: str) -> np.ndarray:
        """Return a parameter, (V, 4) or (1, 4)."""
        if name in self._tracked:
            return self._vertices.color
        given = self._vertices.materials.get(f"{self._side}.{name}")
        return vector(getattr(self._material, name))[np.newaxis] if given is None else np.asarray(given, np.float32)

    def product(self, name: str, light: LightState, stray: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return RGB of light times material, (V, 3) or (1, 3), with what `stray` has in green and blue."""
        made: np.ndarray = vector(getattr(light, name))[:3] * self(name)[:, :3]
        if name not in stray:
            return made
        count = len(self._vertices.position)
        red = np.broadcast_to(made, (count, 3))[:, :1]
        return np.concatenate([red, np.broadcast_to(stray[name], (count, 2))], axis=1)
