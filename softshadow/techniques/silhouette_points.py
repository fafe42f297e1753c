"""The points of a shadow silhouette map: for each cell of a shadow map, one point of the silhouette that crosses it.

The corners of a cell are four texel centres of the shadow map. For an edge that ends in a cell the point is its end;
for an edge that crosses the cell it is the intersection with a diagonal, or the middle of both intersections. A cell
crossed by several edges stores the point nearest to the light.

References: Sen, Cammarano & Hanrahan 2003, "Shadow silhouette maps".
"""

from typing import NamedTuple

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.scene.silhouette import silhouette
from softshadow.techniques.light_camera import LightCamera

MIDDLE = 0.5
# an edge is hidden if all four texels round it are nearer by more than this, in the map's range 0 to 1; the margin is
# needed because the map holds the surfaces that meet in the edge
HIDDEN = 2.0**-12


class Pieces(NamedTuple):
    """Pieces of edges, each within one cell.

    Attributes
    ----------
    edges, cells : (P,), (P, 2) int
    begins, ends : (P,) float64  where on its edge, from 0 to 1
    """

    edges: np.ndarray
    cells: np.ndarray
    begins: np.ndarray
    ends: np.ndarray


def silhouette_points(scene: Scene, light: Light, camera: LightCamera, stored: np.ndarray) -> np.ndarray:
    """Return the silhouette map (n, n, 3) float32 of a shadow map (n, n): s, t in the cell, and 1 if it has a point."""
    ends = [np.zeros((0, 2, 3))]
    for caster in scene.casters:
        edges = silhouette(caster.mesh, light.in_object_space(caster.object_to_world)).edges
        ends.append(caster.world_positions[edges])
    return stored_points(in_window(np.concatenate(ends), camera, len(stored)), stored)


def in_window(edges: np.ndarray, camera: LightCamera, side: int) -> np.ndarray:
    """Return world-space edges (E, 2, 3) in the map's window: x and y in texels, whole at texel centres, and depth.

    The parts in front of the near plane are cut off.
    """
    seen = (edges - camera.eye) @ camera.frame.T
    seen = seen[(seen[:, :, 2] > camera.near).any(axis=1)]
    along = seen[:, ::-1] - seen
    with np.errstate(divide="ignore", invalid="ignore"):
        cut = seen + ((camera.near - seen[:, :, 2]) / along[:, :, 2])[:, :, None] * along
    seen = np.where(seen[:, :, 2:] < camera.near, cut, seen)
    near, far, forward = camera.near, camera.far, seen[:, :, 2]
    scale = np.ones_like(forward) if camera.parallel else forward
    depth = (forward - near) / (far - near) if camera.parallel else far / (far - near) * (1 - near / forward)
    place = (seen[:, :, :2] / (camera.half * scale[:, :, None]) * 0.5 + 0.5) * side - 0.5
    return np.concatenate([place, depth[:, :, None]], axis=2)


def stored_points(edges: np.ndarray, stored: np.ndarray) -> np.ndarray:
    """Return the silhouette map (n, n, 3) float32 of edges (E, 2, 3) in the window of a shadow map (n, n)."""
    side = len(stored)
    points = np.full((side, side, 3), MIDDLE, np.float32)
    points[..., 2] = 0
    pieces = cut_at_cells(edges)
    inside = ((pieces.cells >= 0) & (pieces.cells < side - 1)).all(axis=1)
    pieces = Pieces(*(part[inside] for part in pieces))
    where = representative(edges, pieces)
    chosen = edges[pieces.edges, 0] + where[:, None] * (edges[pieces.edges, 1] - edges[pieces.edges, 0])
    x, y = pieces.cells.T
    corners = np.array([stored[y + j, x + i] for j in (0, 1) for i in (0, 1)])
    visible = np.flatnonzero((chosen[:, 2] <= corners.max(axis=0, initial=0) + HIDDEN) & np.isfinite(where))
    visible = visible[np.argsort(-chosen[visible, 2], kind="stable")]  # the nearest is written last
    points[y[visible], x[visible], :2] = chosen[visible, :2] - pieces.cells[visible]
    points[y[visible], x[visible], 2] = 1
    return points


def cut_at_cells(edges: np.ndarray) -> Pieces:
    """Return the pieces into which the lines of whole x and of whole y cut the edges."""
    numbers, places = [np.repeat(np.arange(len(edges)), 2)], [np.tile([0.0, 1.0], len(edges))]
    for axis in (0, 1):
        start, end = edges[:, 0, axis], edges[:, 1, axis]
        first, last = np.floor(np.minimum(start, end)) + 1, np.ceil(np.maximum(start, end)) - 1
        lines = np.maximum(last - first + 1, 0).astype(np.int64)
        number = np.repeat(np.arange(len(edges)), lines)
        line = np.arange(len(number)) - np.repeat(np.cumsum(lines) - lines, lines) + first[number]
        numbers.append(number)
        places.append((line - start[number]) / (end - start)[number])
    number, place = np.concatenate(numbers), np.concatenate(places)
    order = np.lexsort((place, number))
    number, place = number[order], place[order]
    piece = np.flatnonzero((number[1:] == number[:-1]) & (place[1:] > place[:-1]))
    number, begin, end = number[piece], place[piece], place[piece + 1]
    middle = edges[number, 0, :2] + ((begin + end) / 2)[:, None] * (edges[number, 1, :2] - edges[number, 0, :2])
    return Pieces(number, np.floor(middle).astype(np.int64), begin, end)


def representative(edges: np.ndarray, pieces: Pieces) -> np.ndarray:
    """Return where (P,) on its edge the point of each piece lies, from 0 to 1; NaN where the piece has no point."""
    start = edges[pieces.edges, 0, :2] - pieces.cells
    along = edges[pieces.edges, 1, :2] - edges[pieces.edges, 0, :2]
    crossings = []
    for side in (np.array([1, -1]), np.array([1, 1])):  # the diagonals x - y = 0 and x + y = 1
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (max(side[1], 0) - start @ side) / (along @ side)
        crossings.append(np.where((t >= pieces.begins) & (t <= pieces.ends), t, np.nan))
    both = np.array(crossings)
    met = np.isfinite(both)
    with np.errstate(invalid="ignore"):
        where = np.where(met, both, 0).sum(axis=0) / met.sum(axis=0)
    where = np.where(pieces.ends == 1, 1.0, where)
    ending: np.ndarray = np.where(pieces.begins == 0, 0.0, where)
    return ending
