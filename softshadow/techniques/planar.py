"""Projected planar shadows: casters flattened onto flat receivers by one matrix.

A 4x4 matrix takes every point along the ray from the light onto the receiver's plane; the caster drawn through it, in
dark, is its own shadow. Flattened caster and receiver lie in one plane, and the flattened caster may reach beyond the
receiver's edge: the five methods differ in how they decide which of the two is seen. `stencil` is the one without a
fault.

Paper: Blinn 1988, "Me and my (fake) shadow".
Slides: Andújar, Ombres per projecció (un pla; amb stencil; completa); Zimányi & Valient, Projekčné tiene.

Known failures: receivers have to be flat, casters have no shadow on themselves or on each other, edges are hard.
depth-off paints over nearer objects, and beyond the edge of the receiver; offset paints beyond the edge and over the
feet of casters, and receiver and shadow fight for the pixel when factor and units are 0; both paint every light's
shadow as dark as if there were no other light. stencil-blend darkens the whole colour instead of leaving out the light.
`clip` = False shows the false shadow of what is behind a receiver.
"""

from collections.abc import Callable
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.errors import SceneError
from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing
from softshadow.techniques.flattened import draw_flattened, draw_the_casters
from softshadow.techniques.planar_texture import texture
from softshadow.techniques.technique import Range, Steps

# stencil-blend: the share of the colour that a shadow takes away, however much of it came from the light
DARKNESS = 0.6


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    method: Annotated[
        Literal["depth-off", "offset", "stencil", "stencil-blend", "texture"],
        "how receiver and flattened caster share the plane",
    ] = "stencil",
    clip: Annotated[bool, "cut casters at the receiver's plane and at the light before they are flattened"] = True,
    factor: Annotated[float, "offset and stencil-blend: first argument of glPolygonOffset; negative is nearer"] = -1.0,
    units: Annotated[float, "offset and stencil-blend: second argument of glPolygonOffset"] = -1.0,
    texture_size: Annotated[int, "texture: texels on a side of each receiver's shadow", Range(1, 4096)] = 256,
) -> Steps:
    """Draw the scene with planar shadows by one of the methods."""
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
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
    """Draw the receivers, the flattened casters with the depth test off, then the casters."""
    # 1. draw the receivers
    drawing.light_by(gl, scene, scene.lights, ambient=True)
    drawing.draw_objects(gl, scene.receivers)
    receivers = drawing.read_depth(gl, size)
    yield "draw the receivers"

    # 2. draw the flattened casters (the shadow)
    lit: list[np.ndarray] = []
    for light in scene.lights:
        begin_counting_layers(gl)
        gl.glDisable(gl.GL_DEPTH_TEST)
        paint_shadows(gl, scene, light, clip)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDisable(gl.GL_STENCIL_TEST)
        lit.append(drawing.read_stencil(gl, size) == 0)
        yield drawing.title("draw the flattened casters", scene, light)

    # 3. draw the casters (E34: the slide prints "emissor", the light source)
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def offset(gl: Any, scene: Scene, size: tuple[int, int], clip: bool, factor: float, units: float) -> Steps:
    """Draw the receivers, the flattened casters a little nearer by glPolygonOffset, then the casters."""
    # 1. draw the receivers
    drawing.light_by(gl, scene, scene.lights, ambient=True)
    drawing.draw_objects(gl, scene.receivers)
    receivers = drawing.read_depth(gl, size)
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
        lit.append(drawing.read_stencil(gl, size) == 0)
        yield drawing.title("draw the flattened casters", scene, light)

    # 3. draw the casters
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def stencil(gl: Any, scene: Scene, size: tuple[int, int], clip: bool) -> Steps:
    """Mark the receivers, unmark the flattened casters, draw the dark part of the receivers, then the casters.

    Each receiver marks its pixels with a number of its own (1 for the first), so that a caster flattened onto one
    receiver does not affect the others. The first light is drawn as on the slide; every further light is added where
    it is visible.
    """
    check_number_of_receivers(gl, scene)
    first = scene.lights[0]

    # 1. draw the receivers into the colour and the stencil buffer
    gl.glEnable(gl.GL_STENCIL_TEST)
    drawing.light_by(gl, scene, [first], ambient=True)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_ALWAYS, number, 0xFF)
        drawing.draw_objects(gl, [receiver])
    receivers = drawing.read_depth(gl, size)
    yield "draw the receivers and mark them"

    # 2. draw the flattened casters: they clear the stencil buffer where there is shadow
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_EQUAL, number, 0xFF)
        draw_flattened(gl, scene, receiver, first, clip)
    lit = [drawing.read_stencil(gl, size) != 0]
    yield drawing.title("unmark the flattened casters", scene, first)

    # 3. draw the dark part of the receivers
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_LEQUAL)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.receivers)
    gl.glDepthFunc(gl.GL_LESS)
    yield drawing.title("draw the dark part of the receivers", scene, first)

    for light in scene.lights[1:]:
        yield from add_further_light(gl, scene, size, light, clip, lit)

    # 4. draw the casters
    gl.glDisable(gl.GL_STENCIL_TEST)
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


def add_further_light(
    gl: Any, scene: Scene, size: tuple[int, int], light: Light, clip: bool, lit: list[np.ndarray]
) -> Steps:
    """Mark the receivers again, unmark the flattened casters, and add the light where marks are left."""
    mark_again(gl, scene)
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_ZERO)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_EQUAL, number, 0xFF)
        draw_flattened(gl, scene, receiver, light, clip)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glEnable(gl.GL_DEPTH_TEST)
    lit.append(drawing.read_stencil(gl, size) != 0)
    yield drawing.title("unmark the flattened casters", scene, light)

    gl.glStencilFunc(gl.GL_NOTEQUAL, 0, 0xFF)
    drawing.light_by(gl, scene, [light], ambient=False)
    with drawing.additive_blending(gl):
        drawing.draw_objects(gl, scene.receivers, emission=False)
    yield drawing.title("add the light where receivers are marked", scene, light)


def stencil_blend(gl: Any, scene: Scene, size: tuple[int, int], clip: bool, factor: float, units: float) -> Steps:
    """Mark the receivers, blend the flattened casters once over each marked pixel, then draw the casters.

    The first layer that darkens a pixel clears its mark, so that further layers do not darken it again.
    """
    # 1. draw the receivers into the colour and the stencil buffer
    gl.glEnable(gl.GL_STENCIL_TEST)
    drawing.light_by(gl, scene, scene.lights, ambient=True)
    mark_receivers(gl, scene, drawing.draw_objects)
    receivers = drawing.read_depth(gl, size)
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
        lit.append(drawing.read_stencil(gl, size) != 0)
        yield drawing.title("darken each marked pixel once", scene, light)

    # 3. draw the casters
    gl.glDisable(gl.GL_STENCIL_TEST)
    yield from draw_the_casters(gl, scene, size, receivers < 1, lit)


# -- parts that methods share ------------------------------------------------------------------------------------------


def begin_counting_layers(gl: Any) -> None:
    """Let the stencil buffer count how often each pixel is painted; the picture does not depend on it."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)


def paint_shadows(gl: Any, scene: Scene, light: Light, clip: bool) -> None:
    """Draw the flattened casters in the colour that each receiver has under the ambient light."""
    gl.glDisable(gl.GL_LIGHTING)
    for receiver in scene.receivers:
        material = receiver.material
        gl.glColor3f(*np.clip(material.color * scene.ambient + material.emission, 0, 1))
        draw_flattened(gl, scene, receiver, light, clip)


def mark_receivers(gl: Any, scene: Scene, draw: Callable[[Any, list[SceneObject]], None]) -> None:
    """Draw each receiver and write its number into the stencil buffer."""
    check_number_of_receivers(gl, scene)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    for number, receiver in enumerate(scene.receivers, start=1):
        gl.glStencilFunc(gl.GL_ALWAYS, number, 0xFF)
        draw(gl, [receiver])


def check_number_of_receivers(gl: Any, scene: Scene) -> None:
    """Make sure that the stencil buffer has a number for each receiver.

    Raises
    ------
    SceneError                   more receivers than numbers
    """
    largest = 2 ** int(gl.glGetIntegerv(gl.GL_STENCIL_BITS)) - 1
    if len(scene.receivers) > largest:
        raise SceneError(
            f"scene {scene.name}: {len(scene.receivers)} receivers; expected at most {largest}, the numbers that the "
            "stencil buffer has for marks (methods depth-off, offset and texture need none)"
        )


def mark_again(gl: Any, scene: Scene) -> None:
    """Mark the visible receivers again for the next light; only the stencil buffer changes."""
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glDepthFunc(gl.GL_LEQUAL)
    mark_receivers(gl, scene, drawing.draw_shapes)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
