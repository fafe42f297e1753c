"""Techniques of the user's own: run as functions, registered by name, saved and loaded."""

from typing import Annotated

import numpy as np
import pytest

import softshadow as ss
from softshadow import techniques

SIZE = (64, 48)


def only_clear(gl, scene, *, size, value: Annotated[int, "what to clear to", ss.Range(0, 255)] = 3):
    """Clear the stencil buffer.

    And do nothing else.
    """
    gl.glClearStencil(value)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    yield "clear", {"rows": np.repeat(np.arange(size[1], dtype=np.uint8)[:, None], size[0], axis=1)}


@pytest.fixture
def register(monkeypatch):
    monkeypatch.setattr(techniques, "REGISTER", dict(techniques.REGISTER))
    return ss.register


def test_a_generator_function_is_a_technique():
    run = ss.run(only_clear, "torus", SIZE, value=5)
    assert (run.technique, dict(run.options), run.steps.titles) == ("only-clear", {"value": 5}, ["clear"])
    assert (run.stencil == 5).all()
    assert run.maps["rows"][0, 0] == 47  # row 0 is on top
    with pytest.raises(ValueError, match="technique 'only-clear' has no option 'valeu': did you mean 'value'"):
        ss.run(only_clear, "torus", SIZE, valeu=5)


def test_a_registered_technique_is_found_by_its_name(register):
    technique = register(only_clear)
    assert ss.technique_names()[-1] == "only-clear"
    assert ss.run("only-clear", "torus", SIZE).stencil[0, 0] == 3
    assert ss.run(technique, "torus", SIZE).technique == "only-clear"
    text = ss.describe("only-clear")
    assert "And do nothing else." in text
    assert "what to clear to (a whole number from 0 to 255)" in text


def test_register_is_a_decorator_and_a_new_version_takes_the_place_of_the_old(register):
    for value in (1, 2):

        @register
        def mine(gl, scene, *, size, value=value):
            gl.glClearStencil(value)
            gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
            yield "clear"

        assert isinstance(mine, ss.Technique)
        assert ss.run("mine", "torus", SIZE).stencil[0, 0] == value


def test_names_of_built_in_techniques_are_kept(register):
    with pytest.raises(ValueError, match="'map' is built in; expected another name"):
        register(only_clear, name="map")
    assert register(only_clear, name="mine").name == "mine"


def test_a_technique_needs_no_annotations_but_the_arguments_of_one():
    for wrong in (lambda gl, scene: iter(()), lambda: None, 3, None):
        with pytest.raises(TypeError, match=r"expected the name of a technique, a Technique, or a generator function"):
            ss.run(wrong, "torus", SIZE)


def test_a_generator_that_yields_nothing_or_nonsense_is_told_what_to_yield():
    def nothing(gl, scene, *, size):
        return None

    def number(gl, scene, *, size):
        yield 5

    with pytest.raises(ValueError, match="technique 'nothing' yielded no step; expected `yield \"title\"`"):
        ss.run(nothing, "torus", SIZE)
    with pytest.raises(TypeError, match="technique 'number' yielded 5; expected a title"):
        ss.run(number, "torus", SIZE)


@pytest.mark.parametrize("name", ["mine.html", "mine.npz", "mine.png", "mine/"])
def test_a_run_of_ones_own_technique_can_be_saved(tmp_path, name):
    run = ss.run(only_clear, "torus", SIZE, value=5)
    saved = run.save(f"{tmp_path}/{name}")
    if name == "mine.html":
        assert "value=5" in saved.read_text(encoding="utf-8")
    if name == "mine.npz":
        again = ss.load_run(saved)
        assert (again.technique, again.options) == ("only-clear", {"value": 5})
        np.testing.assert_array_equal(again.stencil, run.stencil)
        again.save(tmp_path / "again.html")
    assert "text/html" in run._repr_mimebundle_()[0]
