"""The faces that cast, and the silhouette: the boundary of these faces as a chain with multiplicity.

Each face is classified once, in float64 from the float32 positions. Whatever the result for a face that is nearly
edge-on, the volume is closed (Bergeron 1986; Kim, Kim & Turk 2008 for the multiplicity).
"""

from dataclasses import dataclass

import numpy as np

from softshadow.scene.mesh import Mesh


@dataclass(frozen=True, eq=False)
class CastingFaces:
    """The faces of a mesh that cast, by number, in drawing order.

    Attributes
    ----------
    facing : (C,) int32       faces that face the light
    reversed : (R,) int32     faces of open bodies that face away from the light; they cast with reversed winding
    """

    facing: np.ndarray
    reversed: np.ndarray


@dataclass(frozen=True, eq=False)
class Silhouette:
    """The silhouette as directed edges, each directed as in its casting face.

    Attributes
    ----------
    edges : (S, 2) int32          vertices u, v of the mesh
    multiplicity : (S,) int32     casting faces with the edge u to v minus those with v to u; at least 1
    numbers : (S,) int32          which edge of the mesh's topology each is
    """

    edges: np.ndarray
    multiplicity: np.ndarray
    numbers: np.ndarray


def light_distances(mesh: Mesh, light: np.ndarray) -> np.ndarray:
    """Return (T,) float64: signed distance of the light from each face's plane, times twice the face's area.

    For a directional light it is the dot product of its direction and the face normal.

    Parameters
    ----------
    light : (4,) float64      homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    """
    from softshadow.scene.face_kernels import distances_to_planes

    distances = np.empty(len(mesh.triangles))
    distances_to_planes(homogeneous_light(light), mesh.first_corners, mesh.face_normals, distances)
    return distances


def casting_faces(mesh: Mesh, light: np.ndarray) -> CastingFaces:
    """Return the faces that cast: those of closed bodies that face the light, and all faces of open bodies.

    A body is a connected piece of the mesh. A face that is edge-on to the light, or has no area, does not cast.

    Parameters
    ----------
    light : (4,) float64      homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    """
    distances = light_distances(mesh, light)
    facing = np.flatnonzero(distances > 0).astype(np.int32)
    topology = mesh.topology
    if topology.closed:
        return CastingFaces(facing, np.zeros(0, np.int32))
    return CastingFaces(facing, np.flatnonzero((distances < 0) & ~topology.closed_faces).astype(np.int32))


def silhouette(mesh: Mesh, light: np.ndarray) -> Silhouette:
    """Return the edges where the chain sum of the casting faces is not 0; they form closed loops.

    Parameters
    ----------
    light : (4,) float64      homogeneous, object space, w >= 0; w = 0 is a direction towards the light
    """
    return silhouette_of(mesh, casting_faces(mesh, light))


def silhouette_of(mesh: Mesh, faces: CastingFaces) -> Silhouette:
    """Return the silhouette of a mesh whose casting faces are known."""
    topology = mesh.topology
    sums = topology.chain_sum(faces.facing, faces.reversed)
    outline = np.flatnonzero(sums)
    edges = topology.representatives[topology.edges[outline]]
    backward = sums[outline] < 0
    edges[backward] = edges[backward, ::-1]
    return Silhouette(edges, np.abs(sums[outline]), outline.astype(np.int32))


def homogeneous_light(light: np.ndarray) -> np.ndarray:
    """Return the light as (4,) float64 with w = 1 (a point) or w = 0 (a direction towards it).

    Raises
    ------
    ValueError      not four finite numbers, w < 0, or a direction of length 0
    """
    value = np.asarray(light, dtype=np.float64)
    if value.shape != (4,) or not np.isfinite(value).all() or value[3] < 0 or not value.any():
        raise ValueError(f"light: expected four finite numbers x, y, z, w with w >= 0, not all 0, got {value.tolist()}")
    return value if value[3] == 0 else value / value[3]
