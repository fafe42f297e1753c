"""Percentage-closer soft shadows: filtering whose square is as wide as the penumbra.

An edge's shadow is soft because parts of an area light are hidden and others not. If light, blocker and receiver are
parallel, the penumbra's width follows from similar triangles: w = s (d_r - d_b) / d_b, for a light of size s, a blocker
at distance d_b and a receiver at d_r. A shadow map has the distance of blockers, so each point first looks for them, in
the region of the map through which it can see the light; takes the mean of their distances as d_b; and is then compared
with the texels of a region of width w, as in percentage-closer filtering.

Paper: Fernando 2005, "Percentage-closer soft shadows"; the bias is that of Isidoro 2006, "Shadow mapping: GPU-based
tips and techniques".
Slides: none; Andújar, Shadow mapping, and Zimányi & Valient, Mäkké tiene, have its two halves.

The map is drawn from the light's centre. The regions have the shape of the light as this camera sees it: an ellipse for
a disc, a line for a segment. A light without a shape has hard shadows, those of `map-pcf` with one texel.

The wider the region, the more a sloping receiver differs from itself in depth; a slope offset for the widest region
would move the casters' own shadows away. So points are compared with the plane that they lie in, and the offset is that
of a single comparison. A receiver that is not flat within the region still shadows itself.

Known failures: of several blockers at different distances only the mean counts, so a shadow is too soft or too sharp
where they overlap; the map has what the centre of the light sees, so parts of casters that are hidden from there block
nothing (light leaks through at their feet); the search misses casters that are thinner than the distance of its points;
a part of the light below the horizon of a face counts as seen; and visibility has as many steps as there are taps, of
which a wide penumbra shows bands.
"""

import math
from functools import cache
from typing import Annotated, Any

import numpy as np

from softshadow.scene import Disc, Light, Scene, Sphere
from softshadow.techniques import depth_maps, drawing
from softshadow.techniques.light_by_program import draw_lit_by_program
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.map_lookups import set_map_coordinates
from softshadow.techniques.map_pcf import behind, disc
from softshadow.techniques.technique import Range, Steps
from softshadow.techniques.visibility_buffer import set_uniforms

GOLDEN = (math.sqrt(5) - 1) / 2
SHOWN = ("blocker distance", "penumbra width", "blockers")


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    map_size: depth_maps.MapSize = 512,
    map_format: depth_maps.MapFormat = "d24",
    factor: depth_maps.Factor = 1.0,
    # more than for `map`: the plane adds its own rounding to that of the depth
    units: depth_maps.Units = 4.0,
    bias: depth_maps.Bias = 0.0,
    normal_bias: depth_maps.NormalBias = 0.0,
    outside: depth_maps.Outside = "lit",
    search: Annotated[int, "points on a side of the region that is searched for blockers", Range(1, 64)] = 8,
    taps: Annotated[int, "comparisons on a side of the region that is as wide as the penumbra", Range(1, 64)] = 8,
) -> Steps:
    """Draw the scene with percentage-closer soft shadows."""
    drawing.begin_frame(gl, scene)
    cameras = [light_camera(scene, light) for light in scene.lights]
    depth_maps.warn_of_casters_outside(scene, cameras)

    # pass 1: the depth of the casters, seen from the centre of the light
    shadow_maps = []
    for light, camera in zip(scene.lights, cameras, strict=True):
        shadow_map = depth_maps.depth_texture(gl, map_size, gl.GL_NEAREST, outside, map_format)
        with depth_maps.polygon_offset(gl, factor, units):
            depth_maps.draw_into(gl, scene, camera, shadow_map, map_size)
        shadow_maps.append(shadow_map)
        yield (
            drawing.title("draw the depth map from the light", scene, light),
            {drawing.title("ZS", scene, light): depth_maps.read_depths(gl, shadow_map)},
        )

    # pass 2: blocker search, width of the penumbra, and comparisons in a region of that width
    program = gl.program("soft-visibility")

    def look_up(number: int, light: Light, camera: LightCamera) -> None:
        gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_maps[number])
        set_map_coordinates(gl, camera, 0.0)
        n_search, n_taps = (1, 1) if light.shape is None else (search, taps)
        set_uniforms(
            gl, program, search=n_search, searchStride=stride(n_search), taps=n_taps, tapsStride=stride(n_taps)
        )
        set_uniforms(gl, program, **light_uniforms(light, camera))
        set_uniforms(gl, program, near=camera.near, far=camera.far, parallel=int(camera.parallel))
        set_uniforms(gl, program, bias=bias, behind=behind(light, outside), cone=disc(light, camera))

    yield from draw_lit_by_program(gl, scene, size, cameras, program, look_up, SHOWN, normal_bias)
    gl.glDeleteTextures(shadow_maps)


def light_uniforms(light: Light, camera: LightCamera) -> dict[str, Any]:
    """Return the uniforms that describe a light as the camera at its centre sees it."""
    u, v = half_axes(light, camera)
    side = 2 * camera.half  # of the map, at distance 1
    width = 2 * max(np.linalg.norm(u[:2]), np.linalg.norm(v[:2]))
    return {
        "lightU": tuple(float(x) for x in u / side),
        "lightV": tuple(float(x) for x in v / side),
        "disc": int(isinstance(light.shape, Disc | Sphere)),
        "size": float(width),
    }


def half_axes(light: Light, camera: LightCamera) -> tuple[np.ndarray, np.ndarray]:
    """Return the two half axes (3,) of a light, along right, up and forward of its camera; 0 without a shape."""
    if light.shape is None:
        return np.zeros(3), np.zeros(3)
    if isinstance(light.shape, Sphere):
        return np.array([light.shape.radius, 0, 0]), np.array([0, light.shape.radius, 0])
    u, v = light.shape.half_axes
    return camera.frame @ u, camera.frame @ v


@cache
def stride(side: int) -> int:
    """Return the number without a common divisor with `side` that is nearest to its golden section.

    Steps of it visit all places, and spread those of neighbouring rows. For a side of 8, the shares of points in half
    planes have an RMS error of 0.012; with steps of 1 it is 0.020.
    """
    return min((step for step in range(1, side + 1) if math.gcd(step, side) == 1), key=lambda s: abs(s - GOLDEN * side))
