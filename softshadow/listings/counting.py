"""The steps that the listings of shadow volumes share: draw the volumes, count their faces, light the scene.

"Trimite in banda grafica poligoanele de umbra" and ``dibuixa(volum_ombra)`` on the slides are ``draw_volumes`` here.
"""

from typing import Any

import numpy as np

from softshadow.listings.listing import Steps
from softshadow.listings.stage import Stage, begin_frame, draw, draw_faces
from softshadow.scene import shadow_volume


def draw_volumes(gl: Any, stage: Stage, closed: bool = False) -> None:
    """Draw the side polygons of every volume (RO1:93-101), counter-clockwise seen from outside; `closed` adds caps."""
    for thing in stage.occluder:
        volume = shadow_volume(thing.mesh, np.array(stage.light))
        gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, f"volume of the {thing.name}")
        gl.glBegin(gl.GL_QUADS)
        for corner in volume.sides.reshape(-1, 4).tolist():
            gl.glVertex4f(*corner)
        gl.glEnd()
        if closed:
            gl.glBegin(gl.GL_TRIANGLES)
            for corner in volume.dark_cap.reshape(-1, 4).tolist():
                gl.glVertex4f(*corner)
            gl.glEnd()
        gl.glPopDebugGroup()
        if closed:
            draw_faces(gl, thing, volume.light_cap)


def ambient_scene(gl: Any, stage: Stage, far: float | None = None) -> Steps:
    """Pasul 1 (RO1:175-191): the scene without light, colour and depth."""
    begin_frame(gl, stage, far)  # "initializeaza z-buffer si stencil-buffer": E61, by glClear
    gl.glDisable(gl.GL_LIGHTING)
    draw(gl, stage.scene)
    yield "Pasul 1: the scene without light"


def begin_count(gl: Any, corrected: frozenset[str], cull: int) -> None:
    """RO1:200-204 and RO1:304-308: let draws change the stencil buffer and nothing else; cull these faces."""
    if "E1" in corrected:
        gl.glEnable(gl.GL_STENCIL_TEST)  # E1: printed in step 4 only, after counting
        gl.glEnable(gl.GL_CULL_FACE)  # E1: printed nowhere
    gl.glDepthMask(gl.GL_FALSE)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glFrontFace(gl.GL_CCW)
    gl.glCullFace(cull)
    gl.glStencilFunc(gl.GL_ALWAYS, 0x0, 0xFF)


def count_passes(gl: Any, corrected: frozenset[str], stage: Stage) -> Steps:
    """Pasul 2 and Pasul 3 of z-pass (RO1:195-256)."""
    begin_count(gl, corrected, gl.GL_BACK)  # nu sunt rasterizate poligoanele PUN
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
    draw_volumes(gl, stage)
    yield "Pasul 2: count front faces up"

    gl.glCullFace(gl.GL_FRONT)  # nu sunt rasterizate poligoanele PUV
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_DECR)
    draw_volumes(gl, stage)
    yield "Pasul 3: count back faces down"


def volumes_around_eye(stage: Stage) -> int:
    """Return how many volumes contain the eye: the number of boxes between the eye and the lamp."""
    eye, to_lamp = np.array(stage.eye), np.array(stage.light[:3]) - np.array(stage.eye)
    volumes = 0
    for thing in stage.occluder:
        low, high = thing.mesh.positions.min(axis=0), thing.mesh.positions.max(axis=0)
        with np.errstate(divide="ignore"):  # a ray along a side of the box meets its planes at infinity
            enters, leaves = np.sort([(low - eye) / to_lamp, (high - eye) / to_lamp], axis=0)
        volumes += bool(max(enters.max(), 0) < min(leaves.min(), 1))
    return volumes


def start_at_near_plane(gl: Any, stage: Stage) -> Steps:
    """E10: write into each pixel the number of volumes that contain its point of the near plane.

    A ray from that point leaves each of these volumes; any other volume that it enters it leaves again. So it meets as
    many more back faces than front faces of closed volumes, whatever their depth.
    """
    begin_count(gl, frozenset({"E1"}), gl.GL_FRONT)
    gl.glDisable(gl.GL_DEPTH_TEST)
    for cull, operation in ((gl.GL_FRONT, gl.GL_INCR_WRAP), (gl.GL_BACK, gl.GL_DECR_WRAP)):
        gl.glCullFace(cull)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, operation)
        draw_volumes(gl, stage, closed=True)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDisable(gl.GL_STENCIL_TEST)
    gl.glDisable(gl.GL_CULL_FACE)
    yield "start the count at the near plane"


def lit_scene(gl: Any, corrected: frozenset[str], stage: Stage) -> Steps:
    """Pasul 4 (RO1:260-277): the scene with light where the count is 0."""
    if "E2" in corrected:
        gl.glDepthFunc(gl.GL_LEQUAL)  # E2: not printed; the second draw has equal depth
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)  # E4: printed KEEP
    gl.glStencilFunc(gl.GL_EQUAL, 0x0, 0xFF)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glEnable(gl.GL_LIGHTING)
    draw(gl, stage.scene)
    yield "Pasul 4: add the light where the count is 0"
