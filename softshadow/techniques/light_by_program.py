"""Pass 2 of soft maps: the camera's picture, with as much of each light as a program finds in the light's map."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.technique import Steps
from softshadow.techniques.visibility_buffer import add_light_times, draw_visibility


def draw_lit_by_program(
    gl: Any,
    scene: Scene,
    size: tuple[int, int],
    cameras: list[LightCamera],
    program: int,
    look_up: Callable[[int, Light, LightCamera], None],
    shown: tuple[str, ...],
    normal_bias: float,
) -> Steps:
    """Yield the steps from the picture without light to the one with all lights.

    Parameters
    ----------
    program : int                writes the visibility of a light as alpha
    look_up : (number of the light, light, camera) -> None
                                 binds the light's map, and sets uniforms and the texture matrix
    shown : names of the maps that the program writes as red, green and blue; 0 where nothing is drawn
    """
    # the camera's picture, first as if all of it were in shadow
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    # then how much of the light each pixel sees, and that much of the light
    lit = []
    points = drawing.world_points(scene, depth, size)
    for number, (light, camera) in enumerate(zip(scene.lights, cameras, strict=True)):
        look_up_light = partial(look_up, number, light, camera)
        visibility, values = draw_visibility(gl, scene, size, program, look_up_light, normal_bias)
        lit.append(values[..., 3])
        found = np.where(valid[..., None], values, np.float32(0))
        maps = {drawing.title(name, scene, light): found[..., channel] for channel, name in enumerate(shown)}
        maps[drawing.title("unknown", scene, light)] = valid & depth_maps.unknown(scene, light, camera, points)
        yield drawing.title("find how much of the light each point sees", scene, light), maps

        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility])
        yield drawing.title("add the share of the light", scene, light), drawing.visibility_maps(scene, lit, valid)
