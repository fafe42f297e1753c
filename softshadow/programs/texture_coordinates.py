"""Texture coordinates of the fixed function, per vertex: generation (texgen) and texture matrices.

All sums are in float32 and in the order of Mesa's vertex program: matrix times vector adds columns from x to w, a dot
product adds from the last component to the first. Every bit matters in shadow comparisons.

References: GL 2.1 sec. 2.11.2 (matrices) and 2.11.4 (texgen); ffvertex_prog.c of Mesa 22.3.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.jit import kernel, read_only
from softshadow.programs.program import VertexInputs
from softshadow.state import TexGen, TextureUnit

ONE, HALF = np.float32(1.0), np.float32(0.5)
WITH_NORMALS = (gl.GL_SPHERE_MAP, gl.GL_REFLECTION_MAP, gl.GL_NORMAL_MAP)
IN_EYE_SPACE = (gl.GL_EYE_LINEAR, *WITH_NORMALS)


def transform(matrix: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Return ``matrix @ vector`` of each row (V, 4): ((c0 x + c1 y) + c2 z) + c3 w, every step rounded."""
    columns = np.ascontiguousarray(np.asarray(matrix, vectors.dtype).T)
    result = np.empty((len(vectors), columns.shape[1]), vectors.dtype)
    transform_rows(columns, read_only(np.ascontiguousarray(vectors)), result)
    return result


@kernel
def transform_rows_of_four(columns, vectors, result):
    """Write the transformed vectors (V, 4): with the matrix in local variables, four sums are one vector instruction.

    The loops of `transform_rows` take three times as long.
    """
    x0, x1, x2, x3 = columns[0, 0], columns[0, 1], columns[0, 2], columns[0, 3]
    y0, y1, y2, y3 = columns[1, 0], columns[1, 1], columns[1, 2], columns[1, 3]
    z0, z1, z2, z3 = columns[2, 0], columns[2, 1], columns[2, 2], columns[2, 3]
    w0, w1, w2, w3 = columns[3, 0], columns[3, 1], columns[3, 2], columns[3, 3]
    for number in range(len(vectors)):
        v = np.uint64(number)
        x, y, z, w = vectors[v, 0], vectors[v, 1], vectors[v, 2], vectors[v, 3]
        result[v, 0] = x * x0 + y * y0 + z * z0 + w * w0
        result[v, 1] = x * x1 + y * y1 + z * z1 + w * w1
        result[v, 2] = x * x2 + y * y2 + z * z2 + w * w2
        result[v, 3] = x * x3 + y * y3 + z * z3 + w * w3


@kernel
def transform_rows(columns, vectors, result):
    """Write the transformed vectors (V, k) to `result` (V, n); `columns` (k, n) are those of the matrix."""
    if columns.shape[0] == columns.shape[1] == 4:
        transform_rows_of_four(columns, vectors, result)
        return
    for v in range(len(vectors)):
        for i in range(columns.shape[1]):
            total = vectors[v, 0] * columns[0, i]
            for c in range(1, columns.shape[0]):
                total += vectors[v, c] * columns[c, i]
            result[v, i] = total


def dot(vectors: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the dot products (V,) of rows with rows or with one vector, added from the last component to the first."""
    result = vectors[:, -1] * other[..., -1]
    for i in range(vectors.shape[1] - 2, -1, -1):
        result = result + vectors[:, i] * other[..., i]
    return result


def reciprocal_root(x: np.ndarray) -> np.ndarray:
    """Return 1 / sqrt(x), both rounded; infinity at 0."""
    root: np.ndarray = ONE / np.sqrt(x)
    return root


def normalize_rows(v: np.ndarray) -> np.ndarray:
    """Return rows (V, 3) normalized as in Mesa's vertex program; 0 becomes NaN."""
    with np.errstate(invalid="ignore"):
        unit: np.ndarray = v * reciprocal_root(dot(v, v))[:, np.newaxis]
    return unit


def reflects_r(unit: TextureUnit) -> bool:
    """Return whether a unit generates r as the z component of a reflection."""
    return unit.gen[2].enabled and unit.gen[2].mode == gl.GL_REFLECTION_MAP


def needs_normals(unit: TextureUnit) -> bool:
    """Return whether a unit generates coordinates from normals."""
    return any(gen.enabled and gen.mode in WITH_NORMALS for gen in unit.gen)


class Normals(NamedTuple):
    """The normals (V, 3) of the vertices in eye space, and whether a unit generates r by GL_REFLECTION_MAP.

    In that case Mesa sums the z component for a sphere map in another order.
    """

    eye: np.ndarray
    reflects_r: bool


def reflections(position: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Return the reflection directions (V, 3) of eye rays to eye positions (V, 3 or more)."""
    turn, ray = turns_and_rays(position, normal)
    return turn + ray


def turns_and_rays(position: np.ndarray, normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return -2 (n . u) n and the unit eye rays u; both (V, 3)."""
    ray = normalize_rows(position[:, :3])
    cosine = dot(normal, ray)
    return -(cosine + cosine)[:, np.newaxis] * normal, ray


def sphere_map(position: np.ndarray, normals: Normals) -> np.ndarray:
    """Return sphere map coordinates of reflections: x and y over twice the length of (x, y, z + 1), plus 1/2."""
    turn, ray = turns_and_rays(position, normals.eye)
    reflected = turn + ray
    half_way = reflected.copy()
    half_way[:, 2] = reflected[:, 2] + ONE if normals.reflects_r else (turn[:, 2] + ONE) + ray[:, 2]
    coordinates: np.ndarray = reflected * (reciprocal_root(dot(half_way, half_way)) * HALF)[:, np.newaxis] + HALF
    return coordinates


def generate_coordinate(component: int, gen: TexGen, vertices: VertexInputs, normals: Normals | None) -> np.ndarray:
    """Return one generated coordinate (V,)."""
    real = vertices.position.dtype
    if gen.mode == gl.GL_OBJECT_LINEAR:
        return dot(vertices.position, np.array(gen.object_plane, real))
    eye = transform(vertices.modelview, vertices.position)
    if gen.mode == gl.GL_EYE_LINEAR:
        return dot(eye, np.array(gen.eye_plane, real))
    assert normals is not None
    if gen.mode == gl.GL_NORMAL_MAP:
        return normals.eye[:, component]
    vectors = sphere_map(eye, normals) if gen.mode == gl.GL_SPHERE_MAP else reflections(eye, normals.eye)
    return vectors[:, component]


def texture_coordinates(
    index: int, unit: TextureUnit, vertices: VertexInputs, normals: Normals | None = None
) -> np.ndarray:
    """Return the coordinates (V, 4) of texture unit `index`: specified or generated, times the texture matrix.

    The modes of `WITH_NORMALS` need `normals`.
    """
    coordinates = vertices.texcoords[index]
    if any(gen.enabled for gen in unit.gen):
        coordinates = coordinates.copy()
        for component, gen in enumerate(unit.gen):
            if gen.enabled:
                coordinates[:, component] = generate_coordinate(component, gen, vertices, normals)
    matrix = vertices.texture_matrices[index]
    if (matrix == np.eye(4)).all():
        return coordinates
    return transform(matrix, coordinates)
