"""Packed pixel types: components in the bits that GL 2.1, tables 3.6 to 3.8, names."""

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.packed_colors import PACKED_COLORS, with_more_bits

EXAMPLES: dict[int, tuple[int, tuple[int, ...]]] = {  # word and components by type
    gl.GL_UNSIGNED_BYTE_3_3_2: (0b101_011_10, (0b101, 0b011, 0b10)),
    gl.GL_UNSIGNED_BYTE_2_3_3_REV: (0b10_011_101, (0b101, 0b011, 0b10)),
    gl.GL_UNSIGNED_SHORT_5_6_5: (0xF81F, (31, 0, 31)),
    gl.GL_UNSIGNED_SHORT_5_6_5_REV: (0x07E1, (1, 63, 0)),
    gl.GL_UNSIGNED_SHORT_4_4_4_4: (0x1234, (1, 2, 3, 4)),
    gl.GL_UNSIGNED_SHORT_4_4_4_4_REV: (0x1234, (4, 3, 2, 1)),
    gl.GL_UNSIGNED_SHORT_5_5_5_1: (0b00001_00010_00011_1, (1, 2, 3, 1)),
    gl.GL_UNSIGNED_SHORT_1_5_5_5_REV: (0b1_00011_00010_00001, (1, 2, 3, 1)),
    gl.GL_UNSIGNED_INT_8_8_8_8: (0x01020304, (1, 2, 3, 4)),
    gl.GL_UNSIGNED_INT_8_8_8_8_REV: (0x01020304, (4, 3, 2, 1)),
    gl.GL_UNSIGNED_INT_10_10_10_2: (1 << 22 | 2 << 12 | 3 << 2 | 1, (1, 2, 3, 1)),
    gl.GL_UNSIGNED_INT_2_10_10_10_REV: (1 << 30 | 3 << 20 | 2 << 10 | 1, (1, 2, 3, 1)),
}
COLORS: dict[int, list[tuple[int, tuple[float, ...]]]] = {  # words and their colours
    gl.GL_UNSIGNED_INT_5_9_9_9_REV: [
        (16 << 27 | 256, (1.0, 0.0, 0.0)), (31 << 27 | 511 << 18, (0.0, 0.0, 65408.0)),
        (257 << 9, (0.0, 257 / 2**24, 0.0)),
    ],
    gl.GL_UNSIGNED_INT_10F_11F_11F_REV: [
        (15 << 6 | (16 << 6 | 32) << 11 | 14 << 27, (1.0, 3.0, 0.5)), (30 << 6 | 63, (65024.0, 0.0, 0.0)),
        ((30 << 5 | 31) << 22, (0.0, 0.0, 64512.0)), (31 << 6, (np.inf, 0.0, 0.0)),
    ],
}  # fmt: skip
LEAST_STEP = 2.0**-5  # of a mantissa of 5 bits for numbers between 1 and 2


def test_every_type_has_an_example():
    of_integers = {kind for kind, packed in PACKED_COLORS.items() if packed.small_floats is None}
    assert EXAMPLES.keys() == of_integers
    assert COLORS.keys() == PACKED_COLORS.keys() - of_integers


@pytest.mark.parametrize("kind", COLORS, ids=gl.token_name)
def test_small_floats_are_those_of_the_specification(kind):
    small_floats = PACKED_COLORS[kind].small_floats
    for word, color in COLORS[kind]:
        words = np.array([word], np.uint32)
        np.testing.assert_array_equal(small_floats.floats(words), np.array([color], np.float32))
        assert small_floats.words(np.array([color], np.float32)).tolist() == [word]


@pytest.mark.parametrize("kind", COLORS, ids=gl.token_name)
def test_colors_keep_the_first_bits_of_their_mantissas(kind):
    small_floats = PACKED_COLORS[kind].small_floats
    colors = np.random.default_rng(3).uniform(0, 2, (1000, 3)).astype(np.float32)
    again = small_floats.floats(small_floats.words(colors))
    assert np.abs(again - colors).max() <= LEAST_STEP
    np.testing.assert_array_equal(small_floats.floats(small_floats.words(again)), again)
    nothing = np.array([[-1, -np.inf, -0.0]], np.float32)
    assert small_floats.floats(small_floats.words(nothing)).tolist() == [[0, 0, 0]]


@pytest.mark.parametrize("kind", EXAMPLES, ids=gl.token_name)
def test_components_are_in_the_bits_of_the_specification(kind):
    packed, (word, components) = PACKED_COLORS[kind], EXAMPLES[kind]
    words = np.array([[word, 0]], packed.dtype)
    assert packed.split(words)[0, 0].tolist() == list(components)
    assert packed.join(packed.split(words)).tolist() == words.tolist()


@pytest.mark.parametrize("kind", EXAMPLES, ids=gl.token_name)
def test_the_largest_components_are_the_word_of_all_bits(kind):
    packed = PACKED_COLORS[kind]
    assert packed.join(packed.largest) == np.iinfo(packed.dtype).max


@pytest.mark.parametrize(("n_bits", "wanted"), [(1, 8), (2, 8), (3, 8), (4, 8), (5, 8), (6, 8), (8, 10)])
def test_more_bits_keep_order_and_ends(n_bits, wanted):
    widened = with_more_bits(np.arange(1 << n_bits), n_bits, wanted)
    assert (widened[0], widened[-1]) == (0, (1 << wanted) - 1)
    assert (np.diff(widened) > 0).all()
    assert (widened >> (wanted - n_bits)).tolist() == list(range(1 << n_bits))
