"""Shadow volume geometry: silhouette, extrusion and caps of a large mesh, as after a movement of the light.

Nothing is drawn, so the time is the same for all renderers.
"""

from __future__ import annotations

from typing import Any

from softshadow.bench.meshes import torus_over_ground
from softshadow.techniques.shadow_volumes import volumes_of
from softshadow.testing.timing import DrawFrame

TRIANGLES = 1_000_000


def prepare(gl: Any, size: tuple[int, int], *, triangles: int = TRIANGLES) -> DrawFrame:
    """Prepare the scene and the mesh topology; a frame builds the volumes of all casters."""
    scene = torus_over_ground(triangles)

    def frame() -> None:
        volumes_of(scene, scene.lights[0], "silhouette", "infinite", None)

    frame()
    return frame
