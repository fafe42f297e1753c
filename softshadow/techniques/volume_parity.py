"""Shadow volumes by parity: one bit that every face of a volume inverts, front or back.

A line of sight that meets the faces of volumes an odd number of times before the visible surface has entered one more
than it has left: the surface is inside. One draw, one bit, no counter; but two volumes around a point are an even
number, too.

Paper: after Heidmann 1991, "Real shadows, real time", with GL_INVERT in place of the counter.
Slides: Andújar, Volums d'ombra, the listing with the mask 1 (E38).

Known failures: wherever an even number of volumes overlap, shadow is lit; so are a caster's own folds, and open meshes,
of which every layer counts. It is right exactly where the count is 0 or 1 (z-pass and z-fail have the count). As in
z-pass, a near rectangle in shadow turns everything round (`NearClipZPass`); edges are hard.
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
    within_cone,
)
from softshadow.techniques.shadow_volumes import (
    OPTIONS as SHARED_OPTIONS,
)
from softshadow.techniques.shadow_volumes import (
    add_light,
    begin_count,
    draw_volumes,
    end_count,
    volumes_of,
)
from softshadow.techniques.start_value import warn_of_a_wrong_start
from softshadow.techniques.technique import Steps

OPTIONS = {name: SHARED_OPTIONS[name] for name in ("generator", "cap", "reach", "far")}


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    generator: str = "silhouette",
    cap: str = "infinite",
    reach: float | None = None,
    far: str = "infinite",
) -> Steps:
    """Draw the scene with the parity of shadow volumes; see `OPTIONS`."""
    # step 1: colour of the scene in shadow, and the depth of what is visible
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size, far)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.objects)
    depth = read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    lit = []
    for light in scene.lights:
        warn_of_a_wrong_start(scene, light, scene.casters, "none", size, far)
        volumes = volumes_of(scene, light, generator, cap, reach)
        begin_count(gl)
        gl.glDisable(gl.GL_LIGHTING)

        # step 2: every face before the visible surface inverts the lowest bit
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glStencilMask(1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INVERT)
        draw_volumes(gl, volumes, light_caps=False, dark_caps=cap == "finite")
        gl.glStencilMask(0xFF)
        yield title_of("invert at every face", scene, light)
        end_count(gl)

        # step 3: the lit part of the scene
        lit.append((read_stencil(gl, size) == 0) & within_cone(scene, light, depth, size, far))
        add_light(gl, scene, light)
        yield title_of("add the light where the parity is even", scene, light), visibility_maps(scene, lit, valid)
