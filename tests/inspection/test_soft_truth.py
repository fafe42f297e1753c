"""Soft shadows of a scene: visibility per pixel and light, and how runs are compared with it."""

from dataclasses import replace

import numpy as np
import pytest

import softshadow as ss
from softshadow.inspection.comparison import jumps
from softshadow.inspection.hard_truth import hard_visibility, seen_faces
from softshadow.scene import Disc, Light, Rectangle, Scene

SIZE = (96, 72)
pytestmark = pytest.mark.filterwarnings("ignore::softshadow.Warning")


def scan_line(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Return x and the visibility of the floor's pixels near z = 0."""
    truth = ss.soft_truth(scene, (320, 240))
    objects, _, points = seen_faces(scene, (320, 240))
    near = (objects == 0) & (np.abs(points[:, 2]) < 0.3)
    return points[near, 0], truth.visibility.ravel()[near]


def test_slab_has_the_penumbra_of_the_formula() -> None:
    """A light of 1 at a height of 4, a slab of 1.5 at 2: an umbra of 2, and 1 of penumbra on each side."""
    x, visible = scan_line(ss.Scene.named("soft-slab"))
    assert visible == pytest.approx(np.clip(np.abs(x) - 1, 0, 1), abs=1e-9)
    assert ((visible > 0) & (visible < 1)).sum() > 100


def test_a_larger_light_has_a_wider_penumbra_and_a_smaller_umbra() -> None:
    scene = ss.Scene.named("soft-slab")
    (light,) = scene.lights
    shares = []
    for factor in (0.25, 0.5, 1, 1.5):
        truth = ss.soft_truth(replace(scene, lights=(replace(light, shape=light.shape.scaled(factor)),)), SIZE)
        shares.append(np.bincount(truth.classes[truth.valid], minlength=3))
    umbra, penumbra, lit = np.transpose(shares)
    assert (np.diff(umbra) < 0).all()
    assert (np.diff(penumbra) > 0).all()
    assert (np.diff(lit) < 0).all()


def test_arrays_are_per_pixel_and_light() -> None:
    scene = ss.Scene.named("two-lights")
    warm, cool = scene.lights
    truth = ss.soft_truth(replace(scene, lights=(replace(warm, shape=Disc(0.5, (0, 1, 0))), cool)), SIZE, samples=36)
    hard, valid = hard_visibility(scene, SIZE)
    assert (truth.valid == valid).all()
    assert (truth.visibilities[1] == hard[1]).all()
    assert truth.methods[1] == "exact"
    assert truth.size == SIZE
    assert truth.samples == 36
    for array in (*truth.visibilities, *truth.standard_errors):
        assert (array.shape, array.dtype, array.flags.writeable) == (SIZE[::-1], np.float64, False)
        assert (array[~valid] == (1 if array.max() == 1 else 0)).all()
    assert truth.visibility == pytest.approx((truth.visibilities[0] + truth.visibilities[1]) / 2)
    assert set(np.unique(truth.classes)) == {0, 1, 2}


def test_all_ways_to_measure_agree() -> None:
    pytest.importorskip("embreex")
    scene = ss.Scene.named("soft-overlap")
    exact, rays, embree = (ss.soft_truth(scene, SIZE, method=method) for method in ("exact", "rays", "embree"))
    assert [str(truth) for truth in (exact, rays, embree)] == [
        "soft shadows (exact)",
        "soft shadows (rays, 256 rays per pixel)",
        "soft shadows (embree, 256 rays per pixel)",
    ]
    error = rays.visibility - exact.visibility
    assert np.sqrt(np.mean(error**2)) < np.sqrt(np.mean(rays.standard_errors[0] ** 2))
    # float32 rays to points on casters may hit a neighbouring face first
    assert (np.abs(embree.visibility - rays.visibility) > 0.05).mean() < 0.002


@pytest.mark.parametrize("technique", ["volume-zfail", "map", "planar"])
def test_hard_technique_is_right_off_the_penumbra(technique: str) -> None:
    run = ss.run(technique, "soft-slab", size=SIZE)
    comparison = run.compare(truth="soft")
    assert comparison.against == "soft shadows (exact)"
    parts = comparison.parts
    assert parts["penumbra"].pixels > 300
    assert parts["penumbra"].rms > 0.2
    assert parts["penumbra"].wrong_share > 0.5
    assert parts["all"].pixels == sum(parts[name].pixels for name in ("lit", "umbra", "penumbra", "band"))
    # what the centre sees is right in umbra and light; a map is wrong where it touches itself
    assert max(parts["umbra"].wrong_share, parts["lit"].wrong_share) < (0.01 if technique == "map" else 1e-9)


def test_truth_is_computed_once_for_several_runs() -> None:
    scene = ss.Scene.named("soft-overlap")
    truth = ss.soft_truth(scene, SIZE)
    for technique in ("volume-zfail", "map"):
        run = ss.run(technique, scene, size=SIZE)
        again, first = run.compare(truth=truth), run.compare(truth="soft")
        assert (again.error == first.error).all()
        assert np.abs(again.error).max() == pytest.approx(again.max)


def test_point_light_compares_softly_as_hard() -> None:
    run = ss.run("map", "boxes", size=SIZE)
    soft, hard = run.compare(truth="soft"), run.compare(truth="hard")
    assert (soft.error == hard.error).all()
    assert (soft.band == hard.band).all()
    assert soft.parts["umbra"] == hard.parts["umbra"]


def test_small_light_compares_as_its_centre() -> None:
    scene = ss.Scene.named("boxes")
    (light,) = scene.lights
    tiny = replace(scene, lights=(replace(light, shape=Rectangle((1e-9, 0, 0), (0, 0, 1e-9))),))
    assert (ss.soft_truth(tiny, SIZE).visibility == ss.soft_truth(scene, SIZE).visibility).mean() > 0.999


def test_band_is_where_the_visibility_jumps() -> None:
    ramp = np.tile(np.linspace(0, 1, 11), (4, 1))
    assert not jumps(ramp).any()
    assert jumps(np.where(np.arange(11) < 5, 0.0, 1.0)[None]).tolist() == [[False] * 4 + [True] * 2 + [False] * 5]


def test_spot_light_is_dark_outside_its_cone() -> None:
    scene = ss.Scene.named("spotlight")
    hard, _ = hard_visibility(scene, SIZE)
    assert (ss.soft_truth(scene, SIZE).visibility == hard[0]).all()


def test_run_with_an_area_light_is_saved_and_loaded(tmp_path) -> None:  # type: ignore[no-untyped-def]
    run = ss.run("map", "soft-torus", size=(32, 24))
    again = ss.load_run(run.save(tmp_path / "run.npz"))
    assert isinstance(again.scene.lights[0], Light)
    assert again.scene.lights[0].corners.tolist() == run.scene.lights[0].corners.tolist()
    assert (again.compare(truth="soft").error == run.compare(truth="soft").error).all()
