"""Shadow volumes counted where the depth test passes.

The solid behind each caster is drawn into the stencil buffer: one more where the eye's ray enters a volume before the
visible surface, one less where it leaves one. What is left is the number of volumes that contain the surface point.
Where it is 0 the light is added to the picture.

Paper: Heidmann 1991, "Real shadows, real time"; volumes by Crow 1977, "Shadow algorithms for computer graphics".
Slides: Moldoveanu "umbre 1", Volume de umbra (6) to (11); Zimányi & Valient, Tieňové telesá; Andújar, Volums d'ombra.

Known failures: the count starts from `start`, so it is wrong where the near rectangle lies in more or fewer volumes (a
`NearClipZPass` warning says so); counters that saturate lose counts when volumes nest deeper than the buffer has
values, and, with `two_sided`, as soon as a face that counts down is drawn before one that counts up; edges are hard. A
finite cap is dark up to its reach only.
"""

from typing import Any

from softshadow.scene import Light, Scene
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
    CasterVolume,
    add_light,
    begin_count,
    counting_ops,
    draw_volumes,
    end_count,
    volumes_of,
    warn_when_saturated,
)
from softshadow.techniques.start_value import START, set_start_value, warn_of_a_wrong_start
from softshadow.techniques.technique import Steps
from softshadow.techniques.zpass_or_zfail import Counting, choose_option, count_by_choice

OPTIONS = {**SHARED_OPTIONS, "start": START, "choose": choose_option("zpass")}


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
    start: str = "none",
    choose: str = "zpass",
) -> Steps:
    """Draw the scene with z-pass shadow volumes; see `OPTIONS`."""
    if choose != "zpass" and start != "none":
        raise ValueError(f"start={start!r} with choose={choose!r}: the choice starts from 0; expected start='none'")
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
        if choose == "zpass":
            warn_of_a_wrong_start(scene, light, scene.casters, start, size, far)
            yield from set_start_value(gl, scene, light, volumes, start=start, size=size, far=far, ops=(up, down))
            yield from count(gl, scene, light, volumes, up, down, two_sided, cap == "finite")
        else:
            counting = Counting(up, down, two_sided, caps=True, finite=cap == "finite")
            yield from count_by_choice(gl, scene, light, volumes, counting, choose=choose, size=size, far=far)
        end_count(gl)

        # step 4 (Pasul 4): the lit part of the scene
        stencil = read_stencil(gl, size)
        warn_when_saturated(gl, stencil, ops, light)
        lit.append((stencil == 0) & within_cone(scene, light, depth, size, far))
        add_light(gl, scene, light)
        yield title_of("add the light where the count is 0", scene, light), visibility_maps(scene, lit, valid)


def count(
    gl: Any,
    scene: Scene,
    light: Light,
    volumes: list[CasterVolume],
    up: int,
    down: int,
    two_sided: bool,
    finite: bool,
) -> Steps:
    """Count what lies between the eye and the visible surface; a `finite` volume is drawn with its dark cap."""
    # a light cap lies on a visible surface or behind one, an infinite dark cap behind everything: neither ever passes
    caps = {"light_caps": False, "dark_caps": finite}
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
