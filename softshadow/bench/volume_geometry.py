"""The geometry of shadow volumes alone: silhouette, extrusion and caps of a large mesh, as if the light had moved.

Nothing is drawn, so all renderers take the same time; what counts is seconds.
"""

from __future__ import annotations

from typing import Any

from softshadow.bench.meshes import torus_over_ground
from softshadow.techniques.shadow_volumes import volumes_of
from softshadow.testing.timing import Frame

TRIANGLES = 1_000_000


def prepare(gl: Any, size: tuple[int, int], *, triangles: int = TRIANGLES) -> Frame:
    """A frame makes the volumes of all casters; how the mesh hangs together is found out once, before."""
    scene = torus_over_ground(triangles)

    def frame() -> None:
        volumes_of(scene, scene.lights[0], "silhouette", "infinite", None)

    frame()
    return frame
