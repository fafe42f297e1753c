"""Number formats of pixels; their agreement with Mesa is in tests/gl/test_pixel_formats.py."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from softshadow import color_values
from softshadow import pixels as conversions
from softshadow import tokens as gl
from softshadow.image import D24, D32F, FORMATS
from softshadow.packed_colors import PACKED_COLORS
from softshadow.pipeline.shade.color_writes import rounded_floats
from softshadow.pixel_store import COMPONENTS
from softshadow.pixel_transfer import PixelTransfer
from softshadow.pixels import (
    pack_color,
    pack_color_into,
    pack_depth,
    quantized_depth,
    sampled_depth,
    to_base,
    unpack_color,
    unpack_depth,
)

D16 = FORMATS[gl.GL_DEPTH_COMPONENT16]
D32 = FORMATS[gl.GL_DEPTH_COMPONENT32]
FORMATS_THAT_HOLD_DEPTH = (D16, D24, D32, D32F)
ONE = (1 << 24) - 1

depths = arrays(np.float32, (1, 8), elements=st.floats(0, 1, width=32))
units24 = arrays(np.int64, (1, 8), elements=st.integers(0, ONE))


@given(units24)
def test_depth_is_read_as_its_quotient(units):
    cells = units.astype(np.float32)
    assert (pack_depth(cells, D24, np.float32) == (units / ONE).astype(np.float32)).all()


@given(units24)
def test_depth_as_unsigned_int_repeats_its_upper_bits(units):
    assert (pack_depth(units.astype(np.float32), D24, np.uint32) == (units << 8 | units >> 16)).all()


@given(units24)
def test_depth_through_unsigned_int_and_back_loses_one_unit_at_most(units):
    cells = units.astype(np.float32)
    again = unpack_depth(pack_depth(cells, D24, np.uint32), D24)  # an upload cuts where a draw would round
    assert set(np.unique(cells - again)) <= {0, 1}


def test_floats_are_cut_to_depth_units():
    z = np.float32([[0, 0.5, 1, 1.5, -1, 1 - 2**-24]])
    assert unpack_depth(z, D24).tolist() == [[0, 8388607, ONE, ONE, 0, ONE - 1]]
    assert (unpack_depth(z, D32F) == z.clip(0, 1)).all()


@given(depths, st.sampled_from(FORMATS_THAT_HOLD_DEPTH))
def test_rounding_depth_moves_it_by_less_than_two_units(z, format):
    units = min(format.largest or 2**24, 2**23)  # textures read 23 bits of the 32-bit format
    moved = sampled_depth(quantized_depth(z, format), format).astype(np.float64) - z
    assert (abs(moved) < 2 / units).all()


@given(depths, st.sampled_from(FORMATS_THAT_HOLD_DEPTH))
def test_rounded_depth_keeps_the_order(z, format):
    cells = quantized_depth(np.sort(z), format)
    assert (np.diff(cells) >= 0).all()


@given(units24)
def test_a_drawn_copy_of_depth_is_the_same_or_one_more(units):
    cells = units.astype(np.float32)
    again = quantized_depth(sampled_depth(cells, D24), D24)
    assert set(np.unique(again - cells)) <= {0, 1}


@pytest.mark.parametrize(
    ("base", "expected"),
    [
        (gl.GL_RGBA, [10, 20, 30, 40]),
        (gl.GL_RGB, [10, 20, 30, 255]),
        (gl.GL_RG, [10, 20, 0, 255]),
        (gl.GL_RED, [10, 0, 0, 255]),
        (gl.GL_ALPHA, [0, 0, 0, 40]),
        (gl.GL_LUMINANCE, [10, 10, 10, 255]),
        (gl.GL_LUMINANCE_ALPHA, [10, 10, 10, 40]),
        (gl.GL_INTENSITY, [10, 10, 10, 10]),
    ],
)
def test_a_base_format_keeps_what_table_3_15_says(base, expected):
    assert to_base(np.uint8([[10, 20, 30, 40]]), base).tolist() == [expected]


@pytest.mark.parametrize("internal", [f for f, stored in FORMATS.items() if stored.kind in ("unorm8", "float")])
@given(arrays(np.uint8, (2, 3, 4)))
def test_bytes_survive_storage(internal, rgba):
    format = FORMATS[internal]
    cells = unpack_color(rgba, gl.GL_RGBA, format)
    read = pack_color(cells, format, gl.GL_RGBA, np.uint8)
    assert (unpack_color(read, gl.GL_RGBA, format) == cells).all()


@given(arrays(np.float32, (2, 3, 4), elements=st.floats(-4, 4, width=32)))
def test_floats_survive_float_storage(rgba):
    format = FORMATS[gl.GL_RGBA32F]
    assert (pack_color(unpack_color(rgba, gl.GL_RGBA, format), format, gl.GL_RGBA, np.float32) == rgba).all()


def test_luminance_out_of_a_framebuffer_is_the_sum():
    cells, format = np.uint8([[[10, 20, 30, 40]]]), FORMATS[gl.GL_RGBA8]
    assert pack_color(cells, format, gl.GL_LUMINANCE, np.uint8, from_framebuffer=True).item() == 60
    assert pack_color(cells, format, gl.GL_LUMINANCE, np.uint8).item() == 10


@pytest.mark.parametrize("flipped", [False, True])
def test_the_rgb_of_a_large_image_is_that_of_its_rgba(flipped):
    rgba = np.random.default_rng(3).integers(0, 256, (301, 299, 4), np.uint8)[:, 5:]
    rgba = rgba[::-1] if flipped else rgba
    assert rgba.size >= color_values.LARGE
    read = pack_color(rgba, FORMATS[gl.GL_RGBA8], gl.GL_RGB, np.uint8, from_framebuffer=True)
    np.testing.assert_array_equal(read, rgba[..., :3])


def both_ways(monkeypatch, convert):
    """Return what a conversion returns with the kernels for large images, and without them."""
    answers = []
    for large in (0, 1 << 60):
        monkeypatch.setattr(color_values, "LARGE", large)
        answers.append(convert())
    return answers


CLIENTS = (
    gl.GL_RED,
    gl.GL_ALPHA,
    gl.GL_RGB,
    gl.GL_BGR,
    gl.GL_BGRA,
    gl.GL_ABGR_EXT,
    gl.GL_LUMINANCE,
    gl.GL_LUMINANCE_ALPHA,
)


@pytest.mark.interpreted
@pytest.mark.parametrize("pixel_format", CLIENTS)
def test_large_images_of_bytes_are_stored_as_small_ones(monkeypatch, pixel_format):
    components = len(COMPONENTS[pixel_format])
    pixels = np.random.default_rng(components).integers(0, 256, (5, 7, components), dtype=np.uint8)
    one_pass, by_channels = both_ways(monkeypatch, lambda: unpack_color(pixels, pixel_format, FORMATS[gl.GL_RGBA8]))
    assert (one_pass == by_channels).all()


@pytest.mark.interpreted
@pytest.mark.parametrize("pixel_format", CLIENTS)
@pytest.mark.parametrize("kind", [np.uint8, np.float32])
@pytest.mark.parametrize("internal", [gl.GL_RGBA8, gl.GL_RGB8, gl.GL_RGBA32F])
def test_large_images_are_read_as_small_ones(monkeypatch, pixel_format, kind, internal):
    rng, stored = np.random.default_rng(4), FORMATS[internal]
    cells = rng.integers(0, 256, (9, 7, 4), dtype=np.uint8)[::-1, :5]
    if stored.kind == "float":
        cells = rng.choice([*rng.uniform(-1, 2, 50), np.nan, np.inf], (9, 7, 4)).astype(np.float32)[::-1, :5]
    for from_framebuffer in (False, True):
        options = (cells, stored, pixel_format, kind, from_framebuffer)
        one_pass, by_channels = both_ways(monkeypatch, lambda options=options: pack_color(*options))
        assert one_pass.tobytes() == by_channels.tobytes()
        pixels = np.zeros_like(by_channels)
        pack_color_into(pixels, *options)
        assert pixels.tobytes() == by_channels.tobytes()


@pytest.mark.interpreted
def test_large_images_of_floats_become_the_bytes_of_small_ones(monkeypatch):
    between = np.nextafter(np.float32(np.arange(512) / 510), np.float32([[-1], [2]]))
    values = np.append(between.astype(np.float32), np.float32([np.nan, np.inf, -np.inf, -0.0, 1e30]))
    one_pass, by_steps = both_ways(monkeypatch, lambda: color_values.to_unorm8(values))
    assert (one_pass == by_steps).all()
    assert (rounded_floats(values[:-1][values[:-1] != np.inf]) == by_steps[:-1][values[:-1] != np.inf]).all()


SHORT_WORDS = [kind for kind, packed in PACKED_COLORS.items() if packed.dtype.itemsize <= 2]
STORED = ("RGBA8", "RGB8", "LUMINANCE8", "RGB565", "RGBA4", "RGB5_A1", "RGBA16", "RGBA16F", "RGBA32F", "SRGB8_ALPHA8")


@pytest.mark.parametrize("internal", STORED)
@pytest.mark.parametrize("kind", SHORT_WORDS, ids=gl.token_name)
def test_many_packed_pixels_are_stored_as_few(monkeypatch, kind, internal):
    packed, stored = PACKED_COLORS[kind], FORMATS[getattr(gl, "GL_" + internal)]
    words = np.arange(1 << 16).astype(packed.dtype).reshape(256, 256, 1)
    for pixel_format in packed.formats:
        monkeypatch.undo()
        by_table = unpack_color(words, pixel_format, stored, kind)
        monkeypatch.setattr(conversions, "MANY", words.size + 1)
        one_by_one = unpack_color(words, pixel_format, stored, kind)
        assert (by_table.dtype, by_table.shape) == (one_by_one.dtype, one_by_one.shape)
        assert by_table.tobytes() == one_by_one.tobytes()


def test_many_packed_pixels_are_scaled_as_glPixelTransfer_says():
    words = np.full((256, 256, 1), 0xFFFF, np.uint16)
    half = PixelTransfer(scales=((0.5, 0.0),) * 3 + ((1.0, 0.0),))
    cells = unpack_color(words, gl.GL_RGB, FORMATS[gl.GL_RGBA8], gl.GL_UNSIGNED_SHORT_5_6_5, half)
    assert (cells == (128, 128, 128, 255)).all()


@given(arrays(np.uint8, 8), arrays(np.int16, 8), arrays(np.uint32, 8))
def test_integers_become_bytes_by_the_nearest_quotient(small, signed, large):
    for values in (small, signed, large):
        largest = color_values.largest_of(values.dtype.type)
        expected = [(max(value, 0) * 255 + largest // 2) // largest for value in values.tolist()]
        assert color_values.to_unorm8(values).tolist() == expected
