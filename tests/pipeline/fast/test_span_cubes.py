"""Directions hit the same places of the same faces as in the textbook, also infinite ones, zeros and NaN."""

from itertools import product

import numpy as np
import pytest

from softshadow.pipeline.fast.fragment_block import SIZE, R, S, T, block_memory
from softshadow.pipeline.fast.span_cubes import FACE, project_onto_faces_of_block
from softshadow.programs.cube_maps import on_faces

SPECIAL = np.float32([0.0, -0.0, 1.0, -1.0, 0.3, -7e-42, 3e38, np.inf, -np.inf, np.nan, -np.nan])


@pytest.mark.interpreted
@pytest.mark.parametrize("by_reciprocal", [False, True])
def test_directions_hit_the_places_of_the_textbook(by_reciprocal):
    directions = np.concatenate(
        [
            np.array(list(product(SPECIAL, repeat=3)), np.float32),
            np.random.default_rng(1).normal(0, 1, (500, 3)).astype(np.float32),
        ]
    )
    faces, places = on_faces(directions, by_reciprocal)
    room, whole = block_memory.arrays[:2]
    for first in range(0, len(directions), SIZE):
        part = slice(first, first + SIZE)
        count = len(directions[part])
        for c, row in enumerate((S, T, R)):
            room[int(row) : int(row) + count] = directions[part, c]
        with np.errstate(all="ignore"):
            project_onto_faces_of_block(by_reciprocal, count, room, whole)
        assert np.array_equal(whole[int(FACE) : int(FACE) + count], faces[part])
        for c, row in enumerate((S, T)):
            assert np.array_equal(room[int(row) : int(row) + count], places[part, c], equal_nan=True)
