"""What Hypothesis draws: every strategy of the tests, one section for each block of the package."""

import numpy as np
from hypothesis import reject
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softshadow.errors import MeshError
from softshadow.scene import Camera, Light, Mesh, Scene, SceneObject, placement, shapes

# -- techniques --------------------------------------------------------------------------------------------------------

SOLIDS = {
    "box": shapes.box(0.8, 0.5, 0.6),
    "tetrahedron": shapes.tetrahedron(0.8),
    "ball": shapes.sphere(0.4, 8, 4),
    "ring": shapes.torus(0.4, 0.15, 8, 5),
}


def coordinates(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers on a grid of 1/64, so that a failing example is readable."""
    return st.integers(round(low * 64), round(high * 64)).map(lambda k: k / 64)


@st.composite
def floor_scenes(draw: st.DrawFn, lights: int = 1) -> Scene:
    """Return a floor with one to three closed casters over it, lit from above; the camera stands aside."""
    objects = [SceneObject(shapes.floor(16), casts=False, receives=True, name="floor")]
    for index in range(draw(st.integers(1, 3))):
        solid = draw(st.sampled_from(sorted(SOLIDS)))
        move = draw(st.tuples(coordinates(-1.5, 1.5), coordinates(0.7, 2), coordinates(-1.5, 1.5)))
        turn = (draw(st.integers(0, 359)), *draw(st.sampled_from([(0, 1, 0), (1, 0, 0), (1, 2, 3)])))
        scale = draw(st.sampled_from([0.7, 1.0, 1.3]))
        objects.append(SceneObject(SOLIDS[solid], placement(move, turn, scale), name=f"{solid} {index}"))
    return Scene("drawn", Camera((4, 5, 7), (0, 0.7, 0), near=1, far=40), draw(_lights_above(lights)), tuple(objects))


def _lights_above(count: int) -> st.SearchStrategy[tuple[Light, ...]]:
    place = st.tuples(coordinates(-3, 3), coordinates(4, 7), coordinates(-3, 1), st.sampled_from([0.0, 1.0]))
    return st.tuples(*[place.map(lambda p, i=i: Light(p, np.full(3, 0.4), f"light {i}")) for i in range(count)])


@st.composite
def planes_and_lights(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Return a plane (4,) with a normal of some length, and a homogeneous light (4,) off it."""
    normal = np.array(draw(st.tuples(*[coordinates(-2, 2)] * 3).filter(any)))
    light = np.array([*draw(st.tuples(*[coordinates(-4, 4)] * 3).filter(any)), draw(st.sampled_from([0.0, 1.0]))])
    plane = np.array([*normal, draw(coordinates(-3, 3))])
    if abs(plane @ light) < 1 / 16:  # nearer to the plane, the matrix says nothing any more
        plane[:3] = light[:3]
        plane[3] = 1.0 if light[3] else 0.0
    return plane, light


# -- pipeline ----------------------------------------------------------------------------------------------------------

FUNCTIONS = ("GL_NEVER", "GL_LESS", "GL_EQUAL", "GL_LEQUAL", "GL_GREATER", "GL_NOTEQUAL", "GL_GEQUAL", "GL_ALWAYS")
STENCIL_OPS = ("GL_KEEP", "GL_ZERO", "GL_REPLACE", "GL_INCR", "GL_DECR", "GL_INVERT", "GL_INCR_WRAP", "GL_DECR_WRAP")


@st.composite
def fragment_states(draw: st.DrawFn) -> dict:
    """Per-fragment state as the oracle takes it: alpha, stencil and depth test or None, and whether it is scissored."""
    func, op, byte = st.sampled_from(FUNCTIONS), st.sampled_from(STENCIL_OPS), st.integers(0, 255)
    bits = draw(st.sampled_from([8, 8, 1, 3]))
    return {
        "scissored": draw(st.integers(0, 9)) == 0,
        "alpha": draw(st.none() | st.tuples(func, byte)),
        "stencil": draw(st.none() | st.tuples(func, st.integers(-3, 300), byte, op, op, op, byte, st.just(bits))),
        "depth": draw(st.none() | st.tuples(func, st.booleans())),
    }


@st.composite
def window_fans(draw: st.DrawFn, size: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """A fan all round an inner point: positions (V, 2) on a grid of 1/8 pixel, triangles (T, 3) that share their
    spokes.

    Each rim vertex stays in the middle two thirds of its own sector, so the pieces never overlap. Corners often lie on
    pixel centres, so that edges run through samples.
    """
    step, corners = 8, draw(st.integers(4, 9))
    sector = 360 / corners
    turned = np.radians([sector * (i + draw(st.integers(-8, 8)) / 24) for i in range(corners)])
    reach = np.array([draw(st.integers(3 * step, (size // 2 - 1) * step)) for _ in range(corners)])
    middle = np.array([draw(st.integers(size // 2 * step - 4, size // 2 * step + 4)) for _ in range(2)])
    rim = np.rint(np.stack([np.cos(turned), np.sin(turned)], axis=1) * reach[:, None])
    positions = np.concatenate([middle[None], middle + rim]) / step
    fan = [(0, 1 + i, 1 + (i + 1) % corners) for i in range(corners)]
    return positions.astype(np.float32), np.array(fan, np.int32)


# -- scene -------------------------------------------------------------------------------------------------------------


@st.composite
def closed_meshes(draw: st.DrawFn) -> Mesh:
    """Return a closed mesh, its vertices moved about on a grid: it may cross itself and have flat faces."""
    solid = SOLIDS[draw(st.sampled_from(sorted(SOLIDS)))]
    topology = solid.topology
    grid = draw(st.sampled_from([1, 4, 1024]))
    moves = draw(arrays(np.int8, (len(topology.representatives), 3), elements=st.integers(-3, 3)))
    moved = np.rint(solid.positions[topology.representatives] * 4 * grid) / grid + moves / grid
    return _with_area(moved[topology.vertex_ids], solid.triangles)


@st.composite
def open_meshes(draw: st.DrawFn) -> Mesh:
    """Return a soup of triangles over few grid points: boundaries, edges of many faces, faces back to back."""
    points = draw(st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=4, max_size=9, unique=True))
    corner = st.integers(0, len(points) - 1)
    triangles = draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=14))
    return _with_area(np.array(points, dtype=np.float64), np.array(triangles))


def _with_area(positions: np.ndarray, triangles: np.ndarray) -> Mesh:
    try:
        return Mesh(positions, triangles)
    except MeshError:  # nothing but flat faces
        reject()


def lights() -> st.SearchStrategy[np.ndarray]:
    """Homogeneous lights (4,), points and directions, often in the plane of a face or at a vertex."""
    place = st.tuples(*[st.integers(-12, 12).map(lambda k: k / 2)] * 3, st.sampled_from([0.0, 1.0]))
    return place.filter(lambda light: any(light)).map(np.array)
