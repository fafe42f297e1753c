"""Soft planar shadows: for each flat receiver a texture of how much of the light its texels see.

A picture of the casters is drawn through `matrices.receiver_view` for each point of the light (or for each layer of
`planar_nested`); a texel sees the light as often as it is not covered. The textures do not depend on the camera, and
stay right as long as light, casters and receivers do not move.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

from softshadow import matrices
from softshadow.scene import Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.planar_texture import world_to_receiver
from softshadow.techniques.visibility_buffer import texture_and_depth_attached, visibility_texture


def view_of(scene: Scene, receiver: SceneObject, light: np.ndarray, shift: float = 0.0) -> np.ndarray | None:
    """Return the `receiver_view` of a light (4,), or None if the light lies in the plane.

    `shift` moves the plane towards the light, in world units; the picture is moved back along the normal.
    """
    assert receiver.plane is not None
    plane = receiver.plane * np.sign(receiver.plane @ light) / np.linalg.norm(receiver.plane[:3])
    plane[3] -= shift
    if plane @ light <= 0:
        return None
    highest = 0.0
    if light[3] == 0:
        vertices = np.concatenate([thing.world_positions for thing in scene.objects])
        highest = 2 * float(np.ptp(vertices, axis=0).max())
    return matrices.receiver_view(world_to_receiver(receiver), plane, light, highest)


def count_covered(
    gl: Any, scene: Scene, receiver: SceneObject, views: Iterable[np.ndarray | None], texture_size: int
) -> np.ndarray:
    """Return how many of the views show a caster at each texel, (n, n) int32, first row = v 0."""
    covered = np.zeros((texture_size, texture_size), np.int32)
    casters = [caster for caster in scene.casters if caster is not receiver]
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, texture_size, texture_size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None
    )
    with drawing.texture_attached(gl, gl.GL_COLOR_ATTACHMENT0, name):
        gl.glViewport(0, 0, texture_size, texture_size)
        gl.glClearColor(0.0, 0.0, 0.0, 0.0)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        for view in views:
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            if view is not None:
                gl.glMatrixMode(gl.GL_PROJECTION)
                gl.glLoadMatrixd(drawing.column_major(view))
                gl.glMatrixMode(gl.GL_MODELVIEW)
                gl.glLoadIdentity()
                drawing.draw_shapes(gl, casters)
            covered += gl.glReadPixels(0, 0, texture_size, texture_size, gl.GL_ALPHA, gl.GL_UNSIGNED_BYTE) != 0
    gl.glDeleteTextures([name])
    gl.glClearColor(*scene.background, 1.0)
    return covered


def draw_shares(gl: Any, scene: Scene, size: tuple[int, int], shares: dict[str, np.ndarray]) -> np.ndarray:
    """Return what the receivers' textures say at each pixel of the window, (h, w) float32, first row = bottom.

    Other objects and the background see all of the light.

    Parameters
    ----------
    shares : dict                by the receiver's name: (n, n) float32, 0 in shadow to 1 lit, first row = v 0
    """
    visibility = visibility_texture(gl, size)
    with texture_and_depth_attached(gl, visibility, size):
        gl.glClearColor(1.0, 1.0, 1.0, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        drawing.set_camera(gl, scene.camera, size)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glColor4f(1.0, 1.0, 1.0, 1.0)
        drawing.draw_shapes(gl, [thing for thing in scene.objects if thing.name not in shares])
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        for receiver in scene.receivers:
            texture = share_texture(gl, shares[receiver.name])
            gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glLoadIdentity()
            gl.glMultMatrixd(drawing.column_major(world_to_receiver(receiver) @ receiver.object_to_world))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            with drawing.object_space(gl, receiver):
                drawing.draw_mesh(gl, receiver, shaded=False, texture_coordinates=receiver.mesh.positions)
            gl.glDeleteTextures([texture])
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
        gl.glDisable(gl.GL_TEXTURE_2D)
        gl.glMatrixMode(gl.GL_TEXTURE)
        gl.glLoadIdentity()
        gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glClearColor(*scene.background, 1.0)
    gl.glBindTexture(gl.GL_TEXTURE_2D, visibility)
    values: np.ndarray = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT)[..., 3]
    gl.glDeleteTextures([visibility])
    return values


def share_texture(gl: Any, share: np.ndarray) -> int:
    """Return a bound, linearly filtered texture of shares (n, n) float32."""
    height, width = share.shape
    texture = visibility_texture(gl, (width, height), np.repeat(share[..., None], 4, axis=2))
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR)
    return texture
