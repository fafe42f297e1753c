"""The bits of a shadow map: what is stored, and how much offset the rounding needs."""

import numpy as np
import pytest

from softshadow import techniques
from softshadow.scene import Camera, Light, Scene, SceneObject, shapes
from techniques.drawn_frames import draw

BITS = {"d16": 16, "d24": 24}
FORMATS = ("d16", "d24", "d32", "d32f")
WITH_FORMAT = ("map", "map-pcf", "map-pcss", "map-sampled", "map-silhouette", "map-cube")
HEIGHTS = (4.0, 5.0, 5.5, 6.5, 7.0)
SHAPE = {"map_size": 32, "factor": 0.0}
FLOAT_STEP = 256.0  # units of 32 bits, 2^-31 each, in two steps of a float32 between 0.5 and 1


def floor_below(height: float) -> Scene:
    """A floor across the light's view: its depth has no slope, so only rounding is left."""
    floor = SceneObject(shapes.floor(12), name="floor")
    return Scene("floor", Camera((2.6, 3, 4.8), (0, 0, 0)), (Light((0, height, 0)),), (floor,))


def dark(map_format: str, units: float) -> int:
    """The largest number of pixels in shadow, of lights at several heights."""
    return max(
        int(draw("map", floor_below(height), map_format=map_format, units=units, **SHAPE).shadow.sum())
        for height in HEIGHTS
    )


@pytest.mark.parametrize("map_format", BITS)
def test_stored_depths_are_rounded_to_whole_steps(map_format: str) -> None:
    steps = 2 ** BITS[map_format] - 1
    for height in HEIGHTS:
        stored, exact = (
            draw("map", floor_below(height), map_format=name, units=0.0, **SHAPE).maps["ZS"].astype(np.float64)
            for name in (map_format, "d32f")
        )
        rounding = 2.0**-25  # all depths, 0 to 1, are read as float32
        assert np.abs(stored * steps - np.rint(stored * steps)).max() <= rounding * steps
        assert np.abs(stored - exact).max() <= 0.5 / steps + 2 * rounding


@pytest.mark.parametrize("map_format", BITS)
def test_one_unit_is_enough_for_maps_of_up_to_24_bits(map_format: str) -> None:
    assert dark(map_format, 0.0) > 0
    assert dark(map_format, 1.0) == 0


@pytest.mark.parametrize("map_format", ["d32", "d32f"])
def test_a_finer_map_needs_more_units_because_the_compared_depth_is_a_float(map_format: str) -> None:
    assert dark(map_format, 1.0) > 0
    assert dark(map_format, FLOAT_STEP) == 0


@pytest.mark.parametrize("technique", WITH_FORMAT)
def test_every_map_of_depths_takes_the_formats(technique: str) -> None:
    assert techniques.get(technique).options["map_format"].choices == FORMATS
    scene = floor_below(5.0)
    stored = {}
    for name in FORMATS:
        drawn = draw(technique, scene, map_format=name, map_size=32, units=FLOAT_STEP)
        assert not drawn.shadow.any()
        stored[name] = next((array for key, array in drawn.maps.items() if key.startswith("ZS")), None)
    if stored["d16"] is not None and technique != "map-cube":  # the first face of the cube does not see the floor
        assert (stored["d16"] != stored["d24"]).any()


def test_techniques_without_a_map_of_depths_have_no_format() -> None:
    assert {name for name in techniques.names() if "map_format" in techniques.get(name).options} == set(WITH_FORMAT)
