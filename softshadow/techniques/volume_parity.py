"""Shadow volumes by parity: one bit that every face of a volume inverts, front or back.

A line of sight that meets the faces of volumes an odd number of times before the visible surface has entered one more
than it has left: the surface is inside. It takes one draw and one bit instead of a counter, but a point in two volumes
has an even number of faces before it, too.

Paper: after Heidmann 1991, "Real shadows, real time", with GL_INVERT in place of the counter.
Slides: Andújar, Volums d'ombra, the listing with the mask 1 (E38).

Known failures: wherever an even number of volumes overlap, shadow is lit; so it is where a caster folds over itself,
and behind open meshes, of which every layer counts. The result is right exactly where the count is 0 or 1 (z-pass and
z-fail have the count). As in z-pass, a near rectangle in shadow turns light and shadow round (`NearClipZPass`); edges
are hard.
"""

from typing import Any

from softshadow.scene import Scene
from softshadow.techniques import drawing, shadow_volumes, start_value
from softshadow.techniques.technique import Steps


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    generator: shadow_volumes.Generator = "silhouette",
    cap: shadow_volumes.Cap = "infinite",
    reach: shadow_volumes.Reach = None,
    far: shadow_volumes.Far = "infinite",
) -> Steps:
    """Draw the scene with the parity of shadow volumes."""
    # step 1: the colours of the scene in shadow, and the depth of what is visible
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size, far)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    lit = []
    for light in scene.lights:
        start_value.warn_of_a_wrong_start(scene, light, scene.casters, "none", size, far)
        volumes = shadow_volumes.volumes_of(scene, light, generator, cap, reach)

        # step 2: every face before the visible surface inverts the last bit
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glDisable(gl.GL_CULL_FACE)
        gl.glStencilMask(1)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INVERT)
        shadow_volumes.draw_volumes(gl, volumes, light_caps=False, dark_caps=cap == "finite")
        gl.glStencilMask(0xFF)
        yield drawing.title("invert at every face", scene, light)

        # step 3: the lit part of the scene
        lit.append(shadow_volumes.lit_pixels(gl, scene, light, depth, size, far))
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        drawing.light_by(gl, scene, [light], ambient=False)
        with drawing.additive_blending(gl):
            drawing.draw_objects(gl, scene.objects, emission=False)
        gl.glDisable(gl.GL_STENCIL_TEST)
        yield (
            drawing.title("add the light where the parity is even", scene, light),
            drawing.visibility_maps(scene, lit, valid),
        )
