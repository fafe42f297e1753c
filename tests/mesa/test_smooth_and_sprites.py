"""Smooth lines and points, sizes by distance and point sprites are Mesa's."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from mesa.test_stipples import SIZE, primitives, scene
from softshadow.testing import compare

pytestmark = pytest.mark.mesa


def texture(gl: Any, rng: np.random.Generator) -> None:
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    texels = rng.integers(0, 256, (8, 8, 4), dtype=np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 8, 8, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR)


def blend(gl: Any) -> None:
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)


@pytest.mark.parametrize("attenuation", [(1.0, 0.0, 0.0), (0.2, 0.1, 0.3)])
@pytest.mark.parametrize("size", [1.0, 7.3])
def test_smooth_points_are_those_of_mesa(size: float, attenuation: tuple[float, ...]) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(5)
        scene(gl, rng)
        gl.glEnable(gl.GL_POINT_SMOOTH)
        gl.glPointSize(size)
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, attenuation)
        primitives(gl, rng, "GL_POINTS", 2.0)
        blend(gl)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_POINT)
        primitives(gl, rng, "GL_TRIANGLES", 2.0)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert compared.ours.stencil.any()


@pytest.mark.slow
def test_random_smooth_points_of_points_and_polygons_are_those_of_mesa() -> None:
    for seed in range(100):
        compared = compare(random_points(seed), SIZE)
        assert compared, f"seed {seed}: {compared}"


def random_points(seed: int) -> Callable[[Any], None]:
    """Return a program that draws smooth points of any size, by distance or not, with culling and offsets."""

    def program(gl: Any) -> None:
        rng = np.random.default_rng(seed)
        scene(gl, rng)
        gl.glEnable(gl.GL_POINT_SMOOTH)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_POINT)
        gl.glPolygonOffset(1, 2)
        if rng.random() < 0.6:
            blend(gl)
        for _ in range(3):
            gl.glPointSize(float(rng.choice([0.4, 1.0, 2.0, 3.5, 7.3, 20.0, rng.uniform(0.1, 12)])))
            attenuation = ((1, 0, 0), (1, 0, 0), (0.2, 0.1, 0.3), (0, 0, 0.2), (0, 0.4, 0))[int(rng.integers(5))]
            gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, attenuation)
            gl.glPointParameterf(gl.GL_POINT_SIZE_MIN, rng.choice([0.0, 0.0, 2.5]))
            gl.glPointParameterf(gl.GL_POINT_SIZE_MAX, rng.choice([255.0, 255.0, 5.5]))
            for capability in (gl.GL_CULL_FACE, gl.GL_POLYGON_OFFSET_POINT):
                (gl.glEnable if rng.random() < 0.3 else gl.glDisable)(capability)
            gl.glEdgeFlag(bool(rng.random() < 0.9))
            mode = rng.choice(["GL_POINTS", "GL_TRIANGLES", "GL_QUADS", "GL_POLYGON", "GL_TRIANGLE_STRIP"])
            primitives(gl, rng, str(mode), float(rng.choice([0.95, 2.0])))

    return program


@pytest.mark.parametrize("limits", [(0.0, 255.0), (3.5, 6.2)])
def test_sizes_by_distance_are_limited_as_on_mesa(limits: tuple[float, float]) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(6)
        scene(gl, rng)
        gl.glPointSize(9.0)
        gl.glPointParameterf(gl.GL_POINT_SIZE_MIN, limits[0])
        gl.glPointParameterf(gl.GL_POINT_SIZE_MAX, limits[1])
        primitives(gl, rng, "GL_POINTS", 2.0)
        gl.glPointParameterfv(gl.GL_POINT_DISTANCE_ATTENUATION, (0.1, 0.2, 0.1))
        primitives(gl, rng, "GL_POINTS", 2.0)

    compared = compare(program, SIZE)
    assert compared, str(compared)


@pytest.mark.parametrize("origin", ["GL_UPPER_LEFT", "GL_LOWER_LEFT"])
@pytest.mark.parametrize("mode", ["GL_POINTS", "GL_TRIANGLES", "GL_LINES"])
def test_point_sprites_and_other_primitives_beside_them_are_those_of_mesa(mode: str, origin: str) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(7)
        scene(gl, rng)
        texture(gl, rng)
        gl.glEnable(gl.GL_POINT_SPRITE)
        gl.glPointParameteri(gl.GL_POINT_SPRITE_COORD_ORIGIN, getattr(gl, origin))
        gl.glPointSize(9.3)
        for replaces in (0, 1):
            gl.glTexEnvi(gl.GL_POINT_SPRITE, gl.GL_COORD_REPLACE, replaces)
            primitives(gl, rng, mode, 2.0)
        gl.glPolygonMode(gl.GL_FRONT, gl.GL_POINT)
        blend(gl)
        primitives(gl, rng, mode, 2.0)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert compared.ours.stencil.any()


@pytest.mark.parametrize("stippled", [False, True])
@pytest.mark.parametrize("width", [0.5, 2.0, 3.3])
def test_smooth_lines_cover_the_pixels_that_they_cover_on_mesa(width: float, stippled: bool) -> None:
    def program(gl: Any) -> None:
        rng = np.random.default_rng(8)
        scene(gl, rng)
        gl.glEnable(gl.GL_LINE_SMOOTH)
        gl.glLineWidth(width)
        if stippled:
            gl.glEnable(gl.GL_LINE_STIPPLE)
            gl.glLineStipple(2, 0x2F35)
        blend(gl)
        primitives(gl, rng, "GL_LINE_STRIP", 0.95)
        gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        primitives(gl, rng, "GL_QUADS", 0.95)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert compared.ours.stencil.any()
