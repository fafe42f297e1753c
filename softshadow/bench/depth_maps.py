"""Depth maps drawn from a light, for shading programs that do the depth comparison themselves."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import matrices
from softshadow.scene import Light, Scene
from softshadow.techniques.depth_maps import depth_texture, draw_casters_from
from softshadow.techniques.light_camera import light_camera

FACTOR, UNITS = 1.5, 4.0  # of the polygon offset


class DepthMap:
    """A depth texture and its framebuffer object; all frames use the same ones.

    Attributes
    ----------
    texture : int                name of the texture; GL's own comparison is off
    world_to_map : (4, 4)        world space to homogeneous s, t and depth of the map; set by `draw`
    """

    def __init__(self, gl: Any, map_size: int) -> None:
        self.size = map_size
        self.texture = depth_texture(gl, map_size, gl.GL_NEAREST)
        self.framebuffer = gl.glGenFramebuffers(1)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self.framebuffer)
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_DEPTH_ATTACHMENT, gl.GL_TEXTURE_2D, self.texture, 0)
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glReadBuffer(gl.GL_NONE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        self.world_to_map = np.eye(4)

    def draw(self, gl: Any, scene: Scene, light: Light) -> None:
        """Draw the casters from the light; the framebuffer stays bound, and viewport and matrices stay changed."""
        camera = light_camera(scene, light)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, self.framebuffer)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(FACTOR, UNITS)
        draw_casters_from(gl, scene.casters, camera, self.size)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        to_texture = matrices.scale(matrices.translate(np.eye(4), 0.5, 0.5, 0.5), 0.5, 0.5, 0.5)
        projection = (
            matrices.ortho(-camera.half, camera.half, -camera.half, camera.half, camera.near, camera.far)
            if camera.parallel
            else matrices.perspective(camera.fov, 1.0, camera.near, camera.far)
        )
        eye, target, up = (list(map(float, v)) for v in (camera.eye, camera.target, camera.up))
        self.world_to_map = to_texture @ projection @ matrices.look_at(np.eye(4), eye, target, up)
