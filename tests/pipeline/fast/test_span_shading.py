"""The kernels that shade blocks of fragments leave the bits of the shading stage, for any fixed-function state."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

import fixed_function_pictures
from draws import same_window
from fixed_function_pictures import pick, random_picture
from softshadow import gl
from softshadow.pipeline import choose, explain_paths, set_threads, threads, use_short_cuts
from softshadow.pipeline.fast import fragment_block
from softshadow.state import Blend

OWN_SOURCES = (gl.GL_TEXTURE, gl.GL_CONSTANT, gl.GL_PRIMARY_COLOR, gl.GL_PREVIOUS)
WITHOUT_BORDER = (gl.GL_REPEAT, gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP, gl.GL_MIRRORED_REPEAT)


@pytest.fixture(autouse=True)
def _compiled(monkeypatch):
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 0)


def assert_same(seed, **options):
    with explain_paths() as paths:
        window = random_picture(seed, **options)
    with use_short_cuts(False):
        assert same_window(window, random_picture(seed, **options)), seed
    return {path.shading for path in paths}


@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 2]))
def test_visible_spans_are_shaded_as_by_the_shading_stage(seed, thread_count):
    before = threads()
    try:
        set_threads(thread_count)
        assert_same(seed)
    finally:
        set_threads(before)


def test_spans_longer_than_a_block_are_continued():
    for seed in range(3):
        assert_same(seed, size=(3 * fragment_block.SIZE + 50, 5), n_triangles=20, units=1)


@pytest.mark.parametrize(("option", "is_used"), [({}, True), ({"precision": "exact"}, False)])
def test_only_float32_is_shaded_in_blocks(option, is_used):
    shadings = set()
    for seed in range(8):
        shadings |= assert_same(seed, **option)
    assert ("fixed-function kernel" in shadings) == is_used


def test_up_to_four_units_are_shaded_in_blocks(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "MODES", (gl.GL_REPLACE, gl.GL_MODULATE, gl.GL_ADD, gl.GL_BLEND))
    monkeypatch.setattr(fixed_function_pictures, "TARGETS", (gl.GL_TEXTURE_2D, gl.GL_TEXTURE_3D))
    monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", 0)
    shadings = [assert_same(seed, units=3 + seed % 2, size=(40, 30), ordered=seed % 3 == 0) for seed in range(30)]
    assert shadings.count({"fixed-function kernel"}) > len(shadings) / 4  # others have borders, or float formats


def test_more_than_two_combined_textures_do_not_read_each_other(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "MODES", (gl.GL_COMBINE,))
    monkeypatch.setattr(fixed_function_pictures, "TARGETS", (gl.GL_TEXTURE_2D,))
    shadings = [assert_same(seed, units=3, size=(40, 30), ordered=seed % 3 == 0) for seed in range(30)]
    assert {"program"} in shadings  # where one reads the texel of another
    monkeypatch.setattr(fixed_function_pictures, "SOURCES", OWN_SOURCES)
    for seed in range(20):
        shadings = assert_same(seed, units=3 + seed % 2, size=(40, 30), ordered=seed % 3 == 0)
        assert shadings <= {"fixed-function kernel", ""}


def test_combined_textures_are_shaded_in_blocks(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "MODES", (gl.GL_COMBINE,))
    monkeypatch.setattr(fixed_function_pictures, "TARGETS", (gl.GL_TEXTURE_2D,))
    for seed in range(20):
        shadings = assert_same(seed, units=1 + seed % 2, size=(40, 30), ordered=seed % 3 == 0)
        assert shadings <= {"fixed-function kernel", ""}  # the latter where nothing is visible


@pytest.mark.parametrize("mode", [gl.GL_REPLACE, gl.GL_MODULATE])
@pytest.mark.parametrize("format", [gl.GL_RGBA, gl.GL_RGB])
def test_texels_that_are_the_colours_are_copied(mode, format, monkeypatch):
    choices = {"MODES": (mode,), "FORMATS": (format,), "TARGETS": (gl.GL_TEXTURE_2D,), "WRAPS": (gl.GL_REPEAT,) * 2}
    for name, values in choices.items():
        monkeypatch.setattr(fixed_function_pictures, name, values)
    monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", 0)
    for seed in range(24):
        ways = {"ordered": seed % 3 == 0, "tested": seed % 4 == 1, "special": seed % 5 == 2}
        assert_same(seed, units=1, size=(40, 30), white=True, **ways)


@pytest.mark.parametrize("depth_share", [0, 1])
def test_linear_filters_in_float_have_borders_and_compare_depths(depth_share, monkeypatch):
    choices = {"TARGETS": (gl.GL_TEXTURE_2D,), "MIN_FILTERS": (gl.GL_LINEAR, gl.GL_LINEAR_MIPMAP_NEAREST)}
    for name, values in choices.items():
        monkeypatch.setattr(fixed_function_pictures, name, values)
    monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", depth_share)
    edges = (gl.GL_CLAMP, gl.GL_CLAMP_TO_BORDER, gl.GL_MIRRORED_REPEAT, gl.GL_REPEAT, gl.GL_CLAMP_TO_EDGE)
    for seed in range(30):
        first = edges[seed % 5]
        monkeypatch.setattr(fixed_function_pictures, "WRAPS", (first, gl.GL_CLAMP, first))
        assert_same(seed, units=1 + seed % 2, size=(40, 30), ordered=seed % 3 == 0)


@pytest.mark.parametrize("filters", ["one level", "nearest level", "mixed levels", "any"])
def test_textures_of_floats_are_sampled_in_blocks(filters, monkeypatch):
    choices = {
        "one level": (gl.GL_NEAREST, gl.GL_LINEAR),
        "nearest level": (gl.GL_NEAREST_MIPMAP_NEAREST, gl.GL_LINEAR_MIPMAP_NEAREST),
        "mixed levels": (gl.GL_NEAREST_MIPMAP_LINEAR, gl.GL_LINEAR_MIPMAP_LINEAR),
    }
    values = {"TARGETS": (gl.GL_TEXTURE_2D,), "FORMATS": fixed_function_pictures.FLOAT_FORMATS, "DEPTH_SHARE": 0}
    values |= {"TEXELS": (-2.0, 3.0), "MIN_FILTERS": choices.get(filters, fixed_function_pictures.MIN_FILTERS)}
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)
    for seed in range(30):
        ways = {"ordered": seed % 3 == 0, "tested": seed % 4 == 1, "special": seed % 5 == 2}
        shadings = assert_same(seed, units=1 + seed % 2, size=(40, 30), **ways)
        assert shadings <= {"fixed-function kernel", ""}


@pytest.mark.parametrize("depth_share", [0, 0.5])
def test_rectangles_are_sampled_in_blocks(depth_share, monkeypatch):
    formats = (*fixed_function_pictures.FORMATS, *fixed_function_pictures.FLOAT_FORMATS)
    values = {"TARGETS": (gl.GL_TEXTURE_RECTANGLE,), "FORMATS": formats, "DEPTH_SHARE": depth_share}
    values |= {"MIN_FILTERS": (gl.GL_NEAREST, gl.GL_LINEAR), "COORDINATES": 30.0}
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)
    edges = (gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP, gl.GL_CLAMP_TO_BORDER)
    for seed in range(45):
        first = edges[seed % 3]
        monkeypatch.setattr(fixed_function_pictures, "WRAPS", (first, first, gl.GL_CLAMP))
        shadings = assert_same(seed, units=1 + seed % 2, size=(40, 30), ordered=seed % 4 == 0)
        assert shadings <= {"fixed-function kernel", ""}


@pytest.mark.parametrize("target", [gl.GL_TEXTURE_1D, gl.GL_TEXTURE_3D, gl.GL_TEXTURE_CUBE_MAP])
@pytest.mark.parametrize("of_floats", [False, True])
def test_textures_of_other_targets_are_sampled_in_blocks(target, of_floats, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "TARGETS", (target,))
    if of_floats:
        monkeypatch.setattr(fixed_function_pictures, "FORMATS", fixed_function_pictures.FLOAT_FORMATS)
        monkeypatch.setattr(fixed_function_pictures, "TEXELS", (-2.0, 3.0))
    if target == gl.GL_TEXTURE_1D:  # those of depths are shaded by the textbook
        monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", 0)
    shadings = [assert_same(seed, units=1 + seed % 2, size=(40, 30), ordered=seed % 3 == 0) for seed in range(30)]
    assert shadings.count({"fixed-function kernel"}) > (0 if of_floats else len(shadings) / 4)


@pytest.mark.parametrize("target", [gl.GL_TEXTURE_1D, gl.GL_TEXTURE_3D])
@pytest.mark.parametrize("wrap", [gl.GL_CLAMP, gl.GL_CLAMP_TO_BORDER, gl.GL_MIRRORED_REPEAT])
def test_lines_and_boxes_are_filtered_in_float(target, wrap, monkeypatch):
    values = {"TARGETS": (target,), "WRAPS": (wrap,) * 2, "DEPTH_SHARE": 0, "MIN_FILTERS": (gl.GL_LINEAR,)}
    values |= {"FORMATS": (*fixed_function_pictures.FORMATS, *fixed_function_pictures.FLOAT_FORMATS)}
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)
    shadings = [assert_same(seed, units=1 + seed % 2, size=(40, 30)) for seed in range(30)]
    assert {"fixed-function kernel"} in shadings


def test_depths_of_cube_maps_are_compared_by_the_textbook(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "TARGETS", (gl.GL_TEXTURE_CUBE_MAP,))
    monkeypatch.setattr(fixed_function_pictures, "MIN_FILTERS", (gl.GL_NEAREST,))
    monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", 1.0)
    for seed in range(12):
        assert assert_same(seed, units=1, size=(40, 30)) <= {"program", ""}


@pytest.fixture
def anisotropic(monkeypatch):
    """Let random textures be 2-D colours with anisotropic filters and without borders."""
    values = {"TARGETS": (gl.GL_TEXTURE_2D,), "WRAPS": WITHOUT_BORDER, "ANISOTROPY": 8.0, "DEPTH_SHARE": 0}
    values |= {"COORDINATES": 0.02}  # else most ellipses have thousands of texels
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)


@pytest.mark.parametrize("coordinates", [0.005, 0.03])
def test_bytes_in_ellipses_are_averaged(coordinates, anisotropic, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "COORDINATES", coordinates)
    shadings = [assert_same(seed, units=1 + seed % 2, size=(40, 30), ordered=seed % 3 == 0) for seed in range(24)]
    assert shadings.count({"fixed-function kernel"}) > len(shadings) / 2  # others have levels without a mipmap filter


def test_floats_in_ellipses_are_averaged(anisotropic, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "FORMATS", fixed_function_pictures.FLOAT_FORMATS)
    monkeypatch.setattr(fixed_function_pictures, "TEXELS", (-2.0, 3.0))
    shadings = [assert_same(seed, units=1 + seed % 2, size=(40, 30), tested=seed % 4 == 1) for seed in range(30)]
    assert shadings.count({"fixed-function kernel"}) > len(shadings) / 2


def test_texels_of_rectangles_in_ellipses_are_averaged(anisotropic, monkeypatch):
    values = {
        "TARGETS": (gl.GL_TEXTURE_RECTANGLE,),
        "FORMATS": (*fixed_function_pictures.FORMATS, *fixed_function_pictures.FLOAT_FORMATS),
        "COORDINATES": 0.02,
    }
    values |= {"MIN_FILTERS": (gl.GL_NEAREST, gl.GL_LINEAR), "WRAPS": (gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP) * 2}
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)
    shadings = [assert_same(seed, units=1, size=(40, 30)) for seed in range(30)]
    assert {"fixed-function kernel"} in shadings


def test_ellipses_with_borders_or_depths_are_left_to_the_textbook(anisotropic, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "WRAPS", (*WITHOUT_BORDER, gl.GL_CLAMP_TO_BORDER))
    monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", 0.5)
    shadings = [assert_same(seed, units=1, size=(40, 30)) for seed in range(30)]
    assert {"program"} in shadings


def test_ellipses_may_be_longer_than_a_block(anisotropic, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "COORDINATES", 0.3)
    monkeypatch.setattr(fixed_function_pictures, "MIN_FILTERS", (gl.GL_LINEAR,))  # without smaller levels
    for seed in range(40):
        assert_same(seed, units=1, size=(12, 8), n_triangles=3)


def weighted_sum(rng, state):
    """Return a state that adds the source to the target, either weighted by the source's alpha or not."""
    source, target = pick(rng, (gl.GL_ONE, gl.GL_SRC_ALPHA)), pick(rng, (gl.GL_ONE, gl.GL_ONE_MINUS_SRC_ALPHA))
    has_logic = bool(rng.random() < 0.1)  # which floats have not
    add = gl.GL_FUNC_ADD, gl.GL_FUNC_ADD
    return replace(state, blend=Blend(True, *(source, target) * 2, *add, (0.0,) * 4, has_logic, gl.GL_XOR))


@pytest.mark.parametrize("format", [gl.GL_RGBA32F, gl.GL_RGB16F, gl.GL_RG32F, gl.GL_R16F])
@pytest.mark.parametrize("blending", ["none", "weighted sum", "any"])
def test_colours_are_written_into_floats(format, blending, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "TARGETS", (gl.GL_TEXTURE_2D,))
    if blending == "weighted sum":
        monkeypatch.setattr(fixed_function_pictures, "random_blending", weighted_sum)
    for seed in range(30):
        ways = {"ordered": blending != "none", "special": seed % 5 == 2, "white": seed % 7 == 3}
        ways["tested"] = seed % 4 == 1
        shadings = assert_same(seed, stored_as=format, units=seed % 3, size=(40, 30), **ways)
        assert shadings <= {"fixed-function kernel", ""}


def test_ellipses_may_be_infinite(anisotropic):
    def picture():
        context = gl.create_context(1, 1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
        gl.glTexParameterf(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAX_ANISOTROPY_EXT, 2.0)
        texels = [[50, 60, 70, 80]] * 16
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, 4, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glEnable(gl.GL_TEXTURE_2D)
        middle, half_step = 2.0**28, 2.0**27  # steps with whose squares the axes overflow
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl.glTexCoord2f(middle + x * half_step, 0.5)
            gl.glVertex2f(x, y)
        gl.glEnd()
        gl.glFinish()
        return context

    with explain_paths() as paths:
        window = picture()
    assert [path.shading for path in paths] == ["fixed-function kernel"]
    with use_short_cuts(False):
        assert same_window(window, picture())


def test_uncovered_states_are_shaded_by_the_textbook():
    with explain_paths() as paths:
        for seed in range(12):
            random_picture(seed, units=5)
    assert {path.shading for path in paths} <= {"program", ""}  # as the kernels have four texture units


def test_the_kernels_are_compiled_when_it_pays(monkeypatch):
    compiled = []
    monkeypatch.setattr(choose.SPAN_KERNELS, "are_compiled", lambda: bool(compiled))
    monkeypatch.setattr(choose.SPAN_KERNELS, "note_compiled", lambda: compiled.append(True))
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 250)
    monkeypatch.setattr(choose, "LARGE_DRAW", 100)
    monkeypatch.setattr(choose.SPAN_KERNELS, "_done", 0)
    with explain_paths() as paths, gl.create_context(10, 10):
        for _ in range(4):
            gl.glRectf(-1, -1, 1, 1)
            gl.glFinish()
    assert [path.shading for path in paths] == ["program", *["fixed-function kernel"] * 3]


def test_many_small_draws_pay_for_the_kernels_too(monkeypatch):
    compiled = []
    monkeypatch.setattr(choose.SPAN_KERNELS, "are_compiled", lambda: bool(compiled))
    monkeypatch.setattr(choose.SPAN_KERNELS, "note_compiled", lambda: compiled.append(True))
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 20 * choose.SMALL_DRAW)
    monkeypatch.setattr(choose.SPAN_KERNELS, "_done", 0)
    with explain_paths() as paths, gl.create_context(10, 10):
        for _ in range(21):
            gl.glRectf(-0.5, -0.5, 0, 0)
            gl.glFinish()
    assert paths[0].shading == "program"
    assert paths[-1].shading == "fixed-function kernel"


@pytest.mark.interpreted
def test_the_interpreted_kernels_leave_the_bits_of_the_shading_stage():
    for seed in range(6):
        assert_same(seed, size=(12, 9), n_triangles=4)
