"""Soft shadows from light samples: one hard shadow map for each sample of an area light, accumulated.

References: Heckbert & Herf 1997, "Simulating soft shadows with graphics hardware".
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.bench.depth_maps import DepthMap
from softshadow.bench.meshes import torus_over_ground
from softshadow.bench.shadow_map_shading import draw_under_map, location
from softshadow.scene import Light
from softshadow.techniques.drawing import set_camera
from softshadow.testing.timing import DrawFrame

SAMPLES = 8
TRIANGLES = 2_000
MAP_SIZE = 512
SIDE = 0.8  # of the square area light, parallel to the ground


def prepare(
    gl: Any,
    size: tuple[int, int],
    *,
    samples: int = SAMPLES,
    triangles: int = TRIANGLES,
    map_size: int = MAP_SIZE,
) -> DrawFrame:
    """Prepare the scene; a frame draws a map and an image for each sample, and accumulates the images."""
    scene = torus_over_ground(triangles)
    lights = [Light(scene.lights[0].position[:3] + offset) for offset in offsets(samples)]
    depth_map = DepthMap(gl, map_size)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glClearColor(*scene.background, 1.0)
    program = gl.program("shadow-map")
    gl.glUseProgram(program)
    gl.glUniform1f(location(gl, "bias"), 0.0)
    gl.glUniform4f(location(gl, "ambient"), 0.3, 0.3, 0.3, 1.0)

    def frame() -> None:
        gl.glClear(gl.GL_ACCUM_BUFFER_BIT)
        for light in lights:
            gl.glUseProgram(0)
            depth_map.draw(gl, scene, light)
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
            gl.glUseProgram(program)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
            set_camera(gl, scene.camera, size)
            draw_under_map(gl, scene, depth_map.world_to_map)
            gl.glAccum(gl.GL_ACCUM, 1 / samples)
        gl.glAccum(gl.GL_RETURN, 1.0)

    return frame


def offsets(samples: int) -> np.ndarray:
    """Return sample points (samples, 3) relative to the light's centre, from the R2 sequence (even for any number)."""
    root = 1.32471795724474602596  # the real root of x³ = x + 1, which defines the R2 sequence
    fractions = (0.5 + np.arange(1, samples + 1)[:, None] / np.array([root, root**2])) % 1
    return SIDE * np.stack([fractions[:, 0] - 0.5, np.zeros(samples), fractions[:, 1] - 0.5], axis=1)
