"""The fixed function as one program: the columns of its vertex stage, and the order of its fragment stage."""

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.programs import VertexInputs, fixed_function
from softshadow.state import Fog, Lighting, State, TextureUnit
from softshadow.texture import Sampler, Texture

IDENTITY = np.eye(4, dtype=np.float32)


def vertices(real: Any = np.float32) -> VertexInputs:
    position = np.array([[0, 0, -2, 1], [1, 0, -3, 1], [0, 1, -4, 1]], real)
    color = np.array([[2, 0.5, -1, 1], [0, 1, 0, 1], [0, 0, 1, 0.5]], real)
    texcoords = tuple(np.full((3, 4), unit + 1, real) for unit in range(2))
    matrix = np.eye(4, dtype=real)
    return VertexInputs(position, color, position[:, :3], texcoords, matrix, matrix, (matrix, matrix), {})


def white(*color: int) -> Texture:
    image = Image.new(FORMATS[gl.GL_RGBA8], 1, 1)
    image.view[:] = color or (255, 255, 255, 255)
    return Texture(1, gl.GL_TEXTURE_2D, Sampler(min_filter=gl.GL_LINEAR), {(0, 0): image})


def units(*enabled: TextureUnit) -> State:
    return State(units=(*enabled, *State().units[len(enabled) :]))


def bound(textures: dict[int, Texture]) -> dict[tuple[int, int], Texture]:
    return {(unit, gl.GL_TEXTURE_2D): texture for unit, texture in textures.items()}


ON = TextureUnit(enabled_2d=True, bound_2d=1)


def test_without_texture_the_columns_are_the_clamped_colour():
    varyings = fixed_function.program(State(), {}).vertex(vertices())
    assert varyings.values.tolist() == [[1, 0.5, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0.5]]
    assert not varyings.flat.any()
    assert varyings.back is None


def test_units_and_fog_follow_the_colour():
    state = replace(units(ON, TextureUnit(), ON), fog=Fog(True))
    inputs = replace(vertices(), texcoords=(*vertices().texcoords, np.full((3, 4), 3, np.float32)))
    inputs = replace(inputs, texture_matrices=(IDENTITY,) * 3)
    values = fixed_function.program(state, bound({0: white(), 2: white()})).vertex(inputs).values
    assert values.shape == (3, 4 + 4 + 4 + 1)
    assert (values[:, 4:8] == 1).all()
    assert (values[:, 8:12] == 3).all()
    assert values[:, 12].tolist() == [2, 3, 4]


def test_flat_shading_marks_the_colour_only():
    state = replace(units(ON), lighting=Lighting(shade_model=gl.GL_FLAT))
    program = fixed_function.program(state, bound({0: white()}))
    assert program.vertex(vertices()).flat.tolist() == [True] * 4 + [False] * 4


def test_units_work_one_after_the_other():
    state = units(replace(ON, env_mode=gl.GL_REPLACE), ON)
    program = fixed_function.program(state, bound({0: white(255, 0, 255, 255), 1: white(51, 51, 51, 255)}))
    out = np.empty((3, 4), np.float32)
    program.shade(program.vertex(vertices()).values, {}, out)
    assert np.allclose(out, (0.2, 0, 0.2, 1))


def test_an_incomplete_texture_switches_its_unit_off():
    mipmapped = white()
    mipmapped.images[0, 0] = Image.new(FORMATS[gl.GL_RGBA8], 2, 2)
    mipmapped.sampler = Sampler()  # GL's initial filter needs all levels
    program = fixed_function.program(units(ON), bound({0: mipmapped}))
    assert program.vertex(vertices()).values.shape == (3, 4)


def test_a_complete_cube_map_comes_before_a_2d_texture():
    one_face = Texture(2, gl.GL_TEXTURE_CUBE_MAP, Sampler(min_filter=gl.GL_NEAREST))
    one_face.images[0, 0] = Image.new(FORMATS[gl.GL_RGBA8], 1, 1)
    textures = {**bound({0: white()}), (0, gl.GL_TEXTURE_CUBE_MAP): one_face}
    state = units(replace(ON, enabled_cube=True))
    assert [used.texture.name for used in fixed_function.units_in_use(state, textures)] == [1]
    one_face.images.update({(face, 0): one_face.images[0, 0] for face in range(6)})
    assert [used.texture.name for used in fixed_function.units_in_use(state, textures)] == [2]
    assert [used.texture.name for used in fixed_function.units_in_use(units(ON), textures)] == [1]


def test_lit_and_textured_columns_keep_the_precision_of_the_vertices():
    lit = State(lighting=Lighting(enabled=True, two_side=True))
    for real, state in product((np.float32, np.float64), (lit, replace(lit, units=units(ON).units, fog=Fog(True)))):
        program = fixed_function.program(state, bound({0: white()}))
        varyings = program.vertex(vertices(real))
        assert varyings.back is not None
        out = np.empty((3, 4), real)
        program.shade(varyings.values, {}, out)
        assert (varyings.values.dtype, varyings.back.dtype) == (real, real)
