"""A dark blob under every caster, the oldest and cheapest of shadows.

A disc is laid on each flat receiver below the caster's centre, darkest in its middle and fading to its rim, and the
weaker the higher the caster is. It shows where an object stands and how high, and nothing else: neither the light nor
the silhouette has any influence on it.

Paper: none; it is older than the papers about it.
Slides: none; of what shadows tell in Andújar's list, a blob keeps where a thing stands and how high.

Known failures: the blob does not move with the light, does not have the caster's shape, lies under the caster even
where the light comes from the side, and takes its share of the ambient light, too. Several blobs multiply. A receiver
below another one gets the blob as well. Receivers have to be flat. How far off the picture is, the comparison of the
map `visibility` with ray casting shows.
"""

from typing import Annotated, Any

import numpy as np

from softshadow.scene import Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.flattened import draw_the_casters
from softshadow.techniques.planar import mark_receivers
from softshadow.techniques.technique import Range, Steps

RIM = 48  # corners of the disc


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    radius: Annotated[float, "radius of the blob, in radii of the caster's bounding sphere", Range(0)] = 1.0,
    darkness: Annotated[
        float, "share of the light that the middle of a blob on the ground takes away", Range(0, 1)
    ] = 0.6,
    fade: Annotated[float, "height of the centre at which a blob disappears, in the same radii", Range(1e-6)] = 4.0,
) -> Steps:
    """Draw the scene with a blob under each caster."""
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)

    # 1. draw the receivers and mark them, so that a blob ends where its receiver does
    gl.glEnable(gl.GL_STENCIL_TEST)
    drawing.light_by(gl, scene, scene.lights, ambient=True)
    mark_receivers(gl, scene, drawing.draw_objects)
    receivers = drawing.read_depth(gl, size)
    yield "draw the receivers and mark them"

    # 2. blend the blobs: they multiply colour and alpha by the share of the light that they leave
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ZERO, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_EQUAL, number, 0xFF)
        for caster in scene.casters:
            draw_blob(gl, caster, receiver, radius, darkness, fade)
    gl.glDisable(gl.GL_BLEND)
    gl.glDisable(gl.GL_STENCIL_TEST)
    gl.glEnable(gl.GL_DEPTH_TEST)
    lit = drawing.read_alpha(gl, size)
    yield "blend the blobs"

    # 3. draw the casters; blobs are the same for every light
    yield from draw_the_casters(gl, scene, size, receivers < 1, [lit] * len(scene.lights))


def draw_blob(gl: Any, caster: SceneObject, receiver: SceneObject, radius: float, darkness: float, fade: float) -> None:
    """Draw a caster's disc on a receiver's plane; its alpha is the share of the light that it takes away."""
    assert receiver.plane is not None
    center, size = bounding_sphere(caster)
    height = float(receiver.plane[:3] @ center + receiver.plane[3])
    taken = darkness * (1 - height / (fade * size))
    if caster is receiver or height < 0 or taken <= 0:
        return
    with drawing.debug_group(gl, caster), drawing.made_of(gl, "blob", "", casters=[caster]):
        gl.glPushMatrix()
        gl.glMultMatrixd(drawing.column_major(disc_to_world(center, receiver.plane, radius * size)))
        gl.glBegin(gl.GL_TRIANGLE_FAN)
        gl.glColor4f(0.0, 0.0, 0.0, taken)
        gl.glVertex2f(0.0, 0.0)
        gl.glColor4f(0.0, 0.0, 0.0, 0.0)
        for angle in np.linspace(0, 2 * np.pi, RIM + 1):
            gl.glVertex2f(np.cos(angle), np.sin(angle))
        gl.glEnd()
        gl.glPopMatrix()


def bounding_sphere(caster: SceneObject) -> tuple[np.ndarray, float]:
    """Return the centre (3,) of a caster's bounding box in world space, and its distance to the farthest vertex."""
    positions = caster.world_positions[np.unique(caster.mesh.triangles)]
    center = (positions.min(axis=0) + positions.max(axis=0)) / 2
    return center, float(np.linalg.norm(positions - center, axis=1).max())


def disc_to_world(center: np.ndarray, plane: np.ndarray, radius: float) -> np.ndarray:
    """Return the matrix (4, 4) that lays the unit disc z = 0 on a plane (4,), under a centre (3,)."""
    normal = plane[:3]
    axis = np.eye(3)[np.abs(normal).argmin()]
    along_x = np.cross(axis, normal)
    along_x /= np.linalg.norm(along_x)
    matrix = np.eye(4)
    matrix[:3, 0] = radius * along_x
    matrix[:3, 1] = radius * np.cross(normal, along_x)
    matrix[:3, 2] = normal
    matrix[:3, 3] = center - (normal @ center + plane[3]) * normal
    return matrix
