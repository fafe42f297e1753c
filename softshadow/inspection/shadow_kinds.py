"""Own and cast shadow, pixel by pixel: of a surface that is turned away from a light, and of one that is hidden."""

from __future__ import annotations

import numpy as np

from softshadow.inspection.hard_truth import seen_faces
from softshadow.scene import Light, Scene

NO_SHADOW, OWN, CAST = 0, 1, 2


def turned_away(scene: Scene, light: Light, size: tuple[int, int]) -> np.ndarray:
    """Return (H, W) bool, row 0 on top: where the camera sees a side of a caster that the light does not reach.

    Eye and light are then on different sides of the face. A surface that does not cast lets light through.
    """
    objects, triangles, points = seen_faces(scene, size)
    away = np.zeros(len(objects), bool)
    for number, thing in enumerate(scene.objects):
        seen = np.flatnonzero(objects == number)
        if not thing.casts or not len(seen):
            continue
        corners = thing.world_positions[thing.mesh.triangles[triangles[seen]]]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        to_eye = (normals * (scene.camera.eye - points[seen])).sum(axis=1)
        to_light = (normals * (light.position[:3] - light.position[3] * points[seen])).sum(axis=1)
        away[seen] = to_eye * to_light <= 0
    width, height = size
    return away.reshape(height, width)


def shadow_kinds(scene: Scene, light: Light, shadow: np.ndarray) -> np.ndarray:
    """Return (H, W) uint8: 0 where there is no shadow, 1 for own shadow, 2 for cast shadow.

    Parameters
    ----------
    shadow : (H, W) bool         where the light is hidden, fully or in part; row 0 on top
    """
    height, width = shadow.shape
    kinds = np.where(shadow, CAST, NO_SHADOW).astype(np.uint8)
    kinds[shadow & turned_away(scene, light, (width, height))] = OWN
    kinds.setflags(write=False)
    return kinds
