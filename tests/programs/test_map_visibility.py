"""Programs that write visibility: examples, and comparison with their GLSL on Mesa, bit for bit."""

from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, fragments_on_mesa, load, pixel_centers, same_bits
from programs.test_builtin import D24, IDENTITY, depth_map, texture_of
from softshadow import programs
from softshadow import tokens as gl
from softshadow.programs import VertexInputs
from softshadow.programs.texture_coordinates import transform

BOX, BILINEAR, EIGHT = "map-visibility", "map-visibility-bilinear", "map-visibility-8"
SIDE = 16


def coordinates(seed: int) -> np.ndarray:
    """Return homogeneous map coordinates (POINTS, 4), inside and outside the map, some behind the light."""
    rng = np.random.default_rng(seed)
    placed = rng.uniform(-0.2, 1.2, (POINTS, 4)).astype(np.float32)
    placed[:, 3] = rng.uniform(-0.2, 2, POINTS)
    placed[:, :3] *= placed[:, 3:]
    return placed


def visibility(name: str, placed: np.ndarray, uniforms: dict[str, Any]) -> np.ndarray:
    program = programs.get(name)
    empty = np.zeros((len(placed), 4), np.float32)
    inputs = VertexInputs(empty, empty, empty[:, :3], (placed,), IDENTITY, IDENTITY, (IDENTITY,), {})
    out = np.empty_like(empty)
    with np.errstate(all="ignore"):
        program.shade(program.vertex(inputs).values, {**program.uniforms, **uniforms}, out)
    assert (out == out[:, :1]).all()
    return out[:, 0]


def on_mesa(
    name: str, placed: np.ndarray, uniforms: dict[str, Any], setup: Any, matrices: Any = lambda on: None
) -> np.ndarray:
    def use_program(on: Any) -> None:
        setup(on)
        for mode in (on.GL_MODELVIEW, on.GL_PROJECTION, on.GL_TEXTURE):
            load(on, mode, IDENTITY)
        matrices(on)
        program = on.program(name)
        on.glUseProgram(program)
        for uniform, value in uniforms.items():
            location = on.glGetUniformLocation(program, uniform)
            if isinstance(value, tuple):
                on.glUniform3f(location, *value)
            else:
                (on.glUniform1i if isinstance(value, int) else on.glUniform1f)(location, value)

    vertex = np.ones((POINTS, 4), np.float32)
    vertex[:, :2] = pixel_centers()
    return fragments_on_mesa(use_program, {"vertex": vertex, "texcoord": placed})


@pytest.mark.mesa
@pytest.mark.parametrize("radius", [0, 1, 2])
@pytest.mark.parametrize("name", [BOX, BILINEAR])
def test_map_visibility_is_its_glsl_twin(name: str, radius: int) -> None:
    depths = np.random.default_rng(radius).random((SIDE, SIDE), np.float32)
    placed = coordinates(radius)
    uniforms = {"side": float(SIDE), "radius": radius, "bias": 0.01, "behind": 0.25, "cone": 0.3}
    ours = visibility(name, placed, {**uniforms, "shadowMap": depth_map(np.floor(depths * D24))})
    assert len(np.unique(ours)) > (2 if radius == 0 and name == BOX else 8)
    mesa = on_mesa(name, placed, uniforms, texture_of(depths, gl.GL_NEAREST))
    assert same_bits(np.repeat(ours[:, None], 4, axis=1), mesa)


def eight_maps(depths: np.ndarray, maps: int) -> tuple[np.ndarray, list[np.ndarray]]:
    """Return texture matrices (8, 4, 4), and what "map-visibility" finds in each of the first maps."""
    matrices = (np.eye(4) + np.random.default_rng(maps).normal(0, 0.2, (8, 4, 4))).astype(np.float32)
    uniforms = {"side": float(SIDE), "bias": 0.01, "behind": 0.25}
    places = [transform(matrices[i], coordinates(7)) for i in range(maps)]
    found = [
        visibility(BOX, places[i], {**uniforms, "shadowMap": depth_map(np.floor(depths[i] * D24))}) for i in range(maps)
    ]
    return matrices, found


@pytest.mark.mesa
@pytest.mark.parametrize("maps", [1, 3, 8])
def test_eight_maps_give_the_sum_here_and_on_mesa(maps: int) -> None:
    depths = np.random.default_rng(maps).random((8, SIDE, SIDE), np.float32)
    matrices, found = eight_maps(depths, maps)
    expected = np.sum(found, axis=0, dtype=np.float32)
    program = programs.get(EIGHT)
    placed, empty = coordinates(7), np.zeros((POINTS, 4), np.float32)
    uniforms = {"maps": maps, "bias": 0.01, "behind": 0.25, **{f"shadowMap{i}": i for i in range(8)}}
    textures = {f"shadowMap{i}": depth_map(np.floor(depths[i] * D24)) for i in range(8)}
    inputs = VertexInputs(empty, empty, empty[:, :3], (placed,), IDENTITY, IDENTITY, tuple(matrices), uniforms)
    ours = np.empty_like(empty)
    with np.errstate(all="ignore"):
        program.shade(program.vertex(inputs).values, {**program.uniforms, **uniforms, **textures}, ours)
    assert same_bits(ours, np.repeat(expected[:, None], 4, axis=1))

    def setup(on: Any) -> None:
        for unit in reversed(range(8)):
            on.glActiveTexture(on.GL_TEXTURE0 + unit)
            texture_of(depths[unit], gl.GL_NEAREST)(on)

    def matrices_too(on: Any) -> None:
        for unit in reversed(range(8)):
            on.glActiveTexture(on.GL_TEXTURE0 + unit)
            load(on, on.GL_TEXTURE, matrices[unit])

    assert same_bits(ours, on_mesa(EIGHT, placed, uniforms, setup, matrices_too))


@pytest.mark.parametrize("radius", [0, 1, 2])
def test_box_has_as_many_steps_as_texels(radius: int) -> None:
    depths = np.random.default_rng(4).random((SIDE, SIDE)) * D24
    share = visibility(BOX, coordinates(4), {"side": float(SIDE), "radius": radius, "shadowMap": depth_map(depths)})
    texels = (2 * radius + 1) ** 2
    assert set(np.unique(share)) <= set((np.arange(texels + 1) / np.float32(texels)).astype(np.float32))


@pytest.mark.parametrize("radius", [0, 1, 2])
def test_bilinear_ramp_over_an_edge_is_linear_and_as_wide_as_the_kernel(radius: int) -> None:
    cells = np.full((SIDE, SIDE), D24)
    cells[:, : SIDE // 2] = 0  # near on the left
    s = np.linspace(0.2, 0.8, 301).astype(np.float32)
    placed = np.stack([s, np.full_like(s, 0.47), np.full_like(s, 0.5), np.ones_like(s)], axis=1)
    share = visibility(BILINEAR, placed, {"side": float(SIDE), "radius": radius, "shadowMap": depth_map(cells)})
    width = (2 * radius + 1) / SIDE
    # sums of a few float32 weights
    assert share == pytest.approx(np.clip((s - 0.5) / width + 0.5, 0, 1), abs=1e-6)


@pytest.mark.parametrize("name", [BOX, BILINEAR])
def test_visibility_never_grows_with_the_depth_of_the_receiver(name: str) -> None:
    cells = np.random.default_rng(5).random((SIDE, SIDE)) * D24
    uniforms = {"side": float(SIDE), "radius": 1, "shadowMap": depth_map(cells)}
    placed = coordinates(5)
    before = placed[:, 3] > 0
    shares = []
    for depth in np.linspace(0, 1, 9, dtype=np.float32):
        placed[:, 2] = depth * placed[:, 3]
        shares.append(visibility(name, placed, uniforms)[before])
    # a sum of weights is rounded, the more of them the more
    assert (np.diff(shares, axis=0) <= 1e-6).all()
    assert (shares[0] > shares[-1]).any()


def test_what_lies_beyond_the_far_plane_is_compared_as_if_on_it() -> None:
    empty = depth_map(np.full((SIDE, SIDE), D24))
    placed = np.array([[0.5, 0.5, 1.5, 1]], np.float32)
    assert visibility(BOX, placed, {"side": float(SIDE), "shadowMap": empty})[0] == 1
