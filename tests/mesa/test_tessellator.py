"""The tessellator makes the callbacks of libGLU, one for one, with its corners, combined vertices and errors."""

import sys
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import run_on_mesa

pytestmark = pytest.mark.mesa
SIZE = (8, 8)
RULES = ("ODD", "NONZERO", "POSITIVE", "NEGATIVE", "ABS_GEQ_TWO")


def contour(rng: np.random.Generator, kind: str, n: int) -> np.ndarray:
    """Return the vertices (n, 3) of a random contour: on a grid many coincide, those in space have no common plane."""
    if kind == "grid":
        return np.hstack([rng.integers(0, 6, (n, 2)), np.zeros((n, 1))]).astype(np.float64)
    if kind == "convex":
        angles = np.sort(rng.random(n)) * 2 * np.pi
        return np.stack([np.cos(angles), np.sin(angles), np.zeros(n)], axis=1)
    vertices = rng.random((n, 3))
    vertices[:, 2] *= kind == "in space"
    return vertices


def callbacks_of(gl: Any, seed: int) -> list[float]:
    """Return everything that the callbacks get for a random polygon, as numbers."""
    rng = np.random.default_rng(seed)
    told: list[float] = []
    kept: list[Any] = []  # PyOpenGL hands out addresses of the data
    tess = gl.gluNewTess()

    def on(which: str, call: Any) -> None:
        kept.append(call)
        gl.gluTessCallback(tess, getattr(gl, f"GLU_TESS_{which}"), call)

    def combine(coords: Any, data: Any, weights: Any) -> tuple[float, ...]:
        told.append(-1.0)
        told.extend(map(float, coords))
        for vertex in data:
            told.extend((-2.0,) if vertex is None else vertex)
        told.extend(map(float, weights))
        kept.append(tuple(map(float, coords)))
        return kept[-1]

    on("BEGIN", lambda mode: told.append(1000.0 + mode))
    on("VERTEX", told.extend)
    on("END", lambda: told.append(2000.0))
    on("ERROR", lambda code: told.append(float(code)))
    if rng.random() < 0.3:
        on("EDGE_FLAG", lambda flag: told.append(3000.0 + flag))
    if rng.random() < 0.9:
        on("COMBINE", combine)
    gl.gluTessProperty(tess, gl.GLU_TESS_WINDING_RULE, getattr(gl, f"GLU_TESS_WINDING_{rng.choice(RULES)}"))
    gl.gluTessProperty(tess, gl.GLU_TESS_BOUNDARY_ONLY, rng.random() < 0.2)
    if rng.random() < 0.3:
        gl.gluTessNormal(tess, *map(float, rng.integers(-1, 2, 3)))
    kind = str(rng.choice(("grid", "plane", "plane", "convex", "in space")))
    gl.gluTessBeginPolygon(tess, None)
    for _ in range(rng.integers(1, 4)):
        gl.gluTessBeginContour(tess)
        for vertex in contour(rng, kind, 130 if seed % 25 == 0 else int(rng.choice((3, 4, 5, 8, 20, 60)))).tolist():
            kept.append(tuple(vertex))
            gl.gluTessVertex(tess, kept[-1], kept[-1])
        gl.gluTessEndContour(tess)
    gl.gluTessEndPolygon(tess)
    gl.gluDeleteTess(tess)
    return told


def all_callbacks(seeds: range) -> Any:
    def program(gl: Any) -> list[np.ndarray]:
        return [np.array(callbacks_of(gl, seed)) for seed in seeds]

    return program


def assert_equal(seeds: range) -> None:
    with gl.create_context(*SIZE):
        ours = all_callbacks(seeds)(gl)
    theirs = run_on_mesa(all_callbacks(seeds), SIZE).returned
    for seed, mine, other in zip(seeds, ours, theirs, strict=True):
        np.testing.assert_array_equal(mine, other, err_msg=f"seed {seed}")
    assert any(1000.0 + mode in told for told in ours for mode in (gl.GL_TRIANGLE_FAN, gl.GL_TRIANGLE_STRIP))


def test_random_polygons_are_tessellated_as_by_libglu() -> None:
    assert_equal(range(25))


@pytest.mark.slow
def test_many_random_polygons_are_tessellated_as_by_libglu() -> None:
    assert_equal(range(1000, 1800))


def what_is_left_out(gl: Any) -> list[np.ndarray]:
    """Return the errors of calls without those that must come before them, and of wrong properties and coordinates."""
    told: list[int] = []
    tess = gl.gluNewTess()
    gl.gluTessCallback(tess, gl.GLU_TESS_ERROR, told.append)
    gl.gluTessVertex(tess, (0.0, 0.0, 0.0), None)
    gl.gluTessVertex(tess, (1e200, 0.0, 0.0), None)
    gl.gluTessEndPolygon(tess)
    gl.gluTessBeginContour(tess)
    gl.gluTessBeginPolygon(tess, None)
    gl.gluTessProperty(tess, gl.GLU_TESS_WINDING_RULE, 7)
    gl.gluTessProperty(tess, gl.GLU_TESS_WINDING_RULE, 0.5)
    gl.gluTessProperty(tess, 7, 7)
    gl.gluTessProperty(tess, gl.GLU_TESS_TOLERANCE, 2)
    properties = [
        gl.gluGetTessProperty(tess, which)
        for which in (gl.GLU_TESS_WINDING_RULE, gl.GLU_TESS_TOLERANCE, gl.GLU_TESS_BOUNDARY_ONLY)
    ]
    gl.gluBeginPolygon(tess)
    gl.gluNextContour(tess, gl.GLU_EXTERIOR)
    gl.gluEndPolygon(tess)
    gl.gluDeleteTess(tess)
    return [np.array(told), np.array(properties, np.float64)]


def test_errors_of_the_tessellator_are_those_of_libglu() -> None:
    with gl.create_context(*SIZE):
        ours = what_is_left_out(gl)
    for mine, other in zip(ours, run_on_mesa(what_is_left_out, SIZE).returned, strict=True):
        np.testing.assert_array_equal(mine, other)
    assert gl.GLU_TESS_MISSING_BEGIN_POLYGON in ours[0]


def test_callbacks_with_data_get_that_of_the_polygon() -> None:
    told: list[Any] = []
    tess = gl.gluNewTess()
    gl.gluTessCallback(tess, gl.GLU_TESS_VERTEX_DATA, lambda vertex, data: told.append((vertex, data)))
    gl.gluTessCallback(tess, gl.GLU_TESS_VERTEX, lambda vertex: pytest.fail("the one with data has replaced it"))
    gl.gluTessCallback(tess, gl.GLU_TESS_BEGIN_DATA, lambda mode, data: told.append((mode, data)))
    gl.gluTessBeginPolygon(tess, "polygon")
    gl.gluTessBeginContour(tess)
    for name, corner in zip("abc", ((0, 0, 0), (1, 0, 0), (0, 1, 0)), strict=True):
        gl.gluTessVertex(tess, corner, name)
    gl.gluTessEndContour(tess)
    gl.gluTessEndPolygon(tess)
    assert told == [(gl.GL_TRIANGLES, "polygon"), ("a", "polygon"), ("b", "polygon"), ("c", "polygon")]


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda tess: gl.gluTessCallback(tess, 5, None), ValueError, "expected GLU_TESS_BEGIN"),
        (lambda tess: gl.gluTessCallback(tess, gl.GLU_TESS_END, 5), TypeError, "expected a function or None"),
        (lambda tess: gl.gluTessVertex(tess, (1, 2)), ValueError, "expected three numbers"),
    ],
)
def test_wrong_arguments_of_the_tessellator_are_named(call: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        call(gl.gluNewTess())


def test_a_polygon_with_a_hole_has_its_area() -> None:
    corners: list[Any] = []
    tess = gl.gluNewTess()
    gl.gluTessCallback(tess, gl.GLU_TESS_EDGE_FLAG, lambda flag: None)  # single triangles only
    gl.gluTessCallback(tess, gl.GLU_TESS_VERTEX, corners.append)
    gl.gluTessBeginPolygon(tess, None)
    for side in (4.0, 2.0):
        gl.gluTessBeginContour(tess)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl.gluTessVertex(tess, (x * side, y * side, 0.0), (x * side, y * side))
        gl.gluTessEndContour(tess)
    gl.gluTessEndPolygon(tess)
    a, b, c = np.array(corners).reshape(-1, 3, 2).transpose(1, 0, 2)
    areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert (areas > 0).all()
    assert areas.sum() == 8 * 8 - 4 * 4


def test_polygons_deeper_than_pythons_stack_need_no_recursion() -> None:
    n, tess = 3 * sys.getrecursionlimit(), gl.gluNewTess()
    rng, count = np.random.default_rng(2), [0]
    gl.gluTessCallback(tess, gl.GLU_TESS_VERTEX, lambda vertex: count.__setitem__(0, count[0] + 1))
    gl.gluTessBeginPolygon(tess, None)
    gl.gluTessBeginContour(tess)
    angles = np.linspace(0, 2 * np.pi, n, endpoint=False)
    for x, y in zip((np.cos(angles) * rng.uniform(1, 2, n)).tolist(), np.sin(angles).tolist(), strict=True):
        gl.gluTessVertex(tess, (x, y, 0.0))
    gl.gluTessEndContour(tess)
    gl.gluTessEndPolygon(tess)
    assert count[0] >= n
