"""Area lights: their shapes, attenuation and emission, and the points that stand for them."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scene.test_scene_files import MINIMAL, mistakes_of, write
from softshadow.errors import SceneError
from softshadow.inspection.recording import Packer, Unpacker
from softshadow.scene import Disc, Light, LightShape, Material, Rectangle, Scene, Segment, Sphere
from softshadow.scene.light_samples import PATTERNS, light_samples, sample_lights
from softshadow.scene.sample_patterns import sobol, square_to_disc, strata

SHAPES = (Rectangle((2, 0, 0), (0, 0, 1)), Disc(0.5, (1, 2, 0)), Sphere(0.75), Segment((0, 1, 1)))
CENTER = np.array([1.0, 4, 2])
ROUNDING = 1e-12

shapes = st.sampled_from(SHAPES)
patterns = st.sampled_from([pattern for pattern in PATTERNS if pattern != "corners"])


def lamp(shape: LightShape | None = None, **other: object) -> Light:
    return Light(CENTER, name="lamp", shape=shape, **other)


def is_on(shape: LightShape, points: np.ndarray) -> np.ndarray:
    """Return which points (n, 3), relative to the centre, lie on the shape, or within a sphere."""
    if isinstance(shape, Sphere):
        return np.linalg.norm(points, axis=1) <= shape.radius + ROUNDING
    u, v = shape.half_axes
    a, b = points @ u / (u @ u), points @ v / (v @ v if v.any() else 1)
    within = a * a + b * b <= 1 + ROUNDING if isinstance(shape, Disc) else np.maximum(abs(a), abs(b)) <= 1 + ROUNDING
    return within & (np.abs(points - a[:, None] * u - b[:, None] * v).max(axis=1) < ROUNDING)


# -- shapes ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_corners_lie_on_the_shape_around_its_centre(shape: LightShape) -> None:
    assert is_on(shape, shape.corners).all()
    assert shape.corners.mean(axis=0) == pytest.approx(np.zeros(3), abs=ROUNDING)
    assert np.linalg.norm(shape.corners, axis=1).max() == pytest.approx(shape.bounding_radius)
    assert lamp(shape).corners == pytest.approx(CENTER + shape.corners)
    assert shape.scaled(3).corners == pytest.approx(3 * shape.corners)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Rectangle((1, 0, 0), (0, 0, 0)), "edge_v: expected a length other than 0"),
        (
            lambda: Rectangle((1, 0, 0), (1, 1, 0)),
            "edge_v: expected an edge perpendicular to edge_u, got a cosine of 0.7",
        ),
        (lambda: Disc(0, (0, 1, 0)), "radius: expected a positive number, got 0"),
        (lambda: Disc(1, (0, 0, 0)), "normal: expected a length other than 0"),
        (lambda: Sphere(-1), "radius: expected a positive number, got -1"),
        (lambda: Segment((0, 0, 0)), "edge: expected a length other than 0"),
        (lambda: lamp("disc"), "lamp: shape: expected one of rectangle, disc, sphere, segment or None"),
        (lambda: Light((0, 1, 0, 0), shape=Sphere(1)), "shape: a light at infinity has none"),
        (lambda: lamp(Sphere(1), axis=(0, -1, 0), cutoff=30), "shape: a spot light has none"),
        (lambda: lamp(attenuation=(1, -1, 0)), "attenuation: expected three numbers of at least 0, not all 0"),
        (lambda: lamp(attenuation=(0, 0, 0)), "attenuation: expected three numbers of at least 0, not all 0"),
        (lambda: Light((0, 1, 0, 0), attenuation=(1, 1, 0)), "attenuation: a light at infinity has no distance"),
        (lambda: lamp().corners, "lamp: corners: expected a light with a shape"),
        (lambda: Material(emission=(1, 2)), "material: emission: expected 3 finite numbers"),
    ],
)
def test_impossible_light_is_named(make, said) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(SceneError, match=said):
        make()


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_area_light_is_saved_and_loaded_with_a_run(shape: LightShape) -> None:
    packer = Packer()
    packed = packer.pack(lamp(shape, attenuation=(1, 0.5, 0.25)))
    again = Unpacker(packer.objects, packer.arrays).unpack(packed)
    assert again.corners.tolist() == lamp(shape).corners.tolist()
    assert again.attenuation.tolist() == [1, 0.5, 0.25]


# -- samples -----------------------------------------------------------------------------------------------------------


@given(shapes, patterns, st.integers(2, 40), st.integers(0, 3))
def test_samples_lie_on_the_light_and_are_repeatable(shape: LightShape, pattern: str, n: int, seed: int) -> None:
    points = light_samples(lamp(shape), n, pattern, seed)
    assert points.shape == (n, 3)
    assert is_on(shape, points - CENTER).all()
    assert (points == light_samples(lamp(shape), n, pattern, seed)).all()
    if pattern != "grid":
        assert (points != light_samples(lamp(shape), n, pattern, seed + 1)).any()


@given(shapes, st.sampled_from(PATTERNS))
def test_one_sample_is_the_centre(shape: LightShape, pattern: str) -> None:
    assert light_samples(lamp(shape), 1, pattern).tolist() == [CENTER.tolist()]
    assert light_samples(lamp(), 1, pattern).tolist() == [CENTER.tolist()]


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: type(shape).__name__)
def test_corners_are_samples(shape: LightShape) -> None:
    assert light_samples(lamp(shape), len(shape.corners), "corners") == pytest.approx(lamp(shape).corners)
    with pytest.raises(SceneError, match=f"n=3: expected 1 or {len(shape.corners)}, the number of corners"):
        light_samples(lamp(shape), 3, "corners")


@given(st.integers(1, 60), st.data())
def test_strata_have_equal_areas_and_one_point_each(n: int, data: st.DataObject) -> None:
    columns = data.draw(st.integers(1, n))
    low, high = (strata(n, columns, np.full((n, 2), place)) for place in (0.0, 1.0))
    assert np.prod(high - low, axis=1) == pytest.approx(np.full(n, 1 / n))
    assert (low >= 0).all()
    assert (high <= 1 + ROUNDING).all()
    middles = strata(n, columns, np.full((n, 2), 0.5))
    inside = ((middles[:, None] > low) & (middles[:, None] < high)).all(axis=2)
    assert (inside == np.eye(n, dtype=bool)).all()


def test_a_square_grid_has_the_centres_of_its_cells() -> None:
    points = light_samples(lamp(Rectangle((3, 0, 0), (0, 0, 3))), 9) - CENTER
    assert sorted(map(tuple, points.round(9))) == [(x, 0, z) for x in (-1, 0, 1) for z in (-1, 0, 1)]
    ends = light_samples(lamp(Segment((8, 0, 0))), 4) - CENTER
    assert ends[:, 0].tolist() == [-3, -1, 1, 3]


@pytest.mark.parametrize("seed", [0, 7])
@pytest.mark.parametrize("pair", [(0, 1), (0, 2), (1, 2)])
def test_sobol_points_lie_in_different_cells_of_every_shape(seed: int, pair: tuple[int, int]) -> None:
    points = sobol(64, 3, seed)[:, pair]
    shapes_of_cells = [(8, 8), (64, 1), (1, 64)] + ([(2, 32), (32, 2), (4, 16), (16, 4)] if pair == (0, 1) else [])
    for cells in shapes_of_cells:
        assert len({tuple(cell) for cell in np.floor(points * cells).astype(int)}) == 64


def test_square_is_moved_to_the_disc_with_equal_areas() -> None:
    cells = (np.stack(np.meshgrid(np.arange(300), np.arange(300)), -1).reshape(-1, 2) + 0.5) / 300
    x, y = square_to_disc(cells).T
    assert np.hypot(x, y).max() < 1
    for radius in (0.3, 0.6, 0.9):
        assert (np.hypot(x, y) < radius).mean() == pytest.approx(radius**2, abs=0.01)  # cells on the circle
    assert (np.arctan2(y, x) < 1).mean() == pytest.approx(0.5 + 1 / (2 * np.pi), abs=0.01)


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0, 0.8)])
@pytest.mark.parametrize("pattern", ["sobol", "jittered", "random"])
def test_a_sphere_is_filled_so_that_every_side_sees_an_even_disc(axis: tuple, pattern: str) -> None:
    points = (light_samples(lamp(Sphere(2)), 4096, pattern) - CENTER) / 2
    from_axis = np.linalg.norm(points - np.outer(points @ axis, axis), axis=1)
    for radius in (0.25, 0.5, 0.75, 0.9):
        # 4096 independent points: three standard errors are 0.024
        assert (from_axis < radius).mean() == pytest.approx(radius**2, abs=0.024)


def test_lights_at_samples_are_points_with_names() -> None:
    lights = sample_lights(lamp(SHAPES[0], attenuation=(1, 1, 0)), 4)
    assert [light.name for light in lights] == ["lamp 1", "lamp 2", "lamp 3", "lamp 4"]
    assert np.stack([light.position[:3] for light in lights]) == pytest.approx(light_samples(lamp(SHAPES[0]), 4))
    assert all(light.shape is None and light.is_attenuated for light in lights)
    sun = Light((0, 1, 0, 0))
    assert sample_lights(sun, 16) == (sun,)


def test_impossible_samples_are_named() -> None:
    with pytest.raises(ValueError, match="n=0: expected a number of points, 1 or more"):
        light_samples(lamp(SHAPES[0]), 0)
    with pytest.raises(ValueError, match=r"pattern='sobel': did you mean 'sobol'\?"):
        light_samples(lamp(SHAPES[0]), 4, "sobel")
    with pytest.raises(SceneError, match="lamp: a light without a shape has one point, not 4"):
        light_samples(lamp(), 4)
    with pytest.raises(SceneError, match="a light at infinity has no points"):
        light_samples(Light((0, 1, 0, 0)), 1)


# -- scene files -------------------------------------------------------------------------------------------------------

PLACE = "position = [2, 5, 3]"


@pytest.mark.parametrize(
    ("table", "kind"),
    [
        ('shape = "rectangle"\nparameters = { edge_u = [1, 0, 0], edge_v = [0, 0, 2] }', Rectangle),
        ('shape = "disc"\nparameters = { radius = 0.5, normal = [0, 1, 0] }', Disc),
        ('shape = "sphere"\nparameters = { radius = 0.5 }', Sphere),
        ('shape = "segment"\nparameters = { edge = [1, 0, 0] }', Segment),
    ],
)
def test_scene_file_has_an_area_light(tmp_path: Path, table: str, kind: type) -> None:
    scene = Scene.load(write(tmp_path, MINIMAL.replace(PLACE, f"{PLACE}\n{table}\nattenuation = [1, 0, 0.1]")))
    assert isinstance(scene.lights[0].shape, kind)
    assert scene.lights[0].attenuation.tolist() == [1, 0, 0.1]


def test_scene_file_has_an_emission(tmp_path: Path) -> None:
    text = MINIMAL.replace('"box"', '"box"\nmaterial = { emission = [0.5, 0, 0.25] }')
    assert Scene.load(write(tmp_path, text)).objects[0].material.emission.tolist() == [0.5, 0, 0.25]


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ('shape = "disk"', "light[0].shape: no shape of lights is called 'disk'; did you mean 'disc'?"),
        ('shape = "sphere"', "light[0].parameters.radius: expected a positive number, but it is missing"),
        (
            'shape = "sphere"\nparameters = { radius = 0 }',
            "light[0].parameters.radius: expected a positive number, got 0",
        ),
        ('shape = "segment"\nparameters = { edge = 3 }', "light[0].parameters.edge: expected 3 finite numbers, got 3"),
        (
            'shape = "segment"\nparameters = { edges = [1, 0, 0], edge = [1, 0, 0] }',
            "light[0].parameters.edges: a segment has no such parameter; did you mean 'edge'?",
        ),
        ("parameters = { radius = 1 }", "light[0].parameters: only a shape has parameters; expected none"),
        ("attenuation = [1, 0]", "light[0].attenuation: expected [constant, linear, quadratic], got [1, 0]"),
        ("attenuation = [0, 0, 0]", "light[0].attenuation: expected three numbers of at least 0, not all 0"),
    ],
)
def test_mistake_in_a_light_is_named_with_its_place(tmp_path: Path, table: str, said: str) -> None:
    (line,) = mistakes_of(tmp_path, MINIMAL.replace(PLACE, f"{PLACE}\n{table}"))
    assert line.startswith(said)
