"""The failure gallery: every failure of the course is there, goes wrong as it says, and is cured by what it says."""

from dataclasses import replace

import numpy as np
import pytest

import softshadow as ss
from softshadow.gallery import Failure
from softshadow.gallery.measures import STRICTER, darkened_twice, deepest, differ, wrong_paint

MOST_LINES = 60  # of a diff: a cure is a call, an option, or at most a pass of its own

# what the course is known to get wrong or to warn of
KNOWN = {
    "z-fighting", "double-blending", "shadow-outside-receiver", "anti-shadow", "false-shadow", "wrong-matrix-sign",
    "cpu-division", "painting-over-nearer", "eye-in-shadow", "constant-eye-count", "missing-caps", "finite-far-plane",
    "parity-overlap", "decr-before-incr", "overflow-256", "stencil-test-forgotten", "culling-left-on",
    "less-in-lit-pass", "mask-1", "acne", "peter-panning", "jagged-edges", "linear-filtered-depth", "edge-smear",
    "factor-on-whole-color", "map-larger-than-window", "missing-clear", "t-junction-leak", "open-mesh-leak",
    "vertex-distance-cap", "omni-light", "pcf-bias", "light-bleeding", "wedges-by-depth", "wedge-overlap",
    "centre-silhouette", "banding", "corners-only", "constant-width", "blurred-contact", "mean-blocker",
    "reversed-comparison", "depth-test-off-while-counting",
}  # fmt: skip


def test_what_is_known_to_go_wrong_is_there() -> None:
    assert set(ss.failures) >= KNOWN


@pytest.fixture(params=list(ss.failures))
def failure(request: pytest.FixtureRequest) -> Failure:
    """Each entry as users get it: its runs are kept, so that the tests of this file share them."""
    return ss.failures[request.param]


@pytest.mark.thin(2)
def test_pixels_are_wrong_with_the_failure_and_right_with_the_cure(failure: Failure) -> None:
    assert failure.number_wrong > max(0, failure.floor)
    assert failure.number_cured <= failure.floor
    assert failure.why_floor or not failure.floor


def test_planar_cure_paints_where_shadow_falls_and_nowhere_else(failure: Failure) -> None:
    """Whatever the entry counts: over the floor's edge, over nearer casters, and on lit places."""
    if (
        failure.family == "planar"
        and failure.with_cure.technique != "volume-zfail"
        and failure.name != "modulative-lights"
    ):
        assert wrong_paint(replace(failure.cured, scene=failure.scene)).sum() <= failure.floor


@pytest.mark.thin(3)
def test_wrong_pixels_that_a_measure_leaves_out_are_told(failure: Failure) -> None:
    strict = STRICTER.get(failure.measure, failure.measure)
    wrong = strict(replace(failure.cured, scene=failure.scene)).sum()
    assert failure.number_cured + failure.number_uncounted >= wrong
    assert (str(failure.number_uncounted) in failure.remark) == (failure.number_uncounted > 0)
    assert failure.why_floor or not failure.number_uncounted
    assert failure.remark in failure.explain()


@pytest.mark.thin(2)
def test_cure_is_better_everywhere_than_its_failure(failure: Failure) -> None:
    """Also by the measure that leaves nothing out."""
    strict = STRICTER.get(failure.measure, failure.measure)
    wrong, cured = (strict(replace(run, scene=failure.scene)).sum() for run in (failure.wrong, failure.cured))
    assert 2 * cured < wrong or failure.measure is darkened_twice


@pytest.mark.thin(3)
def test_pixel_to_click_has_two_colors(failure: Failure) -> None:
    x, y = failure.pixel
    assert differ(failure.wrong.image, failure.cured.image)[y, x]
    assert failure.wrong_pixels(failure.wrong)[y, x]
    assert not failure.wrong_pixels(failure.cured)[y, x]
    assert f"pixel x={x} y={y}" in failure.explain()


def test_diff_is_a_few_calls_of_gl(failure: Failure) -> None:
    lines = failure.diff.splitlines()
    calls = [line for line in lines if line[0] in "-+"]
    assert lines[0].startswith("@@ ")
    assert 0 < len(calls) <= MOST_LINES
    assert all(" gl" in line for line in calls)


def test_altered_calls_are_all_that_differs(failure: Failure) -> None:
    altered = {change.call.partition("(")[0] for change in failure.with_failure.altered_calls}
    if altered:
        told = {line.split("(")[0].lstrip("-+ ") for line in failure.diff.splitlines() if line[0] in "-+"}
        assert told == altered


@pytest.mark.parametrize(
    "name", [name for name, failure in ss.failures.items() if len(failure.with_failure.altered_calls) > 1]
)
def test_each_altered_call_counts(name: str) -> None:
    """A failure of several altered calls is another one, or none, with one of them less."""
    failure = ss.failures[name]
    setting = failure.with_failure
    for change in setting.altered_calls:
        others = tuple(each for each in setting.altered_calls if each is not change)
        fewer = replace(failure, with_failure=replace(setting, altered_calls=others))
        assert differ(fewer.wrong.image, failure.wrong.image).any()


def test_names_are_looked_up_and_misspelt_ones_told_the_nearest() -> None:
    assert ss.failures["acne"].name == "acne"
    assert len(ss.failures) == len(list(ss.failures)) == len(set(ss.failures))
    with pytest.raises(KeyError, match="did you mean 'acne'"):
        ss.failures["akne"]
    assert "acne" in repr(ss.failures)
    assert "<td>acne</td>" in ss.failures._repr_html_()


def test_failure_in_another_size_is_measured_anew() -> None:
    small = ss.failures["mask-1"].at((80, 60))
    assert small.wrong.size == (80, 60)
    assert 0 < small.number_wrong < ss.failures["mask-1"].number_wrong


def test_failure_that_does_not_show_has_no_pixel_to_click() -> None:
    sharp = ss.failures["jagged-edges"].at((12, 9))  # a texel is smaller than a pixel
    assert sharp.number_wrong == 0
    with pytest.raises(ValueError, match="'jagged-edges' is not visible at 12 x 9; expected another size"):
        sharp.explain()


def test_picture_holds_both_runs_and_rings_the_pixel() -> None:
    failure = ss.failures["mask-1"]
    picture = np.asarray(failure.picture())
    (x, y), (width, _) = failure.pixel, failure.size
    corner = 16  # the line with the numbers stands above
    for left, run in ((0, failure.wrong), (2 * width + 6, failure.cured)):
        panel = picture[corner:, left : left + 2 * width]
        np.testing.assert_array_equal(panel[2 * y, 2 * x], run.image[y, x])
        np.testing.assert_array_equal(panel[0, 0], run.image[0, 0])
        assert (panel[2 * y + 1, 2 * x + 1 + 7] == (0xD5, 0x5E, 0x00)).all()
    shown = failure._repr_mimebundle_()[0]
    assert shown["text/plain"] == failure.explain()
    assert shown["image/png"]


def test_deepest_place_of_a_mask_lies_inside_its_largest_part() -> None:
    mask = np.zeros((9, 9), bool)
    mask[0, :] = True
    mask[3:8, 3:8] = True
    assert deepest(mask) == (5, 5)
