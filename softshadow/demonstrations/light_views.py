"""Demonstrations about shadow maps: object space against world space, and depth against distance."""

from typing import Any

import numpy as np

from softshadow.demonstrations.demonstration import Demonstration, color_of, depth_of, number
from softshadow.listings.depth_and_stencil import RED
from softshadow.listings.maps import (
    LIGHT_FAR,
    LIGHT_FOV,
    LIGHT_NEAR,
    MAP_SIZE,
    begin_framebuffer,
    end_framebuffer,
    light_matrix,
    look_from_light,
    restore,
    set_up,
    use,
)  # fmt: skip
from softshadow.listings.stage import AMBIENT, STAGE, Thing, begin_frame, draw, moved

PLACE = (0.0, 0.5, 0.0)  # where a model matrix puts the lower box
BOX = STAGE.occluder[0]
CENTERED = Thing(moved(BOX.mesh, *(-value for value in PLACE)), BOX.color)
MODEL = np.eye(4, dtype=np.float32)
MODEL[:3, 3] = PLACE
CORRECTED = frozenset({"E46", "E47"})
BEHIND = -5.0  # eye z of a wall across the light's view
ONE_PERCENT = 0.01
ROUNDING = 1  # level of 255: 0.9 is half-way between two of them


def picture(gl: Any, placed: bool, in_product: bool) -> np.ndarray:
    """Return the scene with one box and its shadow map.

    Parameters
    ----------
    placed                       the box is placed by a model matrix; otherwise its vertices are in world space
    in_product                   the program gets the model matrix, for the product that gives the texture coordinates
    """
    begin_frame(gl, STAGE)
    gl.glDisable(gl.GL_LIGHTING)
    framebuffer = begin_framebuffer(gl, set_up(gl, CORRECTED))
    gl.glViewport(0, 0, MAP_SIZE, MAP_SIZE)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluPerspective(LIGHT_FOV, 1.0, LIGHT_NEAR, LIGHT_FAR)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    look_from_light(gl, STAGE)
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glPolygonOffset(1, 1)
    gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
    draw(gl, STAGE.receiver)
    draw_box(gl, placed)
    gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
    end_framebuffer(gl, framebuffer)

    restore(gl, STAGE)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    program, matrix = gl.program("shadow-map"), np.asarray(light_matrix(gl, STAGE))
    use(gl, program, matrix, 0.0, AMBIENT)
    draw(gl, STAGE.receiver, unlit=1.0)
    if in_product:
        gl.glUniformMatrix4fv(gl.glGetUniformLocation(program, "modelMatrix"), 1, gl.GL_TRUE, MODEL)
    draw_box(gl, placed, unlit=1.0)
    gl.glUseProgram(0)
    return color_of(gl)


def draw_box(gl: Any, placed: bool, unlit: float = AMBIENT) -> None:
    """Draw the box, in object space with a model matrix or in world space."""
    gl.glPushMatrix()
    if placed:
        gl.glTranslatef(*PLACE)
    draw(gl, [CENTERED if placed else BOX], unlit)
    gl.glPopMatrix()


def model_matrix(gl: Any) -> list[int]:
    """E66: wrong pixels of a box that a model matrix places: lightMatrix * vertex, and with the model matrix."""
    right = picture(gl, placed=False, in_product=False).astype(int)
    pictures = [picture(gl, placed=True, in_product=each) for each in (False, True)]
    return [number((abs(each - right) > ROUNDING).any(axis=-1)) for each in pictures]


def distance_of_equal_depths(gl: Any) -> list[int]:
    """E69: pixels of a wall across the light's view that differ from its middle: by distance, and by window z."""
    gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluPerspective(LIGHT_FOV, 1.0, LIGHT_NEAR, LIGHT_FAR)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.glColor3f(*RED)
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((-4, -4), (4, -4), (4, 4), (-4, 4)):
        gl.glVertex3f(x, y, BEHIND)
    gl.glEnd()
    depth = depth_of(gl)
    height, width = depth.shape
    slope = np.tan(np.radians(LIGHT_FOV / 2))  # the view is square
    x, y = np.meshgrid((2 * np.arange(width) + 1) / width - 1, (2 * np.arange(height) + 1) / height - 1)
    distance = -BEHIND * np.sqrt(1 + slope**2 * (x**2 + y**2))
    middle = depth[height // 2, width // 2]
    return [number(distance > -BEHIND * (1 + ONE_PERCENT)), number(abs(depth - middle) > ONE_PERCENT * middle)]


DEMONSTRATIONS = (
    Demonstration("model-matrix", "wrong pixels: without, with the model matrix", model_matrix),
    Demonstration("distance-of-equal-depths", "pixels of a wall that differ by 1 % from its middle: distance, window z",
                  distance_of_equal_depths),
)  # fmt: skip
