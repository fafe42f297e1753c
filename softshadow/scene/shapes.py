"""Built-in shapes: meshes computed by formula, counter-clockwise seen from outside, y up.

Faces that meet in a crease have separate vertices there (split normals). Their positions are equal to the last bit, so
that `Mesh.topology` classifies every solid as closed. Texture coordinates start with (0, 0) at the bottom left.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from softshadow.scene.mesh import Mesh

UNIT_SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float64)


def quad(
    corner: Sequence[float], across: Sequence[float], up: Sequence[float], cells: int = 1, name: str = "quad"
) -> Mesh:
    """Return a parallelogram from `corner` along `across` and `up`; it faces across x up.

    Parameters
    ----------
    cells : int      squares per side; more squares make lighting per vertex finer
    """
    steps = np.linspace(0, 1, _at_least("cells", cells, 1) + 1)
    t, s = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    positions = np.asarray(corner, dtype=np.float64) + np.outer(s, across) + np.outer(t, up)
    normal = np.cross(across, up)
    if not normal.any():
        raise ValueError(f"across: {list(across)} and up {list(up)} are parallel; expected two different directions")
    normal = normal / np.linalg.norm(normal)
    triangles = _grid_triangles(cells, cells)
    return Mesh(positions, triangles, np.tile(normal, (len(positions), 1)), np.stack([s, t], axis=1), name=name)


def floor(width: float = 12, depth: float | None = None, cells: int = 1, name: str = "floor") -> Mesh:
    """Return a rectangle in the plane y = 0, centred on the origin, facing up."""
    depth = width if depth is None else depth
    _positive(width=width, depth=depth)
    return quad((-width / 2, 0, depth / 2), (width, 0, 0), (0, 0, -depth), cells, name)


def box(width: float = 1, height: float | None = None, depth: float | None = None, name: str = "box") -> Mesh:
    """Return a box centred on the origin, with 24 vertices at 8 positions."""
    height = width if height is None else height
    depth = width if depth is None else depth
    size = np.array(_positive(width=width, height=height, depth=depth)) / 2
    faces = []
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal, across = np.zeros(3), np.zeros(3)
            normal[axis] = sign
            across[(axis + 1) % 3] = 1.0
            faces.append(_face_of_box(normal, across, size))
    return _polygons(faces, name)


def wall(width: float = 3, height: float = 2, thickness: float = 0.05, name: str = "wall") -> Mesh:
    """Return a thin box (along z) that stands on y = 0, centred over the origin."""
    solid = box(width, height, thickness)
    raised = solid.positions + np.array([0, height / 2, 0], dtype=np.float32)
    return Mesh(raised, solid.triangles, solid.normals, solid.texcoords, name=name)


def stairs(steps: int = 4, width: float = 2, rise: float = 0.4, tread: float = 0.6, name: str = "stairs") -> Mesh:
    """Return a solid staircase on y = 0 that climbs from z = 0 towards -z, centred in x."""
    _at_least("steps", steps, 1)
    _positive(width=width, rise=rise, tread=tread)
    left, right = -width / 2, width / 2
    profile = [(0.0, 0.0)]  # z, y
    for step in range(steps):
        profile += [(-step * tread, (step + 1) * rise), (-(step + 1) * tread, (step + 1) * rise)]
    profile.append((-steps * tread, 0.0))
    faces = []
    for (z0, y0), (z1, y1) in pairwise([*profile, profile[0]]):
        faces.append(np.array([[left, y0, z0], [right, y0, z0], [right, y1, z1], [left, y1, z1]]))
    # the last point of the profile sees all others: a fan around it fills the side
    for x, outline in ((right, profile[::-1]), (left, [profile[-1], *profile[:-1]])):
        faces.append(np.array([(x, y, z) for z, y in outline]))
    return _polygons(faces, name)


def tetrahedron(size: float = 1, name: str = "tetrahedron") -> Mesh:
    """Return a regular tetrahedron with its vertices at alternate corners of a cube of this size, centred."""
    _positive(size=size)
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=np.float64) * size / 2
    return _polygons([corners[list(face)] for face in ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2))], name)


def sphere(radius: float = 0.5, segments: int = 32, rings: int = 16, name: str = "sphere") -> Mesh:
    """Return a sphere centred on the origin, poles on the y axis; a pole has one vertex per texture column."""
    _positive(radius=radius)
    _at_least("segments", segments, 3)
    _at_least("rings", rings, 2)
    latitude = np.linspace(-np.pi / 2, np.pi / 2, rings + 1)
    around, height = np.cos(latitude), np.sin(latitude)
    around[[0, -1]] = 0  # cos gives 6e-17, and every vertex of a pole would be at a different position
    cosine, sine = _circle(segments)
    normals = np.stack(
        [np.outer(around, sine), np.outer(height, np.ones(segments + 1)), np.outer(around, cosine)], axis=2
    )
    triangles = _grid_triangles(segments, rings)
    has_area = np.ones(len(triangles), dtype=bool)
    has_area[0 : 2 * segments : 2] = False  # in a cell at a pole, one triangle has two corners at the pole
    has_area[2 * segments * (rings - 1) + 1 :: 2] = False
    return _surface(radius * normals, normals, triangles[has_area], name)


def torus(
    major_radius: float = 0.7, minor_radius: float = 0.25, segments: int = 32, sides: int = 16, name: str = "torus"
) -> Mesh:
    """Return a torus around the y axis."""
    _positive(major_radius=major_radius, minor_radius=minor_radius)
    _at_least("segments", segments, 3)
    _at_least("sides", sides, 3)
    cosine, sine = _circle(segments)
    tube_cosine, tube_sine = _circle(sides)
    flat = np.ones(segments + 1)
    normals = np.stack([np.outer(tube_cosine, sine), np.outer(tube_sine, flat), np.outer(tube_cosine, cosine)], axis=2)
    centers = major_radius * np.stack([sine, 0 * flat, cosine], axis=1)
    return _surface(centers + minor_radius * normals, normals, _grid_triangles(segments, sides), name)


def cylinder(
    radius: float = 0.4, height: float = 1, segments: int = 32, capped: bool = True, name: str = "cylinder"
) -> Mesh:
    """Return a cylinder around the y axis, centred on the origin; an open tube without caps."""
    _positive(radius=radius, height=height)
    _at_least("segments", segments, 3)
    cosine, sine = _circle(segments)
    ring = np.stack([radius * sine, np.zeros(segments + 1), radius * cosine], axis=1)
    half = np.array([0, height / 2, 0])
    normals = np.tile(np.stack([sine, 0 * sine, cosine], axis=1), (2, 1, 1))
    side = _surface(np.stack([ring - half, ring + half]), normals, _grid_triangles(segments, 1), name)
    if not capped:
        return side
    caps = [ring[:-1] + half, (ring[:-1] - half)[::-1]]
    return _combined([side, _polygons(caps, name)], name)


def _at_least(key: str, value: int, smallest: int) -> int:
    if value < smallest:
        raise ValueError(f"{key}: expected at least {smallest}, got {value}")
    return value


def _positive(**lengths: float) -> tuple[float, ...]:
    for key, length in lengths.items():
        if not 0 < length < np.inf:
            raise ValueError(f"{key}: expected a positive length, got {length}")
    return tuple(lengths.values())


def _circle(segments: int) -> tuple[np.ndarray, np.ndarray]:
    """Return cosine and sine of segments + 1 angles around a circle; the last equals the first exactly."""
    angles = 2 * np.pi * (np.arange(segments + 1) % segments) / segments
    return np.cos(angles), np.sin(angles)


def _grid_triangles(columns: int, rows: int) -> np.ndarray:
    """Return two triangles per cell of a (rows + 1, columns + 1) grid of vertices, row by row."""
    row, column = np.divmod(np.arange(rows * columns), columns)
    low = row * (columns + 1) + column
    high = low + columns + 1
    return np.stack([low, low + 1, high + 1, low, high + 1, high], axis=1).reshape(-1, 3)


def _surface(positions: np.ndarray, normals: np.ndarray, triangles: np.ndarray, name: str) -> Mesh:
    """Return the mesh of a grid of vertices, (rows + 1, columns + 1, 3)."""
    rows, columns = positions.shape[:2]
    t, s = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    return Mesh(
        positions.reshape(-1, 3), triangles, normals.reshape(-1, 3), np.stack([s, t], axis=2).reshape(-1, 2), name=name
    )


def _face_of_box(normal: np.ndarray, across: np.ndarray, half: np.ndarray) -> np.ndarray:
    up = np.cross(normal, across)
    return np.array([(normal + x * across + y * up) * half for x, y in 2 * UNIT_SQUARE - 1])


def _polygons(faces: Sequence[np.ndarray], name: str) -> Mesh:
    """Return a mesh of flat polygons that share no vertices, each a fan around its first corner."""
    meshes = []
    for face in faces:
        normal = np.cross(face[1] - face[0], face[2] - face[0])
        middle = np.arange(1, len(face) - 1)
        fan = np.stack([np.zeros_like(middle), middle, middle + 1], axis=1)
        texcoords = UNIT_SQUARE if len(face) == 4 else np.zeros((len(face), 2))
        normals = np.tile(normal / np.linalg.norm(normal), (len(face), 1))
        meshes.append(Mesh(face, fan, normals, texcoords, name=name))
    return _combined(meshes, name)


def _combined(meshes: Sequence[Mesh], name: str) -> Mesh:
    starts = np.cumsum([0, *(len(mesh.positions) for mesh in meshes[:-1])])
    texcoords = [mesh.texcoords for mesh in meshes if mesh.texcoords is not None]
    return Mesh(
        np.concatenate([mesh.positions for mesh in meshes]),
        np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, starts, strict=True)]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate(texcoords),
        name=name,
    )
