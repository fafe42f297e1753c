"""Shadows of real models: thousands of faces, boundary edges, several bodies."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from paths import shared_file
from softshadow.errors import NearClipZPass, SceneError
from softshadow.scene import Camera, Light, Scene
from softshadow.techniques.near_rectangle import near_counts
from techniques.drawn_frames import Drawn, cast_rays, draw, off_the_edges

SIZE = (96, 72)
MODELS = ["stanford-bunny.obj", "teapot.obj", "rocker-arm.obj", "Duck.glb", "multibody.stl", "wallhole.obj"]


@pytest.fixture(scope="module", params=MODELS)
def drawn(request: pytest.FixtureRequest) -> tuple[Scene, Drawn]:
    scene = Scene.from_mesh(shared_file(f"meshes/{request.param}"))
    return scene, draw("volume-zfail", scene, SIZE)


def test_count_of_a_model_is_that_of_rays(drawn: tuple[Scene, Drawn]) -> None:
    scene, zfail = drawn
    truth = cast_rays(scene, SIZE)
    sure = truth.sure()
    assert sure.mean() > 0.2
    assert (truth.counts[0][sure] > 0).any()
    differing = (zfail.stencil["count front faces"] != truth.counts[0]) & sure
    assert not differing.any(), np.argwhere(differing)[:5]


def test_zpass_counts_what_zfail_counts_on_a_model(drawn: tuple[Scene, Drawn]) -> None:
    scene, zfail = drawn
    zpass = draw("volume-zpass", scene, SIZE)
    assert NearClipZPass not in zpass.warnings
    np.testing.assert_array_equal(zpass.stencil["count back faces"], zfail.stencil["count front faces"])


@pytest.fixture(scope="module")
def from_the_shadow(drawn: tuple[Scene, Drawn]) -> tuple[Scene, np.ndarray]:
    """The model seen from its own shadow, the light low behind it, and what z-fail counts."""
    scene = drawn[0]
    low, high = (end(scene.casters[0].world_positions, axis=0) for end in (np.min, np.max))
    middle, size = (low + high) / 2, np.linalg.norm(high - low)
    along = np.array([0.9, 0.15, 0.4])
    camera = Camera(middle - 1.1 * size * along, middle, near=0.45 * size, far=20 * size)
    scene = replace(scene, camera=camera, lights=(Light(middle + 2 * size * along),))
    return scene, draw("volume-zfail", scene, SIZE).stencil["count front faces"]


@pytest.mark.parametrize(
    ("technique", "options"),
    [("volume-zpass", {"start": "near-plane"}), ("volume-zpass-plus", {})],
)
def test_a_start_for_each_pixel_is_right_in_the_shadow_of_a_model(
    from_the_shadow: tuple[Scene, np.ndarray], technique: str, options: dict[str, Any]
) -> None:
    scene, zfail = from_the_shadow
    near = near_counts(scene, scene.lights[0], scene.casters, SIZE, "infinite")
    inner = off_the_edges(near)
    assert (near[inner] > 0).any()
    differing = draw(technique, scene, SIZE, **options).stencil["count back faces"] != zfail
    assert not (differing & inner).any()
    # samples on the edge of the near cap, where rays, flattened faces and clipped sides are rounded differently
    assert differing.sum() <= 0.01 * (~inner).sum()


@pytest.mark.parametrize(
    "options", [{"start": "preload"}, {"choose": "per-caster"}, {"choose": "split-plane"}], ids=str
)
def test_ways_that_look_behind_the_surface_are_right_in_the_shadow_of_a_model(
    from_the_shadow: tuple[Scene, np.ndarray], options: dict[str, Any]
) -> None:
    scene, zfail = from_the_shadow
    drawn = draw("volume-zpass", scene, SIZE, **options)
    np.testing.assert_array_equal(drawn.stencil[drawn.titles[-1]], zfail)


@pytest.mark.parametrize("model", ["fuze.obj", "multibody.stl"])
def test_shadow_polygons_of_a_model_are_where_rays_are_blocked(model: str) -> None:
    scene = Scene.from_mesh(shared_file(f"meshes/{model}"))
    polygons, truth = draw("shadow-polygons", scene, SIZE, method="decal"), cast_rays(scene, SIZE)
    sure = truth.sure() & polygons.maps["valid"]
    assert (truth.counts[0][sure] > 0).any()
    # where polygons of neighbouring faces meet, corners rounded to float32 may leave a sample to neither
    assert ((polygons.shadow != (truth.counts[0] > 0)) & sure).sum() <= 1


def test_a_model_of_too_many_faces_for_shadow_polygons_is_refused_at_once() -> None:
    scene = Scene.from_mesh(shared_file("meshes/stanford-bunny.obj"))
    with pytest.raises(SceneError, match="pairs of a casting and a receiving face; expected at most"):
        draw("shadow-polygons", scene, SIZE)
