"""The second surface that each ray of the light meets, behind the first, and the middle between both.

A comparison with the first map keeps the fragments behind it; among these, the depth test keeps the nearest. Receivers
are drawn, too: a thin sheet has no second surface of its own, so the one behind it serves for the middle.

References: Woo 1992, "The shadow depth map revisited"; Everitt 2001, "Interactive order-independent transparency"
(depth peeling with a shadow map).
"""

from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import depth_maps, drawing
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.map_lookups import draw_looked_up, set_map_coordinates
from softshadow.techniques.technique import Steps

# how much farther than the first surface the second has to be, in the map's range 0 to 1: a depth from a texture
# coordinate has a rounding error of some 2^-21, and the first surface must not be its own second
APART = 2.0**-18
APART_16 = 2.0**-16  # 16 bits add a rounding error of 2^-17
HALF = 0.5


def store_midpoint(
    gl: Any,
    scene: Scene,
    light: Light,
    camera: LightCamera,
    shadow_map: int,
    map_size: int,
    map_format: depth_maps.MapFormat = "d24",
) -> Steps:
    """Replace the depths of a map by the middle of the first and the second surface.

    Where there is no second surface, the far plane takes its place. Polygon offset and culling have to be those that
    the map was drawn with.
    """
    second = second_layer(gl, scene, camera, shadow_map, map_size, map_format)
    second_depths = depth_maps.read_depths(gl, second)
    yield (
        drawing.title("draw what is behind it", scene, light),
        {drawing.title("ZS second", scene, light): second_depths},
    )

    middle = ((depth_maps.read_depths(gl, shadow_map) + second_depths) * np.float32(HALF)).astype(np.float32)
    gl.glBindTexture(gl.GL_TEXTURE_2D, shadow_map)
    depth_maps.set_depths(gl, middle, map_format)
    gl.glDeleteTextures([second])
    yield (
        drawing.title("take the middle", scene, light),
        {drawing.title("ZS midpoint", scene, light): depth_maps.read_depths(gl, shadow_map)},
    )


def second_layer(
    gl: Any, scene: Scene, camera: LightCamera, first: int, map_size: int, map_format: depth_maps.MapFormat = "d24"
) -> int:
    """Return a depth texture of the second surface; polygon offset and culling are those of the first map."""
    second = depth_maps.depth_texture(gl, map_size, gl.GL_NEAREST, map_format=map_format)
    gl.glBindTexture(gl.GL_TEXTURE_2D, first)
    depth_maps.compare_in_alpha(gl, gl.GL_GREATER)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(gl.GL_GREATER, HALF)
    with drawing.texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, second):
        depth_maps.look_from(gl, camera, map_size)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        set_map_coordinates(gl, camera, APART_16 if map_format == "d16" else APART)
        draw_looked_up(gl, scene.objects)
    gl.glDisable(gl.GL_ALPHA_TEST)
    gl.glDisable(gl.GL_TEXTURE_2D)
    return second
