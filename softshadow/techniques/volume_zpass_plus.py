"""Z-pass shadow volumes that start from the casting faces as the light projects them onto the near rectangle.

Seen from the light, a point of the near rectangle is in as many volumes as there are casting faces in front of it. The
faces between light and rectangle are flattened onto it by the matrix of planar shadows and drawn into the stencil
buffer, one more for each; from there z-pass counts on. It needs no caps, and nothing behind the surface.

Paper: Hornus, Hoberock, Lefebvre & Hart 2005, "ZP+: correct Z-pass stencil shadows".
Slides: none; the start value is that of Moldoveanu "umbre 1", Volume de umbra (5), for each pixel.

Known failures: pixels at the edge of a volume where it is cut by the near plane may be one off: the flattened faces and
the clipped sides round their common edge differently. A light in the near plane itself sees the rectangle as a line:
there, rays count the faces instead. Saturating counters as in z-pass; edges are hard. Under depth clamping nothing is
cut and there is no near rectangle to flatten onto: `far` offers none.
"""

from typing import Any

from softshadow.scene import Light, Scene
from softshadow.techniques.drawing import (
    begin_frame,
    draw_objects,
    draw_polygons,
    light_ambient_only,
    named,
    read_depth,
    read_stencil,
    set_camera,
    title_of,
    visibility_maps,
    within_cone,
)
from softshadow.techniques.near_rectangle import near_cap, near_counts, near_rectangle, seen_edge_on
from softshadow.techniques.shadow_volumes import (
    OPTIONS as SHARED_OPTIONS,
)
from softshadow.techniques.shadow_volumes import (
    add_light,
    begin_count,
    counting_ops,
    end_count,
    volumes_of,
    warn_when_saturated,
)
from softshadow.techniques.start_value import limited, write_stencil
from softshadow.techniques.technique import Option, Steps
from softshadow.techniques.volume_zpass import count

OPTIONS = {
    **SHARED_OPTIONS,
    "far": Option(
        "infinite",
        str,
        "far plane: an infinite projection, or the camera's own, which may cut volumes open",
        choices=("infinite", "finite"),
    ),
}


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
    """Draw the scene with z-pass shadow volumes that start from the near-plane count; see `OPTIONS`."""
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
        volumes = volumes_of(scene, light, generator, cap, reach)
        up, down = counting_ops(gl, ops)
        begin_count(gl)
        gl.glDisable(gl.GL_LIGHTING)

        # step 2: one more for every casting face between the near rectangle and the light
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, up)
        if seen_edge_on(light, near_rectangle(scene.camera, size, far)):
            write_stencil(gl, limited(gl, near_counts(scene, light, scene.casters, size, far), (up, down)), size)
        else:
            draw_near_caps(gl, scene, light, size)
        near_count = {title_of("near-plane count", scene, light): read_stencil(gl, size)}
        yield title_of("draw the casting faces onto the near rectangle", scene, light), near_count

        # steps 3 and 4: those of z-pass
        yield from count(gl, scene, light, volumes, up, down, two_sided, cap == "finite")
        end_count(gl)

        # step 5: the lit part of the scene
        stencil = read_stencil(gl, size)
        warn_when_saturated(gl, stencil, ops, light)
        lit.append((stencil == 0) & within_cone(scene, light, depth, size, far))
        add_light(gl, scene, light)
        yield title_of("add the light where the count is 0", scene, light), visibility_maps(scene, lit, valid)


def draw_near_caps(gl: Any, scene: Scene, light: Light, size: tuple[int, int]) -> None:
    """Draw the casting faces flattened onto the near rectangle, both sides of them, whatever the depth."""
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_DEPTH_CLAMP)  # they lie in the near plane, and rounding must not cut them off
    gl.glPushMatrix()
    gl.glLoadIdentity()  # eye space
    for caster in scene.casters:
        with named(gl, caster):
            draw_polygons(gl, near_cap(caster, light, scene.camera, size))
    gl.glPopMatrix()
    gl.glDisable(gl.GL_DEPTH_CLAMP)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_CULL_FACE)
