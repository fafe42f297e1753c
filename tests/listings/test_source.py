"""The code of a listing: the version that runs, with the steps that execute each line."""

import ast

import pytest

from softshadow import listings
from softshadow.listings.source import FOLDER, code_of, titles_of


def lines_with(text, excerpts):
    return [line for excerpt in excerpts for line in excerpt.lines if text in line.text]


@pytest.mark.parametrize("name", listings.names())
@pytest.mark.parametrize("corrected", [(), None])
def test_code_of_every_version_is_python_without_switches(name, corrected):
    listing = listings.get(name)
    excerpts = code_of(listing, corrected)
    assert excerpts[0].function
    for excerpt in excerpts:
        source = "\n".join(line.text for line in excerpt.lines)
        ast.parse(source)
        assert "in corrected" not in source


@pytest.mark.parametrize("name", listings.names())
def test_every_step_executes_a_line_and_draws_or_clears(name):
    titles = titles_of(listings.get(name))
    assert len(titles) > 1
    executed = {step for excerpt in code_of(listings.get(name)) for line in excerpt.lines for step in line.steps}
    assert executed == set(range(len(titles)))


def test_numbers_are_those_of_the_file():
    for excerpt in code_of(listings.get("planar")):
        source = (FOLDER / excerpt.file).read_text(encoding="utf-8")
        for line in excerpt.lines:
            if "E34" not in line.text:  # a choice is resolved there
                assert source.splitlines()[line.number - 1].strip() == line.text.strip()


def test_line_has_the_steps_that_execute_it():
    zpass = listings.get("volume-zpass")
    assert [line.steps for line in lines_with("gl.glVertex4f(*corner)", code_of(zpass))] == [(1, 2), ()]  # sides, cap
    assert [line.steps for line in lines_with("GL_LEQUAL", code_of(zpass))] == [(3,)]


def test_corrections_choose_between_branches_and_values():
    copied, drawn = code_of(listings.get("map"), ()), code_of(listings.get("map"))
    assert lines_with("glCopyTexSubImage2D", copied)
    assert not lines_with("glCopyTexSubImage2D", drawn)
    assert lines_with("begin_framebuffer(gl, texture)", drawn)
    only = code_of(listings.get("map"), ["E46"])
    assert [line.text.strip() for line in lines_with("wrap = ", only)] == [
        "wrap = gl.GL_CLAMP_TO_EDGE  # E47: edge texels smear"
    ]
    with_offset = lines_with("use(gl, program, light_matrix", drawn)[0].text
    without_e48 = lines_with("use(gl, program, light_matrix", only)[0].text
    assert "0.0 if offset else 0.01" in with_offset
    assert ", 0.01, AMBIENT)" in without_e48


def test_condition_of_a_correction_and_something_else_keeps_the_rest():
    (line,) = lines_with("continue  # E16", code_of(listings.get("planar-faces")))
    assert line.steps == (1,)
    assert lines_with("if thing.mesh.positions[:, 1].max() <= 0:", code_of(listings.get("planar-faces")))
    assert not lines_with("continue", code_of(listings.get("planar-faces"), ()))


def test_unknown_correction_is_told_the_nearest():
    with pytest.raises(ValueError, match="unknown correction 'E9'"):
        code_of(listings.get("planar"), ["E9"])
