"""Decide the pixels that a shadow map says nothing about: points beside or behind the light, or outside its cone.

Each pixel is decided once: by these draws first, by the comparison with the map after them. The stencil buffer holds 0
for undecided pixels, `LIT` where the light has been added, and `DARK` where it is not to be added. A draw decides the
pixels where its texture's alpha is more than a half.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.scene.lights import WIDEST_CONE
from softshadow.techniques import drawing
from softshadow.techniques.depth_maps import Outside
from softshadow.techniques.light_camera import LightCamera
from softshadow.techniques.map_lookups import draw_looked_up, set_map_coordinates

LIT, DARK, DECIDED = 1, 3, 1  # in the stencil buffer; DECIDED is the bit that LIT and DARK share
# the texture of a cone's disc: texels on a side, how much wider than the disc, and the width of the soft rim in texels
DISC, WIDER, RIM = 256, 1.1, 4


def decide_unseen(gl: Any, scene: Scene, light: Light, camera: LightCamera, outside: Outside) -> None:
    """Decide the pixels whose points the light's camera does not see, as far as the map's border does not."""
    if light.is_spot:
        decide_outside_cone(gl, scene, light, camera)
    elif outside != "edge":
        decide_behind(gl, scene, light, camera, outside)


def decide_behind(gl: Any, scene: Scene, light: Light, camera: LightCamera, outside: Outside) -> None:
    """Decide the points beside or behind the light, where q ≤ 0.

    The division by q would take them to the mirrored place of the map, where they might find a shadow.
    """
    vertices = np.concatenate([thing.world_positions for thing in scene.objects])
    if camera.has_behind(vertices):
        sides = side_texture(gl)
        set_side_coordinates(gl, camera)
        if outside == "lit":
            drawing.light_by(gl, scene, [light], ambient=False, cones=False)
            with drawing.additive_blending(gl):
                draw_looked_up(gl, scene.objects, shaded=True)
        else:
            darken(gl, scene)
        gl.glDeleteTextures([sides])


def decide_outside_cone(gl: Any, scene: Scene, light: Light, camera: LightCamera) -> None:
    """Decide to be dark what is behind a spot light or outside the disc that its cone fills in its map."""
    sides = side_texture(gl)
    set_side_coordinates(gl, camera)
    darken(gl, scene)
    gl.glDeleteTextures([sides])
    if light.cutoff < WIDEST_CONE:
        disc = disc_texture(gl)
        set_map_coordinates(gl, replace(camera, half=WIDER * float(np.tan(np.radians(light.cutoff)))), 0.0)
        darken(gl, scene)
        gl.glDeleteTextures([disc])


def darken(gl: Any, scene: Scene) -> None:
    """Decide pixels to be dark: their stencil value changes, and no colour is added."""
    gl.glDisable(gl.GL_LIGHTING)
    gl.glStencilFunc(gl.GL_NOTEQUAL, DARK, DECIDED)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    with drawing.additive_blending(gl):
        draw_looked_up(gl, scene.objects)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glStencilFunc(gl.GL_NOTEQUAL, LIT, DECIDED)


def set_side_coordinates(gl: Any, camera: LightCamera) -> None:
    """Set the texture matrix: s is below a half beside and behind the light, above a half in front of it."""
    forward = camera.frame[2]
    matrix = np.zeros((4, 4))
    matrix[0] = [*forward, 0.5 - forward @ camera.eye]
    matrix[1, 3] = 0.5
    matrix[3, 3] = 1
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glMultMatrixd(drawing.column_major(matrix))
    gl.glMatrixMode(gl.GL_MODELVIEW)


def side_texture(gl: Any) -> int:
    """Return a bound texture of two texels: alpha 1 on the left, behind the light, and 0 on the right, in front."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    texels = np.array([[[255, 255, 255, 255], [255, 255, 255, 0]]], np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 2, 1, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    return name


def disc_texture(gl: Any) -> int:
    """Return a bound texture whose alpha is less than a half inside the disc of a cone, and more outside.

    Alpha grows with the distance from the middle, so that linear filtering finds the rim to a fraction of a texel.
    """
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    centers = np.arange(DISC) + 0.5 - DISC / 2
    beyond_rim = np.hypot(centers[:, None], centers) - DISC / 2 / WIDER
    texels = np.full((DISC, DISC, 4), 255, np.uint8)
    texels[..., 3] = np.rint(255 * np.clip(0.5 + beyond_rim / RIM, 0, 1))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, DISC, DISC, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
    return name
