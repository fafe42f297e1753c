"""The built-in programs: examples, and comparison with their GLSL on Mesa, bit for bit."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, fragments_on_mesa, load, pixel_centers, same_bits
from softshadow import programs
from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.image import FORMATS, Image
from softshadow.programs import VertexInputs
from softshadow.texture import Sampler, Texture

IDENTITY = np.eye(4, dtype=np.float32)
D24 = np.float32(2**24 - 1)


def points(seed: int) -> VertexInputs:
    """Return one vertex for each pixel, with identity matrices."""
    rng = np.random.default_rng(seed)
    position = np.ones((POINTS, 4), np.float32)
    position[:, :2], position[:, 2] = pixel_centers(), rng.uniform(-1, 1, POINTS)
    normal = rng.normal(size=(POINTS, 3)).astype(np.float32)
    return VertexInputs(position, rng.random((POINTS, 4), np.float32), normal, (), IDENTITY, IDENTITY, (), {})


def shaded(name: str, vertices: VertexInputs, uniforms: dict[str, Any]) -> np.ndarray:
    program = programs.get(name)
    uniforms = {**program.uniforms, **uniforms}
    out = np.empty((4, len(vertices.position)), np.float32).T  # stored column by column, as in the pipeline
    inputs = replace(vertices, uniforms=uniforms)
    program.shade(np.asfortranarray(program.vertex(inputs).values), uniforms, out)
    return out


def shaded_on_mesa(name: str, vertices: VertexInputs, uniforms: dict[str, Any], setup: Any) -> np.ndarray:
    def use_program(on: Any) -> None:
        setup(on)
        load(on, on.GL_MODELVIEW, vertices.modelview)
        load(on, on.GL_PROJECTION, vertices.projection)
        program = on.program(name)
        on.glUseProgram(program)
        for uniform, value in uniforms.items():
            location = on.glGetUniformLocation(program, uniform)
            if isinstance(value, np.ndarray):
                on.glUniformMatrix4fv(location, 1, on.GL_FALSE, np.ascontiguousarray(value.T))
            elif isinstance(value, tuple):
                getattr(on, f"glUniform{len(value)}f")(location, *value)
            elif isinstance(value, float):
                on.glUniform1f(location, value)

    arrays = {"vertex": vertices.position, "color": vertices.color, "normal": vertices.normal}
    return fragments_on_mesa(use_program, arrays)


def depth_map(cells: np.ndarray, filter_name: int = gl.GL_NEAREST) -> Texture:
    image = Image.new(FORMATS[gl.GL_DEPTH_COMPONENT24], cells.shape[1], cells.shape[0])
    image.view[:] = cells
    sampler = Sampler(min_filter=filter_name, mag_filter=filter_name)
    return Texture(1, gl.GL_TEXTURE_2D, sampler, {(0, 0): image})


def lit(texture_coordinate: tuple[float, ...], bias: float = 0.0) -> bool:
    """Return whether the point at map coordinates (s, t, p, q) is lit; the map holds the depth 0.5."""
    white = np.ones((1, 4), np.float32)
    one = VertexInputs(np.float32([texture_coordinate]), white, white[:, :3], (), IDENTITY, IDENTITY, (), {})
    half = depth_map(np.full((1, 1), np.rint(D24 / 2), np.float32))
    return bool(shaded("shadow-map", one, {"shadowMap": half, "bias": bias})[0, 0] == 1)


def test_shadow_map_compares_the_projected_depth():
    assert lit((0.5, 0.5, 0.4, 1))
    assert not lit((0.5, 0.5, 0.6, 1))
    assert lit((1.0, 1.0, 0.8, 2))
    assert lit((0.5, 0.5, 0.505, 1), bias=0.01)


def test_shadow_map_leaves_what_the_light_does_not_see_lit():
    assert lit((1.5, 0.5, 0.9, 1))
    assert lit((0.5, -0.1, 0.9, 1))
    assert lit((-0.5, -0.5, -0.9, -1))
    assert lit((0.5, 0.5, 0.9, 0))


def texture_of(depths: np.ndarray, filter_name: int) -> Any:
    """Return the calls that bind a square depth texture."""

    def setup(on: Any) -> None:
        on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
        formats = on.GL_DEPTH_COMPONENT24, *depths.shape, 0, on.GL_DEPTH_COMPONENT, on.GL_FLOAT
        on.glTexImage2D(on.GL_TEXTURE_2D, 0, *formats, depths)
        on.glTexParameteri(on.GL_TEXTURE_2D, on.GL_TEXTURE_MIN_FILTER, filter_name)
        on.glTexParameteri(on.GL_TEXTURE_2D, on.GL_TEXTURE_MAG_FILTER, filter_name)

    return setup


@pytest.mark.mesa
@pytest.mark.parametrize("filter_name", [gl.GL_NEAREST, gl.GL_LINEAR], ids=gl.token_name)
def test_shadow_map_is_its_glsl_twin(filter_name):
    for seed in range(3):
        rng, vertices = np.random.default_rng(seed), points(seed)
        depths = rng.random((16, 16), np.float32)
        light_matrix = rng.normal(0, 0.5, (4, 4)).astype(np.float32)
        light_matrix[:, 3] += (0.5, 0.5, 0.5, 1.5)

        model_matrix = rng.normal(0, 0.3, (4, 4)).astype(np.float32) + IDENTITY
        matrices = {"lightMatrix": light_matrix} | ({"modelMatrix": model_matrix} if seed else {})
        uniforms = {**matrices, "bias": 0.01, "ambient": (0.3, 0.2, 0.1, 1.0)}
        ours = shaded("shadow-map", vertices, {**uniforms, "shadowMap": depth_map(np.floor(depths * D24), filter_name)})
        assert 0 < (ours != vertices.color).any(axis=1).mean() < 1
        assert same_bits(ours, shaded_on_mesa("shadow-map", vertices, uniforms, texture_of(depths, filter_name)))


@pytest.mark.mesa
@pytest.mark.parametrize("light", [(1.0, 2.0, 3.0, 0.0), (1.0, 2.0, 3.0, 1.0), (1.0, -2.0, 3.0, 0.5)])
@pytest.mark.parametrize("shininess", [0.75, 10.0])
def test_blinn_phong_is_its_glsl_twin(light, shininess):
    colors = {"ambient": (0.1, 0.2, 0.3), "diffuse": (0.6, 0.5, 0.4), "specular": (0.3, 0.4, 0.5)}
    uniforms = {"lightPosition": light, "shininess": shininess, **colors}
    vertices = points(7)
    assert same_bits(
        shaded("blinn-phong", vertices, uniforms), shaded_on_mesa("blinn-phong", vertices, uniforms, lambda on: None)
    )


@pytest.mark.mesa
@pytest.mark.parametrize("name", ["blinn-phong-shadowed", "blinn-phong-shadowed-5x5"])
@pytest.mark.parametrize("filter_name", [gl.GL_NEAREST, gl.GL_LINEAR], ids=gl.token_name)
def test_blinn_phong_under_a_shadow_map_is_its_glsl_twin(name, filter_name):
    for seed in range(3):
        rng, vertices = np.random.default_rng(seed), points(seed)
        depths = rng.random((16, 16), np.float32)
        light_matrix = rng.normal(0, 0.5, (4, 4)).astype(np.float32)
        light_matrix[:, 3] += (0.5, 0.5, 0.5, 1.5)
        colors = {"ambient": (0.1, 0.2, 0.3), "diffuse": (0.6, 0.5, 0.4), "specular": (0.3, 0.4, 0.5)}
        light = {"lightPosition": (1.0, 2.0, 3.0, 1.0), "shininess": 10.0}
        model_matrix = np.float32([[1, 0.1, 0, 0.2], [0, 1, 0.3, 0], [0.2, 0, 0.9, 0.1], [0, 0, 0, 1]])
        uniforms = {
            **colors,
            **light,
            "lightMatrix": light_matrix,
            "modelMatrix": model_matrix,
            "bias": 0.01,
            "texel": 1 / 16,
        }
        ours = shaded(name, vertices, {**uniforms, "shadowMap": depth_map(np.floor(depths * D24), filter_name)})
        without = shaded("blinn-phong", vertices, {**colors, **light})
        assert 0 < (ours != without).any(axis=1).mean() < 1
        assert same_bits(ours, shaded_on_mesa(name, vertices, uniforms, texture_of(depths, filter_name)))


@pytest.mark.mesa
@pytest.mark.parametrize("name", ["shadow-map", "blinn-phong-shadowed", "blinn-phong-shadowed-5x5"])
@pytest.mark.parametrize("q", [1.1, 2.7, 4.3])
def test_coordinates_on_edges_of_texels_find_the_texels_of_mesa(name, q):
    rng, vertices = np.random.default_rng(5), points(5)
    depths = rng.random((32, 32), np.float32)
    # s / q is k / 32 but for the last bit: pixel centres are edges of texels
    uniforms: dict[str, Any] = {"lightMatrix": np.eye(4, dtype=np.float32) * np.float32(q), "bias": 0.0}
    if name != "shadow-map":
        uniforms |= {"texel": 1 / 32, "ambient": (0.1, 0.2, 0.3), "diffuse": (0.6, 0.5, 0.4)}
        uniforms |= {"lightPosition": (1.0, 2.0, 3.0, 1.0), "shininess": 10.0, "specular": (0.3, 0.4, 0.5)}
    else:
        uniforms |= {"ambient": (0.3, 0.2, 0.1, 1.0)}
    ours = shaded(name, vertices, {**uniforms, "shadowMap": depth_map(np.floor(depths * D24))})
    assert same_bits(ours, shaded_on_mesa(name, vertices, uniforms, texture_of(depths, gl.GL_NEAREST)))


def test_what_no_map_shadows_is_lit_as_without_one():
    vertices = points(3)
    light = {"lightPosition": (1.0, 2.0, 3.0, 1.0), "shininess": 10.0, "specular": (0.3, 0.4, 0.5)}
    far = depth_map(np.full((1, 1), D24, np.float32))
    lit = shaded("blinn-phong-shadowed", vertices, {**light, "shadowMap": far, "bias": 1.0})
    np.testing.assert_array_equal(lit, shaded("blinn-phong", vertices, light))


def test_an_unknown_program_names_the_nearest():
    with pytest.raises(StateError, match="shadow-map"):
        programs.get("shadow-mop")
