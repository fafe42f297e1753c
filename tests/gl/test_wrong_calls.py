"""Refused calls have Mesa's error codes and change nothing."""

from typing import Any

import numpy as np
import pytest

from gl.wrong_calls import WRONG_CALLS, prepare
from softshadow import gl
from softshadow.context import Context
from softshadow.testing import run_on_mesa

SIZE = (8, 8)


def error_codes(gl: Any) -> dict[str, int]:
    """The error code of every wrong call, each in the same world."""
    world, codes = prepare(gl), {}
    for name, call in WRONG_CALLS.items():
        call(world)
        codes[name] = int(gl.glGetError())
        bind_nothing(gl)
    return codes


def bind_nothing(gl: Any) -> None:
    """Undo the bindings that some of the wrong calls need."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glUseProgram(0)


def changeable(context: Context) -> dict[str, Any]:
    """Everything that a call can change, comparable with ==."""
    storage = context.storage
    return {
        "state": context.state,
        "unit": context.active_unit,
        "stores": (context.pack_store, context.unpack_store),
        "names": dict(context.names),
        "uniforms": {k: {n: np.asarray(v).tolist() for n, v in u.items()} for k, u in context.uniforms.items()},
        "commands": len(context.frame.commands),
        "textures": {name: (t.sampler, sorted(t.images)) for name, t in storage.textures.items()},
        "texels": [i.cells.tobytes() for t in storage.textures.values() for i in t.images.values()],
        "framebuffers": {
            name: (f.attachments, f.draw_buffers, f.read_buffer) for name, f in storage.framebuffers.items()
        },
        "pixels": [a.image.cells.tobytes() for f in storage.framebuffers.values() for a in f.attachments.values()],
    }


@pytest.mark.mesa
def test_error_codes_are_mesas():
    with gl.create_context(*SIZE, raise_errors=False):
        ours = error_codes(gl)
    assert ours == run_on_mesa(error_codes, SIZE, raise_errors=False).returned
    assert gl.GL_NO_ERROR not in ours.values()


@pytest.mark.parametrize("name", WRONG_CALLS)
def test_a_refused_call_changes_nothing(name):
    with gl.create_context(*SIZE, raise_errors=False) as context:
        world = prepare(gl)
        before = changeable(context)
        WRONG_CALLS[name](world)
        assert context.error != gl.GL_NO_ERROR
        bind_nothing(gl)
        assert changeable(context) == before


@pytest.mark.parametrize("name", WRONG_CALLS)
def test_a_refused_call_raises_and_says_what_was_expected(name):
    with gl.create_context(*SIZE) as context:
        world = prepare(gl)
        with pytest.raises(gl.GLError, match=r"^GL_INVALID_\w+: gl\w+[(:]") as raised:
            WRONG_CALLS[name](world)
        assert raised.value.err == context.error
