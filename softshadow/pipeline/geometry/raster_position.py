"""The place of glRasterPos in the window, in the arithmetic of Mesa's C code: products are summed from the left.

References: GL 2.1, sec. 2.13 (current raster position); rastpos.c of Mesa 22.3.
"""

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.pipeline.constants import ONE, ZERO


@kernel
def raster_place(modelview, projection, planes, x, y, z, w, scale, shift, near, far, clamps_depth):
    """Return window x, y, z, clip w, the distance from the eye, and whether the point (x, y, z, w) is in the view.

    Parameters
    ----------
    modelview, projection : (4, 4) float32
    planes : (P, 4) float32, the enabled clip planes in clip space
    scale, shift : (3,) float32, from normalized device coordinates to the window
    near, far : the depth range, which w is clamped to where depths are clamped, as in Mesa
    """
    point = np.float32(x), np.float32(y), np.float32(z), np.float32(w)
    eye = transformed(modelview, point)
    clip = transformed(projection, eye)
    x, y, z, w = clip
    outside = x > w or x < -w or y > w or y < -w or (not clamps_depth and (z < -w or z > w))  # NaN is inside
    for p in range(planes.shape[0]):
        outside = outside or ((x * planes[p, 0] + y * planes[p, 1]) + z * planes[p, 2]) + w * planes[p, 3] < ZERO
    over_w = ONE if w == ZERO else ONE / w
    x, y, z = x * over_w * scale[0] + shift[0], y * over_w * scale[1] + shift[1], z * over_w * scale[2] + shift[2]
    if clamps_depth:
        w = (far if w > far else w) if w > near else near
    distance = np.sqrt((eye[0] * eye[0] + eye[1] * eye[1]) + eye[2] * eye[2])
    return x, y, z, w, distance, not outside


@inlined
def transformed(matrix, point):
    """Return the product of a matrix (4, 4) and a point of four numbers."""
    return (
        ((matrix[0, 0] * point[0] + matrix[0, 1] * point[1]) + matrix[0, 2] * point[2]) + matrix[0, 3] * point[3],
        ((matrix[1, 0] * point[0] + matrix[1, 1] * point[1]) + matrix[1, 2] * point[2]) + matrix[1, 3] * point[3],
        ((matrix[2, 0] * point[0] + matrix[2, 1] * point[1]) + matrix[2, 2] * point[2]) + matrix[2, 3] * point[3],
        ((matrix[3, 0] * point[0] + matrix[3, 1] * point[1]) + matrix[3, 2] * point[2]) + matrix[3, 3] * point[3],
    )
