"""A mesh as it is drawn. Vertices may share a position (at creases and texture seams); `topology` joins those."""

from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import MeshError
from softshadow.scene.topology import Topology
from softshadow.scene.validate import set_fields

# so that squared lengths and their reciprocals are finite float32 numbers (largest 3.4e38)
LARGEST_COORDINATE = 1e18


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Mesh:
    """Triangles and their vertices. The arrays are checked here once; all kernels rely on it.

    Parameters
    ----------
    positions : (V, 3) float32    object space; converted, copied and made read-only
    triangles : (T, 3) int32      counter-clockwise seen from outside, drawn in this order
    normals : (V, 3) float32      unit; by default the area-weighted mean over the triangles of each vertex
    texcoords : (V, 2) float32    (0, 0) at the bottom left, as in GL
    colors : (V, 4) float32       0 to 1
    name : str                    used by messages

    Raises
    ------
    ValueError                    an array has the wrong shape or dtype
    MeshError                     no vertices or triangles, an index out of range, a coordinate that is not finite or is
                                  too large for float32 arithmetic, or no triangle has an area
    """

    positions: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray
    texcoords: np.ndarray | None
    colors: np.ndarray | None
    name: str

    def __init__(
        self,
        positions: ArrayLike,
        triangles: ArrayLike,
        normals: ArrayLike | None = None,
        texcoords: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        name: str = "mesh",
    ) -> None:
        points = _array("positions", positions, 3)
        faces = _indices(triangles)
        _check_content(name, points, faces)
        optional = {
            "normals": vertex_normals(points, faces) if normals is None else _array("normals", normals, 3),
            "texcoords": None if texcoords is None else _array("texcoords", texcoords, 2),
            "colors": None if colors is None else _array("colors", colors, 4),
        }
        for key, array in optional.items():
            if array is not None and len(array) != len(points):
                raise ValueError(f"{key}: expected one row per vertex ({len(points)}), got {len(array)}")
            if array is not None and not np.isfinite(array).all():
                raise MeshError(f"{name}: {key} are not all finite; expected finite numbers")
        set_fields(self, positions=points, triangles=faces, name=name, **optional)

    @cached_property
    def topology(self) -> Topology:
        """Edges and bodies of the mesh, with vertices at exactly the same position joined; computed once."""
        return Topology(self.positions, self.triangles)

    @cached_property
    def face_normals(self) -> np.ndarray:
        """(T, 3) float64: the normal of each triangle; its length is twice the area."""
        return face_normals(self.positions, self.triangles)

    @cached_property
    def doubled_areas(self) -> np.ndarray:
        """(T,) float64: twice the area of each triangle."""
        return np.linalg.norm(self.face_normals, axis=1)

    @cached_property
    def first_corners(self) -> np.ndarray:
        """(T, 3) float64: the first corner of each triangle."""
        return self.positions[self.triangles[:, 0]].astype(np.float64)

    @cached_property
    def bounds(self) -> np.ndarray:
        """(2, 3) float64: smallest and largest coordinates of the vertices that a triangle uses."""
        is_used = np.zeros(len(self.positions), bool)
        is_used[self.triangles] = True
        used = self.positions[is_used].astype(np.float64)
        return np.stack([used.min(axis=0), used.max(axis=0)])

    @cached_property
    def signed_volume(self) -> float:
        """Volume of a closed mesh in object units, negative if its triangles are clockwise seen from outside."""
        # relative to the middle: far from the origin, large terms cancel and would round the volume away
        corners = self.first_corners - self.first_corners.mean(axis=0)
        return float(np.einsum("ij,ij", corners, self.face_normals)) / 6

    if TYPE_CHECKING:
        # softshadow.scene attaches this: its module imports this one

        @staticmethod
        def load(path: str | PathLike[str]) -> "Mesh": ...

    def __repr__(self) -> str:
        return f"Mesh({self.name!r}, {len(self.positions)} vertices, {len(self.triangles)} triangles)"


def face_normals(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return (T, 3) float64 normals of the triangles, each twice as long as the triangle's area."""
    a, b, c = (positions[triangles[:, corner]].astype(np.float64) for corner in range(3))
    return np.cross(b - a, c - a)


def vertex_normals(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return (V, 3) float32 unit normals: the area-weighted mean over the triangles of each vertex.

    A vertex of no triangle with an area gets (0, 0, 1), so that lighting stays finite.
    """
    weighted = face_normals(positions, triangles)
    corners = triangles.ravel()
    sums = np.stack(
        [np.bincount(corners, np.repeat(weighted[:, axis], 3), minlength=len(positions)) for axis in range(3)], axis=1
    )
    length = np.linalg.norm(sums, axis=1, keepdims=True)
    unit = np.divide(sums, length, out=np.tile([0.0, 0.0, 1.0], (len(sums), 1)), where=length > 0)
    return np.ascontiguousarray(unit, dtype=np.float32)


def _array(key: str, value: ArrayLike, width: int) -> np.ndarray:
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{key}: expected numbers of shape (V, {width}), got {array.dtype} of shape {array.shape}")
    with np.errstate(over="ignore"):  # numbers too large for float32 become infinite, which _check_content reports
        return np.array(array, dtype=np.float32, order="C")


def _indices(value: ArrayLike) -> np.ndarray:
    array = np.asarray(value)
    if array.dtype.kind not in "iu" and array.size:
        raise ValueError(f"triangles: expected integers of shape (T, 3), got {array.dtype} of shape {array.shape}")
    if array.size and (array.ndim != 2 or array.shape[1] != 3):
        raise ValueError(f"triangles: expected integers of shape (T, 3), got shape {array.shape}")
    # clipped first: the conversion to int32 could wrap a huge index into a legal one
    clipped = np.clip(array.reshape(-1, 3), -1, np.iinfo(np.int32).max)
    return np.array(clipped, dtype=np.int32, order="C")


def _check_content(name: str, positions: np.ndarray, triangles: np.ndarray) -> None:
    if not len(positions) or not len(triangles):
        raise MeshError(
            f"{name}: {len(positions)} vertices and {len(triangles)} triangles; expected at least one triangle"
        )
    outside = np.flatnonzero((triangles < 0).any(axis=1) | (triangles >= len(positions)).any(axis=1))
    if len(outside):
        raise MeshError(
            f"{name}: {len(outside)} triangles use vertices that do not exist, the first is triangle {outside[0]} "
            f"with vertices {triangles[outside[0]].tolist()}; expected indices 0 to {len(positions) - 1}"
        )
    with np.errstate(invalid="ignore"):
        bad = np.flatnonzero(~(np.abs(positions) <= LARGEST_COORDINATE).all(axis=1))
    if len(bad):
        raise MeshError(
            f"{name}: {len(bad)} vertices have coordinates that are NaN, infinite or beyond {LARGEST_COORDINATE:g}, "
            f"the first is vertex {bad[0]} at {positions[bad[0]].tolist()}; expected finite coordinates"
        )
    if not face_normals(positions, triangles).any():
        raise MeshError(
            f"{name}: none of the {len(triangles)} triangles has an area; expected at least one with an area"
        )
