"""Every function, called correctly, wrongly, and between glBegin and glEnd, has Mesa's error codes."""

import inspect
from typing import Any

import numpy as np
import pytest

from gl.facade_calls import CALLS, NAMED_AGAIN, World, attempts, prepare
from gl.gl_state import same, state_of
from gl.more_facade_calls import OF_GLU
from softshadow import gl
from softshadow.gl.typed_images import TYPED_CALLS
from softshadow.testing import run_on_mesa, stop_workers

SIZE = (16, 12)
GROUPS = 13  # each a program of its own on Mesa
NAMES = sorted(CALLS)


@pytest.fixture(autouse=True)
def own_process() -> None:
    """Start a process of Mesa for each test: wrong calls can make it crash, depending on what it drew before."""
    stop_workers()


def attempt(namespace: Any, world: World, name: str, arguments: tuple[Any, ...]) -> str:
    """Make a call; what never gets to GL, as an argument of the wrong kind, is answered by the name of the error."""
    try:
        getattr(namespace, name)(*world.values(namespace, arguments))
    except Exception as error:
        return "" if isinstance(getattr(error, "err", None), int) else type(error).__name__
    return ""


def undo(namespace: Any) -> None:
    """End what a call may have begun, and bind nothing."""
    for name, arguments in (
        ("glEnd", ()), ("glEndList", ()), ("glEndQuery", ("GL_SAMPLES_PASSED",)),
        ("glEndConditionalRender", ()), ("glUseProgram", (0,)),
        ("glBindFramebuffer", ("GL_FRAMEBUFFER", 0)), ("glBindBuffer", ("GL_ARRAY_BUFFER", 0)),
        ("glBindBuffer", ("GL_ELEMENT_ARRAY_BUFFER", 0)),
    ):  # fmt: skip
        attempt(namespace, World({}), name, arguments)
        namespace.glGetError()


def codes_and_state(namespace: Any, names: list[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The error code of every attempt at the calls, and all state at the end."""
    codes: dict[str, Any] = {}
    for name in names:
        world = prepare(namespace)
        for arguments in attempts(name):
            if name.startswith("glUniform"):
                namespace.glUseProgram(world.names["@program"])
            if name.startswith(("glBuffer", "glGetBuffer")):
                namespace.glBindBuffer(namespace.GL_ELEMENT_ARRAY_BUFFER, world.names["@buffer"])
            refused = attempt(namespace, world, name, arguments)
            codes[f"{name}{arguments[:8]!r}"] = refused or int(namespace.glGetError())
            undo(namespace)
        attempt(namespace, world, "glDeleteTextures", (1, ["@texture"]))
    return codes, state_of(namespace)


def codes_inside(namespace: Any, names: list[str]) -> dict[str, int]:
    """The error code of every right call between glBegin and glEnd."""
    world, codes = prepare(namespace), {}
    for name in names:
        namespace.glBegin(namespace.GL_TRIANGLES)
        attempt(namespace, world, name, CALLS[name])
        attempt(namespace, world, "glEnd", ())
        codes[name] = int(namespace.glGetError())
        undo(namespace)
    return codes


def test_every_function_is_called() -> None:
    functions = {name for name in dir(gl) if name.startswith("gl") and inspect.isroutine(getattr(gl, name))}
    typed = TYPED_CALLS.keys()  # see mesa/test_typed_images.py
    assert functions - typed == CALLS.keys() | NAMED_AGAIN.keys() | OF_GLU
    assert all(getattr(gl, name) is getattr(gl, first) for name, first in NAMED_AGAIN.items())


@pytest.mark.thin(2)
@pytest.mark.mesa
@pytest.mark.parametrize("group", range(GROUPS))
def test_error_codes_and_state_of_all_attempts_are_those_of_mesa(group: int) -> None:
    names = NAMES[group::GROUPS]
    with gl.create_context(*SIZE):
        our_codes, ours = codes_and_state(gl, names)
    their_codes, theirs = run_on_mesa(lambda namespace: codes_and_state(namespace, names), SIZE).returned
    reached = {call: code for call, code in their_codes.items() if isinstance(code, int)}
    assert {call: our_codes[call] for call in reached} == reached
    assert len(reached) > 0.7 * len(their_codes)
    assert [(name, ours[name], theirs[name]) for name in ours if not same(ours[name], theirs[name])] == []


@pytest.mark.mesa
def test_calls_inside_a_primitive_have_mesas_error_codes() -> None:
    with gl.create_context(*SIZE, raise_errors=False):
        ours = codes_inside(gl, NAMES)
    assert ours == run_on_mesa(lambda namespace: codes_inside(namespace, NAMES), SIZE, raise_errors=False).returned


@pytest.mark.parametrize("group", range(GROUPS))
def test_a_refused_attempt_changes_nothing(group: int) -> None:
    with gl.create_context(*SIZE) as context:
        for name in NAMES[group::GROUPS]:
            world = prepare(gl)
            for arguments in attempts(name):
                before = (context.state, len(context.frame.commands), dict(context.names), repr(context.current))
                stacks = [np.array(stack[-1]) for stack in (context.modelview_stack, context.projection_stack)]
                attempt(gl, world, name, arguments)
                if gl.glGetError():
                    after = (context.state, len(context.frame.commands), dict(context.names), repr(context.current))
                    assert after == before, (name, arguments)
                    assert all(map(np.array_equal, stacks, (context.modelview_stack[-1], context.projection_stack[-1])))
                undo(gl)
