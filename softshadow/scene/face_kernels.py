"""Kernels that loop over the faces of large meshes; imported inside functions, so that reading scenes needs no Numba.

They write nothing but the result; with NumPy, temporary arrays took two thirds of the time for a million faces.
"""

import numpy as np

from softshadow.jit import kernel

HASH = (73_856_093, 19_349_663, 83_492_791)  # Teschner et al. 2003, "Optimized spatial hashing", sec. 3


@kernel
def distances_to_planes(light, first_corners, face_normals, distances):
    """Write (T,) ``(L - w p) . n`` for each face, with corner p (T, 3), normal n (T, 3) and the light (4,)."""
    x, y, z, w = light[0], light[1], light[2], light[3]
    for t in range(face_normals.shape[0]):
        from_x, from_y = x - w * first_corners[t, 0], y - w * first_corners[t, 1]
        from_z = z - w * first_corners[t, 2]
        distances[t] = from_x * face_normals[t, 0] + from_y * face_normals[t, 1] + from_z * face_normals[t, 2]


@kernel
def write_directions(positions, light, directions):
    """Write (V, 4) the directions from a point light (3,) to positions (V, 3), as far points of homogeneous w = 0."""
    for v in range(positions.shape[0]):
        for k in range(3):
            directions[v, k] = np.float64(positions[v, k]) - light[k]
        directions[v, 3] = 0


@kernel
def add_chain(face_edges, face_signs, faces, sign, sums):
    """Add `sign` times the edge signs of the listed faces to the sums (E,) of their edges."""
    for n in range(faces.shape[0]):
        t = faces[n]
        for corner in range(3):
            sums[face_edges[t, corner]] += np.int32(sign * face_signs[t, corner])


@kernel
def join_corners(triangles, labels):
    """Set labels (P,), initially 0 to P - 1, to the smallest position connected to each by triangles (T, 3)."""
    for t in range(triangles.shape[0]):
        for corner in range(3):
            a, b = triangles[t, 0], triangles[t, corner]
            while labels[a] != a:
                labels[a] = labels[labels[a]]  # path halving: shortens later walks
                a = labels[a]
            while labels[b] != b:
                labels[b] = labels[labels[b]]
                b = labels[b]
            if a < b:
                labels[b] = a
            else:
                labels[a] = b
    for p in range(labels.shape[0]):  # ascending: the smaller label is already final
        labels[p] = labels[labels[p]]


@kernel
def mark_within_edges(points, keys, low, width, corners, distance, is_within):
    """Set is_within (V,) for the points (V, 3) within `distance` of an edge (E, 2, 3) but not of its ends.

    Points are sorted by keys (V,), the hash of the cube that contains each; cubes start at `low` (3,), `width` wide.
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
                        is_within[n] = True
