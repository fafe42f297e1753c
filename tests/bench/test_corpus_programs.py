"""The programs of the corpus: each draws a picture, and the same one as Mesa."""

from functools import partial
from typing import Any

import numpy as np
import pytest

from softshadow.bench.corpus.programs import EVERY, PROGRAMS, get
from softshadow.testing import compare, run_here

SIZE = (64, 48)
FRAMES = 2  # the second one finds the state that the first one has left


def draw(gl: Any, name: str) -> None:
    """Draw the first frames of a program."""
    get(name).resized(SIZE).frames(gl, FRAMES)


@pytest.mark.thin(3)
@pytest.mark.mesa
@pytest.mark.parametrize("name", EVERY)
def test_program_draws_the_same_picture_as_mesa(name: str) -> None:
    comparison = compare(partial(draw, name=name), SIZE)
    assert comparison, comparison
    color = comparison.ours.color.reshape(-1, 4)
    _, pixels = np.unique(color, axis=0, return_counts=True)
    assert pixels.max() < 0.97 * len(color), "hardly anything but the background"


def test_frames_of_a_program_differ() -> None:
    one, two = (run_here(partial(get("turning-cubes").frames, count=count), (640, 480)) for count in (1, 2))
    assert (one.color != two.color).any()


def test_programs_have_titles_and_there_are_enough() -> None:
    assert len(PROGRAMS) >= 24
    assert all(program.title and program.name == name for name, program in EVERY.items())


def test_an_unknown_program_names_the_nearest() -> None:
    with pytest.raises(ValueError, match="did you mean 'chess-board'"):
        get("ches-board")
