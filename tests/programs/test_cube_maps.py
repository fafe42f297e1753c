"""Cube maps: faces by GL's table, edges by geometry, and filters, levels of detail and programs against Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa_points import same_bits
from oracle import cube as oracle
from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.programs import Program, Varyings, VertexInputs, cube_filtering, cube_maps, register, sampling
from softshadow.programs.level_of_detail import bias_of
from softshadow.testing import compare
from softshadow.texture import Sampler, Texture

SIZE = (40, 33)
FACES = ("POSITIVE_X", "NEGATIVE_X", "POSITIVE_Y", "NEGATIVE_Y", "POSITIVE_Z", "NEGATIVE_Z")
FILTERS = ("GL_NEAREST", "GL_LINEAR")
MIN_FILTERS = FILTERS + tuple(f"{within}_MIPMAP_{between}" for within in FILTERS for between in ("NEAREST", "LINEAR"))


def directions(seed: int, count: int, columns: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(count, columns)).astype(np.float32)


# -- faces -------------------------------------------------------------------------------------------------------------
@pytest.mark.interpreted
def test_faces_and_places_are_the_oracles():
    vectors = directions(1, 200, 4)
    faces, places = cube_maps.on_faces(vectors, False)
    for direction, face, place in zip(vectors, faces, places, strict=True):
        assert (face, *place) == (*oracle.on_face(direction[:3]), direction[3])


def test_a_direction_meets_its_place_on_the_cube():
    vectors = directions(2, 200)
    for by_reciprocal in (False, True):
        faces, places = cube_maps.on_faces(vectors, by_reciprocal)
        met = [oracle.point(face, s, t) for face, (s, t, _) in zip(faces, places, strict=True)]
        assert np.allclose(met, vectors / abs(vectors).max(axis=1, keepdims=True), atol=1e-6)  # float32 against float64


def test_equal_components_prefer_z_then_y():
    corners = np.float32([[1, 1, 1], [1, 1, 0], [-1, 1, 0.5], [1, 0, -1], [0, 0, 0]])
    assert cube_maps.on_faces(corners, False)[0].tolist() == [4, 2, 2, 5, 4]


def test_a_direction_of_length_0_is_in_the_middle_of_a_face():
    faces, places = cube_maps.on_faces(np.zeros((1, 3), np.float32), False)
    assert (faces[0], places[0].tolist()) == (4, [0.5, 0.5, 0])


@pytest.mark.interpreted
def test_a_step_is_measured_on_the_pixels_own_face():
    """Return a block of directions along +z; each pixel is a quarter of a face to the right and half a face down."""
    block = np.float32([[x, y, 1] for y in (0.0, -1.0) for x in (0.0, 0.5)])
    squared = cube_maps.squared_texels_per_pixel(block, 8)
    assert squared[0] == 4**2  # half a face of 8 texels
    across = np.float32([[1, 0, 0], [0, 0, 1], [1, 0, 0], [0, 0, 1]])
    assert np.isfinite(cube_maps.squared_texels_per_pixel(across, 8)).all()


# -- edges -------------------------------------------------------------------------------------------------------------
@pytest.mark.interpreted
@pytest.mark.parametrize("face", range(6))
@pytest.mark.parametrize("edge", range(4))
def test_the_texel_beyond_an_edge_is_the_one_that_touches_it(edge, face):
    size = 4
    for along in range(size):
        x, y = ((-1, along), (size, along), (along, -1), (along, size))[edge]
        assert cube_filtering.on_next_face(edge, face, along, size - 1) == oracle.beyond(face, x, y, size)


@pytest.mark.interpreted
def test_seamless_filters_are_the_oracles():
    cells = np.random.default_rng(4).integers(0, 256, (6, 3, 3, 4), dtype=np.uint8)
    cube_map = make_cube_map(cells, min_filter=gl.GL_LINEAR, mag_filter=gl.GL_LINEAR, seamless=1)
    vectors = np.array([d for d in directions(5, 400) if not oracle.reaches_a_corner(d, 3)][:200])
    colors = cells.astype(np.float32) * (np.float32(1) / np.float32(255))
    for direction, color in zip(vectors, sampled(cube_map, vectors), strict=True):
        assert same_bits(color, oracle.sample_seamlessly(colors, direction))


def make_cube_map(cells: np.ndarray, **parameters: Any) -> Texture:
    """Return a cube map of one level with cells (6, n, n, 4)."""
    images = {}
    for face, texels in enumerate(cells):
        images[face, 0] = Image.new(FORMATS[gl.GL_RGBA8], texels.shape[1], texels.shape[0])
        images[face, 0].view[:] = texels
    return Texture(1, gl.GL_TEXTURE_CUBE_MAP, Sampler(**parameters), images)


def sampled(cube_map: Texture, vectors: np.ndarray) -> np.ndarray:
    out = np.empty((len(vectors), 4), np.float32)
    sampling.sample(cube_map, vectors, out)
    return out


def test_a_seamless_filter_meets_in_the_middle_of_an_edge():
    cells = np.zeros((6, 4, 4, 4), np.uint8)
    cells[0] = 255
    edge = np.float32([[1, 0.1, 1]] * 4)  # between +x and +z
    for seamless, value in ((0, 0.0), (1, 0.5)):
        cube_map = make_cube_map(cells, min_filter=gl.GL_LINEAR, mag_filter=gl.GL_LINEAR, seamless=seamless)
        assert sampled(cube_map, edge)[0, 0] == value


def test_a_corner_is_the_mean_of_three_texels():
    cells = np.zeros((6, 4, 4, 4), np.uint8)
    cells[0], cells[2], cells[4] = 255, 0, 0
    cube_map = make_cube_map(cells, min_filter=gl.GL_LINEAR, mag_filter=gl.GL_LINEAR, seamless=1)
    assert np.isclose(sampled(cube_map, np.float32([[1, 1, 1]] * 4))[0, 0], 1 / 3)


def test_cube_maps_are_complete_with_six_square_faces_of_one_size_and_format():
    whole = make_cube_map(np.zeros((6, 2, 2, 4), np.uint8), min_filter=gl.GL_LINEAR)
    assert sampling.is_complete(whole)
    for spoil in (
        lambda images: images.pop((3, 0)),
        lambda images: images.update({(5, 0): Image.new(FORMATS[gl.GL_RGBA8], 1, 1)}),
        lambda images: images.update({(1, 0): Image.new(FORMATS[gl.GL_RGB8], 2, 2)}),
        lambda images: images.update({(1, 0): Image.new(FORMATS[gl.GL_RGBA8], 2, 2, gl.GL_RGBA)}),
    ):
        spoiled = whole.copy()
        spoil(spoiled.images)
        assert not sampling.is_complete(spoiled)


def test_the_biases_of_texture_and_unit_are_added_up():
    assert bias_of(Sampler(lod_bias=0.5, unit_lod_bias=0.25)) == 0.75


# -- Mesa --------------------------------------------------------------------------------------------------------------
def upload(on: Any, rng: np.random.Generator, side: int, depths: bool = False) -> None:
    """Define all levels of the bound cube map."""
    for face in FACES:
        target, size, level = getattr(on, f"GL_TEXTURE_CUBE_MAP_{face}"), side, 0
        while size:
            if depths:
                layout = on.GL_DEPTH_COMPONENT24, size, size, 0, on.GL_DEPTH_COMPONENT, on.GL_FLOAT
                on.glTexImage2D(target, level, *layout, rng.random((size, size), np.float32))
            else:
                texels = rng.integers(0, 256, (size, size, 4), dtype=np.uint8)
                on.glTexImage2D(target, level, on.GL_RGBA8, size, size, 0, on.GL_RGBA, on.GL_UNSIGNED_BYTE, texels)
            size, level = size // 2, level + 1


def set_filters(on: Any, min_filter: str, mag_filter: str) -> None:
    on.glTexParameteri(on.GL_TEXTURE_CUBE_MAP, on.GL_TEXTURE_MIN_FILTER, getattr(on, min_filter))
    on.glTexParameteri(on.GL_TEXTURE_CUBE_MAP, on.GL_TEXTURE_MAG_FILTER, getattr(on, mag_filter))


def draw_triangles(on: Any, rng: np.random.Generator) -> None:
    """Draw six triangles whose coordinates are close together or on many faces."""
    on.glBegin(on.GL_TRIANGLES)
    for number in range(18):
        if number % 3 == 0:
            middle, spread = rng.normal(size=3), rng.choice([0.05, 0.3, 1, 3])
        on.glTexCoord4f(*(middle + rng.normal(size=3) * spread), rng.choice([1.0, 0.7]))
        on.glVertex4f(*rng.uniform(-1, 1, 3), rng.choice([1.0, 2.0]))
    on.glEnd()


@pytest.mark.thin(5)
@pytest.mark.mesa
@pytest.mark.parametrize("seamless", [False, True])
@pytest.mark.parametrize("mag_filter", FILTERS)
@pytest.mark.parametrize("min_filter", MIN_FILTERS)
def test_filters_are_mesas(min_filter, mag_filter, seamless):
    for seed, side in enumerate((8, 5, 1, 16)):

        def program(on: Any, seed: int = seed, side: int = side) -> None:
            rng = np.random.default_rng(seed)
            if seamless:
                on.glEnable(on.GL_TEXTURE_CUBE_MAP_SEAMLESS)
            upload(on, rng, side)
            set_filters(on, min_filter, mag_filter)
            on.glTexEnvi(on.GL_TEXTURE_ENV, on.GL_TEXTURE_ENV_MODE, on.GL_REPLACE)
            on.glTexEnvf(on.GL_TEXTURE_FILTER_CONTROL, on.GL_TEXTURE_LOD_BIAS, (0.0, -0.7, 1.3)[seed % 3])
            on.glEnable(on.GL_TEXTURE_CUBE_MAP)
            draw_triangles(on, rng)

        assert compare(program, SIZE)


PASS_ON = """#version 130
varying vec4 direction;
void main() { direction = gl_MultiTexCoord0; gl_Position = ftransform(); }
"""
LOOK_UP = """#version 130
uniform samplerCube cube;
varying vec4 direction;
void main() { gl_FragColor = textureCube(cube, direction.xyz); }
"""
COMPARE = """#version 130
uniform samplerCubeShadow cube;
varying vec4 direction;
void main() { gl_FragColor = vec4(texture(cube, direction)); }
"""


def program_of(fragment: str) -> Program:
    """Return a program that looks up a cube map, or compares the fourth coordinate with its depths."""

    def vertex(vertices: VertexInputs) -> Varyings:
        return Varyings(vertices.texcoords[0], np.zeros(4, bool))

    def shade(inputs: np.ndarray, uniforms: Any, out: np.ndarray) -> None:
        sampling.sample(uniforms["cube"], inputs, out)

    sources = {"glsl_vertex": PASS_ON, "glsl_fragment": fragment}
    return Program("cube", vertex, shade, samplers=("cube",), cube_samplers=("cube",), **sources)


@pytest.mark.mesa
@pytest.mark.parametrize("min_filter", MIN_FILTERS)
@pytest.mark.parametrize("fragment", [LOOK_UP, COMPARE], ids=["colours", "depths"])
def test_programs_look_cube_maps_up_as_on_mesa(fragment, min_filter):
    def program(on: Any) -> None:
        register(program_of(fragment))
        rng, compared = np.random.default_rng(3), fragment == COMPARE
        on.glActiveTexture(on.GL_TEXTURE2)
        on.glBindTexture(on.GL_TEXTURE_CUBE_MAP, on.glGenTextures(1))
        upload(on, rng, 8, depths=compared)
        set_filters(on, min_filter, "GL_LINEAR")
        if compared:
            parameter = on.GL_TEXTURE_COMPARE_MODE, on.GL_COMPARE_R_TO_TEXTURE
            on.glTexParameteri(on.GL_TEXTURE_CUBE_MAP, *parameter)
            on.glTexParameteri(on.GL_TEXTURE_CUBE_MAP, on.GL_DEPTH_TEXTURE_MODE, on.GL_INTENSITY)
        number = on.program("cube")
        on.glUseProgram(number)
        on.glUniform1i(on.glGetUniformLocation(number, "cube"), 2)
        draw_triangles(on, rng)

    assert compare(program, SIZE)


@pytest.mark.interpreted
def test_a_block_is_filtered_without_its_neighbours():
    cells = np.random.default_rng(8).integers(0, 256, (6, 4, 4, 4), dtype=np.uint8)
    cube_map = make_cube_map(cells, min_filter=gl.GL_LINEAR, mag_filter=gl.GL_LINEAR, seamless=1)
    vectors = directions(9, 40)
    block_by_block = [sampled(cube_map, vectors[4 * n : 4 * n + 4]) for n in range(10)]
    assert same_bits(sampled(cube_map, vectors), np.concatenate(block_by_block))
