"""Agreement with ray casting: exact off the band for techniques that are right, and errors of the others."""

import re
from dataclasses import replace

import numpy as np
import pytest

import softshadow as ss
from softshadow.testing import agreement, agreement_of, cast_truth
from softshadow.testing.agreement import changes_nearby

SIZE = (96, 72)
pytestmark = pytest.mark.filterwarnings("ignore::softshadow.Warning")


def quietly(technique: str, scene: ss.Scene, **options: object) -> ss.Run:
    return ss.run(technique, scene, size=SIZE, **options)


@pytest.mark.thin(3)
@pytest.mark.parametrize("name", ss.scene_names())
@pytest.mark.parametrize("technique", ["planar", "shadow-polygons", "volume-zfail", "volume-zpass-plus"])
def test_planar_shadows_and_counting_volumes_are_right_off_the_band(technique: str, name: str) -> None:
    for result in agreement(quietly(technique, ss.Scene.named(name))):
        assert (result.compared & ~result.band).sum() > 1000
        assert result.off_band == 0
        # an edge runs through each of these: few samples lie on its other side when it is snapped; polygons computed
        # for all cameras at once have edges of their own
        assert result.on_band <= 0.05 * result.band.sum()


@pytest.mark.parametrize("name", ss.scene_names())
def test_a_shadow_map_is_right_off_its_texels_and_pixels_band_on_what_does_not_cast(name: str) -> None:
    scene = ss.Scene.named(name)
    truth = cast_truth(scene, SIZE)
    casts = np.array([*(thing.casts for thing in scene.objects), False])[truth.objects]
    for result in agreement(quietly("map", scene), truth):
        # casters touch themselves: there the offset, which is as deep as a texel is steep, moves edges further
        assert not (result.wrong & ~result.band & ~casts).any()
        assert result.off_band <= 0.02 * result.compared.sum()


def test_what_a_map_of_one_of_two_lights_does_not_cover_is_left_out() -> None:
    """The map of unknown pixels is found for each light of several (it was looked up under another name)."""
    scene = ss.Scene.named("room")
    (lamp,) = scene.lights
    twice = replace(scene, lights=(lamp, replace(lamp, name="again")))
    (alone,) = agreement(quietly("map", scene))
    for result in agreement(quietly("map", twice)):
        assert (result.compared == alone.compared).all()
        assert result.off_band == alone.off_band


def test_a_coarser_map_has_a_wider_band_and_stays_right_off_it() -> None:
    scene = ss.Scene.named("overlapping")
    truth = cast_truth(scene, SIZE)
    floor = truth.objects == 0
    bands = []
    for map_size in (64, 32, 16):
        (result,) = agreement(quietly("map", scene, map_size=map_size), truth)
        assert not (result.wrong & ~result.band & floor).any()
        bands.append((result.band & floor & result.compared).sum())
    assert bands[0] < bands[1] < bands[2]


def test_parity_is_wrong_off_the_band_where_volumes_overlap() -> None:
    scene = ss.Scene.named("overlapping")
    truth = cast_truth(scene, SIZE)
    (result,) = agreement(quietly("volume-parity", scene), truth)
    even = (truth.counts[0] > 0) & (truth.counts[0] % 2 == 0)
    assert result.off_band > 50
    assert (result.wrong == even)[~result.band].all()
    assert str(result).startswith(f"light: {result.off_band} of ")


@pytest.mark.parametrize("name", ["overlapping", "soft-overlap"])
def test_a_parity_is_caught_although_the_count_changes_inside_the_shadow(name: str) -> None:
    """The band is round the edges of the shadow alone: where two volumes begin to overlap, nothing is uncertain."""
    scene, size = ss.Scene.named(name), (160, 120)
    truth = cast_truth(scene, size)
    parity = truth.counts[0] % 2 == 0  # lit, says a renderer that counts modulo 2
    result = agreement_of(parity, truth)
    assert result.off_band > 0.85 * result.wrong.sum() > 400
    inside = changes_nearby(truth.counts[0], 1) & ~changes_nearby(truth.lit(), 1) & ~changes_nearby(truth.objects, 1)
    assert inside.sum() > 50
    assert not (result.band & inside & ~truth.unsure[0]).any()


def test_every_light_has_its_own_agreement() -> None:
    agreements = agreement(quietly("volume-zfail", ss.Scene.named("two-lights")))
    assert [each.light for each in agreements] == ["warm", "cool"]
    assert (agreements[0].band != agreements[1].band).any()


def test_counts_of_the_truth_are_those_of_the_stencil_buffer() -> None:
    scene = ss.Scene.named("overlapping")
    truth, run = cast_truth(scene, SIZE), quietly("volume-zfail", scene)
    assert set(np.unique(truth.counts[0])) >= {0, 1, 2}
    assert (run.stencil == truth.counts[0])[~truth.band() & (truth.objects >= 0)].all()


def test_band_is_as_wide_as_asked() -> None:
    values = np.zeros((7, 9), int)
    values[3, 4] = 1
    assert changes_nearby(values, 1).sum() == 9
    assert changes_nearby(values, 2).sum() == 25


def test_the_truth_of_another_scene_or_size_is_refused() -> None:
    run = quietly("volume-zfail", ss.Scene.named("boxes"))
    for truth in (cast_truth(ss.Scene.named("boxes"), SIZE), cast_truth(run.scene, (8, 6))):
        with pytest.raises(ValueError, match=re.escape("truth: expected that of the run's own scene and size")):
            agreement(run, truth)


def test_arrays_of_any_renderer_are_compared() -> None:
    truth = cast_truth(ss.Scene.named("overlapping"), SIZE)
    right = agreement_of(truth.counts[0] == 0, truth)
    assert (right.off_band, right.on_band) == (0, 0)
    parity = agreement_of(truth.counts[0] % 2 == 0, truth)
    assert parity.off_band > 0
    unknown = agreement_of(truth.counts[0] % 2 == 0, truth, known=truth.counts[0] < 2)
    assert unknown.off_band == 0
    with pytest.raises(ValueError, match="expected arrays of shape"):
        agreement_of(np.zeros((2, 2), bool), truth)
    with pytest.raises(ValueError, match="light=1: the scene has 1"):
        agreement_of(truth.counts[0] == 0, truth, light=1)
