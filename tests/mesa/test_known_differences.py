"""Every difference in the list of known differences from Mesa still occurs."""

import pytest

from mesa.known_differences import CORNERS, FAULTS, KNOWN, explanation, follows_back_only, gives_back_only, triangle
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


def test_shiny_backs_are_those_given_inside_a_primitive_for_the_back_alone():
    shiny = [("glLightModeli", ("GL_LIGHT_MODEL_TWO_SIDE", 1)), ("glMaterialf", ("GL_BACK", "GL_SHININESS", 8.0))]
    given, both = (("glMaterialfv", (face, "GL_DIFFUSE", (1.0,) * 4)) for face in ("GL_BACK", "GL_FRONT_AND_BACK"))
    begin, end = ("glBegin", ("GL_TRIANGLES",)), ("glEnd", ())
    assert gives_back_only([*shiny, begin, given, end])
    assert not gives_back_only([*shiny, begin, end, given])
    assert not gives_back_only([*shiny, begin, both, end])
    assert gives_back_only([*shiny, ("glColorMaterial", ("GL_FRONT", "GL_DIFFUSE")), begin, both, end])


@pytest.mark.mesa
def test_finished_quad_in_a_list_is_the_same_on_both():
    def program(gl):
        gl.glNewList(1, gl.GL_COMPILE)
        triangle(gl, gl.GL_QUADS, CORNERS)
        gl.glEndList()
        gl.glCallList(1)

    assert compare(program, SIZE)
