"""Planar shadows in a texture on each receiver, the fifth method of `planar`.

The casters are flattened into the receiver's own coordinates (u, v) instead of onto the screen; then the texture is
laid over the receiver. It is drawn once and stays right as long as light, casters and receiver do not move (E56):
`shadow_textures` draws the textures, and `draw` draws the scene with them from any camera.
Slides: Zimányi & Valient, Projekčné tiene, "Možné renderovanie do textúry".
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.flattened import draw_flattened, draw_the_casters
from softshadow.techniques.technique import Steps

# lit from a weight of one half on; 127.5 would sit between two of the 8-bit values that the alpha test compares
HALF = 127 / 255


@dataclass(frozen=True)
class ShadowTextures:
    """Shadows in textures of the current context, right as long as lights, casters and receivers do not move.

    Attributes
    ----------
    names : dict                 texture by (light, receiver), both by name: alpha 1 where lit, 0 in shadow
    images : dict                the same as (n, n) float32 by title, first row = v 0
    """

    names: dict[tuple[str, str], int]
    images: dict[str, np.ndarray]


def texture(gl: Any, scene: Scene, size: tuple[int, int], clip: bool, texture_size: int) -> Steps:
    """Draw the shadows into each receiver's texture, then the scene with these textures."""
    # 1. flatten the casters into a texture for each receiver and light
    shadows = shadow_textures(gl, scene, clip, texture_size)
    drawing.set_camera(gl, scene.camera, size)
    yield "draw the flattened casters into the receivers' textures", shadows.images

    # 2. to 4.
    yield from draw_with_textures(gl, scene, size, shadows)
    delete_textures(gl, shadows)


def shadow_textures(gl: Any, scene: Scene, clip: bool = True, texture_size: int = 256) -> ShadowTextures:
    """Draw the flattened casters into a texture for each receiver and light, and return the textures."""
    shadows = ShadowTextures({}, {})
    for light in scene.lights:
        for receiver in scene.receivers:
            name, image = shadow_texture(gl, scene, receiver, light, clip, texture_size)
            shadows.names[light.name, receiver.name] = name
            shadows.images[drawing.title(f"texture of {receiver.name}", scene, light)] = image
    return shadows


def delete_textures(gl: Any, shadows: ShadowTextures) -> None:
    """Delete the textures."""
    for name in shadows.names.values():
        gl.glDeleteTextures([name])


def draw(gl: Any, scene: Scene, size: tuple[int, int], shadows: ShadowTextures) -> Steps:
    """Draw the scene from its camera with shadows from `shadow_textures`: no caster is flattened again (E56)."""
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    yield from draw_with_textures(gl, scene, size, shadows)


def draw_with_textures(gl: Any, scene: Scene, size: tuple[int, int], shadows: ShadowTextures) -> Steps:
    """Draw the receivers without light, add the light where their textures have no shadow, then draw the casters."""
    # 2. draw the receivers without light
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.receivers)
    yield "draw the receivers without the light"

    # 3. add the light where the texture has no shadow
    receivers = drawing.read_depth(gl, size)
    lit = []
    for light in scene.lights:
        add_light_through_textures(gl, scene, light, shadows)
        lit.append(drawing.read_stencil(gl, size) != 0)
        yield drawing.title("add the light where the texture has no shadow", scene, light)

    # 4. draw the casters
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def world_to_receiver(receiver: SceneObject) -> np.ndarray:
    """Return the matrix (4, 4) from world space to a receiver's (u, v, 0, 1), in which its outline fills 0 to 1."""
    assert receiver.plane is not None
    normal = receiver.plane[:3]
    # u runs along the world axis with the smallest angle to the plane
    axis = np.eye(3)[np.abs(normal).argmin()]
    along_u = axis - (axis @ normal) * normal
    along_u /= np.linalg.norm(along_u)
    along_v = np.cross(normal, along_u)
    matrix = np.zeros((4, 4))
    matrix[3, 3] = 1
    for row, direction in enumerate((along_u, along_v)):
        extent = receiver.world_positions @ direction
        matrix[row, :3] = direction / np.ptp(extent)
        matrix[row, 3] = -extent.min() / np.ptp(extent)
    return matrix


def shadow_texture(
    gl: Any, scene: Scene, receiver: SceneObject, light: Light, clip: bool, texture_size: int
) -> tuple[int, np.ndarray]:
    """Return a texture with alpha 1 where the receiver is lit and 0 in shadow, and its alpha as (n, n) float32."""
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_MAG_FILTER, gl.GL_LINEAR),
        (gl.GL_TEXTURE_WRAP_S, gl.GL_CLAMP_TO_EDGE),
        (gl.GL_TEXTURE_WRAP_T, gl.GL_CLAMP_TO_EDGE),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    gl.glTexImage2D(
        gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, texture_size, texture_size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, None
    )
    with drawing.texture_attached(gl, gl.GL_COLOR_ATTACHMENT0, name):
        gl.glViewport(0, 0, texture_size, texture_size)
        gl.glClearColor(1.0, 1.0, 1.0, 1.0)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)

        gl.glMatrixMode(gl.GL_PROJECTION)
        gl.glLoadIdentity()
        gl.glOrtho(0, 1, 0, 1, -1, 1)
        gl.glMatrixMode(gl.GL_MODELVIEW)
        gl.glLoadIdentity()
        gl.glMultMatrixd(drawing.column_major(world_to_receiver(receiver)))
        gl.glDisable(gl.GL_LIGHTING)
        gl.glColor4f(1.0, 1.0, 1.0, 0.0)  # only alpha holds the shadow: filtered colours would darken the lit edge
        draw_flattened(gl, scene, receiver, light, clip)

        image = gl.glReadPixels(0, 0, texture_size, texture_size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    gl.glClearColor(*scene.background, 1.0)
    return name, image[:, :, 3].astype(np.float32) / 255


def add_light_through_textures(gl: Any, scene: Scene, light: Light, shadows: ShadowTextures) -> None:
    """Add a light to the receivers where their textures have no shadow, and leave 1 in the stencil buffer there."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    gl.glEnable(gl.GL_ALPHA_TEST)
    gl.glAlphaFunc(gl.GL_GREATER, HALF)
    gl.glEnable(gl.GL_TEXTURE_2D)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_MODULATE)
    drawing.light_by(gl, scene, [light], ambient=False)
    with drawing.additive_blending(gl):
        for receiver in scene.receivers:
            gl.glBindTexture(gl.GL_TEXTURE_2D, shadows.names[light.name, receiver.name])
            gl.glMatrixMode(gl.GL_TEXTURE)
            gl.glLoadIdentity()
            gl.glMultMatrixd(drawing.column_major(world_to_receiver(receiver) @ receiver.object_to_world))
            gl.glMatrixMode(gl.GL_MODELVIEW)
            with drawing.object_space(gl, receiver):
                drawing.set_material(gl, receiver, emission=False)
                drawing.draw_mesh(gl, receiver, shaded=True, texture_coordinates=receiver.mesh.positions)
    gl.glDisable(gl.GL_TEXTURE_2D)
    gl.glDisable(gl.GL_ALPHA_TEST)
    gl.glDisable(gl.GL_STENCIL_TEST)
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadIdentity()
    gl.glMatrixMode(gl.GL_MODELVIEW)
