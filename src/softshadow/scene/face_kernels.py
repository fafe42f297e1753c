"""Loops over the faces of large meshes, for `silhouette` and `topology`, which import them where they are called:
reading and describing scenes needs no Numba.

In one walk over a million faces nothing is written but the result; NumPy's temporaries took two thirds of the time.
"""

import numpy as np

from softshadow.jit import kernel


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
