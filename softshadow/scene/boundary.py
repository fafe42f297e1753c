"""What a boundary of a mesh hides: loops, T-junctions, and edges that lie together but not at equal positions.

A model that looks closed and is not is open by one of these. Everything here is in object space, and looks at boundary
edges only, so that a closed mesh costs nothing. Imported where it is called: reading scenes needs no Numba.
"""

from dataclasses import dataclass

import numpy as np

from softshadow.scene.face_kernels import HASH, join_corners, mark_within_edges
from softshadow.scene.mesh import Mesh

# positions this close, in units of the mesh's size, were meant to be equal: files in text keep six digits
CLOSE = 1e-5
LEAST = 1e-12  # and this is nothing
# more boundary edges than this belong to a soup of separate triangles: some of them say enough
LOOKED_AT = 100_000


@dataclass(frozen=True, eq=False)
class Boundary:
    """What there is about the boundary of a mesh.

    Attributes
    ----------
    loops : int                      connected pieces of the boundary: holes and rims
    first_edge : (2, 3) float32      positions of one boundary edge; zeros where there is none
    t_junctions : (J, 3) float32     boundary vertices that lie within another boundary edge: one edge on this side, two
                                     or more on the other
    unwelded : (U, 3) float32        boundary vertices that lie next to another one, at a position that is not equal

    Of soups with more than 100 000 boundary edges not all T-junctions and unwelded vertices are found.
    """

    loops: int
    first_edge: np.ndarray
    t_junctions: np.ndarray
    unwelded: np.ndarray


def boundary_of(mesh: Mesh) -> Boundary:
    """Return what there is about the boundary of a mesh."""
    topology = mesh.topology
    edges = topology.edges[topology.edge_faces == 1]
    positions = mesh.positions[topology.representatives]
    nothing = positions[:0]
    if not len(edges):
        return Boundary(0, np.zeros((2, 3), np.float32), nothing, nothing)
    is_at_it = np.zeros(len(positions), dtype=bool)
    is_at_it[edges] = True
    vertices = np.flatnonzero(is_at_it)
    points = positions[vertices].astype(np.float64)
    corners = positions[edges].astype(np.float64)
    lengths = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
    size = float(np.ptp(mesh.bounds, axis=0).max())
    # a quarter of the shortest edge: the ends of an edge are never taken for one point
    distance = max(min(CLOSE * size, float(lengths.min()) / 4), LEAST * size)
    within = _within_edges(points, corners[:LOOKED_AT], lengths[:LOOKED_AT], distance)
    return Boundary(
        _pieces(np.cumsum(is_at_it, dtype=np.int32)[edges] - 1, len(vertices)),
        positions[edges[0]],
        positions[vertices[within]],
        positions[vertices[_close_together(points, distance)]],
    )


def _pieces(edges: np.ndarray, count: int) -> int:
    labels = np.arange(count, dtype=np.int32)
    join_corners(edges[:, [0, 1, 1]], labels)
    return int((labels == np.arange(count)).sum())


def _close_together(points: np.ndarray, distance: float) -> np.ndarray:
    """Return (V,) bool: the points that have another within `distance`.

    Points are sorted into boxes twice that wide, eight times, shifted by half a box along each axis or not: two points
    that are close share a box at least once.
    """
    found = np.zeros(len(points), dtype=bool)
    for shift in list(np.ndindex(2, 2, 2))[: 8 if len(points) <= LOOKED_AT else 1]:
        keys = _keys(np.floor((points - points.min(axis=0)) / (2 * distance) + np.array(shift) / 2))
        order = np.argsort(keys, kind="stable")
        together = np.flatnonzero(keys[order[1:]] == keys[order[:-1]])
        one, other = order[together], order[together + 1]
        close = np.linalg.norm(points[one] - points[other], axis=1) <= distance
        found[one[close]] = True
        found[other[close]] = True
    return found


def _within_edges(points: np.ndarray, corners: np.ndarray, lengths: np.ndarray, distance: float) -> np.ndarray:
    """Return (V,) bool: the points within `distance` of the inside of an edge (E, 2, 3).

    The points are sorted into cubes as wide as the mean edge; each edge is walked in steps of a cube, and meets what
    lies in the cubes around each step.
    """
    low = points.min(axis=0)
    width = float(lengths.mean()) + 2 * distance
    keys = _keys(np.floor((points - low) / width))
    order = np.argsort(keys, kind="stable")
    found = np.zeros(len(points), dtype=bool)
    mark_within_edges(points[order], keys[order], low, width, corners, distance, found)
    marked = np.zeros(len(points), dtype=bool)
    marked[order[found]] = True
    return marked


def _keys(boxes: np.ndarray) -> np.ndarray:
    """Return (N,) int64: a number for each box; different boxes seldom have the same."""
    x, y, z = boxes.astype(np.int64).T
    return (x * HASH[0]) ^ (y * HASH[1]) ^ (z * HASH[2])
