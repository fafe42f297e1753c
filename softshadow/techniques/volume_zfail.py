"""Shadow volumes counted where the depth test fails.

Instead of what lies between the eye and the visible surface, this counts what lies behind the surface: one more where
the ray leaves a volume there, one less where it enters one. The number is the same, but nothing depends any more on
where the eye is. The price: the volume must be a closed solid, with a light cap and a dark cap, and no far plane may
cut it.

Paper: Everitt & Kilgard 2002, "Practical and robust stenciled shadow volumes for hardware-accelerated rendering";
found before by Bilodeau & Songy 1999 and by Carmack 2000 ("Carmack's reverse").
Slides: Moldoveanu "umbre 1", Volume de umbra (12) to (14).

Known failures: volumes without caps (the slide's "shadow polygons" are the sides only); `far` = finite cuts the
volumes open where they leave the view; saturating counters as in z-pass; edges are hard.
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
    counting_ops,
    draw_volumes,
    end_count,
    volumes_of,
    warn_when_saturated,
)
from softshadow.techniques.technique import Option, Steps
from softshadow.techniques.zpass_or_zfail import Counting, choose_option, count_by_choice

OPTIONS = {
    **SHARED_OPTIONS,
    "choose": choose_option("zfail"),
    "closed": Option(True, bool, "close the volumes with both caps; False shows the slide's failure"),
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
    choose: str = "zfail",
    closed: bool = True,
) -> Steps:
    """Draw the scene with z-fail shadow volumes; see `OPTIONS`."""
    # step 1 (Pasul 1): colour of the scene in shadow, and the depth of what is visible
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

        if choose != "zfail":
            counting = Counting(up, down, two_sided, caps=closed, finite=closed and cap == "finite")
            yield from count_by_choice(gl, scene, light, volumes, counting, choose=choose, size=size, far=far)
        elif two_sided:
            # steps 2 and 3 in one: hidden back faces count up, hidden front faces count down
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, up, gl.GL_KEEP)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, down, gl.GL_KEEP)
            draw_volumes(gl, volumes, light_caps=closed, dark_caps=closed)
            yield title_of("count front and back faces", scene, light)
        else:
            # step 2 (Pasul 2): leaving a volume behind the visible surface counts up
            gl.glCullFace(gl.GL_FRONT)
            gl.glStencilOp(gl.GL_KEEP, up, gl.GL_KEEP)
            draw_volumes(gl, volumes, light_caps=closed, dark_caps=closed)
            yield title_of("count back faces", scene, light)

            # step 3 (Pasul 3): entering one there counts down
            gl.glCullFace(gl.GL_BACK)
            gl.glStencilOp(gl.GL_KEEP, down, gl.GL_KEEP)
            draw_volumes(gl, volumes, light_caps=closed, dark_caps=closed)
            yield title_of("count front faces", scene, light)
        end_count(gl)

        # step 4 (Pasul 4): the lit part of the scene
        stencil = read_stencil(gl, size)
        warn_when_saturated(gl, stencil, ops, light)
        lit.append((stencil == 0) & within_cone(scene, light, depth, size, far))
        add_light(gl, scene, light)
        yield title_of("add the light where the count is 0", scene, light), visibility_maps(scene, lit, valid)
