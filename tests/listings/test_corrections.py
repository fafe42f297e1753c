"""What each correction is good for, in pixels of the listings' scene, 128 x 128."""

import numpy as np
import pytest

from listings.drawn_listings import corrected, in_shadow, pixels, printed, without
from softshadow import listings
from softshadow.listings.stage import DOWN_THE_AXIS, FAR, NEAR_SHADOW, OVER_THE_TABLE, STAGE

# pixels of colour, depth and stencil that differ when one correction is left out; equal on Mesa
COUNTS = {
    ("offset-formula", "E30"): (4832, 4832, 0),
    ("offset-formula", "E31"): (2888, 5304, 0),
    ("skeleton-depth-test", "E45"): (298, 0, 0),
    ("planar", "E33"): (16, 0, 5939),
    ("planar", "E34"): (1586, 1765, 0),
    ("planar-origin", "E35"): (877, 0, 0),
    ("planar-point", "E35"): (877, 0, 0),
    ("planar-direction", "E36"): (307, 0, 0),
    ("planar-rays", "E21"): (752, 0, 0),
    ("planar-rays", "E33"): (0, 0, 5939),
    ("planar-offset", "E33"): (16, 16, 5939),
    ("planar-offset-again", "E33"): (16, 16, 5939),
    ("planar-offset-again", "E68"): (4644, 4657, 5939),
    ("planar-darken", "E33"): (16, 0, 5939),
    ("planar-darken", "E60"): (500, 468, 0),
    ("planar-polygons", "E15"): (845, 1433, 0),
    ("planar-polygons", "E16"): (16, 16, 5939),
    ("planar-faces", "E16"): (102, 0, 5939),
    ("volume-zpass", "E1"): (941, 0, 1460),
    ("volume-zpass", "E2"): (4927, 0, 0),
    ("volume-zpass", "E3"): (4927, 0, 0),
    ("volume-zpass-reversed", "E1"): (941, 0, 1460),
    ("volume-zpass-reversed", "E2"): (4927, 0, 0),
    ("volume-zpass-reversed", "E11"): (164, 0, 2037),
    ("volume-zpass-general", "E1"): (400, 0, 400),
    ("volume-zpass-general", "E2"): (6027, 0, 0),
    ("volume-zpass-general", "E3"): (6027, 0, 0),
    ("volume-zpass-general", "E10"): (5949, 0, 15856),
    ("volume-zfail", "E1"): (83, 0, 1649),
    ("volume-zfail", "E2"): (6304, 0, 0),
    ("volume-zfail", "E6"): (1497, 0, 3066),
    ("volume-zfail", "E8"): (81, 6387, 1648),
    ("volume-far-side", "E1"): (3151, 0, 3242),
    ("volume-far-side", "E2"): (2782, 0, 0),
    ("volume-far-side", "E7"): (3151, 0, 3151),
    ("volume-five-passes", "E38"): (302, 0, 0),
    ("volume-five-passes", "E63"): (78, 78, 0),
    ("volume-five-passes-eye", "E38"): (0, 0, 0),
    ("volume-five-passes-eye", "E40"): (450, 0, 450),
    ("volume-five-passes-eye", "E63"): (78, 78, 0),
    ("volume-counter", "E20"): (4927, 0, 0),
    ("map", "E46"): (17, 0, 0),
    ("map", "E47"): (57, 0, 0),
    ("map", "E48"): (56, 0, 0),
    ("map", "E62"): (1513, 0, 0),
    ("map-bias", "E49"): (43, 0, 0),
    ("map-two-stages", "E47"): (53, 0, 0),
    ("map-two-stages", "E50"): (1441, 0, 0),
    ("map-two-stages", "E51"): (1848, 0, 0),
    ("map-two-stages", "E52"): (933, 0, 0),
    ("map-two-stages", "E53"): (5160, 0, 0),
    ("map-loop", "E47"): (53, 0, 0),
    ("map-loop", "E52"): (933, 0, 0),
}
# without effect in this view: no two volumes overlap, so parity and count agree
NO_EFFECT = {("volume-five-passes-eye", "E38")}
EDGE = 1  # pixel whose centre lies so near to a shadow's edge that the rounding of its depth decides
STEP = 1  # of the depth buffer: the formula is added before the division into steps, GL's offset after it


def counts(name, number):
    ours, theirs = without(name, number), corrected(name)
    return tuple(pixels(getattr(ours, plane), getattr(theirs, plane)) for plane in ("color", "depth", "stencil"))


def test_every_correction_is_counted():
    assert list(COUNTS) == [(name, n) for name in listings.names() for n in listings.get(name).corrections]


@pytest.mark.parametrize(("name", "number"), list(COUNTS))
def test_correction_changes_this_many_pixels(name, number):
    assert counts(name, number) == COUNTS[name, number]
    assert (sum(COUNTS[name, number]) > 0) == ((name, number) not in NO_EFFECT)


# -- volumes: the stencil buffer against a cast ray per pixel ----------------------------------------------------------
def wrong(result, stage, far=None):
    """Return at how many surface pixels the stencil buffer does not say what a ray to the lamp says."""
    shadowed, surface = in_shadow(stage, result.depth, far)
    return int(np.count_nonzero(surface & ((result.stencil != 0) != shadowed)))


@pytest.mark.parametrize(
    ("name", "stage"),
    [
        ("volume-zpass", STAGE),
        ("volume-zpass-reversed", STAGE),
        ("volume-zpass-general", NEAR_SHADOW),
        ("volume-zfail", DOWN_THE_AXIS),
        ("volume-far-side", OVER_THE_TABLE),
        ("volume-five-passes", STAGE),
        ("volume-five-passes-eye", NEAR_SHADOW),
        ("volume-counter", STAGE),
    ],
)
def test_corrected_count_is_not_zero_exactly_where_a_ray_meets_a_box(name, stage):
    assert wrong(corrected(name), stage) <= EDGE


@pytest.mark.parametrize("name", ["volume-zpass", "volume-zfail"])
def test_e1_stencil_buffer_stays_zero_where_its_test_is_not_enabled(name):
    assert not without(name, "E1").stencil.any()
    assert not printed(name).stencil.any()


@pytest.mark.parametrize(("name", "number"), [("volume-zpass", "E2"), ("volume-zpass", "E3"), ("volume-zfail", "E2")])
def test_e2_e3_lit_scene_changes_no_pixel_of_equal_depth_or_of_front_faces(name, number):
    assert set(np.unique(without(name, number).color)) == set(np.unique(printed("volume-zpass").color))  # ambient
    assert pixels(without(name, number).color, without(name, "E2").color) == 0


def test_e11_decrements_that_come_first_are_lost_at_zero():
    assert wrong(without("volume-zpass-reversed", "E11"), STAGE) == 164
    assert (without("volume-zpass-reversed", "E11").stencil >= corrected("volume-zpass-reversed").stencil).all()


def test_e10_the_eye_s_number_is_wrong_where_the_near_rectangle_lies_outside():
    assert wrong(without("volume-zpass-general", "E10"), NEAR_SHADOW) == 5949


def test_e40_five_passes_are_wrong_where_the_near_rectangle_lies_in_a_volume():
    assert wrong(without("volume-five-passes-eye", "E40"), NEAR_SHADOW) == 450


def test_e7_receiver_below_a_far_side_that_is_too_near_is_lit():
    assert wrong(without("volume-far-side", "E7"), OVER_THE_TABLE) == 3151
    assert not without("volume-far-side", "E7").stencil[corrected("volume-far-side").stencil == 0].any()


def test_e6_sides_alone_count_too_little_where_the_ray_leaves_through_a_cap():
    assert wrong(without("volume-zfail", "E6"), DOWN_THE_AXIS) == 1498


def test_e8_faces_behind_the_far_plane_are_missing_in_the_count():
    assert wrong(without("volume-zfail", "E8"), DOWN_THE_AXIS, FAR) == 82


def test_e38_parity_lights_the_pixels_in_two_volumes():
    lit = (without("volume-five-passes", "E38").color != corrected("volume-five-passes").color).any(axis=-1)
    assert (corrected("volume-five-passes").stencil[lit] == 2).all()
    assert np.count_nonzero(lit) == 302


def test_e63_culling_that_is_left_on_swallows_the_next_triangle():
    assert (corrected("volume-five-passes").color[-1, 0, :3] == 255).all()
    assert (without("volume-five-passes", "E63").color[-1, 0, :3] == 0).all()


def test_e20_no_pixel_is_lit_when_zero_counts_as_shadow():
    assert counts("volume-counter", "E20")[0] == counts("volume-zpass", "E2")[0]


# -- planar ------------------------------------------------------------------------------------------------------------
def test_e33_shadow_leaves_the_receiver_without_the_mark():
    lost = (without("planar", "E33").color != corrected("planar").color).any(axis=-1)
    assert (corrected("planar").depth[lost] == 2**24 - 1).all()


@pytest.mark.parametrize(("name", "number"), [("planar-point", "E35"), ("planar-direction", "E36")])
def test_e35_e36_all_of_the_shadow_is_clipped_with_the_wrong_sign(name, number):
    without_shadow = without(name, number)
    assert (without_shadow.depth == corrected(name).depth).all()
    assert pixels(without_shadow.color, corrected("planar").color) == counts("planar-point", "E35")[0]


def test_e16_face_below_the_floor_paints_a_shadow_on_it_and_a_long_one_leaves_it():
    painted = (without("planar-faces", "E16").color != corrected("planar-faces").color).any(axis=-1)
    outside = corrected("planar-faces").depth == 2**24 - 1
    assert np.count_nonzero(painted & outside) > 0
    assert np.count_nonzero(painted & ~outside) > 0


def test_point_matrix_draws_the_shadow_of_the_ground_matrix():
    assert pixels(corrected("planar-point").color, corrected("planar").color) == 0


def test_e60_flattened_casters_fight_with_the_receiver_for_depth():
    shadow = counts("planar-point", "E35")[0]
    assert 0 < counts("planar-darken", "E60")[0] < shadow


def test_e15_shadow_polygons_stay_behind_nearer_objects():
    """The boxes lie in front of the ground: there only own shadows may be seen."""
    boxes = corrected("planar").depth != without("planar", "E34").depth
    over = (without("planar-polygons", "E15").color != corrected("planar-polygons").color).any(axis=-1)
    assert np.count_nonzero(over & boxes) == 810


def test_both_stencil_masks_draw_the_same_shadow():
    """E41: right as printed."""
    for plane in ("color", "depth", "stencil"):
        assert pixels(getattr(printed("planar-stencil"), plane), getattr(printed("planar-stencil-255"), plane)) == 0
    floor = printed("planar-stencil").depth < 2**24 - 1
    shadowed, _ = in_shadow(STAGE, printed("planar-stencil").depth, FAR)
    boxes = corrected("planar").depth != without("planar", "E34").depth
    differs = (printed("planar-stencil").stencil == 0) != shadowed
    assert np.count_nonzero(differs & floor & ~boxes) <= EDGE


# -- tools -------------------------------------------------------------------------------------------------------------
def test_quads_are_told_apart_by_the_mark():
    image, stencil = printed("stencil-quads").color, printed("stencil-quads").stencil
    assert (image[stencil == 1][:, 0] > image[stencil == 1][:, 1]).all()
    assert np.count_nonzero(image[stencil == 0][:, 1]) > 0


def test_clear_minds_the_stencil_mask_and_not_the_function():
    assert (printed("stencil-setup").stencil == 0xF0).all()
    assert printed("stencil-setup").returned[0].tolist() == [8]


def test_e30_e31_corrected_formula_moves_as_glpolygonoffset_does():
    ours, theirs = corrected("offset-formula"), printed("offset-quiz")
    assert pixels(ours.color, theirs.color) == 0
    # E32: one unit is the smallest step on the slide and two steps on Mesa
    assert np.abs(ours.depth.astype(np.int64) - theirs.depth).max() <= 1 + STEP


def test_e31_surface_that_rises_is_pulled_nearer_without_the_absolute_value():
    changed = (without("offset-formula", "E31").color != corrected("offset-formula").color).any(axis=-1)
    nearer = without("offset-formula", "E31").depth < corrected("offset-formula").depth
    assert (changed <= nearer).all()
    assert not changed[:, : changed.shape[1] // 2].any()


def test_e45_skeleton_is_seen_with_a_split_range_or_last_without_depth_test_and_no_other_way():
    whole = corrected("skeleton").color
    skin = printed("skeleton-offset").color
    seen = pixels(whole, skin)
    assert seen == pixels(corrected("skeleton-depth-test").color, skin) == 298
    for name in ("skeleton-depth-test", "skeleton-depth-range", "skeleton-depth-mask"):
        assert pixels(printed(name).color, skin) == 0


# -- maps --------------------------------------------------------------------------------------------------------------
def test_e62_copy_writes_as_many_texels_as_the_window_has_pixels():
    stored = without("map", "E62").returned[0]
    assert np.count_nonzero(stored) == 128 * 128
    assert np.count_nonzero(corrected("map").returned[0]) == stored.size


def test_e46_filtered_depths_move_edges_and_stay_hard():
    colors = np.unique(without("map", "E46").color.reshape(-1, 4), axis=0)
    assert colors.tolist() == np.unique(corrected("map").color.reshape(-1, 4), axis=0).tolist()


def test_e48_bias_and_offset_together_light_what_touches():
    shade = corrected("map").color.sum(axis=-1, dtype=int)
    brighter = without("map", "E48").color.sum(axis=-1, dtype=int) >= shade
    assert brighter.all()


def test_e49_constant_bias_lights_what_an_offset_leaves_in_shadow():
    shade = corrected("map-bias").color.sum(axis=-1, dtype=int)
    assert (without("map-bias", "E49").color.sum(axis=-1, dtype=int) >= shade).all()


def test_corrected_bias_is_the_corrected_map():
    assert pixels(corrected("map-bias").color, corrected("map").color) == 0


def test_e47_edge_of_the_map_is_smeared_over_what_the_light_does_not_see():
    darker = without("map", "E47").color.sum(axis=-1, dtype=int) <= corrected("map").color.sum(axis=-1, dtype=int)
    assert darker.all()


def test_e50_view_alone_draws_nothing_into_the_map():
    assert np.unique(without("map-two-stages", "E50").returned[0]).tolist() == [1.0]


def test_e51_map_that_starts_at_zero_stays_zero():
    assert np.unique(without("map-two-stages", "E51").returned[0]).tolist() == [0.0]


def test_e52_lit_surfaces_shade_themselves_without_an_offset():
    shade = without("map-two-stages", "E52").color.sum(axis=-1, dtype=int)
    assert (shade <= corrected("map-two-stages").color.sum(axis=-1, dtype=int)).all()


def test_e53_shadow_is_the_ambient_picture_and_not_a_share_of_the_whole():
    shade = corrected("map-two-stages").color[..., :3].sum(axis=-1, dtype=int)
    half = without("map-two-stages", "E53").color[..., :3].sum(axis=-1, dtype=int)
    dark = half > shade + 1  # AMBIENT is 0.3, SHADOW_FACTOR 0.5; lit colours are sums of two rounded parts
    assert np.count_nonzero(dark) == 1441
