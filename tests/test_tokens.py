"""Tokens are named by their numbers."""

import pytest

from softshadow import gl
from softshadow.tokens import token_name


@pytest.mark.parametrize("name", ["GL_EXP", "GL_S", "GL_ACCUM", "GL_TEXTURE_WIDTH", "GL_LIGHT0", "GL_TRIANGLES"])
def test_a_bit_of_a_mask_does_not_replace_a_token_of_the_same_number(name):
    assert token_name(getattr(gl, name)) == name


def test_bits_that_share_their_number_with_no_token_are_named():
    assert token_name(gl.GL_ALL_ATTRIB_BITS) == "GL_ALL_ATTRIB_BITS"
    assert token_name(gl.GL_MAP_UNSYNCHRONIZED_BIT).endswith("_BIT")


def test_the_first_mode_of_fog_is_spelled_as_in_a_program():
    assert "glFogi(GL_FOG_MODE, GL_EXP)" in str(gl.create_context(1, 1).state.fog)
