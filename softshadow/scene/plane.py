"""Is a mesh one flat convex polygon, and in which plane?"""

import numpy as np

from softshadow.scene.mesh import Mesh

# float32 positions of a turned square miss its plane by some units of 6e-8 of its size
FLAT = 1e-6


def flat_plane(mesh: Mesh) -> np.ndarray | None:
    """Return the (4,) float64 object-space plane a, b, c, d of a flat mesh, unit normal; None when it is not flat.

    All triangles have to face the same way, all vertices to lie in one plane, and the outline to be convex.
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
        return None  # triangles that overlap
    u, v = positions[topology.representatives[topology.edges[outline]]].transpose(1, 0, 2)
    # inward: left of the edge as its one face runs along it
    inward = np.cross(normal, v - u) * topology.edge_sums[outline, None]
    inward /= np.linalg.norm(inward, axis=1, keepdims=True)
    lowest = (inward @ used.T).min(axis=1) - (inward * u).sum(axis=1)
    return None if (lowest < -FLAT * size).any() else np.append(normal, distance)
