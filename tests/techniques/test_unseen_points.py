"""Points outside the maps of many light points, found by tiles."""

import numpy as np
import pytest

from softshadow.scene import Scene, sample_lights
from softshadow.techniques.light_camera import light_camera
from softshadow.techniques.unseen_points import TILE, unseen_points


@pytest.mark.parametrize("name", ["soft-slab", "soft-torus", "torus", "sunlight"])
@pytest.mark.parametrize("shape", [(1, 1), (TILE, 2 * TILE), (37, 50)])
def test_tiles_find_the_points_that_a_camera_does_not_see(name, shape):
    rng, scene = np.random.default_rng(len(name) + shape[0]), Scene.named(name)
    cameras = [light_camera(scene, lamp) for lamp in sample_lights(scene.lights[0], 9, "grid", 0)]
    # a wavy floor that reaches beyond the maps, with holes
    x, z = np.meshgrid(np.linspace(-6, 6, shape[1]), np.linspace(-6, 6, shape[0]))
    points = np.stack([x, rng.uniform(-0.1, 0.1, shape), z], axis=-1)
    valid = rng.random(shape) < 0.9
    points[~valid] = rng.choice([1e30, 0.0])
    valid[-TILE:, -TILE:] &= max(shape) < TILE  # a tile without a valid point
    expected = valid & np.any([~camera.sees(points) for camera in cameras], axis=0)
    assert np.array_equal(unseen_points(cameras, points, valid), expected)
    assert shape == (1, 1) or (expected.any() and not expected[valid].all())
