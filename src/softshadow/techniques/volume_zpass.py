"""Shadow volumes counted where the depth test passes.

The solid behind each caster is drawn into the stencil buffer: one more where the eye's ray enters a volume before the
visible surface, one less where it leaves one. What is left is the number of volumes that contain the surface point.
Where it is 0 the light is added to the picture.

Paper: Heidmann 1991, "Real shadows, real time"; volumes by Crow 1977, "Shadow algorithms for computer graphics".
Slides: Moldoveanu "umbre 1", Volume de umbra (6) to (11); Zimányi & Valient, Tieňové telesá; Andújar, Volums d'ombra.

Known failures: the count starts from 0, so it is wrong where the near rectangle lies in a volume (a `NearClipZPass`
warning says so); counters that saturate lose counts when volumes nest deeper than the buffer has values, and, with
`two_sided`, as soon as a face that counts down is drawn before one that counts up; edges are hard. A finite cap is
dark up to its reach only.
"""

from typing import Any

from softshadow.scene import Scene
from softshadow.techniques.drawing import (
    begin_frame,
    draw_objects,
    light_ambient_only,
    read_depth,
    read_stencil,
    set_camera,
    title_of,
    visibility_maps,
)
from softshadow.techniques.shadow_volumes import (
    OPTIONS as OPTIONS,
)
from softshadow.techniques.shadow_volumes import (
    add_light,
    begin_count,
    counting_ops,
    draw_volumes,
    end_count,
    volumes_of,
    warn_when_near_rectangle_in_shadow,
    warn_when_saturated,
)
from softshadow.techniques.technique import Steps


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    generator: str = "silhouette",
    cap: str = "infinite",
    reach: float | None = None,
    far: str = "infinite",
    ops: str = "wrap",
    two_sided: bool = False,
) -> Steps:
    """Draw the scene with z-pass shadow volumes; see `OPTIONS`."""
    # step 1 (Pasul 1): colour of the scene in shadow, and the depth of what is visible
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size, far)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.objects)
    valid = read_depth(gl, size) < 1
    yield "draw the scene without the light"

    lit = []
    for light in scene.lights:
        warn_when_near_rectangle_in_shadow(scene, light, size, far)
        volumes = volumes_of(scene, light, generator, cap, reach)
        # a light cap lies on a visible surface or behind one, an infinite dark cap behind everything: neither ever
        # passes
        caps = {"light_caps": False, "dark_caps": cap == "finite"}
        up, down = counting_ops(gl, ops)
        begin_count(gl)
        gl.glDisable(gl.GL_LIGHTING)

        if two_sided:
            # steps 2 and 3 in one: front faces count up, back faces count down
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, up)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, down)
            draw_volumes(gl, volumes, **caps)
            yield title_of("count front and back faces", scene, light)
        else:
            # step 2 (Pasul 2): entering a volume before the visible surface counts up
            gl.glCullFace(gl.GL_BACK)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
            draw_volumes(gl, volumes, **caps)
            yield title_of("count front faces", scene, light)

            # step 3 (Pasul 3): leaving one counts down
            gl.glCullFace(gl.GL_FRONT)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, down)
            draw_volumes(gl, volumes, **caps)
            yield title_of("count back faces", scene, light)
        end_count(gl)

        # step 4 (Pasul 4): the lit part of the scene
        stencil = read_stencil(gl, size)
        warn_when_saturated(gl, stencil, ops, light)
        lit.append(stencil == 0)
        add_light(gl, scene, light)
        yield title_of("add the light where the count is 0", scene, light), visibility_maps(scene, lit, valid)
