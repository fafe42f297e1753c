"""How triangles are connected: by exact position, so that split normals and texture seams do not open a mesh.

The mesh's own vertices are neither moved, merged nor reordered: the light cap of a shadow volume is drawn with them,
and only equal bits give equal depth. Edge sums of open and non-manifold meshes follow Bergeron (1986, "A general
version of Crow's shadow volumes").
"""

from functools import cached_property

import numpy as np


class Topology:
    """The positions, edges and bodies of a mesh, and the chain sum of its faces on every edge.

    Parameters
    ----------
    positions : (V, 3) float32
    triangles : (T, 3) int32

    Attributes
    ----------
    vertex_ids : (V,) int32           position number of each vertex, 0 to P - 1; the same for equal positions
    representatives : (P,) int32      the first vertex at each position
    triangles : (T, 3) int32          position numbers; in the order of the mesh's triangles
    edges : (E, 2) int32              position numbers, smaller first; always two different ones
    face_edges : (T, 3) int32         the edge from corner i to corner i + 1
    face_signs : (T, 3) int8          +1 if the face uses the edge as stored, -1 if reversed, 0 if degenerate
    edge_faces : (E,) int32           number of faces at the edge
    edge_sums : (E,) int32            sum of the face signs: 0 on every edge of a closed, consistently oriented mesh
    boundary_edges : int              edges with one face
    nonmanifold_edges : int           edges with more than two faces
    misoriented_edges : int           edges that two faces use in the same direction
    degenerate_faces : int            faces with two corners at the same position; they have no edges
    closed : bool                     whether all edge sums are 0
    """

    def __init__(self, positions: np.ndarray, triangles: np.ndarray) -> None:
        self.vertex_ids, self.representatives = weld(positions)
        self.triangles = self.vertex_ids[triangles]
        start = self.triangles
        end = np.roll(start, -1, axis=1)
        degenerate = (start == end).any(axis=1)

        n_positions = len(self.representatives)
        keys = np.minimum(start, end).astype(np.int64) * n_positions + np.maximum(start, end)
        edge_keys, inverse = np.unique(keys[~degenerate], return_inverse=True)
        self.edges = np.stack(np.divmod(edge_keys, n_positions), axis=1).astype(np.int32)
        self.face_edges = np.zeros(start.shape, dtype=np.int32)
        self.face_edges[~degenerate] = inverse.reshape(-1, 3)
        self.face_signs = np.where(start < end, 1, -1).astype(np.int8)
        self.face_signs[degenerate] = 0

        self.edge_faces = np.bincount(inverse.ravel(), minlength=len(self.edges)).astype(np.int32)
        self.edge_sums = self.chain_sum(np.arange(len(start)))
        self.boundary_edges = int((self.edge_faces == 1).sum())
        self.nonmanifold_edges = int((self.edge_faces > 2).sum())
        self.misoriented_edges = int(((self.edge_faces == 2) & (self.edge_sums != 0)).sum())
        self.degenerate_faces = int(degenerate.sum())
        self.closed = not self.edge_sums.any()

    def chain_sum(self, faces: np.ndarray, reversed_faces: np.ndarray | None = None) -> np.ndarray:
        """Return (E,) int32: how often the faces use each edge as stored, minus how often reversed.

        Parameters
        ----------
        faces : (C,) int             faces as stored
        reversed_faces : (R,) int    faces whose winding is reversed first
        """
        from softshadow.scene.face_kernels import add_chain

        sums = np.zeros(
            len(self.edges) + 1, np.int32
        )  # one more, so that degenerate faces can add their zeros even without edges
        add_chain(self.face_edges, self.face_signs, np.asarray(faces, np.int32), 1, sums)
        if reversed_faces is not None and len(reversed_faces):
            add_chain(self.face_edges, self.face_signs, np.asarray(reversed_faces, np.int32), -1, sums)
        return sums[:-1]

    @cached_property
    def face_bodies(self) -> np.ndarray:
        """(T,) int32: number of the body of each face; faces that share a position belong to one body."""
        from softshadow.scene.face_kernels import join_corners

        labels = np.arange(len(self.representatives), dtype=np.int32)
        join_corners(self.triangles, labels)
        return np.unique(labels[self.triangles[:, 0]], return_inverse=True)[1].astype(np.int32)

    @cached_property
    def closed_faces(self) -> np.ndarray:
        """(T,) bool: whether the body of each face is closed; bodies are judged separately."""
        if self.closed:
            return np.ones(len(self.triangles), dtype=bool)
        is_defect = ((self.edge_sums[self.face_edges] != 0) & (self.face_signs != 0)).any(axis=1)
        is_open = np.zeros(self.bodies, dtype=bool)
        is_open[self.face_bodies[is_defect]] = True
        return ~is_open[self.face_bodies]

    @property
    def bodies(self) -> int:
        """Number of bodies."""
        return int(self.face_bodies.max()) + 1

    def __repr__(self) -> str:
        return f"Topology({self.describe()})"

    def describe(self) -> str:
        """Return one line: closed or open, the number of bodies, and the defects of the mesh."""
        kind = "closed" if self.closed else "open" if self.boundary_edges else "not oriented"
        defects = [
            f"{number} {name}{'' if number == 1 else 's'}"
            for number, name in (
                (self.boundary_edges, "boundary edge"),
                (self.nonmanifold_edges, "non-manifold edge"),
                (self.misoriented_edges, "misoriented edge"),
                (self.degenerate_faces, "degenerate face"),
            )
            if number
        ]
        text = f"{kind}, {self.bodies} {'body' if self.bodies == 1 else 'bodies'}"
        return f"{text}: {', '.join(defects)}" if defects else text


def weld(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (V,) int32, a number per distinct position (-0 equals 0), and (P,) int32, the first vertex at each."""
    bits = (positions + np.float32(0)).view(np.uint32)  # adding 0 turns -0 into 0
    order = np.lexsort(
        (bits[:, 2], bits[:, 1], bits[:, 0])
    )  # stable: equal positions stay in the order of the vertices
    ordered = bits[order]
    starts = np.ones(len(order), dtype=bool)
    starts[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    ids = np.empty(len(order), dtype=np.int32)
    ids[order] = np.cumsum(starts, dtype=np.int32) - 1
    return ids, order[starts].astype(np.int32)
