"""The matplotlib helpers draw the arrays of a run at the positions of `Run.pixel`."""

import sys

import matplotlib as mpl

mpl.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest

import softshadow as ss
from softshadow.inspection.pictures import CLEAR_DEPTH, stencil_palette

SIZE = (64, 48)


@pytest.fixture(scope="module")
def zfail():
    return ss.run("volume-zfail", "torus", SIZE)


@pytest.fixture(scope="module")
def shadow_map():
    return ss.run("map", "torus", SIZE, map_size=32)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def shown(ax):
    """Return the colours (H, W, 4) 0-1 that axes show, and the image."""
    (image,) = ax.get_images()
    return image.to_rgba(image.get_array(), norm=True), image


def test_stencil_has_the_colours_of_the_palette_and_the_numbers_of_pixels(zfail):
    ax = ss.notebook.show_stencil(zfail[1])
    colors, _ = shown(ax)
    np.testing.assert_allclose(colors[..., :3] * 255, stencil_palette()[zfail[1].stencil], atol=0.6)
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    counts, pixels = np.unique(zfail[1].stencil, return_counts=True)
    assert labels == [f"{count}: {number}" for count, number in zip(counts, pixels, strict=True)]
    assert "count back faces" in ax.get_title()


def test_row_0_is_on_top_and_a_cell_lies_at_the_position_of_its_pixel(zfail):
    ax = ss.notebook.show_stencil(zfail[1], region=(20, 10, 8, 6))
    _, image = shown(ax)
    assert image.get_extent() == [19.5, 27.5, 15.5, 9.5]
    low, high = ax.get_ylim()
    assert low > high
    ax.figure.canvas.draw()
    assert ax.format_coord(22.2, 13.9) == f"x=22 y=14: {zfail[1].stencil[14, 22]}"
    assert ax.format_coord(3, 3) == ""


def test_small_crops_have_digits_and_large_ones_have_not(zfail):
    ax = ss.notebook.show_stencil(zfail[1], region=(20, 10, 8, 6))
    digits = {text.get_position(): text.get_text() for text in ax.texts}
    assert digits == {(x, y): str(zfail[1].stencil[y, x]) for x in range(20, 28) for y in range(10, 16)}
    assert not ss.notebook.show_stencil(zfail[1]).texts


def test_counts_below_zero_are_said_to_be_so():
    ax = ss.notebook.show_stencil(np.array([[0, 255], [254, 3]], np.uint8))
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["0: 1", "3: 1", "254 (−2): 1", "255 (−1): 1"]


def test_the_legend_of_many_counts_sums_up_the_rest():
    ax = ss.notebook.show_stencil(np.arange(20, dtype=np.uint8).reshape(4, 5))
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels[-1] == "other: 12"
    assert sum(int(label.split(": ")[1]) for label in labels) == 20


@pytest.mark.parametrize("region", [(60, 0, 8, 8), (-1, 0, 4, 4), (0, 0, 0, 4), (0, 46, 4, 4)])
def test_regions_outside_the_picture_are_refused(zfail, region):
    with pytest.raises(ValueError, match="inside the picture of 64 x 48 pixels"):
        ss.notebook.show_stencil(zfail, region=region)


def test_clear_depth_is_left_out_of_the_range(zfail):
    ax = ss.notebook.show_depth(zfail)
    colors, image = shown(ax)
    drawn = zfail.depth[zfail.depth < 1]
    assert image.get_clim() == (drawn.min(), drawn.max())
    np.testing.assert_allclose(colors[zfail.depth == 1][:, :3] * 255, [CLEAR_DEPTH] * (zfail.depth == 1).sum(), atol=1)
    row, column = np.unravel_index(np.where(zfail.depth < 1, zfail.depth, 2).argmin(), zfail.depth.shape)
    assert colors[row, column, 0] == colors[zfail.depth < 1][:, 0].max()  # the nearest is the lightest


def test_an_empty_depth_buffer_is_said_to_be_empty():
    assert "nothing drawn" in ss.notebook.show_depth(np.ones((4, 4), np.float32)).get_title()


def test_the_map_of_a_map_technique_is_the_one_that_is_shown_by_default(shadow_map):
    ax = ss.notebook.show_map(shadow_map)
    _, image = shown(ax)
    ZS = shadow_map.maps["ZS"]
    assert "ZS" in ax.get_title()
    assert image.get_clim() == (ZS[ZS < 1].min(), ZS[ZS < 1].max())


@pytest.mark.slow
def test_every_map_of_every_technique_can_be_shown():
    small = {"map_size": 16, "texture_size": 16, "layers": 2, "samples": 2}
    for name in ("map-silhouette", "map-variance", "volume-wedges", "map-cube", "volume-zpass-plus", "planar-nested"):
        declared = ss.notebook.play.__globals__["techniques"].get(name).options
        run = ss.run(name, "boxes", (12, 9), **{key: value for key, value in small.items() if key in declared})
        for map_name in run.maps:
            ss.notebook.show_map(run, map_name).figure.canvas.draw()
            plt.close("all")


def test_visibility_is_marked_where_it_is_not_defined(zfail):
    colors, image = shown(ss.notebook.show_map(zfail, "visibility"))
    assert image.get_clim() == (0, 1)
    assert (colors[~zfail.valid][:, 2] > colors[~zfail.valid][:, 0]).all()  # blue
    assert set(colors[zfail.valid & (zfail.visibility == 0)][:, 0]) == {0}


def test_unknown_maps_are_answered_with_the_nearest(shadow_map):
    with pytest.raises(KeyError, match="did you mean 'ZS'"):
        ss.notebook.show_map(shadow_map, "SZ")


def test_colours_are_those_of_the_image(zfail):
    _, image = shown(ss.notebook.show_image(zfail))
    np.testing.assert_array_equal(image.get_array(), zfail.image)


def test_steps_are_rows_of_buffers_and_maps(shadow_map):
    axes = ss.notebook.show_steps(shadow_map)
    assert axes.shape == (3, 3)
    titles = [[ax.get_title(loc="left") or ax.get_title() for ax in row if ax.axison] for row in axes]
    assert titles[0] == ["0  draw the depth map from the light\nZS"]
    assert [title.rsplit("\n")[-1] for title in titles[1]] == ["colour", "depth", "stencil"]


def test_some_steps_and_buffers_can_be_chosen_and_drawn_into_given_axes(zfail):
    _, places = plt.subplots(2, 1)
    axes = ss.notebook.show_steps(zfail, [1, "count front faces"], buffers=["stencil"], ax=places[:, None])
    np.testing.assert_array_equal(axes, places[:, None])
    with pytest.raises(ValueError, match="expected axes of 4 rows and 3 columns"):
        ss.notebook.show_steps(zfail, ax=places)
    with pytest.raises(ValueError, match="expected some of colour, depth, stencil"):
        ss.notebook.show_steps(zfail, buffers=["color"])


def test_helpers_draw_into_the_axes_they_are_given(zfail):
    _, ax = plt.subplots()
    for show in (ss.notebook.show_stencil, ss.notebook.show_depth, ss.notebook.show_image, ss.notebook.show_section):
        assert show(zfail, ax=ax) is ax


def test_a_section_has_the_counts_along_the_line_of_sight(zfail):
    y, x = (int(n) for n in np.argwhere(zfail.shadow_mask)[len(zfail.shadow_mask) // 2])
    ax = ss.notebook.show_section(zfail, (x, y))
    words = [text.get_text() for text in ax.texts]
    section = zfail.cross_section(x, y)
    assert [f"{c.step:+d} = {c.count}".replace("-", "−") for c in section.crossings] == [w for w in words if "=" in w]
    assert {"eye", "P", "light"} <= set(words)


@pytest.mark.parametrize("scene", ["soft-slab", "parallel-light", "two-lights"])
def test_sections_of_scenes_need_no_pixel(scene):
    name = scene if scene in ss.scene_names() else "boxes"
    assert ss.notebook.show_section(name).get_title().startswith(f"Section of {name}")


def test_a_missing_library_is_named_with_the_extra(zfail, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=r"show_stencil needs matplotlib.*pip install 'softshadow\[notebook\]'"):
        ss.notebook.show_stencil(zfail)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(ImportError, match="play needs anywidget"):
        ss.notebook.play("map", "torus")
