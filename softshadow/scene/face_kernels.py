"""Loops over the faces of large meshes, for `silhouette` and `topology`, which import them where they are called:
reading and describing scenes needs no Numba.

In one walk over a million faces nothing is written but the result; NumPy's temporaries took two thirds of the time.
"""

import numpy as np

from softshadow.jit import kernel

HASH = (73_856_093, 19_349_663, 83_492_791)  # Teschner et al. 2003, "Optimized spatial hashing", sec. 3


@kernel
def distances_to_planes(light, first_corners, face_normals, distances):
    """Write (T,) ``(L - w p) . n`` of each face: its corner p (T, 3), its normal n (T, 3), the light (4,)."""
    x, y, z, w = light[0], light[1], light[2], light[3]
    for t in range(face_normals.shape[0]):
        from_x, from_y = x - w * first_corners[t, 0], y - w * first_corners[t, 1]
        from_z = z - w * first_corners[t, 2]
        distances[t] = from_x * face_normals[t, 0] + from_y * face_normals[t, 1] + from_z * face_normals[t, 2]


@kernel
def add_chain(face_edges, face_signs, faces, sign, sums):
    """Add `sign` times the directed edges of some faces to the sums (E,) of their edges."""
    for n in range(faces.shape[0]):
        t = faces[n]
        for corner in range(3):
            sums[face_edges[t, corner]] += np.int32(sign * face_signs[t, corner])


@kernel
def join_corners(triangles, labels):
    """Write into labels (P,), which begin as 0 to P - 1, the smallest position joined to each by triangles (T, 3)."""
    for t in range(triangles.shape[0]):
        for corner in range(3):
            a, b = triangles[t, 0], triangles[t, corner]
            while labels[a] != a:
                labels[a] = labels[labels[a]]  # halves the path, so that the next walk is short
                a = labels[a]
            while labels[b] != b:
                labels[b] = labels[labels[b]]
                b = labels[b]
            if a < b:
                labels[b] = a
            else:
                labels[a] = b
    for p in range(labels.shape[0]):  # in ascending order: the smaller label is final already
        labels[p] = labels[labels[p]]


@kernel
def mark_within_edges(points, keys, low, width, corners, distance, found):
    """Mark in found (V,) the points (V, 3) that lie within `distance` of an edge (E, 2, 3), away from its ends.

    Points are sorted by keys (V,), the hash of the cube that each is in; cubes begin at `low` (3,), are `width` wide.
    """
    for e in range(corners.shape[0]):
        ax, ay, az = corners[e, 0, 0], corners[e, 0, 1], corners[e, 0, 2]
        dx, dy, dz = corners[e, 1, 0] - ax, corners[e, 1, 1] - ay, corners[e, 1, 2] - az
        length = np.sqrt(dx * dx + dy * dy + dz * dz)
        steps = int(length / width) + 1
        for step in range(steps + 1):
            part = step / steps
            cx = int(np.floor((ax + part * dx - low[0]) / width))
            cy = int(np.floor((ay + part * dy - low[1]) / width))
            cz = int(np.floor((az + part * dz - low[2]) / width))
            for near in range(27):
                x, y, z = cx + near % 3 - 1, cy + near // 3 % 3 - 1, cz + near // 9 - 1
                key = (x * HASH[0]) ^ (y * HASH[1]) ^ (z * HASH[2])
                for n in range(np.searchsorted(keys, key), keys.shape[0]):
                    if keys[n] != key:
                        break
                    px, py, pz = points[n, 0] - ax, points[n, 1] - ay, points[n, 2] - az
                    along = (px * dx + py * dy + pz * dz) / length
                    if along <= distance or along >= length - distance:
                        continue
                    across = px * px + py * py + pz * pz - along * along
                    if across <= distance * distance:
                        found[n] = True
