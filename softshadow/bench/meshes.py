"""The scene of the shadow workloads: a closed mesh with any number of triangles above a ground."""

from __future__ import annotations

import numpy as np

from softshadow.scene import Camera, Light, Material, Scene, SceneObject, placement, shapes

TRIANGLES = 70_000


def torus_over_ground(triangles: int = TRIANGLES) -> Scene:
    """Return a scene with a torus of about `triangles` triangles, a ground and a point light."""
    sides = max(3, round((triangles / 4) ** 0.5))
    torus = shapes.torus(1.0, 0.4, segments=2 * sides, sides=sides)
    shiny = Material(np.array((0.8, 0.4, 0.2)), np.full(3, 0.5), 40)
    return Scene(
        "torus over ground",
        Camera((2.4, 3.0, 4.6), (0, 0.6, 0), near=0.5, far=40),
        (Light((1.5, 5.0, 2.0)),),
        (
            SceneObject(shapes.floor(12), casts=False, receives=True, name="ground"),
            SceneObject(torus, placement((0, 1.3, 0), (40, 1, 0, 0.3)), shiny),
        ),
    )
