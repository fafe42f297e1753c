"""The named list of differences from Mesa holds nothing that has gone."""

import pytest

from mesa.known_differences import CORNERS, FAULTS, KNOWN, explanation, follows_back_only, triangle
from softshadow.testing import compare

SIZE = (24, 20)


@pytest.mark.mesa
@pytest.mark.parametrize("known", [*KNOWN, *FAULTS], ids=lambda known: known.name)
def test_known_difference_still_occurs(known):
    comparison = compare(known.program, SIZE)
    assert not comparison, f"{known.name} is no difference any more: take it from the list"


@pytest.mark.mesa
@pytest.mark.parametrize("known", KNOWN, ids=lambda known: known.name)
def test_known_difference_is_one_of_colours_and_not_larger_than_said(known):
    comparison = compare(known.program, SIZE)
    assert [found.buffer for found in comparison.differences] == ["color"]
    distance = abs(comparison.ours.color.astype(int) - comparison.theirs.color).max()
    assert distance <= known.largest


def test_stencil_and_depth_are_never_explained():
    plain = [("glLightModeli", ("GL_LIGHT_MODEL_TWO_SIDE", 1)), ("glColorMaterial", ("GL_BACK", "GL_AMBIENT"))]
    assert not follows_back_only(plain)
    calls = [*plain, ("glMaterialf", ("GL_FRONT", "GL_SHININESS", 2.0))]
    assert follows_back_only(calls)
    assert explanation(calls, ("color",)) == "unwritten registers"
    assert explanation(calls, ("color", "returned[2]")) == "unwritten registers"
    assert explanation(calls, ("color", "stencil")) == ""
    assert explanation(calls, ("depth",)) == ""
    assert explanation([], ("color",)) == ""


@pytest.mark.mesa
def test_finished_quad_in_a_list_is_the_same_on_both():
    def program(gl):
        gl.glNewList(1, gl.GL_COMPILE)
        triangle(gl, gl.GL_QUADS, CORNERS)
        gl.glEndList()
        gl.glCallList(1)

    assert compare(program, SIZE)
