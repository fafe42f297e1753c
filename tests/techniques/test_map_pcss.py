"""Percentage-closer soft shadows: hard without a size, as wide as similar triangles say, and nearer to the truth."""

from dataclasses import replace

import numpy as np
import pytest

import softshadow as ss
from softshadow.programs.soft_visibility import on_light
from softshadow.scene import Camera, Disc, Light, LightShape, Rectangle, Scene, SceneObject, Segment, placement, shapes
from softshadow.techniques import drawing
from softshadow.techniques.map_pcss import SHOWN, stride
from techniques.drawn_frames import Drawn, cast_rays, draw

SIZE = (160, 120)
SLAB = Scene.named("soft-slab")
# soft-slab: light 1 wide at height 4, the slab's upper edges 0.75 from the axis at height 2, the floor at 0
WIDTH = 1 * (4 - 2) / 2
MIDDLE_OF_RAMP = 0.75 * 4 / 2


def with_shape(scene: Scene, shape: LightShape | None) -> Scene:
    light = scene.lights[0]
    return replace(scene, lights=(Light(light.position, light.color, light.name, shape=shape),))


def floor_points(drawn: Drawn, scene: Scene, size: tuple[int, int]) -> np.ndarray:
    depth = drawn.depth["draw the scene without the light"]
    return drawing.world_points(scene, depth, size)


@pytest.mark.parametrize("name", ["boxes", "torus", "sunlight", "spotlight", "two-lights"])
def test_a_light_without_a_shape_has_the_shadow_of_one_texel(name: str) -> None:
    scene, options = Scene.named(name), {"factor": 1.0, "units": 1.0}
    soft, hard = (draw("map-pcss", scene, **options), draw("map-pcf", scene, kernel=1, **options))
    assert (soft.maps["visibility"] == hard.maps["visibility"]).all()
    assert (soft.image == hard.image).all()


@pytest.mark.parametrize("name", ["soft-slab", "soft-overlap", "soft-torus"])
def test_a_light_that_shrinks_to_a_point_has_the_shadow_of_one_texel(name: str) -> None:
    scene, options = Scene.named(name), {"factor": 1.0, "units": 1.0}
    shape = scene.lights[0].shape
    assert shape is not None
    soft, hard = (
        draw("map-pcss", with_shape(scene, shape.scaled(1e-9)), **options),
        draw("map-pcf", with_shape(scene, None), kernel=1, **options),
    )
    assert (soft.maps["visibility"] == hard.maps["visibility"]).all()


def test_ramp_of_a_straight_edge_is_as_wide_as_the_formula_says() -> None:
    drawn, truth = draw("map-pcss", SLAB, SIZE, taps=16, search=16), cast_rays(SLAB, SIZE)
    x, _, z = np.moveaxis(floor_points(drawn, SLAB, SIZE), -1, 0)
    beside = (truth.objects == 0) & (np.abs(z) < MIDDLE_OF_RAMP - WIDTH / 2 - 0.1)
    expected = np.clip((np.abs(x) - MIDDLE_OF_RAMP) / WIDTH + 0.5, 0, 1)
    texel = 2 * 4 / 2 * 0.75 * 1.05 / 512  # of the map, on the floor
    seen = drawn.maps["visibility"]
    ramp = beside & (expected > 0) & (expected < 1)
    assert ramp.sum() > 300
    assert np.abs(seen - expected)[beside].max() <= texel / WIDTH + 1 / 16**2 + 1e-3  # a texel, a step, rounding
    assert drawn.maps["blocker distance"][ramp] == pytest.approx(2, abs=1e-3)
    assert drawn.maps["penumbra width"][ramp] == pytest.approx(WIDTH, abs=1e-3)


@pytest.mark.parametrize("size", [0.5, 1.0, 1.4])
def test_width_grows_with_the_light(size: float) -> None:
    scene = with_shape(SLAB, Rectangle((size, 0, 0), (0, 0, size)))
    drawn, truth = draw("map-pcss", scene, SIZE), cast_rays(scene, SIZE)
    x, _, z = np.moveaxis(floor_points(drawn, scene, SIZE), -1, 0)
    beside = (truth.objects == 0) & (np.abs(z) < 0.7)
    partly = beside & (drawn.maps["visibility"] > 0) & (drawn.maps["visibility"] < 1)
    pixel = 0.06  # on the floor, at most
    assert np.ptp(np.abs(x)[partly]) == pytest.approx(size * WIDTH, abs=3 * pixel)


def test_half_axes_of_the_light_give_the_widths_of_two_directions() -> None:
    scene = with_shape(SLAB, Rectangle((1.2, 0, 0), (0, 0, 0.4)))
    drawn, truth = draw("map-pcss", scene, SIZE), cast_rays(scene, SIZE)
    x, _, z = np.moveaxis(floor_points(drawn, scene, SIZE), -1, 0)
    partly = (truth.objects == 0) & (drawn.maps["visibility"] > 0) & (drawn.maps["visibility"] < 1)
    across, along = partly & (np.abs(z) < 0.7), partly & (np.abs(x) < 0.7)
    assert np.ptp(np.abs(x)[across]) == pytest.approx(1.2, abs=0.18)
    assert np.ptp(np.abs(z)[along]) == pytest.approx(0.4, abs=0.18)


@pytest.mark.parametrize(
    "shape", [Rectangle((0.7, 0.7, 0), (-0.7, 0.7, 0)), Disc(0.6, (0, 1, 0)), Segment((0.8, 0, 0.3))]
)
def test_visibility_is_a_share_for_every_shape(shape: LightShape) -> None:
    drawn = draw("map-pcss", with_shape(SLAB, shape), taps=6)
    seen = drawn.maps["visibility"]
    assert seen.min() >= 0
    assert seen.max() <= 1
    assert ((seen > 0) & (seen < 1)).sum() > 20
    n_taps = in_circle(6) if isinstance(shape, Disc) else 6 * 6
    assert seen * n_taps == pytest.approx(np.rint(seen * n_taps), abs=1e-4)


def in_circle(side: int) -> int:
    """Number of points of a region that are within the unit circle."""
    step, indices = stride(side), range(side)
    return sum(on_light(i, j, side, step) ** 2 + on_light(j, i, side, step) ** 2 <= 1 for i in indices for j in indices)


@pytest.mark.parametrize("side", range(1, 65))
def test_points_of_a_region_share_no_row_and_no_column(side: int) -> None:
    places = {i * side + j * stride(side) % side for i in range(side) for j in range(side)}
    assert len(places) == side * side


def contact() -> Scene:
    """A post on a slope: its shadow is sharp at the foot and soft at the top."""
    tilt = placement((0, 0, 0), (20, 1, 0, 0.4))
    return Scene(
        "contact",
        Camera((2.0, 3.0, 5.0), (0.3, 0.3, 0), fov_y=40, near=1, far=30),
        (Light((-2.5, 5, 3.5), shape=Rectangle((0.8, 0, 0), (0, 0, 0.8))),),
        (
            SceneObject(shapes.floor(9), tilt, casts=False, receives=True, name="slope"),
            SceneObject(shapes.box(0.5, 1.8, 0.5), tilt @ placement((0, 0.9, 0)), name="post"),
        ),
    )


@pytest.mark.parametrize("scene", [contact(), SLAB, Scene.named("soft-overlap")], ids=lambda scene: scene.name)
@pytest.mark.parametrize("kernel", [3, 31])
def test_error_is_less_than_that_of_a_constant_width(scene: Scene, kernel: int) -> None:
    truth = ss.soft_truth(scene, SIZE)
    rms = [
        ss.run(technique, scene, size=SIZE, **options).compare(truth=truth).rms
        for technique, options in (("map-pcss", {}), ("map-pcf", {"kernel": kernel, "bilinear": True}))
    ]
    assert 1.5 * rms[0] < rms[1]


def slope() -> Scene:
    roof = SceneObject(shapes.floor(2, 1), placement((0, 1, 0), (35, 1, 0, 0.3)), receives=True, name="roof")
    light = Light((-2.5, 5, 1), shape=Rectangle((1.5, 0, 0), (0, 0, 1.5)))
    return Scene("slope", Camera((3, 4, 6), (0, 1, 0), fov_y=20, near=1, far=30), (light,), (roof,))


@pytest.mark.parametrize("map_size", [32, 512])
def test_a_slope_does_not_shadow_itself_in_regions_of_any_width(map_size: int) -> None:
    assert not draw("map-pcss", slope(), map_size=map_size).shadow.any()
    assert draw("map-pcss", slope(), map_size=map_size, factor=0.0, units=0.0).shadow.any()


def test_the_mean_of_two_blockers_is_neither() -> None:
    """A known failure: where two slabs overlap in the light, the umbra is lit."""
    scene = Scene.named("soft-overlap")
    compared = ss.run("map-pcss", scene, size=SIZE).compare(truth="soft")
    assert compared.parts["umbra"].max > 0.2


def test_maps_are_0_where_nothing_is_drawn() -> None:
    drawn = draw("map-pcss", SLAB)
    sky = ~drawn.maps["valid"]
    assert sky.any()
    assert all((drawn.maps[name][sky] == 0).all() for name in SHOWN)
