"""Which faces of an object the light reaches if nothing is in its way.

On closed bodies that cast, these are the faces turned towards the light; on open ones, all faces.
"""

from dataclasses import dataclass

import numpy as np

from softshadow.scene import CastingFaces, Light, SceneObject, casting_faces
from softshadow.scene.silhouette import light_distances


@dataclass(frozen=True, eq=False)
class LitFaces:
    """A caster, its casting faces, and these as triangles (C, 3, 3) in world space, turned towards the light."""

    thing: SceneObject
    faces: CastingFaces
    triangles: np.ndarray


def lit_faces(thing: SceneObject, light: Light) -> LitFaces:
    """Return the casting faces of an object."""
    faces = casting_faces(thing.mesh, light.in_object_space(thing.object_to_world))
    return LitFaces(thing, faces, turned_triangles(thing, faces))


def reached_faces(thing: SceneObject, light: Light) -> CastingFaces:
    """Return the faces that the light reaches if nothing is in its way, each with the side turned towards the light.

    An object that does not cast lets the light through, even to its own far side: all of its faces are reached.
    """
    in_object_space = light.in_object_space(thing.object_to_world)
    if thing.casts:
        return casting_faces(thing.mesh, in_object_space)
    distances = light_distances(thing.mesh, in_object_space)
    return CastingFaces(*(np.flatnonzero(side).astype(np.int32) for side in (distances > 0, distances < 0)))


def turned_triangles(thing: SceneObject, faces: CastingFaces) -> np.ndarray:
    """Return faces as (C, 3, 3) float64 in world space, counter-clockwise as the light sees them."""
    triangles = thing.mesh.triangles
    return thing.world_positions[np.concatenate([triangles[faces.facing], triangles[faces.reversed][:, ::-1]])]
