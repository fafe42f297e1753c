"""Level of detail: minification, selected levels and weights by example, and whole draws against Mesa."""

from typing import Any

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.programs.level_of_detail import (
    Levels,
    coarse_log2,
    quantized_bias,
    select_levels,
    squared_texels_per_pixel,
)
from softshadow.testing import compare
from softshadow.texture import Sampler


def block(step: float) -> np.ndarray:
    """Return the coordinates (4, 3) of a block whose s grows by `step` per pixel."""
    return np.float32([[0, 0, 0], [step, 0, 0], [0, 0, 0], [step, 0, 0]])


def levels(step: float, sampler: Sampler, last: int = 3) -> Levels:
    """Return the levels selected in an 8 x 8 texture if s grows by `step` per pixel."""
    return select_levels(squared_texels_per_pixel(block(step), 8, 8), sampler, last)


def minified(step: float, sampler: Sampler) -> bool:
    return bool(levels(step, sampler).minified[0])


def test_one_texel_per_pixel_is_still_magnified():
    assert [minified(texels / 8, Sampler()) for texels in (0.5, 1, 1.01, 3)] == [False, False, True, True]


def test_bias_and_limits_move_the_switch_over():
    assert not minified(1.5 / 8, Sampler(lod_bias=-1.0))
    assert minified(0.9 / 8, Sampler(lod_bias=1.0))
    assert minified(0.1 / 8, Sampler(min_lod=0.5, max_lod=4.0))
    assert not minified(9.0, Sampler(min_lod=0.0, max_lod=0.0))


def test_the_nearest_level_is_selected():
    sampler = Sampler(min_filter=gl.GL_NEAREST_MIPMAP_NEAREST)
    assert [int(levels(texels / 8, sampler).lower[0]) for texels in (0.1, 1, 1.4, 1.5, 2.9, 50)] == [0, 0, 0, 1, 2, 3]


def test_two_levels_are_selected_with_the_weight_of_the_upper():
    sampler = Sampler(min_filter=gl.GL_LINEAR_MIPMAP_LINEAR, lod_bias=0.25)
    selected = [levels(texels / 8, sampler) for texels in (1, 2, 100)]
    assert [(int(f.lower[0]), int(f.upper[0]), float(f.weight[0])) for f in selected] == [
        (0, 1, 0.25), (1, 2, 0.25), (3, 3, 0),
    ]  # fmt: skip


def test_equal_limits_are_the_level():
    sampler = Sampler(min_filter=gl.GL_LINEAR_MIPMAP_LINEAR, min_lod=1.5, max_lod=1.5)
    selected = levels(0.001, sampler)
    assert (int(selected.lower[0]), int(selected.upper[0]), float(selected.weight[0])) == (1, 2, 0.5)


def test_biases_count_in_steps_of_a_256th():
    assert [quantized_bias(b) for b in (0.0019, 0.002, -0.002, 100, -100)] == [0, 1 / 256, -1 / 256, 31, -32]


def test_the_coarse_logarithm_is_exact_at_powers_of_two():
    assert coarse_log2(np.float32([0.25, 1, 2, 64])).tolist() == [-2, 0, 1, 6]
    assert coarse_log2(np.float32([3])).tolist() == [1.5]


def begin_with_texture(gl: Any) -> None:
    """Clear the buffers, set the camera, and bind a new texture."""
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.gluPerspective(50, 1, 1, 20)
    gl.glTranslatef(0, 0, -6)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(8))
def test_two_filters_in_one_draw_are_mesas(seed):
    rng = np.random.default_rng(seed)
    names = ("GL_NEAREST", "GL_LINEAR") if seed % 2 else ("GL_LINEAR", "GL_NEAREST")
    cells = rng.integers(0, 256, (13 if seed % 3 else 16, 16, 4), dtype=np.uint8)
    positions, texcoords = rng.normal(0, 2, (12, 3)), rng.normal(0, 2, (12, 2))
    bias = (0.0, 0.5, -1.25)[seed % 3]

    def program(gl: Any) -> None:
        begin_with_texture(gl)
        size = cells.shape[1], cells.shape[0]
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, *size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, cells)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, getattr(gl, names[0]))
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, getattr(gl, names[1]))
        gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_LOD_BIAS, bias)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glBegin(gl.GL_TRIANGLES)
        for position, texcoord in zip(positions, texcoords, strict=True):
            gl.glTexCoord2f(*texcoord)
            gl.glVertex3f(*position)
        gl.glEnd()

    assert compare(program, (61, 47)).differences == ()


SIDES = ((16, 16), (13, 16), (32, 5), (9, 9), (1, 8), (64, 64))
WRAPS = ("GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_MIRRORED_REPEAT", "GL_CLAMP", "GL_CLAMP_TO_BORDER")
PARAMETERS = {
    "GL_TEXTURE_LOD_BIAS": (0.0, 0.0, 0.5, -1.3, 0.123, 100.0, -100.0),
    "GL_TEXTURE_MIN_LOD": (-1000.0, -1000.0, 0.0, 1.0, 1.5, -2.0, 3.0),
    "GL_TEXTURE_MAX_LOD": (1000.0, 1000.0, 0.0, 1.5, 2.0, -1.0, 3.0),
    "GL_TEXTURE_BASE_LEVEL": (0, 0, 0, 1, 2),
    "GL_TEXTURE_MAX_LEVEL": (1000, 1000, 1, 2, 3),
}


def mipmapped(seed: int, internal: str = "GL_RGBA8") -> Any:
    """Return a GL program that draws triangles with random mipmap levels, filters, wraps, limits and bias."""
    rng = np.random.default_rng(seed)
    pick = lambda choices: choices[int(rng.integers(len(choices)))]  # noqa: E731
    width, height = SIDES[seed % len(SIDES)]
    is_depth = "DEPTH" in internal
    cells = []
    for level in range(max(width, height).bit_length()):
        shape = max(height >> level, 1), max(width >> level, 1)
        colors = rng.integers(0, 256, (*shape, 4), dtype=np.uint8)
        cells.append(rng.random(shape, np.float32) if is_depth else colors)
    positions, texcoords = rng.normal(0, 2, (12, 3)), rng.normal(0, pick((2, 8)), (12, 3))
    min_filter = f"GL_{pick(('NEAREST', 'LINEAR'))}_MIPMAP_{pick(('NEAREST', 'LINEAR'))}"
    settings = {
        "GL_TEXTURE_MIN_FILTER": min_filter,
        "GL_TEXTURE_MAG_FILTER": pick(("GL_NEAREST", "GL_LINEAR")),
        "GL_TEXTURE_WRAP_S": pick(WRAPS) if seed % 3 else "GL_REPEAT",
        "GL_TEXTURE_WRAP_T": pick(WRAPS) if seed % 3 else "GL_REPEAT",
    }
    numbers = {name: pick(choices) for name, choices in PARAMETERS.items()}
    compares = is_depth and seed % 2

    def program(gl: Any) -> None:
        begin_with_texture(gl)
        formats = (gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT) if is_depth else (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        for level, data in enumerate(cells):
            size = data.shape[1], data.shape[0]
            gl.glTexImage2D(gl.GL_TEXTURE_2D, level, getattr(gl, internal), *size, 0, *formats, data)
        for name, value in settings.items():
            gl.glTexParameteri(gl.GL_TEXTURE_2D, getattr(gl, name), getattr(gl, value))
        for name, number in numbers.items():
            gl.glTexParameterf(gl.GL_TEXTURE_2D, getattr(gl, name), number)
        if compares:
            gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, positions.astype(np.float32))
        gl.glTexCoordPointer(3, gl.GL_FLOAT, 0, texcoords.astype(np.float32))
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 12)

    return program


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(40))
def test_mipmapped_triangles_are_mesas(seed):
    assert compare(mipmapped(seed), (61, 47)).differences == ()


@pytest.mark.mesa
@pytest.mark.parametrize("seed", range(100, 112))
def test_triangles_with_mipmapped_depth_are_mesas(seed):
    assert compare(mipmapped(seed, "GL_DEPTH_COMPONENT24"), (61, 47)).differences == ()
