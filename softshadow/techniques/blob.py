"""A dark blob under every caster: what a shadow was before there was time for one.

A disc is laid on each flat receiver at the foot of the perpendicular from the caster's centre, darkest in its middle
and fading to its rim, the weaker the higher the caster is. It says where a thing stands, and nothing else: no light and
no silhouette has a part in it.

Paper: none; it is older than the papers about it.
Slides: none; of what shadows tell by Andújar's list, a blob keeps where a thing stands and how high.

Known failures: the blob does not move with the light, has not the caster's shape, lies under the caster even where the
light comes from the side, and takes its share of the ambient light, too. Several blobs multiply. A receiver below
another one gets the blob as well. Receivers have to be flat. How wrong all that is, the comparison of the map
`visibility` with ray casting says.
"""

from typing import Any

import numpy as np

from softshadow.scene import Scene, SceneObject
from softshadow.techniques.drawing import (
    begin_frame,
    column_major,
    draw_objects,
    light_by,
    named,
    read_alpha,
    read_depth,
    set_camera,
)
from softshadow.techniques.flattened import draw_the_casters
from softshadow.techniques.planar import mark_receivers
from softshadow.techniques.technique import Option, Steps

OPTIONS = {
    "radius": Option(1.0, float, "radius of the blob, in radii of the caster's bounding sphere", minimum=0),
    "darkness": Option(
        0.6, float, "share of the light that the middle of a blob on the ground takes away", minimum=0, maximum=1
    ),
    "fade": Option(4.0, float, "height of the centre at which a blob is gone, in the same radii", minimum=1e-6),
}

RIM = 48  # corners of the disc


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    radius: float = 1.0,
    darkness: float = 0.6,
    fade: float = 4.0,
) -> Steps:
    """Draw the scene with a blob under each caster; see `OPTIONS`."""
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)

    # 1. draw the receivers, and mark them: a blob does not know where its receiver ends
    gl.glEnable(gl.GL_STENCIL_TEST)
    light_by(gl, scene, scene.lights, ambient=True)
    mark_receivers(gl, scene, draw_objects)
    receivers = read_depth(gl, size)
    yield "draw the receivers and mark them"

    # 2. blend the blobs: colour and alpha are multiplied by what is left of the light
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
    left = read_alpha(gl, size)
    yield "blend the blobs"

    # 3. draw the casters; every light is the same to a blob
    yield from draw_the_casters(gl, scene, size, receivers < 1, [left] * len(scene.lights))


def draw_blob(gl: Any, caster: SceneObject, receiver: SceneObject, radius: float, darkness: float, fade: float) -> None:
    """Draw a caster's disc on a receiver's plane, its alpha the share of the light that it takes away."""
    assert receiver.plane is not None
    centre, size = bounding_sphere(caster)
    height = float(receiver.plane[:3] @ centre + receiver.plane[3])
    taken = darkness * (1 - height / (fade * size))
    if caster is receiver or height < 0 or taken <= 0:
        return
    with named(gl, caster):
        gl.glPushMatrix()
        gl.glMultMatrixd(column_major(disc_to_world(centre, receiver.plane, radius * size)))
        gl.glBegin(gl.GL_TRIANGLE_FAN)
        gl.glColor4f(0.0, 0.0, 0.0, taken)
        gl.glVertex2f(0.0, 0.0)
        gl.glColor4f(0.0, 0.0, 0.0, 0.0)
        for angle in np.linspace(0, 2 * np.pi, RIM + 1):
            gl.glVertex2f(np.cos(angle), np.sin(angle))
        gl.glEnd()
        gl.glPopMatrix()


def bounding_sphere(caster: SceneObject) -> tuple[np.ndarray, float]:
    """Return the middle (3,) of a caster's bounding box in world space, and how far the farthest vertex is from it."""
    positions = caster.world_positions[np.unique(caster.mesh.triangles)]
    centre = (positions.min(axis=0) + positions.max(axis=0)) / 2
    return centre, float(np.linalg.norm(positions - centre, axis=1).max())


def disc_to_world(centre: np.ndarray, plane: np.ndarray, radius: float) -> np.ndarray:
    """Return the matrix (4, 4) that lays the unit disc z = 0 on a plane (4,), under a centre (3,)."""
    normal = plane[:3]
    axis = np.eye(3)[np.abs(normal).argmin()]
    along_x = np.cross(axis, normal)
    along_x /= np.linalg.norm(along_x)
    matrix = np.eye(4)
    matrix[:3, 0] = radius * along_x
    matrix[:3, 1] = radius * np.cross(normal, along_x)
    matrix[:3, 2] = normal
    matrix[:3, 3] = centre - (normal @ centre + plane[3]) * normal
    return matrix
