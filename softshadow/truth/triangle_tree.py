"""The triangles of a whole scene in world space, under a tree of bounding boxes.

The triangles are sorted along a space-filling curve and paired level by level. The tree is complete, so node i has the
children 2i and 2i + 1, and no pointers are stored.

References
----------
Morton 1966 (the curve); Lauterbach et al. 2009, "Fast BVH construction on GPUs" (trees from sorted codes).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from softshadow.scene import SceneObject

# boxes are widened by this fraction of the scene's size: more than the slab test rounds, far less than a face
MARGIN = 1e-9
# rounding of corners to float32 and their transform move them by less than this, in units of the object's size
COPLANAR = 1e-6


@dataclass(frozen=True, eq=False)
class TriangleTree:
    """The triangles in the order of the leaves, and the bounding boxes of all nodes.

    Attributes
    ----------
    corners : (T, 3, 3) float64      world space
    objects, triangles : (T,) int32  the object of each leaf, and the number of the triangle in it
    closed : (T,) bool               whether the triangle's body is closed: then it casts only if it faces the light
    boxes : (2N, 2, 3) float64       low and high corner of node i; 1 is the root, N to 2N - 1 are the leaves
    leaves : (T,) int32              leaf of triangle t of object o at index starts[o] + t
    starts : (objects + 1,) int64
    flatness : (T,) float64          distance up to which a corner counts as lying in the triangle's plane
    """

    corners: np.ndarray
    objects: np.ndarray
    triangles: np.ndarray
    closed: np.ndarray
    boxes: np.ndarray
    leaves: np.ndarray
    starts: np.ndarray
    flatness: np.ndarray


def build_tree(objects: Sequence[SceneObject]) -> TriangleTree:
    """Return the tree over all triangles of the objects."""
    corners = np.concatenate([item.world_positions[item.mesh.triangles] for item in objects])
    n_triangles = [len(item.mesh.triangles) for item in objects]
    starts = np.concatenate([[0], np.cumsum(n_triangles)])
    low, high = corners.min(axis=1), corners.max(axis=1)
    size = float((high.max(axis=0) - low.min(axis=0)).max())

    order = np.argsort(_morton_codes((low + high) / 2), kind="stable")
    n_leaves = 1 << max(0, int(np.ceil(np.log2(len(order)))))
    boxes = np.empty((2 * n_leaves, 2, 3))
    boxes[:, 0], boxes[:, 1] = np.inf, -np.inf
    boxes[n_leaves : n_leaves + len(order), 0] = low[order] - MARGIN * size
    boxes[n_leaves : n_leaves + len(order), 1] = high[order] + MARGIN * size
    first = n_leaves
    while first > 1:
        pairs = boxes[first : 2 * first].reshape(-1, 2, 2, 3)
        first //= 2
        boxes[first : 2 * first, 0] = pairs[:, :, 0].min(axis=1)
        boxes[first : 2 * first, 1] = pairs[:, :, 1].max(axis=1)

    leaves = np.empty(len(order), dtype=np.int32)
    leaves[order] = np.arange(len(order), dtype=np.int32)
    flatness = [COPLANAR * float(np.ptp(item.world_positions, axis=0).max()) for item in objects]
    return TriangleTree(
        corners[order],
        np.repeat(np.arange(len(objects), dtype=np.int32), n_triangles)[order],
        np.concatenate([np.arange(n, dtype=np.int32) for n in n_triangles])[order],
        np.concatenate([item.mesh.topology.closed_faces for item in objects])[order],
        boxes,
        leaves,
        starts,
        np.repeat(flatness, n_triangles)[order],
    )


def _morton_codes(points: np.ndarray) -> np.ndarray:
    """Return the index of each point along the Morton curve through the box of all points, 10 bits per axis."""
    low = points.min(axis=0)
    extent = np.maximum(points.max(axis=0) - low, np.finfo(float).tiny)
    cells = np.minimum((points - low) / extent * 1024, 1023).astype(np.int64)
    codes = np.zeros(len(points), dtype=np.int64)
    for bit in range(10):
        for axis in range(3):
            codes |= ((cells[:, axis] >> bit) & 1) << (3 * bit + axis)
    return codes
