"""Projected planar shadows: casters flattened onto flat receivers by one matrix.

A 4x4 matrix takes every point along the ray from the light onto the receiver's plane; the caster drawn through it,
dark, is its own shadow. Flattened caster and receiver lie in one plane, and the flattened caster does not know where
the receiver ends: the five methods differ in how they settle which of the two is seen. `stencil` is the one without a
fault.

Paper: Blinn 1988, "Me and my (fake) shadow".
Slides: Andújar, Ombres per projecció (un pla; amb stencil; completa); Zimányi & Valient, Projekčné tiene.

Known failures: receivers have to be flat, casters have no shadow on themselves or on each other, edges are hard.
depth-off paints over whatever stands nearer, and beyond the edge of the receiver; offset paints beyond the edge and
over the feet of casters, and fights for depth when factor and units are 0; both paint every light's shadow as dark as
if no other light were there. stencil-blend darkens instead of leaving out the light. `clip` = False shows the false
shadow of what is behind a receiver.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow.errors import SceneError
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques.drawing import (
    added,
    begin_frame,
    draw_objects,
    draw_shapes,
    light_ambient_only,
    light_by,
    read_depth,
    read_stencil,
    set_camera,
    title_of,
)
from softshadow.techniques.flattened import draw_flattened, draw_the_casters
from softshadow.techniques.planar_texture import texture
from softshadow.techniques.technique import Option, Steps

OPTIONS = {
    "method": Option(
        "stencil",
        str,
        "how receiver and flattened caster share the plane",
        choices=("depth-off", "offset", "stencil", "stencil-blend", "texture"),
    ),
    "clip": Option(True, bool, "cut casters at the receiver's plane and at the light before they are flattened"),
    "factor": Option(-1.0, float, "offset and stencil-blend: first argument of glPolygonOffset; negative is nearer"),
    "units": Option(-1.0, float, "offset and stencil-blend: second argument of glPolygonOffset"),
    "texture_size": Option(256, int, "texture: texels on a side of each receiver's shadow", minimum=1, maximum=4096),
}

# stencil-blend: how much of the colour a shadow takes away, with no regard to what the light gave
DARKNESS = 0.6


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    method: str = "stencil",
    clip: bool = True,
    factor: float = -1.0,
    units: float = -1.0,
    texture_size: int = 256,
) -> Steps:
    """Draw the scene with planar shadows by one of the methods; see `OPTIONS`."""
    begin_frame(gl, scene)
    set_camera(gl, scene.camera, size)
    if method == "depth-off":
        yield from depth_off(gl, scene, size, clip)
    elif method == "offset":
        yield from offset(gl, scene, size, clip, factor, units)
    elif method == "stencil":
        yield from stencil(gl, scene, size, clip)
    elif method == "stencil-blend":
        yield from stencil_blend(gl, scene, size, clip, factor, units)
    else:
        yield from texture(gl, scene, size, clip, texture_size)


def depth_off(gl: Any, scene: Scene, size: tuple[int, int], clip: bool) -> Steps:
    """Receiver, flattened caster with the depth test off, caster."""
    # 1. draw the receivers
    light_by(gl, scene, scene.lights, ambient=True)
    draw_objects(gl, scene.receivers)
    receivers = read_depth(gl, size)
    yield "draw the receivers"

    # 2. draw the flattened casters (the shadow)
    lit: list[np.ndarray] = []
    for light in scene.lights:
        begin_counting_layers(gl)
        gl.glDisable(gl.GL_DEPTH_TEST)
        paint_shadows(gl, scene, light, clip)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDisable(gl.GL_STENCIL_TEST)
        lit.append(read_stencil(gl, size) == 0)
        yield title_of("draw the flattened casters", scene, light)

    # 3. draw the casters (E34: not the emitter)
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def offset(gl: Any, scene: Scene, size: tuple[int, int], clip: bool, factor: float, units: float) -> Steps:
    """Receiver, flattened caster a little nearer by glPolygonOffset, caster."""
    # 1. draw the receivers
    light_by(gl, scene, scene.lights, ambient=True)
    draw_objects(gl, scene.receivers)
    receivers = read_depth(gl, size)
    yield "draw the receivers"

    # 2. draw the flattened casters (the shadow)
    lit: list[np.ndarray] = []
    for light in scene.lights:
        begin_counting_layers(gl)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(factor, units)
        paint_shadows(gl, scene, light, clip)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glDisable(gl.GL_STENCIL_TEST)
        lit.append(read_stencil(gl, size) == 0)
        yield title_of("draw the flattened casters", scene, light)

    # 3. draw the casters
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def stencil(gl: Any, scene: Scene, size: tuple[int, int], clip: bool) -> Steps:
    """Receiver into colour and stencil, flattened caster out of the stencil, dark part of the receiver, caster.

    Each receiver marks its pixels with a number of its own (1 for the first), so that a caster flattened onto one
    receiver leaves the others alone. The first light goes as on the slide; every further light is added where it is
    visible.
    """
    # 1. draw the receivers into the colour and the stencil buffer
    gl.glEnable(gl.GL_STENCIL_TEST)
    light_by(gl, scene, scene.lights[:1], ambient=True)
    mark_receivers(gl, scene, draw_objects)
    receivers = read_depth(gl, size)
    yield "draw the receivers and mark them"

    # 2. draw the flattened casters: they clear the stencil buffer where there is shadow
    first = scene.lights[0]
    unmark_shadows(gl, scene, first, clip)
    lit = [read_stencil(gl, size) != 0]
    yield title_of("unmark the flattened casters", scene, first)

    # 3. draw the dark part of the receivers
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    light_ambient_only(gl, scene)
    draw_objects(gl, scene.receivers)
    gl.glDepthFunc(gl.GL_LESS)
    yield title_of("draw the dark part of the receivers", scene, first)

    for light in scene.lights[1:]:
        mark_again(gl, scene)
        unmark_shadows(gl, scene, light, clip)
        lit.append(read_stencil(gl, size) != 0)
        yield title_of("unmark the flattened casters", scene, light)

        gl.glStencilFunc(gl.GL_NOTEQUAL, 0, 0xFF)
        light_by(gl, scene, [light], ambient=False)
        with added(gl):
            draw_objects(gl, scene.receivers)
        yield title_of("add the light where receivers are marked", scene, light)

    # 4. draw the casters
    gl.glDisable(gl.GL_STENCIL_TEST)
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def stencil_blend(gl: Any, scene: Scene, size: tuple[int, int], clip: bool, factor: float, units: float) -> Steps:
    """Receiver into colour and stencil, flattened caster blended once for each marked pixel, caster.

    The first layer that darkens a pixel takes its mark away, so that the second finds none.
    """
    # 1. draw the receivers into the colour and the stencil buffer
    gl.glEnable(gl.GL_STENCIL_TEST)
    light_by(gl, scene, scene.lights, ambient=True)
    mark_receivers(gl, scene, draw_objects)
    receivers = read_depth(gl, size)
    yield "draw the receivers and mark them"

    # 2. blend the flattened casters over marked pixels
    lit: list[np.ndarray] = []
    for light in scene.lights:
        if lit:
            mark_again(gl, scene)
        gl.glDisable(gl.GL_LIGHTING)
        gl.glEnable(gl.GL_BLEND)
        gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(factor, units)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
        for number, receiver in enumerate(scene.receivers, start=1):
            gl.glStencilFunc(gl.GL_EQUAL, number, 0xFF)
            gl.glColor4f(0.0, 0.0, 0.0, DARKNESS)
            draw_flattened(gl, scene, receiver, light, clip)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glDepthMask(gl.GL_TRUE)
        gl.glDisable(gl.GL_BLEND)
        lit.append(read_stencil(gl, size) != 0)
        yield title_of("darken each marked pixel once", scene, light)

    # 3. draw the casters
    gl.glDisable(gl.GL_STENCIL_TEST)
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


# -- parts that methods share ------------------------------------------------------------------------------------------


def begin_counting_layers(gl: Any) -> None:
    """Let the stencil buffer count how often a pixel is painted; the picture does not depend on it."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)


def paint_shadows(gl: Any, scene: Scene, light: Light, clip: bool) -> None:
    """Draw the flattened casters in the colour that each receiver has without light."""
    gl.glDisable(gl.GL_LIGHTING)
    for receiver in scene.receivers:
        gl.glColor3f(*np.clip(receiver.material.color * scene.ambient, 0, 1))
        draw_flattened(gl, scene, receiver, light, clip)


def mark_receivers(gl: Any, scene: Scene, draw: Callable[[Any, list[SceneObject]], None]) -> None:
    """Draw each receiver with its number into the stencil buffer."""
    largest = 2 ** int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) - 1
    if len(scene.receivers) > largest:
        raise SceneError(
            f"scene {scene.name}: {len(scene.receivers)} receivers; expected at most {largest}, the numbers that the "
            "stencil buffer has for marks (methods depth-off, offset and texture need none)"
        )
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_ALWAYS, number, 0xFF)
        draw(gl, [receiver])


def mark_again(gl: Any, scene: Scene) -> None:
    """Mark the visible receivers anew for the next light, in the stencil buffer alone."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glDepthFunc(gl.GL_LEQUAL)
    mark_receivers(gl, scene, draw_shapes)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)


def unmark_shadows(gl: Any, scene: Scene, light: Light, clip: bool) -> None:
    """Clear the mark of a receiver's pixels where a caster flattened onto it is drawn."""
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_EQUAL, number, 0xFF)
        draw_flattened(gl, scene, receiver, light, clip)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glEnable(gl.GL_DEPTH_TEST)
