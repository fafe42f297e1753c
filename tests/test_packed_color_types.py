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


def test_every_type_has_an_example():
    assert EXAMPLES.keys() == PACKED_COLORS.keys()


@pytest.mark.parametrize("kind", EXAMPLES, ids=gl.token_name)
def test_components_are_in_the_bits_of_the_specification(kind):
    packed, (word, components) = PACKED_COLORS[kind], EXAMPLES[kind]
    words = np.array([[word, 0]], packed.dtype)
    assert packed.split(words)[0, 0].tolist() == list(components)
    assert packed.join(packed.split(words)).tolist() == words.tolist()


@pytest.mark.parametrize("kind", PACKED_COLORS, ids=gl.token_name)
def test_the_largest_components_are_the_word_of_all_bits(kind):
    packed = PACKED_COLORS[kind]
    assert packed.join(packed.largest) == np.iinfo(packed.dtype).max


@pytest.mark.parametrize(("n_bits", "wanted"), [(1, 8), (2, 8), (3, 8), (4, 8), (5, 8), (6, 8), (8, 10)])
def test_more_bits_keep_order_and_ends(n_bits, wanted):
    widened = with_more_bits(np.arange(1 << n_bits), n_bits, wanted)
    assert (widened[0], widened[-1]) == (0, (1 << wanted) - 1)
    assert (np.diff(widened) > 0).all()
    assert (widened >> (wanted - n_bits)).tolist() == list(range(1 << n_bits))
