"""Shadow volumes counted where the depth test fails.

Instead of what lies between the eye and the visible surface, this counts what lies behind the surface: one more where
the ray leaves a volume there, one less where it enters one. The number is the same, but it no longer depends on where
the eye is. The price: the volume must be a closed solid, with a light cap and a dark cap, and no far plane may cut it.

Paper: Everitt & Kilgard 2002, "Practical and robust stenciled shadow volumes for hardware-accelerated rendering";
found before by Bilodeau & Songy 1999 and by Carmack 2000 ("Carmack's reverse").
Slides: Moldoveanu "umbre 1", Volume de umbra (12) to (14).

Known failures: volumes without caps (the slide's "shadow polygons" are the sides only); `far` = finite cuts the
volumes open where they leave the view; saturating counters as in z-pass; edges are hard.
"""

from typing import Annotated, Any

from softshadow.scene import Scene
from softshadow.techniques import drawing, shadow_volumes, zpass_or_zfail
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
    choose: zpass_or_zfail.Choose = "zfail",
    closed: Annotated[bool, "close the volumes with both caps; False shows the slide's failure"] = True,
) -> Steps:
    """Draw the scene with z-fail shadow volumes."""
    if choose != "zfail":
        yield from zpass_or_zfail.steps(
            gl, scene, size=size, generator=generator, cap=cap, reach=reach, far=far, ops=ops, two_sided=two_sided,
            choose=choose, closed=closed,
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
        volumes = shadow_volumes.volumes_of(scene, light, generator, cap, reach)

        # step 2 (Pasul 2): leaving a volume behind the visible surface counts up
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)  # E1: the slide has this in step 4 only,
        gl.glEnable(gl.GL_CULL_FACE)  # and this nowhere
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glDisable(gl.GL_LIGHTING)
        if two_sided:  # steps 2 and 3 in one: hidden back faces count up, hidden front faces count down
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, up, gl.GL_KEEP)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, down, gl.GL_KEEP)
            shadow_volumes.draw_volumes(gl, volumes, light_caps=closed, dark_caps=closed)
            yield drawing.title("count front and back faces", scene, light)
        else:
            gl.glCullFace(gl.GL_FRONT)
            gl.glStencilOp(gl.GL_KEEP, up, gl.GL_KEEP)
            shadow_volumes.draw_volumes(gl, volumes, light_caps=closed, dark_caps=closed)
            yield drawing.title("count back faces", scene, light)

            # step 3 (Pasul 3): entering one there counts down
            gl.glCullFace(gl.GL_BACK)
            gl.glStencilOp(gl.GL_KEEP, down, gl.GL_KEEP)
            shadow_volumes.draw_volumes(gl, volumes, light_caps=closed, dark_caps=closed)
            yield drawing.title("count front faces", scene, light)

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
