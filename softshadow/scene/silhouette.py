"""Which faces cast, and the silhouette: the boundary of the casting faces as a chain with multiplicity.

Each face is decided once, in float64 from the float32 positions: whatever the decision for a face that is nearly
edge-on, the volume made from it is closed (Bergeron 1986; Kim, Kim & Turk 2008 for the multiplicity).
"""

from dataclasses import dataclass

import numpy as np

from softshadow.scene.mesh import Mesh


@dataclass(frozen=True, eq=False)
class CastingFaces:
    """Face numbers in drawing order.

    Attributes
    ----------
    kept : (C,) int32         faces that face the light as stored
    reversed : (R,) int32     faces of open bodies that face away and cast the other way round
    """

    kept: np.ndarray
    reversed: np.ndarray


@dataclass(frozen=True, eq=False)
class Silhouette:
    """Directed edges, each running as in the casting face it belongs to.

    Attributes
    ----------
    edges : (S, 2) int32          drawing vertices u, v
    multiplicity : (S,) int32     how many casting faces have u to v more than v to u; at least 1
    """

    edges: np.ndarray
    multiplicity: np.ndarray


def light_distances(mesh: Mesh, light: np.ndarray) -> np.ndarray:
    """Return (T,) float64: how far the light is before each face's plane, times twice the face's area; 0 for no area.

    For a directional light the cosine to the direction towards it takes the distance's place.

    Parameters
    ----------
    light : (4,) float64      homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    """
    from softshadow.scene.face_kernels import distances_to_planes

    distances = np.empty(len(mesh.triangles))
    distances_to_planes(homogeneous_light(light), mesh.first_corners, mesh.face_normals, distances)
    return distances


def casting_faces(mesh: Mesh, light: np.ndarray) -> CastingFaces:
    """Return the faces that cast: of closed bodies those that face the light, of open ones all, turned towards it.

    A body is a connected piece of the mesh. A face edge-on to the light, or without area, does not cast.

    Parameters
    ----------
    light : (4,) float64      homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    """
    distances = light_distances(mesh, light)
    kept = np.flatnonzero(distances > 0).astype(np.int32)
    topology = mesh.topology
    if topology.closed:
        return CastingFaces(kept, np.zeros(0, np.int32))
    return CastingFaces(kept, np.flatnonzero((distances < 0) & ~topology.closed_faces).astype(np.int32))


def silhouette(mesh: Mesh, light: np.ndarray) -> Silhouette:
    """Return the edges where the chain sum of the casting faces is not 0; at every vertex as many arrive as leave.

    Parameters
    ----------
    light : (4,) float64      homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    """
    return silhouette_of(mesh, casting_faces(mesh, light))


def silhouette_of(mesh: Mesh, faces: CastingFaces) -> Silhouette:
    """Return the boundary of the given faces as a chain."""
    topology = mesh.topology
    sums = topology.chain_sum(faces.kept, faces.reversed)
    found = np.flatnonzero(sums)
    edges = topology.representatives[topology.edges[found]]
    against = sums[found] < 0
    edges[against] = edges[against, ::-1]
    return Silhouette(edges, np.abs(sums[found]))


def homogeneous_light(light: np.ndarray) -> np.ndarray:
    """Return the light as (4,) float64 with w = 1 (a point) or w = 0 (a direction).

    Raises
    ------
    ValueError      not four finite numbers, w < 0, or a direction of length 0
    """
    value = np.asarray(light, dtype=np.float64)
    if value.shape != (4,) or not np.isfinite(value).all() or value[3] < 0 or not value.any():
        raise ValueError(f"light: expected four finite numbers x, y, z, w with w >= 0, not all 0, got {value.tolist()}")
    return value if value[3] == 0 else value / value[3]
