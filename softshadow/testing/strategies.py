"""Hypothesis strategies to test a renderer: meshes, lights, cameras and whole scenes.

All numbers lie on a coarse grid. So a failing example is easy to read and type, and edges, corners and planes coincide
often, which is where renderers fail.

Examples
--------
>>> from softshadow.testing import strategies
>>> mesh = strategies.closed_meshes().example()  # doctest: +SKIP
>>> mesh.topology.closed  # doctest: +SKIP
True
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from softshadow.errors import MeshError
from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, placement, shapes

try:
    from hypothesis import reject
    from hypothesis import strategies as st
    from hypothesis.extra.numpy import arrays
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "softshadow.testing.strategies needs Hypothesis: pip install 'softshadow[properties]'",
        name=error.name,
    ) from None

__all__ = [
    "SOLIDS",
    "cameras",
    "closed_meshes",
    "coordinates",
    "floor_scenes",
    "lights",
    "meshes",
    "overlapping_scenes",
    "scenes",
    "scenes_from_within",
    "sheets",
    "soups",
]

SOLIDS = {
    "box": shapes.box(0.8, 0.5, 0.6),
    "tetrahedron": shapes.tetrahedron(0.8),
    "ball": shapes.sphere(0.4, 8, 4),
    "ring": shapes.torus(0.4, 0.15, 8, 5),
}


def coordinates(low: float, high: float) -> st.SearchStrategy[float]:
    """Return numbers on a grid of 1/64."""
    return st.integers(round(low * 64), round(high * 64)).map(lambda k: k / 64)


# -- meshes ------------------------------------------------------------------------------------------------------------


@st.composite
def closed_meshes(draw: st.DrawFn) -> Mesh:
    """Return a closed polyhedron with vertices displaced on a grid; it may intersect itself and have flat faces."""
    solid = SOLIDS[draw(st.sampled_from(sorted(SOLIDS)))]
    topology = solid.topology
    grid = draw(st.sampled_from([1, 4, 1024]))
    moves = draw(arrays(np.int8, (len(topology.representatives), 3), elements=st.integers(-3, 3)))
    moved = np.rint(solid.positions[topology.representatives] * 4 * grid) / grid + moves / grid
    return _with_area(moved[topology.vertex_ids], solid.triangles)


@st.composite
def soups(draw: st.DrawFn) -> Mesh:
    """Return random triangles over few grid points: with boundaries, edges of many faces, faces back to back."""
    points = draw(st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=4, max_size=9, unique=True))
    corner = st.integers(0, len(points) - 1)
    triangles = draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=14))
    return _with_area(np.array(points, dtype=np.float64), np.array(triangles))


@st.composite
def sheets(draw: st.DrawFn) -> Mesh:
    """Return an open, consistently oriented sheet: a height field of up to 4 x 4 cells, with holes."""
    columns, rows = draw(st.integers(1, 4)), draw(st.integers(1, 4))
    x, z = (axis.ravel() for axis in np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0)))
    heights = draw(arrays(np.int8, x.shape, elements=st.integers(-4, 4)))
    low = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    high = low + columns + 1
    present = draw(arrays(np.bool_, low.shape).filter(np.any))
    triangles = np.stack([low, high, high + 1, low, high + 1, low + 1], axis=1)[present].reshape(-1, 3)
    return Mesh(np.stack([x - columns / 2, heights / 8, z - rows / 2], axis=1) / 2, triangles, name="sheet")


def meshes() -> st.SearchStrategy[Mesh]:
    """Return meshes of all kinds: closed, soups and open sheets."""
    return st.one_of(closed_meshes(), soups(), sheets())


def _with_area(positions: np.ndarray, triangles: np.ndarray) -> Mesh:
    try:
        return Mesh(positions, triangles)
    except MeshError:  # all faces are flat
        reject()


# -- lights and cameras ------------------------------------------------------------------------------------------------


def lights(kind: Literal["point", "directional", "any"] = "any") -> st.SearchStrategy[np.ndarray]:
    """Return homogeneous light positions (4,), often in a face's plane or at a vertex; w = 0 for a direction."""
    choices = {"point": [1.0], "directional": [0.0], "any": [0.0, 1.0]}
    if kind not in choices:
        raise ValueError(f"kind: expected one of {', '.join(choices)}, got {kind!r}")
    place = st.tuples(*[st.integers(-12, 12).map(lambda k: k / 2)] * 3, st.sampled_from(choices[kind]))
    return place.filter(lambda light: any(light)).map(np.array)


@st.composite
def cameras(draw: st.DrawFn, near: float = 0.5, far: float = 40) -> Camera:
    """Return a camera above the plane y = 0 that looks near the origin."""
    target = draw(st.tuples(coordinates(-1, 1), coordinates(0, 1.5), coordinates(-1, 1)))
    around = np.radians(draw(st.integers(0, 359)))
    away, height = draw(coordinates(2, 8)), draw(coordinates(0.5, 6))
    eye = np.add(target, (away * np.sin(around), height, away * np.cos(around)))
    return Camera(eye, target, near=near, far=far)


# -- scenes ------------------------------------------------------------------------------------------------------------


@st.composite
def floor_scenes(draw: st.DrawFn, lights: int = 1) -> Scene:
    """Return a floor with one to three closed solids above it, lit from above; the camera is outside all shadows."""
    return Scene(
        "drawn",
        Camera((4, 5, 7), (0, 0.7, 0), near=1, far=40),
        draw(_lights_above(lights)),
        (_floor(), *draw(_solids_above())),
    )


@st.composite
def overlapping_scenes(draw: st.DrawFn) -> Scene:
    """Return a floor with two or four slabs, one above the other, lit from above: their shadows always overlap.

    The middle of every slab lies on one ray from the light, so some points of the floor are in as many shadow volumes
    as there are slabs, an even number: a renderer that tells only lit from shadow, or odd from even, is found out.
    """
    light = draw(_lights_above(1))[0]
    foot = np.array([draw(coordinates(-0.5, 0.5)), 0.0, draw(coordinates(-0.5, 0.5))])
    towards = light.position[:3] - light.position[3] * foot
    objects = [_floor()]
    for index in range(draw(st.sampled_from([2, 4]))):
        height = 1.6 + 0.4 * index  # so that the camera sees what lies under the slabs
        middle = foot + towards * height / towards[1]
        slab = shapes.box(draw(st.sampled_from([1.6, 1.8, 2.0])), 0.1, draw(st.sampled_from([1.6, 1.8, 2.0])))
        place = placement(tuple(middle), (draw(st.integers(0, 89)), 0, 1, 0))
        objects.append(SceneObject(slab, place, name=f"slab {index}"))
    return Scene("drawn", Camera((5, 6, 8), (0, 0.7, 0), near=1, far=40), (light,), tuple(objects))


@st.composite
def scenes(draw: st.DrawFn, lights: int = 1, casters: st.SearchStrategy[Mesh] | None = None) -> Scene:
    """Return a floor with one to three casters above it, lit from above; the camera may be inside a shadow.

    Parameters
    ----------
    casters : strategy of Mesh   the casters, which are scaled to an extent of 1; by default `meshes`
    """
    objects = [_floor()]
    for index, mesh in enumerate(draw(st.lists(meshes() if casters is None else casters, min_size=1, max_size=3))):
        move = draw(st.tuples(coordinates(-1.5, 1.5), coordinates(0.9, 2), coordinates(-1.5, 1.5)))
        scale = 1 / float(np.ptp(mesh.bounds, axis=0).max())
        matrix = placement(move, _turn(draw), scale) @ placement(tuple(-mesh.bounds.mean(axis=0)))
        objects.append(SceneObject(mesh, matrix, name=f"caster {index}"))
    return Scene("drawn", draw(cameras()), draw(_lights_above(lights)), tuple(objects))


@st.composite
def scenes_from_within(draw: st.DrawFn, lights: int = 1) -> Scene:
    """Return a `floor_scenes` scene with the camera in or beside a shadow.

    The side of a shadow volume often crosses the near rectangle.
    """
    scene = draw(floor_scenes(lights))
    caster, light = draw(st.sampled_from(scene.casters)), scene.lights[0].position
    middle = caster.object_to_world[:3, 3]
    away = middle - light[:3] if light[3] else -light[:3]
    beside = np.array([draw(coordinates(-1, 1)), 0, draw(coordinates(-1, 1))])
    eye = middle + draw(st.sampled_from([0.8, 1.2])) * away / np.linalg.norm(away) + beside
    target = eye + np.array([draw(coordinates(-1, 1)), draw(coordinates(-1, 0.5)), -1])
    near = draw(st.sampled_from([0.02, 0.25, 0.8]))
    return replace(scene, camera=Camera(eye, target, fov_y=60, near=near, far=40))


def _floor() -> SceneObject:
    return SceneObject(shapes.floor(16), casts=False, receives=True, name="floor")


@st.composite
def _solids_above(draw: st.DrawFn) -> list[SceneObject]:
    objects = []
    for index in range(draw(st.integers(1, 3))):
        solid = draw(st.sampled_from(sorted(SOLIDS)))
        move = draw(st.tuples(coordinates(-1.5, 1.5), coordinates(0.7, 2), coordinates(-1.5, 1.5)))
        turn, scale = _turn(draw), draw(st.sampled_from([0.7, 1.0, 1.3]))
        objects.append(SceneObject(SOLIDS[solid], placement(move, turn, scale), name=f"{solid} {index}"))
    return objects


def _turn(draw: st.DrawFn) -> tuple[float, float, float, float]:
    return (draw(st.integers(0, 359)), *draw(st.sampled_from([(0, 1, 0), (1, 0, 0), (1, 2, 3)])))


def _lights_above(n_lights: int) -> st.SearchStrategy[tuple[Light, ...]]:
    place = st.tuples(coordinates(-3, 3), coordinates(4, 7), coordinates(-3, 1), st.sampled_from([0.0, 1.0]))
    return st.tuples(*[place] * n_lights).map(
        lambda places: tuple(Light(p, np.full(3, 0.4), f"light {index}") for index, p in enumerate(places))
    )
