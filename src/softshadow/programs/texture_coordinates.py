"""Eye positions and texture coordinates of the fixed function: generation (texgen) and texture matrices, per vertex.

Float32, in the order of Mesa's vertex program: a matrix times a vector adds columns from x to w, a dot product adds
from the last component to the first. Shadow comparisons see every bit of this.

References: GL 2.1 sec. 2.11.2 (matrices) and 2.11.4 (texgen); ffvertex_prog.c of Mesa 22.3.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.programs import VertexInputs
from softshadow.state import TextureUnit


def transform(matrix: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Return ``matrix @ vector`` of each row (V, 4): ((c0 x + c1 y) + c2 z) + c3 w, every step rounded."""
    columns = np.asarray(matrix, vectors.dtype).T
    result = vectors[:, 0:1] * columns[0]
    for i in range(1, len(columns)):
        result += vectors[:, i : i + 1] * columns[i]
    return result


def dot(vectors: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the dot products (V,) of rows with rows or with one vector, added from the last component to the first."""
    result = vectors[:, -1] * other[..., -1]
    for i in range(vectors.shape[1] - 2, -1, -1):
        result = result + vectors[:, i] * other[..., i]
    return result


def texture_coordinates(index: int, unit: TextureUnit, vertices: VertexInputs) -> np.ndarray:
    """Return the coordinates (V, 4) of texture unit `index`: given or generated, then through the texture matrix.

    Raises
    ------
    StateError                   a generation mode other than GL_OBJECT_LINEAR and GL_EYE_LINEAR is enabled
    """
    coordinates = vertices.texcoords[index]
    if any(gen.enabled for gen in unit.gen):
        coordinates = coordinates.copy()
        real = coordinates.dtype
        eye: np.ndarray | None = None
        for component, (name, gen) in enumerate(zip("STRQ", unit.gen, strict=True)):
            if not gen.enabled:
                continue
            if gen.mode == gl.GL_OBJECT_LINEAR:
                coordinates[:, component] = dot(vertices.position, np.array(gen.object_plane, real))
            elif gen.mode == gl.GL_EYE_LINEAR:
                eye = transform(vertices.modelview, vertices.position) if eye is None else eye
                coordinates[:, component] = dot(eye, np.array(gen.eye_plane, real))
            else:
                raise StateError(
                    f"texture unit {index}: GL_TEXTURE_GEN_MODE of GL_{name} is {gl.token_name(gen.mode)}: "
                    "GL_OBJECT_LINEAR and GL_EYE_LINEAR are supported"
                )
    matrix = vertices.texture_matrices[index]
    if (matrix == np.eye(4)).all():
        return coordinates
    return transform(matrix, coordinates)
