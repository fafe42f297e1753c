"""The plane of a mesh that is one flat convex polygon."""

import numpy as np

from softshadow.scene.mesh import Mesh

# rounding to float32 moves corners out of the plane by a few times 6e-8 of the mesh's size
FLAT = 1e-6


def flat_plane(mesh: Mesh) -> np.ndarray | None:
    """Return the (4,) float64 plane a, b, c, d of a flat mesh in object space, with unit normal; None if not flat.

    Flat means that all triangles face the same way, all vertices lie in one plane, and the outline is convex.
    """
    normals = mesh.face_normals
    areas = np.linalg.norm(normals, axis=1)
    largest = int(areas.argmax())
    normal = normals[largest] / areas[largest]
    positions = mesh.positions.astype(np.float64)
    used = positions[np.unique(mesh.triangles)]
    size = float(np.ptp(used, axis=0).max())
    distance = -float(normal @ used.mean(axis=0))
    if (np.abs(used @ normal + distance) > FLAT * size).any() or (normals @ normal < 0).any():
        return None

    topology = mesh.topology
    outline = np.flatnonzero(topology.edge_sums)
    if (np.abs(topology.edge_sums[outline]) != 1).any():
        return None  # triangles overlap
    u, v = positions[topology.representatives[topology.edges[outline]]].transpose(1, 0, 2)
    # in the plane, perpendicular to the edge, towards its face
    inward = np.cross(normal, v - u) * topology.edge_sums[outline, None]
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    lowest = (inward @ used.T).min(axis=1) - (inward * u).sum(axis=1)
    return None if (lowest < -FLAT * size).any() else np.append(normal, distance)
