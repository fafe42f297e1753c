"""A whole frame with shadow volumes, z-fail: silhouette and extrusion, ambient pass, two counting passes, lit pass.

The technique's own functions, without what it reads back between the passes.
"""

from __future__ import annotations

from typing import Any

from softshadow.bench.meshes import TRIANGLES, torus_over_ground
from softshadow.techniques.drawing import begin_frame, draw_objects, light_ambient_only, set_camera
from softshadow.techniques.shadow_volumes import add_light, begin_count, draw_volumes, end_count, volumes_of
from softshadow.testing.timing import Frame


def prepare(gl: Any, size: tuple[int, int], *, triangles: int = TRIANGLES) -> Frame:
    """A frame makes the volumes and draws everything, as if the light had moved."""
    scene = torus_over_ground(triangles)
    light = scene.lights[0]

    def frame() -> None:
        volumes = volumes_of(scene, light, "silhouette", "infinite", None)
        begin_frame(gl, scene)
        set_camera(gl, scene.camera, size, "infinite")
        light_ambient_only(gl, scene)
        draw_objects(gl, scene.objects)
        begin_count(gl)
        gl.glDisable(gl.GL_LIGHTING)
        for culled, operation in ((gl.GL_FRONT, gl.GL_INCR_WRAP), (gl.GL_BACK, gl.GL_DECR_WRAP)):
            gl.glCullFace(culled)
            gl.glStencilOp(gl.GL_KEEP, operation, gl.GL_KEEP)
            draw_volumes(gl, volumes)
        end_count(gl)
        add_light(gl, scene, light)

    return frame
