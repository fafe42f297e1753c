"""Programs of the penumbra wedges: comparison with their GLSL on Mesa bit for bit, and with the areas in float64."""

from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, SIDE, fragments_on_mesa, load, pixel_centers, same_bits
from softshadow import programs
from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.programs import VertexInputs
from softshadow.programs.wedge import angle
from softshadow.scene import Disc, Light, LightShape, Rectangle, Segment, Sphere
from softshadow.scene.light_coverage import edge_shares, is_inside
from softshadow.techniques.wedge_passes import shape_uniforms
from softshadow.texture import Sampler, Texture

IDENTITY = np.eye(4, dtype=np.float32)
SHAPES: list[LightShape] = [
    Rectangle((1.2, 0.1, 0), (-0.05, 0.6, 0)),
    Disc(0.7, (0.2, 0.3, 1)),
    Sphere(0.8),
    Segment((0.9, 0.4, -0.3)),
]
EDGE_ROW = 1 / (2 * SIDE)


def drawn_edges(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points (POINTS, 3) and edges (POINTS, 2, 3) relative to a light; three in four cross its image."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(POINTS, 3)) * [1, 1, 0.5] + [0, 0, -4]
    edges = rng.normal(size=(POINTS, 2, 3)) * 0.6
    edges += 0.5 * points[:, None]
    edges[: POINTS // 8] = rng.normal(size=(POINTS // 8, 2, 3)) * 3  # anywhere: behind the point, beyond the light
    return points.astype(np.float32), edges.astype(np.float32)


def texture(cells: np.ndarray) -> Texture:
    image = Image.new(FORMATS[gl.GL_RGBA32F], cells.shape[1], cells.shape[0])
    image.view[:] = cells
    sampler = Sampler(gl.GL_NEAREST, gl.GL_NEAREST, gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP_TO_EDGE)
    return Texture(1, gl.GL_TEXTURE_2D, sampler, {(0, 0): image})


def cells_of(points: np.ndarray, edges: np.ndarray) -> dict[str, np.ndarray]:
    stored = np.ones((SIDE, SIDE, 4), np.float32)
    stored[..., :3] = points.reshape(SIDE, SIDE, 3)
    ends = np.zeros((2 * SIDE, SIDE, 4), np.float32)
    ends[0::2, :, :3] = edges[:, 0].reshape(SIDE, SIDE, 3)
    ends[1::2, :, :3] = edges[:, 1].reshape(SIDE, SIDE, 3)
    return {"positions": stored, "edges": ends}


def places() -> tuple[np.ndarray, np.ndarray]:
    """Return vertices at the pixel centres, and texture coordinates of each one's edge; (POINTS, 4)."""
    vertex, texcoord = np.ones((POINTS, 4), np.float32), np.ones((POINTS, 4), np.float32)
    vertex[:, :2] = pixel_centers()
    column, row = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    texcoord[:, 0] = (column.ravel() + 0.5) / SIDE
    texcoord[:, 1] = (row.ravel() * 2 + 0.5) * EDGE_ROW
    return vertex, texcoord


def shaded(name: str, uniforms: dict[str, Any], cells: dict[str, np.ndarray], texcoord: np.ndarray) -> np.ndarray:
    program, empty = programs.get(name), np.zeros((POINTS, 4), np.float32)
    inputs = VertexInputs(places()[0], empty, empty[:, :3], (texcoord,), IDENTITY, IDENTITY, (IDENTITY,), {})
    out = np.empty((4, POINTS), np.float32).T
    textures = {name: texture(array) for name, array in cells.items()}
    values = np.asfortranarray(program.vertex(inputs).values)
    program.shade(values, {**program.uniforms, **uniforms, **textures}, out)
    return out


def on_mesa(name: str, uniforms: dict[str, Any], cells: dict[str, np.ndarray], texcoord: np.ndarray) -> np.ndarray:
    def use_program(on: Any) -> None:
        for mode in (on.GL_MODELVIEW, on.GL_PROJECTION, on.GL_TEXTURE):
            load(on, mode, IDENTITY)
        program = on.program(name)
        on.glUseProgram(program)
        for unit, (sampler, array) in reversed(list(enumerate(cells.items()))):
            on.glActiveTexture(on.GL_TEXTURE0 + unit)
            on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
            for parameter in (on.GL_TEXTURE_MIN_FILTER, on.GL_TEXTURE_MAG_FILTER):
                on.glTexParameteri(on.GL_TEXTURE_2D, parameter, on.GL_NEAREST)
            height, width = array.shape[:2]
            size = (on.GL_RGBA32F, width, height, 0, on.GL_RGBA, on.GL_FLOAT)
            on.glTexImage2D(on.GL_TEXTURE_2D, 0, *size, array)
            on.glUniform1i(on.glGetUniformLocation(program, sampler), unit)
        for uniform, value in uniforms.items():
            location = on.glGetUniformLocation(program, uniform)
            on.glUniform3f(location, *value) if isinstance(value, tuple) else on.glUniform1f(location, value)

    return fragments_on_mesa(use_program, {"vertex": places()[0], "texcoord": texcoord})


def uniforms_of(shape: LightShape) -> tuple[str, dict[str, Any]]:
    name = f"wedge-{type(shape).__name__.lower()}"
    return name, {"edgeRow": EDGE_ROW, **shape_uniforms(shape)}


@pytest.mark.mesa
@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_wedge_is_its_glsl_twin(shape: LightShape) -> None:
    name, uniforms = uniforms_of(shape)
    cells = cells_of(*drawn_edges(1))
    ours = shaded(name, uniforms, cells, places()[1])
    assert 0.1 < ours[:, 2].mean() < 1
    assert same_bits(ours, on_mesa(name, uniforms, cells, places()[1]))


@pytest.mark.mesa
@pytest.mark.parametrize("name", ["position", "volume-side", "wedge-visibility"])
def test_the_other_passes_are_their_glsl_twins(name: str) -> None:
    cells, texcoord, uniforms = cells_of(*drawn_edges(2)), places()[1], {}
    if name == "position":
        cells = {}
    if name == "volume-side":
        uniforms = {"edgeRow": EDGE_ROW, "outside": -1.0, "inside": 0.5}
    if name == "wedge-visibility":
        cells = {"coverage": np.random.default_rng(3).uniform(-0.5, 1.5, (SIDE, SIDE, 4)).astype(np.float32)}
        texcoord = np.random.default_rng(4).normal(size=(POINTS, 4)).astype(np.float32)
        uniforms = {"axis": (0.6, 0.0, 0.8), "squared": 0.3}
    ours = shaded(name, uniforms, cells, texcoord)
    assert len(np.unique(ours)) > 1
    assert same_bits(ours, on_mesa(name, uniforms, cells, texcoord))


@pytest.mark.interpreted
@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_shares_are_the_areas_in_float64(shape: LightShape) -> None:
    points, edges = drawn_edges(5)
    name, uniforms = uniforms_of(shape)
    taken, given, meets, share = shaded(name, uniforms, cells_of(points, edges), places()[1]).T
    light = Light((0, 0, 0), shape=shape)
    exact = np.array([edge_shares(edges[n : n + 1], light, points[n])[0] for n in range(POINTS)])
    assert (share == taken - given).all()
    assert (meets[exact != 0] == 1).mean() > 0.99  # or rounding decides whether a tip is on the light
    assert np.abs(share - exact).max() < 1e-5
    inside = np.array([is_inside(edges[n : n + 1], points[n])[0] for n in range(POINTS)])
    assert not taken[inside].any()
    assert not given[~inside].any()


@pytest.mark.interpreted
def test_the_angle_is_right_to_float_precision() -> None:
    angles = np.linspace(0, np.pi, 2001)
    computed = [float(angle(np.float32(np.sin(a)), np.float32(np.cos(a)))) for a in angles]
    assert np.abs(computed - angles).max() < 5e-7
