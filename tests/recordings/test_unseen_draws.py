"""Draws of earlier frames that nothing can see are not carried out: the chosen frame is the same without that."""

import random
from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from conftest import ALL_LANES
from recordings.traced_program import TracedProgram
from softshadow import gl
from softshadow.context.command_stream import CommandStream
from softshadow.recordings import unseen_draws
from softshadow.recordings.unseen_draws import UnseenDraws

BITS = (gl.GL_COLOR_BUFFER_BIT, gl.GL_DEPTH_BUFFER_BIT, gl.GL_STENCIL_BUFFER_BIT)


def random_program(seed: int) -> TracedProgram:
    """Return frames that clear parts of the window or all of it, under masks, and copy it to a texture and back."""
    dice, traced = random.Random(seed), TracedProgram()
    traced.glBindTexture(gl.GL_TEXTURE_2D, 1)
    traced.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    traced.glStencilFunc(gl.GL_ALWAYS, 1, 255)
    traced.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_INCR)
    for _ in range(dice.randint(2, 4)):
        for _ in range(dice.randint(0, 5)):
            (traced.glEnable if dice.random() < 0.4 else traced.glDisable)(
                dice.choice((gl.GL_DEPTH_TEST, gl.GL_STENCIL_TEST, gl.GL_SCISSOR_TEST, gl.GL_BLEND, gl.GL_TEXTURE_2D))
            )
        match dice.randrange(7):
            case 0:
                traced.glColorMask(*(dice.random() < 0.8 for _ in range(4)))
            case 1:
                traced.glDepthMask(dice.random() < 0.7)
            case 2:
                traced.glScissor(0, 0, dice.choice((5, 16)), dice.choice((5, 12)))
            case 3:
                traced.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 0, 0, 8, 8, 0)
            case 4:
                traced.glDrawBuffer(dice.choice((gl.GL_NONE, gl.GL_BACK, gl.GL_FRONT)))
            case 5:
                traced.glTexImage2D(
                    gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, dice.randbytes(16)
                )
        if dice.random() < 0.8:
            traced.glClear(sum(bit for bit in BITS if dice.random() < 0.8))
        for _ in range(dice.randint(0, 3)):
            traced.glColor4f(*(dice.random() for _ in range(4)))
            traced.glTexCoord2f(dice.random(), dice.random())
            traced.triangle(*((dice.uniform(-1.5, 1.5), dice.uniform(-1.5, 1.5)) for _ in range(3)))
        traced.swap()
    return traced


@pytest.mark.parametrize("seed", range(300 if ALL_LANES else 25))
def test_the_chosen_frame_does_not_depend_on_it(tmp_path: Path, seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    path = random_program(seed).save(tmp_path)
    fast = ss.replay(path, -1)
    monkeypatch.setattr(UnseenDraws, "takes", lambda *_: False)
    slow = ss.replay(path, -1)
    for name in ("image", "depth", "stencil"):
        np.testing.assert_array_equal(getattr(fast, name), getattr(slow, name), name)


def cleared_program(n_frames: int) -> TracedProgram:
    traced = TracedProgram()
    for _ in range(n_frames):
        traced.glClear(BITS[0] | BITS[1])
        traced.triangle()
        traced.swap()
    return traced


def test_frames_before_a_clear_are_not_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    carried_out: list[int] = []
    carry_out = CommandStream.carry_out_kept
    monkeypatch.setattr(
        CommandStream,
        "carry_out_kept",
        lambda self, commands: (carried_out.append(len(commands)), carry_out(self, commands)),
    )
    ss.replay(cleared_program(6).save(tmp_path), -1)
    assert carried_out == [2]  # of the last frame before the chosen one, which does not know that it will be cleared


def test_what_waits_is_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unseen_draws, "MOST_COMMANDS", 10)
    traced = TracedProgram()
    for _ in range(50):
        traced.triangle()
    traced.swap()
    traced.triangle((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
    run = ss.replay(traced.save(tmp_path), 1)
    assert run.image.min() == 255
