"""Whole z-fail frame: silhouette and extrusion, ambient pass, two counting passes, lit pass.

It makes the technique's GL calls, but does not read back buffers between the passes.
"""

from __future__ import annotations

from typing import Any

from softshadow.bench.meshes import TRIANGLES, torus_over_ground
from softshadow.techniques import drawing
from softshadow.techniques.shadow_volumes import draw_volumes, volumes_of
from softshadow.testing.timing import DrawFrame


def prepare(gl: Any, size: tuple[int, int], *, triangles: int = TRIANGLES) -> DrawFrame:
    """Prepare the scene; a frame builds the volumes and draws everything, as after a movement of the light."""
    scene = torus_over_ground(triangles)
    light = scene.lights[0]

    def frame() -> None:
        volumes = volumes_of(scene, light)
        drawing.begin_frame(gl, scene)
        drawing.set_camera(gl, scene.camera, size, "infinite")
        drawing.light_ambient_only(gl, scene)
        drawing.draw_objects(gl, scene.objects)

        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glDisable(gl.GL_LIGHTING)
        for culled, operation in ((gl.GL_FRONT, gl.GL_INCR_WRAP), (gl.GL_BACK, gl.GL_DECR_WRAP)):
            gl.glCullFace(culled)
            gl.glStencilOp(gl.GL_KEEP, operation, gl.GL_KEEP)
            draw_volumes(gl, volumes)

        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        gl.glDisable(gl.GL_CULL_FACE)
        drawing.light_by(gl, scene, [light], ambient=False)
        with drawing.additive_blending(gl):
            drawing.draw_objects(gl, scene.objects, emission=False)
        gl.glDisable(gl.GL_STENCIL_TEST)

    return frame
