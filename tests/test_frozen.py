"""Copies with other values are those of `dataclasses.replace`."""

import dataclasses

import pytest

from softshadow import frozen
from softshadow.state import Depth, State


def test_a_copy_is_that_of_the_standard_library():
    for values in ({}, {"depth": Depth(enabled=True)}, {"program": 3, "depth": Depth(clear=0.5)}):
        before = State()
        copy = frozen.evolve(before, **values)
        assert copy == dataclasses.replace(before, **values)
        assert hash(copy) == hash(dataclasses.replace(before, **values))
        assert before == State()


def test_a_copy_cannot_be_changed_either():
    with pytest.raises(dataclasses.FrozenInstanceError):
        frozen.evolve(State(), program=1).program = 2


def test_an_unknown_field_is_told():
    with pytest.raises(TypeError, match="Depth has no field bias"):
        frozen.evolve(Depth(), func=3, bias=1)


def test_a_copy_with_the_fields_of_a_known_value_is_that_value():
    goal, before = Depth(clear=0.5), Depth()
    assert frozen.evolve_to(goal, before, clear=goal.clear) is goal
    assert frozen.evolve_to(goal, before, clear=before.clear) is before
    assert frozen.evolve_to(goal, Depth(clear=goal.clear)) is goal
    negative = frozen.evolve_to(Depth(clear=0.0), before, clear=-0.0)
    assert str(negative.clear) == "-0.0"
