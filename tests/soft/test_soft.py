"""Errors of techniques against soft truth, how they fall, and the laws of the penumbra."""

import numpy as np
import pytest

from softshadow.inspection.soft_truth import soft_truth
from softshadow.scene import Scene
from softshadow.soft import (
    LAWS,
    Convergence,
    compare_techniques,
    contact_sheet_of,
    convergence,
    law_table,
    save_convergence_plot,
    soft_candidates,
)
from softshadow.soft.penumbra_laws import Arrangement, measured_widths
from softshadow.soft.technique_errors import error_picture

SIZE = (80, 60)


@pytest.fixture(scope="module")
def slab():
    scene = Scene.named("soft-slab")
    return scene, soft_truth(scene, SIZE)


def test_more_samples_are_nearer_to_the_truth_than_one(slab):
    scene, truth = slab
    (hard,) = compare_techniques(scene, truth, ["volume-zfail"])
    (few,) = compare_techniques(scene, truth, ["volume-sampled"], samples=4)
    (many,) = compare_techniques(scene, truth, ["volume-sampled"], samples=64)
    rms = [each.comparison.parts["penumbra"].rms for each in (hard, few, many)]
    assert rms[0] > 2 * rms[1] > 4 * rms[2]
    assert many.comparison.parts["umbra"].max == 0
    assert many.label == "volume-sampled samples=64"
    assert many.seconds > 0


@pytest.mark.slow
def test_all_candidates_are_compared_and_shown(slab):
    scene, truth = slab
    results = compare_techniques(scene, truth, samples=2)
    assert tuple(each.technique for each in results) == soft_candidates()
    sheet = contact_sheet_of(results)
    assert sheet.shape[2] == 3
    assert sheet.shape[0] > len(results) * SIZE[1]


@pytest.mark.slow
def test_a_time_is_filled_with_samples_but_not_exceeded(slab):
    scene, truth = slab
    (result,) = compare_techniques(scene, truth, ["volume-sampled"], seconds=1e9)
    assert result.options == {"samples": 1024}
    (result,) = compare_techniques(scene, truth, ["volume-sampled"], seconds=1e-9)
    assert result.options == {"samples": 1}


@pytest.mark.parametrize("wrong", [{"samples": 0}, {"seconds": 0}])
def test_numbers_must_be_positive(slab, wrong):
    with pytest.raises(ValueError, match="expected positive numbers"):
        compare_techniques(*slab, ["map"], **wrong)


@pytest.mark.slow
def test_errors_of_random_points_fall_with_the_root_and_of_grids_faster(slab):
    by_pattern = {
        each.pattern: each for each in convergence(*slab, patterns=("grid", "random"), samples=(4, 16, 64), seeds=3)
    }
    # the mean of n independent values has an error of n to the power of -1/2; three seeds leave a tenth or two of noise
    assert -0.75 < by_pattern["random"].slope < -0.3
    # an edge parallel to the rows of a grid of k x k points: an error of 1 / k, as for random points, but smaller
    assert by_pattern["grid"].rms[-1] < by_pattern["random"].rms[-1]
    assert by_pattern["grid"].rms[0] > by_pattern["grid"].rms[1] > by_pattern["grid"].rms[2]


def test_the_plot_has_a_line_for_each_result(tmp_path):
    pytest.importorskip("matplotlib")
    results = [Convergence("volume-sampled", "grid", (4, 16, 64), (0.4, 0.2, 0.1))]
    assert results[0].slope == pytest.approx(-0.5)
    path = save_convergence_plot(results, tmp_path / "slopes.svg")
    assert "slope -0.50" in path.read_text() or path.stat().st_size > 10_000  # letters may be outlines


def test_the_arrangement_has_the_widths_of_the_law():
    arrangement = Arrangement(0.5, 2.0, 4.0)
    assert (arrangement.penumbra, arrangement.umbra) == (0.5, 2.7)
    for law in LAWS:
        wider = law.after.penumbra > law.before.penumbra
        assert wider == ("wider" in law.name or "proportion" in law.name)


def test_volumes_of_points_follow_every_law():
    results = law_table(["volume-sampled"])
    assert len(results) == len(LAWS)
    assert all(each.holds and each.direction_holds for each in results)


def test_hard_shadows_and_filters_of_constant_width_follow_none():
    assert measured_widths("volume-zfail", Arrangement())[0] == 0
    for each in law_table(["volume-zfail", "map-pcf"]):
        assert not each.holds
        assert not each.direction_holds


def test_nested_planes_do_not_see_how_large_the_light_is():
    results = {each.law.name: each for each in law_table(["planar-nested"])}
    grows = results[LAWS[0].name]
    assert grows.before == grows.after
    assert not grows.holds


def test_the_sign_of_an_error_is_its_colour():
    red, white, blue = error_picture(np.array([[0.5, 0.0, -0.5]]))[0]
    assert red[0] > red[2]
    assert (white == 255).all()
    assert blue[2] > blue[0]
