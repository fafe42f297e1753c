"""Hard shadows by ray casting: a ray from the eye to the visible surface, and from there to each light."""

from __future__ import annotations

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.truth import casting_faces_between, first_faces


def hard_visibility(scene: Scene, size: tuple[int, int]) -> tuple[list[np.ndarray], np.ndarray]:
    """Return the visibility of every light at every pixel centre, and where a surface is seen at all.

    The eye ray gives the visible point and the face it lies on. That face, and the faces in its plane, cast no shadow
    on the point. Outside the cone of a spot light, the light's visibility is 0.

    Returns
    -------
    list of (H, W) float32       per light: 1 lit or no surface, 0 in shadow; row 0 on top
    (H, W) bool                  where a surface is seen between the near and the far plane
    """
    width, height = size
    objects, triangles, points = seen_faces(scene, size)
    visibilities = []
    for light in scene.lights:
        unblocked = hard_counts(scene, light, objects, triangles, points) == 0
        lit = unblocked & ((objects < 0) | light.shines_on(points))
        visibilities.append(lit.astype(np.float32).reshape(height, width))
    return visibilities, (objects >= 0).reshape(height, width)


def hard_counts(
    scene: Scene, light: Light, objects: np.ndarray, triangles: np.ndarray, points: np.ndarray
) -> np.ndarray:
    """Return how many casting faces lie between each point and a light, (N,) int32; 0 where there is no point.

    Parameters
    ----------
    objects, triangles, points : (N,), (N,), (N, 3)      as `seen_faces` returns them
    """
    seen = objects >= 0
    exclude = own_faces(scene, objects[seen], triangles[seen])
    counts = np.zeros(len(objects), np.int32)
    counts[seen] = casting_faces_between(
        points[seen], light.position, scene.casters, exclude=exclude, viewer=scene.camera.eye
    )
    return counts


def own_faces(scene: Scene, objects: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the face that each point lies on as caster and triangle, -1 for a face that does not cast.

    Parameters
    ----------
    objects, triangles : (N,) int        index of the object in the scene, and of the triangle in it
    """
    caster_index = np.full(len(scene.objects), -1)
    casters = [index for index, item in enumerate(scene.objects) if item.casts]
    caster_index[casters] = np.arange(len(casters))
    return caster_index[objects], triangles


def seen_faces(
    scene: Scene, size: tuple[int, int], offset: tuple[float, float] = (0, 0)
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the face that is visible at every pixel centre, row by row from the top.

    Parameters
    ----------
    offset : (x, y)              of the sample from the pixel centre: pixels to the right and down

    Returns
    -------
    (H * W,) int                 index of the object, -1 where none is seen between the near and the far plane
    (H * W,) int                 index of the triangle in the object
    (H * W, 3) float64           visible point, in world space
    """
    width, height = size
    camera = scene.camera
    x, y = np.meshgrid(np.arange(width) + 0.5 + offset[0], np.arange(height) + 0.5 + offset[1])
    near_points = camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), size)
    directions = near_points - camera.eye
    objects, triangles, distances = first_faces(near_points, directions, scene.objects)
    # a direction reaches from the eye to the near plane; in units of it, the far plane is at far / near from the eye
    seen = (objects >= 0) & (1 + distances <= camera.far / camera.near)
    distances = np.where(seen, distances, 0)
    return np.where(seen, objects, -1), triangles, near_points + distances[:, None] * directions
