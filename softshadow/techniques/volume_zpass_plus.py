"""Z-pass shadow volumes that start from the casting faces as the light projects them onto the near rectangle.

Seen from the light, a point of the near rectangle is in as many volumes as there are casting faces in front of it. The
faces between light and rectangle are flattened onto it by the matrix of planar shadows and drawn into the stencil
buffer, one more for each; z-pass counts on from there. It needs no caps, and nothing behind the surface.

Paper: Hornus, Hoberock, Lefebvre & Hart 2005, "ZP+: correct Z-pass stencil shadows".
Slides: none; the start value is that of Moldoveanu "umbre 1", Volume de umbra (5), for each pixel.

Known failures: where the near plane cuts a volume, pixels at the edge of the cut may be one off, because the flattened
faces and the clipped sides round their common edge differently. A light in the near plane itself sees the rectangle as
a line: there, rays count the faces instead. Saturating counters as in z-pass; edges are hard. Depth clamping has no
near plane to flatten onto, so `far` does not offer it.
"""

from typing import Annotated, Any, Literal

from softshadow.scene import Light, Scene
from softshadow.techniques import drawing, near_rectangle, shadow_volumes, start_value
from softshadow.techniques.technique import Steps


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    generator: shadow_volumes.Generator = "silhouette",
    cap: shadow_volumes.Cap = "infinite",
    reach: shadow_volumes.Reach = None,
    far: Annotated[
        Literal["infinite", "finite"],
        "far plane: an infinite projection, or the camera's own, which may cut volumes open",
    ] = "infinite",
    ops: shadow_volumes.Ops = "wrap",
    two_sided: shadow_volumes.TwoSided = False,
) -> Steps:
    """Draw the scene with z-pass shadow volumes that start from the near-plane count."""
    # step 1: the colours of the scene in shadow, and the depth of what is visible
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
        caps = {"light_caps": False, "dark_caps": cap == "finite"}

        # step 2: one more for every casting face between the near rectangle and the light
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
        if near_rectangle.seen_edge_on(light, near_rectangle.corners(scene.camera, size, far)):
            counts = near_rectangle.near_counts(scene, light, scene.casters, size, far)
            start_value.write_stencil(gl, start_value.limited(gl, counts, (up, down)), size)
        else:
            draw_near_caps(gl, scene, light, size)
        yield (
            drawing.title("draw the casting faces onto the near rectangle", scene, light),
            {drawing.title("near-plane count", scene, light): drawing.read_stencil(gl, size)},
        )

        if two_sided:  # steps 3 and 4 in one, as in z-pass
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, up)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, down)
            shadow_volumes.draw_volumes(gl, volumes, **caps)
            yield drawing.title("count front and back faces", scene, light)
        else:
            # step 3: entering a volume before the visible surface counts up, as in z-pass
            gl.glCullFace(gl.GL_BACK)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
            shadow_volumes.draw_volumes(gl, volumes, **caps)
            yield drawing.title("count front faces", scene, light)

            # step 4: leaving one counts down
            gl.glCullFace(gl.GL_FRONT)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, down)
            shadow_volumes.draw_volumes(gl, volumes, **caps)
            yield drawing.title("count back faces", scene, light)

        # step 5: the lit part of the scene, where the count is 0
        lit.append(shadow_volumes.lit_pixels(gl, scene, light, depth, size, far, ops))
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        gl.glDisable(gl.GL_CULL_FACE)
        drawing.light_by(gl, scene, [light], ambient=False)
        with drawing.additive_blending(gl):
            drawing.draw_objects(gl, scene.objects, emission=False)
        gl.glDisable(gl.GL_STENCIL_TEST)
        yield (
            drawing.title("add the light where the count is 0", scene, light),
            drawing.visibility_maps(scene, lit, valid),
        )


def draw_near_caps(gl: Any, scene: Scene, light: Light, size: tuple[int, int]) -> None:
    """Draw both sides of the casting faces, flattened onto the near rectangle, with the depth test off."""
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_DEPTH_CLAMP)  # the faces lie in the near plane, and rounding must not clip them
    gl.glPushMatrix()
    gl.glLoadIdentity()  # eye space
    for caster in scene.casters:
        with drawing.debug_group(gl, caster):
            triangles, faces = near_rectangle.near_cap(caster, light, scene.camera, size)
            with drawing.made_of(gl, "cap in the near rectangle", "face", faces, [caster]):
                drawing.draw_polygons(gl, triangles)
    gl.glPopMatrix()
    gl.glDisable(gl.GL_DEPTH_CLAMP)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_CULL_FACE)
