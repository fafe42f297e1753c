"""Demonstrations about planar shadows: where, in which colour and with which sign they are drawn."""

from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.demonstrations.demonstration import (
    Demonstration,
    clear,
    color_of,
    differing,
    finish,
    number,
    stencil_of,
)
from softshadow.listings.planar import GROUND, multiply, three_steps, with_stencil
from softshadow.listings.projection import from_point, onto_ground
from softshadow.listings.stage import AMBIENT, STAGE, Stage, Thing, begin_frame, draw

CORRECTED = frozenset({"E33", "E34"})
LATER = replace(STAGE, light=(-2.0, 4.0, -1.0, 1.0))  # the lamp, moved


def vertices_on_the_plane(gl: Any) -> list[int]:
    """E22: vertices of the casters with y = 0, before and after the matrix of SK:153."""
    points = np.concatenate([thing.mesh.positions for thing in STAGE.occluder])
    projected = np.column_stack([points, np.ones(len(points))]) @ onto_ground(STAGE.light).T
    return [number(points[:, 1] == 0), number(projected[:, 1] == 0)]


def unclamped_light(gl: Any) -> list[int]:
    """E23: pixels that are darker than ambient light alone, with L · N as printed and with max(0, L · N)."""
    begin_frame(gl, STAGE)
    gl.glDisable(gl.GL_LIGHTING)
    draw(gl, STAGE.scene)
    ambient = color_of(gl)
    darker = []
    for least in (-1.0, 0.0):
        clear(gl)
        for thing in STAGE.scene:
            draw_with_colors(gl, thing, least)
        darker.append(number((color_of(gl)[..., :3] < ambient[..., :3]).any(axis=-1)))
    return darker


def draw_with_colors(gl: Any, thing: Thing, least: float) -> None:
    """Draw a thing with the colours of the formula at its vertices; L · N is at least `least`."""
    positions, normals = thing.mesh.positions.astype(np.float64), thing.mesh.normals.astype(np.float64)
    towards = np.array(STAGE.light[:3]) - positions
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    light = AMBIENT + np.maximum((towards * normals).sum(axis=1), least)
    gl.glBegin(gl.GL_TRIANGLES)
    for vertex in thing.mesh.triangles.ravel().tolist():
        gl.glColor3f(*(float(channel * light[vertex]) for channel in thing.color))
        gl.glVertex3f(*thing.mesh.positions[vertex].tolist())
    gl.glEnd()


def shadow_pixels(gl: Any, matrix: np.ndarray) -> int:
    """Return how many pixels the flattened casters cover."""
    begin_frame(gl, STAGE)
    gl.glDisable(gl.GL_LIGHTING)
    multiply(gl, matrix)
    draw(gl, STAGE.occluder)
    return number(color_of(gl)[..., :3].any(axis=-1))


def sign_of_w(gl: Any) -> list[int]:
    """E37: pixels of the shadow, by the matrix of SK:153 and by that of CA:383 with the plane turned over (E35)."""
    turned = tuple(-value for value in GROUND)
    return [shadow_pixels(gl, onto_ground(STAGE.light)), shadow_pixels(gl, from_point(turned, STAGE.light))]


def two_masks(gl: Any) -> list[int]:
    """E41: pixels of the receiver left in the light, by the mask 255 of CA:759 and by the mask 1 of CA:333."""
    lit = []
    for mask in (255, 1):
        finish(with_stencil(gl, frozenset(), STAGE, mask))
        lit.append(number(stencil_of(gl) == 1))
    return lit


def kept_shadow(gl: Any) -> list[int]:
    """E56: wrong pixels after the lamp has moved, if the shadow is kept and if it is projected again."""
    pictures = []
    for light in (STAGE.light, LATER.light):
        finish(three_steps(gl, CORRECTED, LATER, onto_ground(light)))
        pictures.append(color_of(gl))
    finish(three_steps(gl, CORRECTED, LATER))
    right = color_of(gl)
    return [differing(picture, right) for picture in pictures]


def colour_of_the_shadow(gl: Any) -> list[int]:
    """E67: pixels of the shadow whose colour is not the receiver's in ambient light: as printed, and recoloured."""
    begin_frame(gl, STAGE)
    gl.glDisable(gl.GL_LIGHTING)
    draw(gl, STAGE.receiver)
    ambient = color_of(gl)
    gray = tuple(Thing(thing.mesh, STAGE.receiver[0].color) for thing in STAGE.occluder)
    wrong = []
    for casters in (STAGE.occluder, gray):
        stage = Stage(STAGE.light, STAGE.eye, STAGE.target, STAGE.receiver, casters)
        steps = three_steps(gl, CORRECTED, stage)
        next(steps)
        lit = color_of(gl)
        next(steps)  # the flattened occluder
        shadowed = color_of(gl)
        wrong.append(number((shadowed != lit).any(axis=-1) & (shadowed != ambient).any(axis=-1)))
        finish(steps)
    return wrong


DEMONSTRATIONS = (
    Demonstration("vertices-on-the-plane", "vertices of casters with y = 0: before, after the matrix",
                  vertices_on_the_plane, on_mesa=False),
    Demonstration("unclamped-light", "pixels darker than ambient light: L·N, max(0, L·N)", unclamped_light),
    Demonstration("sign-of-w", "pixels of the shadow: SK:153, corrected CA:383", sign_of_w),
    Demonstration("two-masks", "pixels left in light: mask 255, mask 1", two_masks),
    Demonstration("kept-shadow", "wrong pixels with a moved light: shadow kept, drawn again", kept_shadow),
    Demonstration("colour-of-the-shadow", "shadow pixels of another colour than the floor's: printed, recoloured",
                  colour_of_the_shadow),
)  # fmt: skip
