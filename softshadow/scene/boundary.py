"""The boundary of an open mesh: its loops, T-junctions, and vertices that lie next to each other at unequal positions.

T-junctions and unequal positions are the usual reasons why a model that looks closed is open. Everything is in object
space. Only boundary edges are examined, so a closed mesh costs nothing. This module needs Numba.
"""

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from softshadow.scene.face_kernels import HASH, join_corners, mark_within_edges
from softshadow.scene.mesh import Mesh

# positions closer than this, in units of the mesh's size, were meant to be equal: text files have six digits
CLOSE = 1e-5
SMALLEST = 1e-12  # lower limit of the distance, in the same units
# a mesh with more boundary edges is a soup of separate triangles; examining this many is enough
MOST_EXAMINED = 100_000


@dataclass(frozen=True, eq=False)
class Boundary:
    """The loops and defects of a mesh's boundary.

    Attributes
    ----------
    loops : int                      connected pieces of the boundary: holes and rims
    first_edge : (2, 3) float32      end points of one boundary edge; zeros if there is none
    t_junctions : (J, 3) float32     boundary vertices that lie within another boundary edge: one edge on this side, two
                                     or more on the other
    unwelded : (U, 3) float32        boundary vertices that lie close to another one, but not at the same position

    In a mesh with more than 100 000 boundary edges, some T-junctions and unwelded vertices are missed.
    """

    loops: int
    first_edge: np.ndarray
    t_junctions: np.ndarray
    unwelded: np.ndarray


_boundaries: WeakKeyDictionary[Mesh, Boundary] = WeakKeyDictionary()


def boundary_of(mesh: Mesh) -> Boundary:
    """Return the boundary of a mesh; computed once per mesh."""
    if mesh not in _boundaries:
        _boundaries[mesh] = _compute_boundary(mesh)
    return _boundaries[mesh]


def _compute_boundary(mesh: Mesh) -> Boundary:
    topology = mesh.topology
    edges = topology.edges[topology.edge_faces == 1]
    positions = mesh.positions[topology.representatives]
    nothing = positions[:0]
    if not len(edges):
        return Boundary(0, np.zeros((2, 3), np.float32), nothing, nothing)
    is_boundary = np.zeros(len(positions), dtype=bool)
    is_boundary[edges] = True
    vertices = np.flatnonzero(is_boundary)
    points = positions[vertices].astype(np.float64)
    corners = positions[edges].astype(np.float64)
    lengths = np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1)
    size = float(np.ptp(mesh.bounds, axis=0).max())
    # at most a quarter of the shortest edge, so that the two ends of an edge never count as close
    distance = max(min(CLOSE * size, float(lengths.min()) / 4), SMALLEST * size)
    is_within = _within_edges(points, corners[:MOST_EXAMINED], lengths[:MOST_EXAMINED], distance)
    return Boundary(
        _count_pieces(np.cumsum(is_boundary, dtype=np.int32)[edges] - 1, len(vertices)),
        positions[edges[0]],
        positions[vertices[is_within]],
        positions[vertices[_close_together(points, distance)]],
    )


def _count_pieces(edges: np.ndarray, n_vertices: int) -> int:
    labels = np.arange(n_vertices, dtype=np.int32)
    join_corners(edges[:, [0, 1, 1]], labels)
    return int((labels == np.arange(n_vertices)).sum())


def _close_together(points: np.ndarray, distance: float) -> np.ndarray:
    """Return (V,) bool: whether another point lies within `distance`.

    Points are sorted into boxes twice that wide, eight times, with the grid shifted by half a box along each
    combination of axes: two close points share a box at least once.
    """
    is_close = np.zeros(len(points), dtype=bool)
    for shift in list(np.ndindex(2, 2, 2))[: 8 if len(points) <= MOST_EXAMINED else 1]:
        keys = _keys(np.floor((points - points.min(axis=0)) / (2 * distance) + np.array(shift) / 2))
        order = np.argsort(keys, kind="stable")
        same_box = np.flatnonzero(keys[order[1:]] == keys[order[:-1]])
        first, second = order[same_box], order[same_box + 1]
        close = np.linalg.norm(points[first] - points[second], axis=1) <= distance
        is_close[first[close]] = True
        is_close[second[close]] = True
    return is_close


def _within_edges(points: np.ndarray, corners: np.ndarray, lengths: np.ndarray, distance: float) -> np.ndarray:
    """Return (V,) bool: whether each point lies within `distance` of the inside of an edge (E, 2, 3).

    The points are sorted into cubes as wide as the mean edge. Each edge is walked in steps of a cube and compared with
    the points in the 27 cubes around each step.
    """
    low = points.min(axis=0)
    width = float(lengths.mean()) + 2 * distance
    keys = _keys(np.floor((points - low) / width))
    order = np.argsort(keys, kind="stable")
    sorted_result = np.zeros(len(points), dtype=bool)
    mark_within_edges(points[order], keys[order], low, width, corners, distance, sorted_result)
    is_within = np.zeros(len(points), dtype=bool)
    is_within[order[sorted_result]] = True
    return is_within


def _keys(boxes: np.ndarray) -> np.ndarray:
    """Return (N,) int64: a hash of each box; different boxes rarely have the same."""
    x, y, z = boxes.astype(np.int64).T
    return (x * HASH[0]) ^ (y * HASH[1]) ^ (z * HASH[2])
