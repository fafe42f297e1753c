"""Pixels that changed between two steps, and the differences of two visibilities."""

import numpy as np
import pytest

from inspection.recorded_frames import random_frame
from softshadow.inspection import Buffers, Replay, compare, difference

pytestmark = pytest.mark.interpreted


def test_a_step_does_not_differ_from_itself():
    buffers = Replay(random_frame(5).frame).after_step(2)
    assert difference(buffers, buffers).counts == {"image": 0, "depth": 0, "stencil": 0}


def test_changed_pixels_are_found_in_their_buffer():
    before = Buffers(np.zeros((3, 4, 4), np.uint8), np.ones((3, 4), np.float32), np.zeros((3, 4), np.uint8))
    after = Buffers(*(buffer.copy() for buffer in before))
    after.color[0, 1, 2] = 9
    after.stencil[2, 3] = 1
    changed = difference(before, after)
    assert changed.counts == {"image": 1, "depth": 0, "stencil": 1}
    assert np.argwhere(changed.any).tolist() == [[0, 1], [2, 3]]


def halves() -> np.ndarray:
    visibility = np.ones((8, 10), np.float32)
    visibility[:, 5:] = 0
    return visibility


def test_errors_are_told_apart_by_where_they_are():
    reference, everywhere = halves(), np.ones((8, 10), bool)
    wrong = reference.copy()
    wrong[0, 0], wrong[1, 8], wrong[2, 4] = 0.5, 1, 0
    comparison = compare(wrong, everywhere, reference, everywhere, "halves")
    assert {name: part.wrong for name, part in comparison.parts.items()} == {
        "all": 3, "lit": 1, "umbra": 1, "penumbra": 0, "band": 1,
    }  # fmt: skip
    assert (comparison.max, comparison.error[0, 0], comparison.error[1, 8]) == (1, -0.5, 1)
    assert comparison.rms == pytest.approx(np.sqrt((0.25 + 1 + 1) / 80))


def test_pixels_that_one_side_does_not_know_are_left_out():
    reference, known = halves(), np.ones((8, 10), bool)
    known[:, 0] = False
    comparison = compare(1 - reference, known, reference, np.ones((8, 10), bool), "halves")
    assert not comparison.compared[:, 0].any()
    assert comparison.parts["all"].pixels == 72
    assert not comparison.error[:, 0].any()
