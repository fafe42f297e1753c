"""What most programs begin with: a camera, a light, a texture, a mesh in vertex arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from softshadow.bench.corpus.shapes import Surface, box_faces

BOX = box_faces()


def look(
    gl: Any,
    size: tuple[int, int],
    eye: Sequence[float] = (3.0, 2.5, 4.0),
    target: Sequence[float] = (0.0, 0.0, 0.0),
    field_of_view: float = 45.0,
    near: float = 0.5,
    far: float = 40.0,
) -> None:
    """Set the viewport and a perspective camera."""
    gl.glViewport(0, 0, *size)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluPerspective(field_of_view, size[0] / size[1], near, far)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.gluLookAt(*eye, *target, 0.0, 1.0, 0.0)


def flat_view(gl: Any, size: tuple[int, int], width: float, height: float) -> None:
    """Set the viewport and a plane of (width, height) units, origin at the lower left."""
    gl.glViewport(0, 0, *size)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluOrtho2D(0.0, width, 0.0, height)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()


def clear(gl: Any, color: Sequence[float] = (0.1, 0.15, 0.25, 1.0), more: int = 0) -> None:
    """Clear colour and depth, and what else is named."""
    gl.glClearColor(*color)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | more)


def light(gl: Any, position: Sequence[float] = (2.0, 5.0, 3.0, 1.0)) -> None:
    """Turn on depth test and one light; glColor sets the material."""
    for capability in (gl.GL_DEPTH_TEST, gl.GL_LIGHTING, gl.GL_LIGHT0, gl.GL_COLOR_MATERIAL, gl.GL_NORMALIZE):
        gl.glEnable(capability)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, position)
    gl.glLightfv(gl.GL_LIGHT0, gl.GL_DIFFUSE, [0.9, 0.9, 0.85, 1.0])
    gl.glColorMaterial(gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE)


def shine(gl: Any, shininess: float = 40.0) -> None:
    """Give the material a white highlight."""
    gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, [0.6, 0.6, 0.6, 1.0])
    gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, shininess)


def box(gl: Any) -> None:
    """Draw the cube from -1 to 1 with glBegin."""
    gl.glBegin(gl.GL_QUADS)
    for normal, corners in BOX:
        gl.glNormal3f(*normal)
        for corner in corners:
            gl.glVertex3f(*corner)
    gl.glEnd()


def floor(gl: Any, half: float = 4.0, y: float = 0.0, repeat: float = 4.0) -> None:
    """Draw a horizontal square as one quad."""
    gl.glBegin(gl.GL_QUADS)
    gl.glNormal3f(0.0, 1.0, 0.0)
    for x, z in ((-1, -1), (-1, 1), (1, 1), (1, -1)):
        gl.glTexCoord2f(repeat * x, repeat * z)
        gl.glVertex3f(half * x, y, half * z)
    gl.glEnd()


def arrays(gl: Any, mesh: Surface, texture: bool = False) -> None:
    """Point at the arrays of a mesh."""
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, mesh.positions)
    gl.glNormalPointer(gl.GL_FLOAT, 0, mesh.normals)
    if texture:
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, mesh.texture)
    else:
        gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)


def draw(gl: Any, mesh: Surface, texture: bool = False) -> None:
    """Draw a mesh from arrays of the program."""
    arrays(gl, mesh, texture)
    gl.glDrawElements(gl.GL_TRIANGLES, mesh.triangles.size, gl.GL_UNSIGNED_INT, mesh.triangles)


def upload(gl: Any, image: np.ndarray, smallest: int, wrap: int) -> int:
    """Return a texture of an image (h, w, 4), with the filter for small sizes and the wrap mode given."""
    name: int = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    mipmapped = smallest not in (gl.GL_NEAREST, gl.GL_LINEAR)
    largest = gl.GL_NEAREST if smallest == gl.GL_NEAREST else gl.GL_LINEAR
    for parameter, value in (
        (gl.GL_TEXTURE_MIN_FILTER, smallest),
        (gl.GL_TEXTURE_MAG_FILTER, largest),
        (gl.GL_TEXTURE_WRAP_S, wrap),
        (gl.GL_TEXTURE_WRAP_T, wrap),
        (gl.GL_GENERATE_MIPMAP, int(mipmapped)),
    ):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, parameter, value)
    height, width = image.shape[:2]
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, width, height, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
    return name
