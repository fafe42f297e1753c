"""Small triangles workload: a depth-only pass of a million triangles of a few pixels, as a dense mesh in a shadow map.

It measures vertex transform and triangle setup; fragments take little of the time.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow.scene import Mesh, shapes
from softshadow.techniques.drawing import draw_triangles
from softshadow.testing.timing import DrawFrame

TRIANGLES = 1_000_000


def prepare(gl: Any, size: tuple[int, int], *, shape: str, triangles: int = TRIANGLES) -> DrawFrame:
    """Prepare the mesh; a frame clears the depth buffer and draws the mesh once.

    Parameters
    ----------
    shape : "sphere" or "grid"
    triangles : int              approximate number
    """
    mesh = sphere(triangles) if shape == "sphere" else displaced_grid(triangles)
    gl.glViewport(0, 0, *size)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    gl.gluPerspective(45.0, size[0] / size[1], 0.5, 10.0)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.gluLookAt(0.0, 0.0, 2.7, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)

    def frame() -> None:
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        draw_triangles(gl, mesh.positions, mesh.triangles)

    return frame


def sphere(triangles: int) -> Mesh:
    """Return a sphere that fills the view, with twice as many segments as rings."""
    rings = max(2, round((triangles / 4) ** 0.5))
    return shapes.sphere(1.0, segments=max(3, 2 * rings), rings=rings)


def displaced_grid(triangles: int) -> Mesh:
    """Return a grid with hills that fills the view."""
    cells = max(1, round((triangles / 2) ** 0.5))
    across = np.linspace(-1.15, 1.15, cells + 1)
    x, y = np.meshgrid(across, across)
    z = 0.1 * np.sin(7 * x) * np.cos(9 * y)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    cell = np.stack([first, first + 1, first + cells + 2, first, first + cells + 2, first + cells + 1], axis=1)
    return Mesh(np.stack([x, y, z], axis=2).reshape(-1, 3), cell.reshape(-1, 3), name="displaced grid")
