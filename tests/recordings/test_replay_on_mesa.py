"""A recorded C program, replayed: colour, depth and stencil are those of Mesa for the same calls."""

import numpy as np
import pytest

import softshadow as ss
from paths import TRACE
from recordings.played_calls import program_of
from softshadow.recordings.replaying import frames_of
from softshadow.testing.mesa import run_on_mesa

pytestmark = pytest.mark.mesa
LARGEST = (1 << 24) - 1


@pytest.mark.parametrize("frame", range(4))
def test_every_pixel_of_a_frame_equals_that_of_mesa(frame: int) -> None:
    run = ss.replay(TRACE, frame)
    theirs = run_on_mesa(program_of(TRACE, frames_of(TRACE).frames[frame].last), run.size)
    np.testing.assert_array_equal(run.image, theirs.color[::-1, :, :3])
    np.testing.assert_array_equal(np.rint(run.depth.astype(np.float64) * LARGEST), theirs.depth[::-1])
    np.testing.assert_array_equal(run.stencil, theirs.stencil[::-1])
