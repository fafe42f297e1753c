"""Codes of colours that are not bytes: every code comes back from the cells, and rounding is that of its name."""

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.encoded_pixels import encoded_bytes
from softshadow.image import FORMATS
from softshadow.texel_codes import (
    SRGB,
    as_halves,
    cells_of,
    codes_of,
    codes_of_bytes,
    resized,
    rounded_to_even,
    rounded_up,
    srgb_codes,
)

WITH_CODES = {name: format for name, format in FORMATS.items() if format.encoding in ("unorm", "srgb")}


@pytest.mark.parametrize("name", WITH_CODES, ids=gl.token_name)
def test_every_code_comes_back_from_its_cells(name):
    format = WITH_CODES[name]
    codes = np.zeros((1 << max(format.bits), 4), np.int64)
    for channel, n_bits in enumerate(format.bits):
        codes[:, channel] = np.arange(len(codes)) & (1 << n_bits) - 1
    cells = cells_of(codes, format)
    assert cells.dtype == format.dtype
    np.testing.assert_array_equal(codes_of(cells, format), codes)


@pytest.mark.parametrize(("n_bits", "wanted"), [(1, 8), (4, 8), (5, 8), (8, 10), (8, 16), (15, 16), (16, 32), (5, 16)])
def test_wider_codes_have_the_old_ones_on_top(n_bits, wanted):
    codes = np.arange(1 << n_bits)
    wider = resized(codes, n_bits, wanted)
    np.testing.assert_array_equal(wider >> wanted - n_bits, codes)
    assert (wider[0], wider[-1]) == (0, (1 << wanted) - 1)


@pytest.mark.parametrize(("n_bits", "wanted"), [(8, 5), (8, 1), (16, 8), (32, 8), (10, 8)])
def test_narrower_codes_are_the_nearest(n_bits, wanted):
    codes = np.linspace(0, (1 << n_bits) - 1, 999).astype(np.int64)
    exact = codes / ((1 << n_bits) - 1) * ((1 << wanted) - 1)
    assert np.abs(resized(codes, n_bits, wanted) - exact).max() <= 0.5


def test_halves_are_rounded_up_or_to_the_even_code():
    values = np.array([0.5, -1, 2, np.nan], np.float32)
    assert rounded_up(values, 1).tolist() == [1, 0, 1, 0]
    assert rounded_to_even(values, 1).tolist() == [0, 0, 1, 0]


def test_half_floats_are_truncated_or_rounded():
    values = np.array([1 + 3 / 4096, -1 - 3 / 4096, 65519], np.float32)
    assert as_halves(values, truncated=True).tolist() == [1, -1, 65504]
    assert as_halves(values, truncated=False).tolist() == [1 + 1 / 1024, -1 - 1 / 1024, 65504]


def test_srgb_is_a_rising_curve_whose_bytes_come_back():
    assert (np.diff(SRGB) > 0).all()
    assert SRGB[0] == 0
    np.testing.assert_array_equal(srgb_codes(SRGB), np.arange(256))
    exact = np.arange(256) / 255
    exact = np.where(exact <= 0.04045, exact / 12.92, ((exact + 0.055) / 1.055) ** 2.4)
    assert np.abs(SRGB - exact).max() < FARTHEST


FARTHEST = 0.002  # llvmpipe's polynomial of third degree from the curve of the specification


def test_bytes_are_encoded_by_a_table():
    rgba = np.random.default_rng(2).integers(0, 256, (9, 40, 4)).astype(np.uint8)
    formats = {format for format in FORMATS.values() if format.has_few_bits or format.encoding == "srgb"}
    assert len(formats) > 5
    for format in formats:
        expected = cells_of(codes_of_bytes(rgba, format), format)
        cells = encoded_bytes(rgba[::-1], format)  # as upside-down images are
        assert cells.dtype == expected.dtype
        np.testing.assert_array_equal(cells[::-1], expected)
