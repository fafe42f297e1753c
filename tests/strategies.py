"""What Hypothesis draws: every strategy of the tests, one section for each block of the package."""

import numpy as np
from hypothesis import strategies as st

from softshadow.scene import Camera, Light, Scene, SceneObject, placement, shapes


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
