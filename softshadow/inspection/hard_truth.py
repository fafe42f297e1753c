"""The hard shadows that a scene has at the pixels of a picture: rays to what is seen, and from there to the light."""

from __future__ import annotations

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.truth import casting_faces_between, first_faces


def hard_visibility(scene: Scene, size: tuple[int, int]) -> tuple[list[np.ndarray], np.ndarray]:
    """Return the visibility of every light at every pixel centre, and where a surface is seen at all.

    The point that a pixel shows is found by its ray, with the face it lies on known by number: that face and those in
    its plane cast nothing on it. A spot light sees nothing outside its cone.

    Returns
    -------
    list of (H, W) float32       per light, 1 lit and 0 in shadow, 1 where no surface is seen; row 0 on top
    (H, W) bool                  where a surface is seen between the near and the far plane
    """
    width, height = size
    found = seen_faces(scene, size)
    visible = []
    for light in scene.lights:
        is_lit = (hard_counts(scene, light, *found) == 0) & ((found[0] < 0) | light.shines_on(found[2]))
        visible.append(is_lit.astype(np.float32).reshape(height, width))
    return visible, (found[0] >= 0).reshape(height, width)


def hard_counts(
    scene: Scene, light: Light, objects: np.ndarray, triangles: np.ndarray, points: np.ndarray
) -> np.ndarray:
    """Return (N,) int32: how many casting faces lie between points and a light, 0 where there is no point.

    Parameters
    ----------
    objects, triangles, points : (N,), (N,), (N, 3)      as `seen_faces` returns them
    """
    seen = objects >= 0
    as_caster = np.full(len(scene.objects) + 1, -1)
    casters = [index for index, thing in enumerate(scene.objects) if thing.casts]
    as_caster[casters] = np.arange(len(casters))
    exclude = as_caster[objects[seen]], triangles[seen]
    counts = np.zeros(len(objects), np.int32)
    counts[seen] = casting_faces_between(
        points[seen], light.position, scene.casters, exclude=exclude, viewer=scene.camera.eye
    )
    return counts


def seen_faces(
    scene: Scene, size: tuple[int, int], aside: tuple[float, float] = (0, 0)
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what every pixel centre shows, row by row from the top.

    Parameters
    ----------
    aside : (x, y)               pixels to the right and down from the centres

    Returns
    -------
    (H * W,) int                 object, -1 where none is seen between the near and the far plane
    (H * W,) int                 triangle of the object
    (H * W, 3) float64           world point
    """
    width, height = size
    camera = scene.camera
    x, y = np.meshgrid(np.arange(width) + 0.5 + aside[0], np.arange(height) + 0.5 + aside[1])
    near_points = camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), size)
    directions = near_points - camera.eye
    objects, triangles, distances = first_faces(near_points, directions, scene.objects)
    # in units of the direction, which spans eye to near plane, the far plane is far / near away from the eye
    seen = (objects >= 0) & (1 + distances <= camera.far / camera.near)
    distances = np.where(seen, distances, 0)
    return np.where(seen, objects, -1), triangles, near_points + distances[:, None] * directions
