"""Shadow volumes counted where the depth test passes.

The solid behind each caster is drawn into the stencil buffer: one more where the eye's ray enters a volume before the
visible surface, one less where it leaves one. What remains is the number of volumes that contain the surface point.
Where it is 0 the light is added to the picture.

Paper: Heidmann 1991, "Real shadows, real time"; volumes by Crow 1977, "Shadow algorithms for computer graphics".
Slides: Moldoveanu "umbre 1", Volume de umbra (6) to (11); Zimányi & Valient, Tieňové telesá; Andújar, Volums d'ombra.

Known failures: the count starts from `start`, so it is wrong where the near rectangle lies in more or fewer volumes (a
`NearClipZPass` warning says so); saturating counters lose counts where more volumes overlap than the buffer has values,
and, with `two_sided`, as soon as a face that counts down is drawn before one that counts up; edges are hard. A volume
with a finite cap casts no shadow beyond its reach.
"""

from typing import Any

from softshadow.scene import Scene
from softshadow.techniques import drawing, shadow_volumes, start_value, zpass_or_zfail
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
    ops: shadow_volumes.Ops = "wrap",
    two_sided: shadow_volumes.TwoSided = False,
    start: start_value.Start = "none",
    choose: zpass_or_zfail.Choose = "zpass",
) -> Steps:
    """Draw the scene with z-pass shadow volumes."""
    if choose != "zpass":
        if start != "none":
            raise ValueError(f"start={start!r} with choose={choose!r}, which counts from 0; expected start='none'")
        yield from zpass_or_zfail.steps(
            gl, scene, size=size, generator=generator, cap=cap, reach=reach, far=far, ops=ops, two_sided=two_sided,
            choose=choose,
        )  # fmt: skip
        return

    # step 1 (Pasul 1): the colours of the scene in shadow, and the depth of what is visible
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size, far)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    up, down = shadow_volumes.counting_ops(gl, ops)
    lit = []
    for light in scene.lights:
        start_value.warn_of_a_wrong_start(scene, light, scene.casters, start, size, far)
        volumes = shadow_volumes.volumes_of(scene, light, generator, cap, reach)
        # a light cap lies on a visible surface or behind one, an infinite dark cap behind everything: neither passes
        caps = {"light_caps": False, "dark_caps": cap == "finite"}

        # step 2 (Pasul 2): entering a volume before the visible surface counts up
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)  # E1: the slide has this in step 4 only,
        gl.glEnable(gl.GL_CULL_FACE)  # and this nowhere
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glDisable(gl.GL_LIGHTING)
        yield from start_value.set_start_value(
            gl, scene, light, volumes, start=start, size=size, far=far, ops=(up, down)
        )
        if two_sided:  # steps 2 and 3 in one: front faces count up, back faces count down
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, up)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, down)
            shadow_volumes.draw_volumes(gl, volumes, **caps)
            yield drawing.title("count front and back faces", scene, light)
        else:
            gl.glCullFace(gl.GL_BACK)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
            shadow_volumes.draw_volumes(gl, volumes, **caps)
            yield drawing.title("count front faces", scene, light)

            # step 3 (Pasul 3): leaving one counts down
            gl.glCullFace(gl.GL_FRONT)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, down)
            shadow_volumes.draw_volumes(gl, volumes, **caps)
            yield drawing.title("count back faces", scene, light)

        # step 4 (Pasul 4): the lit part of the scene, where the count is 0
        lit.append(shadow_volumes.lit_pixels(gl, scene, light, depth, size, far, ops))
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)  # E38: all bits of the count, not only the last
        gl.glDepthMask(gl.GL_TRUE)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        gl.glDisable(gl.GL_CULL_FACE)  # E3: or only back faces of the scene are drawn
        drawing.light_by(gl, scene, [light], ambient=False)
        with drawing.additive_blending(gl):
            drawing.draw_objects(gl, scene.objects, emission=False)
        gl.glDisable(gl.GL_STENCIL_TEST)
        yield (
            drawing.title("add the light where the count is 0", scene, light),
            drawing.visibility_maps(scene, lit, valid),
        )
