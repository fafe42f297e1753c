"""Kernels over bytes and floats against the same arithmetic in NumPy."""

import numpy as np
import pytest

from softshadow.pipeline.buffers.copy import round_to_bytes
from softshadow.pipeline.buffers.mipmaps import (
    centers,
    halved_in_8_bits,
    halved_in_float,
    mix_in_8_bits,
    mix_in_float,
    texels_and_weights,
    texels_and_weights_in_8_bits,
)

pytestmark = pytest.mark.interpreted


SIZES = [(1, 1), (1, 6), (5, 1), (8, 6), (7, 9), (2, 3), (16, 32)]


@pytest.mark.parametrize(("height", "width"), SIZES)
@pytest.mark.parametrize("upside_down", [False, True])
def test_halving_mixes_along_columns_then_rows(height, width, upside_down):
    texels = np.random.default_rng(width).integers(0, 256, (height, width, 4)).astype(np.uint8)
    texels = texels[::-1] if upside_down else texels
    size = max(width // 2, 1), max(height // 2, 1)
    first, second, weight = texels_and_weights_in_8_bits(centers(*size, True), width)
    rows = mix_in_8_bits(texels[:, first], texels[:, second], weight[:, np.newaxis])
    first, second, weight = texels_and_weights_in_8_bits(centers(*size[::-1], False), height)
    expected = mix_in_8_bits(rows[first], rows[second], weight[:, np.newaxis, np.newaxis])
    np.testing.assert_array_equal(halved_in_8_bits(texels, *size), expected)


@pytest.mark.parametrize(("height", "width"), SIZES)
def test_halving_of_floats_differs_on_both_sides_of_the_diagonal(height, width):
    texels = np.random.default_rng(width).normal(0, 10, (height, width, 3)).astype(np.float32)
    size = max(width // 2, 1), max(height // 2, 1)
    first, second, weight = texels_and_weights(centers(*size, True), width)
    rows, halves = mix_in_float(texels[:, first], texels[:, second], weight[:, np.newaxis]), []
    for from_far_end in (False, True):
        first, second, weight = texels_and_weights(centers(*size[::-1], from_far_end), height)
        halves.append(mix_in_float(rows[first], rows[second], weight[:, np.newaxis, np.newaxis]))
    y, x = np.indices(size[::-1])
    is_above = (2 * y + 1) * size[0] > (2 * x + 1) * size[1]
    np.testing.assert_array_equal(halved_in_float(texels, *size), np.where(is_above[..., np.newaxis], *halves[::-1]))


def test_floats_are_clamped_and_rounded_to_the_even_byte():
    halves = (np.arange(255, dtype=np.float32) + np.float32(0.5)) / np.float32(255)
    floats = np.concatenate([halves, [-1, -0.0, 0, 1e-40, 1, 2, np.inf, -np.inf]]).astype(np.float32)
    out = np.empty(len(floats), np.uint8)
    round_to_bytes(floats, out)
    expected = np.rint(np.clip(floats, np.float32(0), np.float32(1)) * np.float32(255))
    np.testing.assert_array_equal(out, expected)


def test_what_is_not_a_number_becomes_the_byte_0():
    out = np.empty(1, np.uint8)
    round_to_bytes(np.array([np.nan], np.float32), out)
    assert out[0] == 0
