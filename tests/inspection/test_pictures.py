"""Buffers as pictures."""

import imageio.v3 as imageio
import numpy as np
import pytest
from PIL import Image

from softshadow.inspection.files import MARK
from softshadow.inspection.pictures import (
    CLEAR_DEPTH,
    UNDEFINED,
    contact_sheet,
    depth_picture,
    map_picture,
    map_pictures,
    resized,
    save_png,
    stencil_palette,
)

pytestmark = pytest.mark.interpreted


def test_indices_of_a_stencil_png_are_the_counts(tmp_path):
    counts = np.arange(256, dtype=np.uint8).reshape(16, 16)
    save_png(counts, tmp_path / "counts.png")
    with Image.open(tmp_path / "counts.png") as picture:
        assert picture.mode == "P"
        np.testing.assert_array_equal(np.asarray(picture), counts)
        assert bytes(picture.getpalette()[:768]) == stencil_palette().tobytes()


@pytest.mark.parametrize("shape", [(1, 1, 3), (3, 3, 3), (4, 3, 3), (5, 7, 3)])
def test_a_colour_png_holds_the_pixels_and_the_mark(tmp_path, shape):
    picture = np.random.default_rng(1).integers(0, 256, shape, np.uint8)
    save_png(picture[::-1], tmp_path / "picture.png")
    np.testing.assert_array_equal(imageio.imread(tmp_path / "picture.png"), picture[::-1])
    assert imageio.immeta(tmp_path / "picture.png")["Comment"] == MARK


def test_pictures_are_resized_by_the_nearest_pixel():
    picture = np.arange(6, dtype=np.uint8).reshape(2, 3)
    assert resized(picture, 6, 4).tolist() == np.kron(picture, np.ones((2, 2), np.uint8)).tolist()
    assert resized(picture, 1, 1).tolist() == [[4]]


def test_small_counts_and_wrapped_ones_have_colours_far_apart():
    palette = stencil_palette().astype(int)
    shown = palette[[0, 1, 2, 3, 4, 5, 6, 254, 255]]
    distances = np.abs(shown[:, None] - shown[None]).sum(axis=2)
    # 40 of 765 is a step that is seen side by side; the closest are the two wrapped ones, light and dark of one hue
    assert distances[~np.eye(len(shown), dtype=bool)].min() > 40


def test_depth_is_stretched_over_what_was_drawn():
    depth = np.array([[0.9, 0.95, 0.99, 1.0]], np.float32)
    near, middle, far, clear = depth_picture(depth)[0]
    assert near.tolist() == [255] * 3
    assert far.tolist() == [50] * 3
    assert 50 < middle[0] < 255
    assert tuple(clear) == CLEAR_DEPTH


def test_depth_of_an_empty_window_is_a_picture_too():
    assert depth_picture(np.ones((2, 3), np.float32)).reshape(-1, 3).tolist() == [list(CLEAR_DEPTH)] * 6


@pytest.mark.parametrize("dtype", [np.bool_, np.uint8, np.float32])
def test_every_kind_of_map_has_a_picture_of_its_size(dtype):
    assert map_picture(np.zeros((5, 7), dtype)).shape[:2] == (5, 7)


def test_visibility_is_light_and_shadow_where_it_is_valid():
    visibility = np.array([[0, 1, 0.5, 1]], np.float32)
    maps = {"visibility": visibility, "visibility of lamp 1": visibility, "valid": visibility < 1}
    pictures = map_pictures(maps)
    assert list(pictures) == list(maps)
    for name in ("visibility", "visibility of lamp 1"):
        shadow, undefined, half, _ = pictures[name][0].tolist()
        assert (shadow, half) == ([0] * 3, [128] * 3)
        assert tuple(undefined) == UNDEFINED
    assert map_pictures({"visibility": visibility})["visibility"][0, 1].tolist() == [255] * 3


def test_contact_sheet_holds_all_rows_within_its_width():
    pictures = [depth_picture(np.ones((40, 500), np.float32))] * 3
    sheet = contact_sheet([("first", pictures), ("second", pictures)])
    height, width, _ = sheet.shape
    assert width <= 972
    assert height > 2 * 14


def test_named_pictures_of_other_shapes_are_fitted_in_and_go_on_below():
    window, shadow_map = np.zeros((30, 40, 3), np.uint8), np.full((64, 64), 1, np.uint8)
    sheet = contact_sheet([("step", dict.fromkeys("abcd", shadow_map)), ("next", {"colour": window})], 400, (40, 30))
    place = (400 // 3 - 4) // 40 * 40
    assert sheet.shape[1] == 3 * (place + 4) - 4
    fitted = (sheet == stencil_palette()[1]).all(axis=2)
    columns = np.flatnonzero(fitted.any(axis=0))
    assert columns.max() - 2 * (place + 4) + 1 == place * 3 // 4  # as high as the window's pictures, and square
    assert np.count_nonzero(fitted) == 4 * (place * 3 // 4) ** 2
    assert np.count_nonzero((sheet == 0).all(axis=2)) == place * place * 3 // 4


def test_maps_of_two_numbers_are_pictures_too():
    assert map_picture(np.full((5, 7, 2), 0.5, np.float32)).shape == (5, 7, 3)
