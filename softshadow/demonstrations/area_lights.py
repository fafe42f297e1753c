"""Demonstrations about soft shadows: the planes of wedges, the edges of wedges, and the width of a penumbra."""

from typing import Any

import numpy as np

from softshadow.demonstrations.demonstration import Demonstration, number
from softshadow.scene import Light, Mesh, Rectangle, SceneObject, placement
from softshadow.scene.light_coverage import edge_shares
from softshadow.scene.penumbra_wedge import penumbra_wedges, silhouette_edges
from softshadow.truth import light_visibility

CENTER, RADIUS = np.array([0.3, 4.0, -0.2]), 0.5
EDGES, POINTS = 20, 50  # as many of each, per edge
ROUNDING = 1e-9  # of distances of a few units in float64
SQUARE = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def wedge_planes(gl: Any) -> list[int]:
    """E28: of 1000 points that see an edge before the light, those outside its wedge: other planes, right planes.

    The points are behind the edges, on lines from the light's sphere through them.
    """
    rng = np.random.default_rng(0)
    edges = rng.uniform(-1, 1, (EDGES, 2, 3)) * [2, 1, 2] + [0, 1, 0]
    wedges = penumbra_wedges(edges, CENTER, RADIUS)
    outside = [0, 0]
    for edge, near, moved, planes in zip(edges, wedges.near_end, wedges.moved_end, wedges.planes, strict=True):
        on_edge = edge[0] + rng.random((POINTS, 1)) * (edge[1] - edge[0])
        towards = rng.normal(size=(POINTS, 3))
        on_light = CENTER + RADIUS * towards / np.linalg.norm(towards, axis=1, keepdims=True)
        points = on_edge + rng.uniform(0, 3, (POINTS, 1)) * (on_edge - on_light)
        other = planes.copy()
        for index, end in ((2, moved), (3, near)):  # right, left
            other[index] = other_tangent(planes[index], end)
        for which, tested in enumerate((other, planes)):
            outside[which] += number((points @ tested[:, :3].T + tested[:, 3] < -ROUNDING).any(axis=1))
    return outside


def other_tangent(plane: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Return the other plane through an end that touches the sphere and is as perpendicular to the edge."""
    outwards = (end - CENTER) / np.linalg.norm(end - CENTER)
    normal = 2 * (plane[:3] @ outwards) * outwards - plane[:3]
    return np.array([*normal, -RADIUS - normal @ CENTER])


def moved_vertex(gl: Any) -> list[int]:
    """E29: of 400 points on a floor, those with another share of the light: moved edges, true edges."""
    corners = np.array([[-1, 0, -0.6], [1, 0, -0.6], [1, 0, 0.6], [-1, 0, 0.6]], np.float32)
    sheet = SceneObject(Mesh(corners, SQUARE), placement((0.2, 1.6, 0), (40, 0, 0, 1)), name="sheet")
    light = Light(CENTER, shape=Rectangle((0.8, 0, 0), (0, 0, 0.8)))
    true = silhouette_edges([sheet], light).ends
    distances = np.linalg.norm(true - CENTER, axis=2, keepdims=True)
    moved = CENTER + (true - CENTER) * (distances.min(axis=1, keepdims=True) / distances)
    x, z = np.meshgrid(np.linspace(-3, 3, 20), np.linspace(-3, 3, 20))
    points = np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])
    right = light_visibility(points, light, [sheet], method="exact").visible
    hard = light_visibility(points, Light(CENTER), [sheet]).visible
    return [
        number(np.abs(hard - [edge_shares(edges, light, point).sum() for point in points] - right) > ROUNDING)
        for edges in (moved, true)
    ]


def penumbra_width(gl: Any) -> list[int]:
    """E54: thousandths of the penumbra's width, after the receiver was moved by 1, and after the occluder was.

    Before, the light is 1 wide, the occluder 2 and the receiver 4 below it: the width is 1.
    """
    widths = []
    for occluder, receiver in ((2, 3), (3, 4)):
        corners = np.array([[-9, 0, -9], [0, 0, -9], [0, 0, 9], [-9, 0, 9]], np.float32)
        sheet = SceneObject(Mesh(corners, SQUARE), placement((0, receiver - occluder, 0)), name="sheet")
        light = Light((0, receiver, 0), shape=Rectangle((1, 0, 0), (0, 0, 1)))
        x = (np.arange(3000) + 0.5) / 1000 - 1.5
        points = np.column_stack([x, np.zeros((len(x), 2))])
        share = light_visibility(points, light, [sheet], method="exact").visible
        widths.append(number((share > ROUNDING) & (share < 1 - ROUNDING)))
    return widths


DEMONSTRATIONS = (
    Demonstration("wedge-planes", "points outside their wedge, of 1000: other tangent, right tangent", wedge_planes,
                  on_mesa=False),
    Demonstration("moved-vertex", "points with a wrong share, of 400: moved edges, true edges", moved_vertex,
                  on_mesa=False),
    Demonstration("penumbra-width", "thousandths of width: receiver 1 nearer, occluder 1 nearer", penumbra_width,
                  on_mesa=False),
)  # fmt: skip
