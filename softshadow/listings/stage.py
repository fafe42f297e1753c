"""The scene of the listings: a floor, two boxes one upon the other, a lamp; drawn by glBegin and glEnd.

The slides write ``dibuixa(receptor)``, ``dibuixa(oclusor)`` and ``dibuixa(escena)``. Here that is
``draw(gl, stage.receiver)`` and so on, and the stage is a parameter of every listing.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow import matrices
from softshadow.scene import Mesh
from softshadow.scene.shapes import box, floor

SIZE = (128, 128)  # of the window in which the listings are shown and their pixels counted
AMBIENT = 0.3  # ambient light, and so the share of its colour that a surface has in shadow
NEAR, FAR = 1.0, 13.0
FIELD_OF_VIEW = 40.0


@dataclass(frozen=True, eq=False)
class Thing:
    """A mesh in world space, its colour, and its name."""

    mesh: Mesh
    color: tuple[float, float, float]

    @property
    def name(self) -> str:
        """The name of the mesh."""
        return self.mesh.name


@dataclass(frozen=True, eq=False)
class Stage:
    """A lamp (homogeneous position), an eye that looks at a target, and the objects that the slides draw."""

    light: tuple[float, float, float, float]
    eye: tuple[float, float, float]
    target: tuple[float, float, float]
    receiver: tuple[Thing, ...]
    occluder: tuple[Thing, ...]

    @property
    def scene(self) -> tuple[Thing, ...]:
        """The receiver and the occluders."""
        return self.receiver + self.occluder

    @property
    def emitter(self) -> tuple[Thing, ...]:
        """A small box at the place of the light."""
        return (Thing(moved(box(0.2, name="lamp"), *self.light[:3]), (1.0, 1.0, 0.6)),)


def moved(mesh: Mesh, x: float, y: float, z: float) -> Mesh:
    """Return a mesh moved by (x, y, z)."""
    return Mesh(mesh.positions + np.array([x, y, z], np.float32), mesh.triangles, mesh.normals, name=mesh.name)


FLOOR = Thing(floor(5), (0.8, 0.8, 0.7))
LOWER = Thing(moved(box(1.6, 1.0, 1.6, name="lower box"), 0.0, 0.5, 0.0), (0.9, 0.4, 0.2))
UPPER = Thing(moved(box(0.8, 0.8, 0.8, name="upper box"), 0.1, 1.4, -0.1), (0.2, 0.5, 0.9))
BELOW = Thing(moved(box(0.5, name="box below the floor"), 1.5, -0.6, -0.8), (0.3, 0.8, 0.3))
STAGE = Stage((-2.0, 4.0, 1.5, 1.0), (4.2, 4.0, 6.1), (0.1, 0.5, -0.1), (FLOOR,), (LOWER, UPPER))

# the eye near the shadows: part of the near rectangle lies in a volume, part of it outside
NEAR_SHADOW = Stage(STAGE.light, (1.6, 0.6, -0.8), (2.5, 0.0, 2.5), (FLOOR,), (LOWER, UPPER))

# the lamp behind the eye: lines of sight run along the volumes and leave them far away
DOWN_THE_AXIS = Stage((5.0, 3.2, 5.0, 1.0), STAGE.eye, STAGE.target, (FLOOR,), (LOWER, UPPER))

# a lamp low over a long table: the middle of its top is much nearer than its corners
OVER_THE_TABLE = Stage(
    (0.1, 1.2, 0.0, 1.0),
    STAGE.eye,
    STAGE.target,
    (FLOOR,),
    (Thing(moved(box(0.8, 0.1, 2.4, name="table"), 0.0, 0.85, 0.0), LOWER.color),),
)

# a lamp below the upper box, and a box below the floor: neither casts a proper shadow on the floor
LOW_LAMP = Stage(
    (0.9, 1.6, 0.9, 1.0),
    STAGE.eye,
    STAGE.target,
    (FLOOR,),
    (
        Thing(moved(box(0.5, name="box on the floor"), -0.4, 0.25, 0.0), LOWER.color),
        Thing(moved(box(0.4, name="box above the lamp"), 1.2, 2.3, 0.6), UPPER.color),
        BELOW,
    ),
)

# shadows that reach over the floor's edge, and a box below the floor
OVER_THE_EDGE = Stage(STAGE.light, STAGE.eye, STAGE.target, (FLOOR,), (LOWER, UPPER, BELOW))


def begin_frame(gl: Any, stage: Stage, far: float | None = FAR) -> None:
    """Clear the buffers and set what the slides assume: camera, depth test, one white light.

    The slide has the buffers "initialised automatically in each frame" (RO1:177-179); E61: only glClear does it. `far`
    is the distance of the far plane, or None for a camera without one.
    """
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    set_camera(gl, stage, far)
    gl.glEnable(gl.GL_LIGHTING)
    gl.glEnable(gl.GL_LIGHT0)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, stage.light)
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, (AMBIENT, AMBIENT, AMBIENT, 1.0))


def set_camera(gl: Any, stage: Stage, far: float | None = FAR) -> None:
    """Set projection and view of the eye."""
    _, _, width, height = gl.glGetIntegerv(gl.GL_VIEWPORT)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    if far is None:
        gl.glMultMatrixd(matrices.infinite_perspective(FIELD_OF_VIEW, width / height, NEAR).T.copy())
    else:
        gl.gluPerspective(FIELD_OF_VIEW, width / height, NEAR, far)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.gluLookAt(*stage.eye, *stage.target, 0.0, 1.0, 0.0)


def draw(gl: Any, things: Iterable[Thing], unlit: float = AMBIENT) -> None:
    """Draw things; with lighting off they have the share `unlit` of their colour."""
    for thing in things:
        draw_faces(gl, thing, thing.mesh.triangles, unlit)


def draw_faces(gl: Any, thing: Thing, triangles: np.ndarray, unlit: float = AMBIENT) -> None:
    """Draw some triangles (T, 3) of a thing; every draw sends the same vertices, so its depths are the same bits."""
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, thing.name)
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE, (*thing.color, 1.0))
    gl.glColor3f(*(unlit * channel for channel in thing.color))
    gl.glBegin(gl.GL_TRIANGLES)
    for vertex in triangles.ravel().tolist():
        gl.glNormal3f(*thing.mesh.normals[vertex].tolist())
        gl.glVertex3f(*thing.mesh.positions[vertex].tolist())
    gl.glEnd()
    gl.glPopDebugGroup()
