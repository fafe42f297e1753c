"""The shadow on one face, computed from the silhouettes of its casters instead of their faces.

The casting faces form a surface whose boundary is the silhouette. Flattened onto a plane, the boundary winds around a
point once for every casting face between the point and the light. A caster that crosses the plane is cut there, and the
cut edges close its boundary.
"""

from collections.abc import Sequence

import numpy as np

from softshadow.scene import CastingFaces, Light
from softshadow.scene.silhouette import silhouette_of
from softshadow.techniques.clipping import clip_segments, clip_triangles, cuts
from softshadow.techniques.flattened import flattened_points, proper_planes
from softshadow.techniques.lit_faces import LitFaces
from softshadow.techniques.plane_sweep import triangulate_nonzero

# points nearer to the light than this share of its height over the plane would be flattened a million times as far away
NEAREST = 1e-6


def inside_of_silhouettes(
    casters: Sequence[LitFaces], face: np.ndarray, plane: np.ndarray, light: Light, flat: float
) -> np.ndarray:
    """Return triangles (N, 3, 3) that cover the shadow in the plane of a face (3, 3), without overlap.

    Parameters
    ----------
    plane : (4,)                 of the face, unit normal towards the light
    flat : float                 casting faces nearer than this to the plane cast nothing
    """
    planes = proper_planes(plane, light.position)
    planes[1:, 3] -= NEAREST * (plane @ light.position)
    chains = [flattened_points(boundary(caster, plane, planes, flat), plane, light.position) for caster in casters]
    # drop the coordinate in which the normal is largest
    axis = int(np.abs(plane[:3]).argmax())
    u, v = (axis + 1) % 3, (axis + 2) % 3
    chain = np.concatenate([np.zeros((0, 2, 3)), *chains])[:, :, [u, v]]
    triangles = triangulate_nonzero(chain, face[:, v].min(), face[:, v].max())
    in_space = np.empty((len(triangles), 3, 3))
    in_space[:, :, [u, v]] = triangles
    in_space[:, :, axis] = -(triangles @ plane[[u, v]] + plane[3]) / plane[axis]
    # counter-clockwise in (u, v) means counter-clockwise seen from the positive end of the axis
    return in_space if plane[axis] > 0 else in_space[:, ::-1]


def boundary(caster: LitFaces, plane: np.ndarray, planes: np.ndarray, flat: float) -> np.ndarray:
    """Return the boundary (S, 2, 3) of the casting faces, clipped to `planes` (K, 4), without the faces in `plane`."""
    above = (np.abs(caster.triangles @ plane[:3] + plane[3]) > flat).any(axis=1)
    facing, turned = np.split(above, [len(caster.faces.facing)])
    faces = CastingFaces(caster.faces.facing[facing], caster.faces.reversed[turned])
    silhouette = silhouette_of(caster.thing.mesh, faces)
    segments = caster.thing.world_positions[np.repeat(silhouette.edges, silhouette.multiplicity, axis=0)]
    triangles = caster.triangles[above]
    for cutting in planes:
        segments = np.concatenate([clip_segments(segments, cutting), cuts(triangles, cutting)])
        triangles = clip_triangles(triangles, cutting)
    return segments
