"""The second surface that each ray of the light meets, peeled off behind the first, and the middle between both.

A comparison with the first map keeps what is farther than it; of that, the depth test keeps the nearest. Receivers are
drawn, too: the middle between a sheet and what it stands before is nearer than that, whatever the sheet is.

References: Woo 1992, "The shadow depth map revisited"; Everitt 2001, "Interactive order-independent transparency"
(depth peeling with a shadow map).
"""

from typing import Any

import numpy as np

from softshadow.scene import Scene
from softshadow.techniques.depth_maps import compare_in_alpha, depth_texture, look_from, read_depths, set_depths
from softshadow.techniques.drawing import texture_attached
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.map_lookups import draw_looked_up, set_map_coordinates

# how much farther than the first surface the second has to be, of the map's range: a depth comes out of a texture
# coordinate with some 2^-21 of rounding, and the first surface is not to be its own second
APART = 2.0**-18
HALF = 0.5


def second_layer(gl: Any, scene: Scene, camera: LightCamera, first: int, map_size: int) -> int:
    """Return a depth texture of what is behind the first map; polygon offset and culling are as they were for it."""
    second = depth_texture(gl, map_size, gl.GL_NEAREST)
    gl.glBindTexture(gl.GL_TEXTURE_2D, first)
    compare_in_alpha(gl, gl.GL_GREATER)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(gl.GL_GREATER, HALF)
    with texture_attached(gl, gl.GL_DEPTH_ATTACHMENT, second):
        look_from(gl, camera, map_size)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        set_map_coordinates(gl, camera, APART)
        draw_looked_up(gl, scene.objects)
    gl.glDisable(gl.GL_ALPHA_TEST)
    gl.glDisable(gl.GL_TEXTURE_2D)
    return second


def store_midpoint(gl: Any, first: int, second: int) -> np.ndarray:
    """Replace the first map by the mean of both, and return it; without a second surface that is the far plane."""
    middle = ((read_depths(gl, first) + read_depths(gl, second)) * np.float32(HALF)).astype(np.float32)
    gl.glBindTexture(gl.GL_TEXTURE_2D, first)
    set_depths(gl, middle)
    return read_depths(gl, first)
