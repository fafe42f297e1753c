"""Draws and vertices are tuples, which behave as other commands do."""

import numpy as np

from softshadow import tokens as gl
from softshadow.inspection.recording import Packer
from softshadow.pipeline.commands import Draw, Vertices, draws_like
from softshadow.state import State


def vertices(count: int) -> Vertices:
    return Vertices(np.zeros((count, 4)), np.ones((count, 4)), np.zeros((count, 3)), ())


def draw(count: int) -> Draw:
    return Draw(State(), gl.GL_TRIANGLES, vertices(count), np.arange(count), np.eye(4), np.eye(4), (), label="a")


def test_a_draw_equals_only_itself():
    one = draw(3)
    other = Draw._make(one)
    assert [one == each for each in (one, other)] == [True, False]  # tuples of arrays would raise an error
    assert [one != each for each in (one, other)] == [False, True]
    assert [other, one].index(one) == 1
    assert len({one, other, one.vertices, vertices(3)}) == 4


def test_draws_like_another_differ_in_vertices_and_indices_only():
    before, counts = draw(3), (4, 5)
    several, indices = [vertices(count) for count in counts], [np.arange(6), None]
    for like, each, own in zip(draws_like(before, several, indices), several, indices, strict=True):
        assert all(a is b for a, b in zip(like, before._replace(vertices=each, indices=own), strict=True))
    for like, each in zip(draws_like(before, several), several, strict=True):
        assert all(a is b for a, b in zip(like, before._replace(vertices=each), strict=True))


def test_files_have_all_fields_but_where_a_rectangle_is_shown():
    packer = Packer()
    packer.pack(draw(3)._replace(shown_at=(1, 2, 1, 1)))
    stored = dict(packer.objects)
    assert stored["Draw"].keys() == {*Draw._fields} - {"shown_at"}
    assert stored["Vertices"].keys() == {*Vertices._fields}
