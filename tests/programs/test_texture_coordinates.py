"""Generated and transformed texture coordinates: examples, and the same bits as on Mesa."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mesa_points import load, same_bits, vertices_on_mesa
from softshadow import tokens as gl
from softshadow.programs import VertexInputs
from softshadow.programs.inverse import inverse
from softshadow.programs.lighting import eye_normals
from softshadow.programs.texture_coordinates import (
    Normals,
    needs_normals,
    reflections,
    reflects_r,
    sphere_map,
    texture_coordinates,
    transform,
)
from softshadow.state import Lighting, TexGen, TextureUnit

COUNT = 300
MODES_FROM_NORMALS = [
    (gl.GL_SPHERE_MAP, gl.GL_SPHERE_MAP),
    (gl.GL_REFLECTION_MAP, gl.GL_REFLECTION_MAP, gl.GL_REFLECTION_MAP),
    (gl.GL_NORMAL_MAP, gl.GL_NORMAL_MAP, gl.GL_NORMAL_MAP),
    (gl.GL_SPHERE_MAP, gl.GL_REFLECTION_MAP, gl.GL_REFLECTION_MAP),
]


def vertices(rng: np.random.Generator, modelview: np.ndarray, texture_matrix: np.ndarray) -> VertexInputs:
    position = rng.normal(0, 2, (COUNT, 4)).astype(np.float32)
    position[:, 3] = 1
    texcoord = rng.normal(size=(COUNT, 4)).astype(np.float32)
    identity = np.eye(4, dtype=np.float32)
    return VertexInputs(
        position, np.ones_like(position), position[:, :3], (texcoord,), modelview, identity, (texture_matrix,), {}
    )


def modelviews(rng: np.random.Generator) -> dict[str, np.ndarray]:
    affine = np.eye(4, dtype=np.float32)
    affine[:3] = rng.normal(size=(3, 4))
    scale = np.diag(np.float32([2, 0.5, 3, 1]))
    return {"identity": np.eye(4, dtype=np.float32), "affine": affine, "scale": scale}


@pytest.mark.mesa
@pytest.mark.parametrize("mode", [gl.GL_OBJECT_LINEAR, gl.GL_EYE_LINEAR], ids=gl.token_name)
@pytest.mark.parametrize("kind", ["identity", "affine", "scale"])
def test_generated_coordinates_are_mesas(kind, mode):
    rng = np.random.default_rng(21)
    modelview, texture_matrix = modelviews(rng)[kind], rng.normal(size=(4, 4)).astype(np.float32)
    planes = rng.normal(size=(4, 4)).astype(np.float32)
    inputs = vertices(rng, modelview, texture_matrix)

    def setup(on: Any) -> None:
        load(on, on.GL_TEXTURE, texture_matrix)
        load(on, on.GL_MODELVIEW, modelview)  # eye planes are transformed when they are set
        plane = on.GL_OBJECT_PLANE if mode == gl.GL_OBJECT_LINEAR else on.GL_EYE_PLANE
        for name, values in zip("STRQ", planes, strict=True):
            on.glTexGeni(getattr(on, f"GL_{name}"), on.GL_TEXTURE_GEN_MODE, mode)
            on.glTexGenfv(getattr(on, f"GL_{name}"), plane, values)
            on.glEnable(getattr(on, f"GL_TEXTURE_GEN_{name}"))

    to_object = inverse(modelview)
    eye_planes = [
        tuple(((p[0] * to_object[0] + p[1] * to_object[1]) + p[2] * to_object[2]) + p[3] * to_object[3]) for p in planes
    ]
    gens = [TexGen(True, mode, tuple(p), e) for p, e in zip(planes.tolist(), eye_planes, strict=True)]
    unit = TextureUnit(enabled_2d=True, gen=(gens[0], gens[1], gens[2], gens[3]))
    arrays = {"vertex": inputs.position, "texcoord": inputs.texcoords[0]}
    _, theirs = vertices_on_mesa(setup, arrays, modelview)
    assert same_bits(texture_coordinates(0, unit, inputs), theirs)


def test_components_without_generation_keep_what_was_given():
    inputs = vertices(np.random.default_rng(1), np.eye(4, dtype=np.float32), np.eye(4, dtype=np.float32))
    s, t, r, q = TextureUnit().gen
    unit = TextureUnit(gen=(replace(s, enabled=True, mode=gl.GL_OBJECT_LINEAR, object_plane=(0, 0, 0, 7)), t, r, q))
    coordinates = texture_coordinates(0, unit, inputs)
    assert (coordinates[:, 0] == 7).all()
    assert (coordinates[:, 1:] == inputs.texcoords[0][:, 1:]).all()


@pytest.mark.mesa
@pytest.mark.thin(2)
@pytest.mark.parametrize("modes", MODES_FROM_NORMALS, ids=lambda modes: "-".join(map(gl.token_name, modes)))
@pytest.mark.parametrize("normals", ["plain", "normalize", "rescale_normal"])
@pytest.mark.parametrize("kind", ["identity", "affine", "scale"])
def test_coordinates_from_normals_are_mesas(kind, normals, modes):
    rng = np.random.default_rng(22)
    modelview = modelviews(rng)[kind]
    inputs = replace(vertices(rng, modelview, np.eye(4, dtype=np.float32)), normal=normals_of(rng))

    def setup(on: Any) -> None:
        if normals != "plain":
            on.glEnable(getattr(on, f"GL_{normals.upper()}"))
        for name, mode in zip("STR", modes, strict=False):
            on.glTexGeni(getattr(on, f"GL_{name}"), on.GL_TEXTURE_GEN_MODE, mode)
            on.glEnable(getattr(on, f"GL_TEXTURE_GEN_{name}"))

    lighting = Lighting(normalize=normals == "normalize", rescale_normal=normals == "rescale_normal")
    gens = [TexGen(True, mode) for mode in modes] + [TexGen()] * (4 - len(modes))
    unit = TextureUnit(enabled_2d=True, gen=(gens[0], gens[1], gens[2], gens[3]))
    arrays = {"vertex": inputs.position, "texcoord": inputs.texcoords[0], "normal": inputs.normal}
    _, theirs = vertices_on_mesa(setup, arrays, modelview)
    assert same_bits(
        texture_coordinates(0, unit, inputs, Normals(eye_normals(lighting, inputs), reflects_r(unit))), theirs
    )


def normals_of(rng: np.random.Generator) -> np.ndarray:
    return rng.normal(size=(COUNT, 3)).astype(np.float32)


def test_a_mirror_sends_an_eye_ray_back_along_its_normal():
    position, normal = np.array([[0, 0, -2, 1]], np.float32), np.array([[0, 0, 1]], np.float32)
    assert reflections(position, normal).tolist() == [[0, 0, 1]]
    assert sphere_map(position, Normals(normal, False))[:, :2].tolist() == [[0.5, 0.5]]


def test_only_units_that_ask_for_them_need_normals():
    s, t, r, q = TextureUnit().gen
    assert not needs_normals(TextureUnit(gen=(replace(s, mode=gl.GL_SPHERE_MAP), t, r, q)))
    assert needs_normals(TextureUnit(gen=(replace(s, mode=gl.GL_SPHERE_MAP, enabled=True), t, r, q)))


@pytest.mark.interpreted
@pytest.mark.parametrize("real", [np.float32, np.float64])
@pytest.mark.parametrize(("rows", "columns"), [(4, 4), (3, 3), (3, 4), (4, 3)])
def test_products_add_columns_from_x_to_w(rows, columns, real):
    rng = np.random.default_rng(rows + columns)
    matrix, vectors = rng.normal(0, 1, (rows, columns)).astype(real), rng.normal(0, 1, (50, columns)).astype(real)
    vectors[:8] = rng.choice([0, -0.0, np.inf, 1e30], (8, columns))
    with np.errstate(all="ignore"):
        expected = vectors[:, :1] * matrix[:, 0]
        for c in range(1, columns):
            expected = expected + vectors[:, c : c + 1] * matrix[:, c]
        result = transform(matrix, vectors)
    assert result.dtype == real
    assert np.array_equal(result, expected, equal_nan=True)
    assert (np.signbit(result) == np.signbit(expected))[~np.isnan(expected)].all()
