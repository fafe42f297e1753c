"""Occlusion queries: the number of fragments that pass all tests."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, is_one_of, outside_begin
from softshadow.gl.names import generate, names_argument, reserve
from softshadow.pipeline.commands import BeginQuery

TARGETS = (gl.GL_SAMPLES_PASSED, gl.GL_ANY_SAMPLES_PASSED)
A_TARGET = "GL_SAMPLES_PASSED or GL_ANY_SAMPLES_PASSED"
COUNTER_BITS = {gl.GL_SAMPLES_PASSED: 64, gl.GL_ANY_SAMPLES_PASSED: 1}


def glGenQueries(n: int, ids: Any = None) -> Any:
    """Return unused query names: an int for n = 1, else an array."""
    return generate("glGenQueries", "query", n, ids)


def glDeleteQueries(*arguments: Any) -> None:
    """Delete queries: (name), (names) or (n, names). An active one is ended first."""
    context = outside_begin("glDeleteQueries")
    if context is None:
        return
    for name in names_argument("glDeleteQueries", arguments):
        if name and name == context.objects.active_query:
            context.execute(BeginQuery(0))
        context.query_targets.pop(name, None)


def glIsQuery(id: int) -> bool | None:
    """Return whether a query of this name exists; the first glBeginQuery creates it."""
    context = outside_begin("glIsQuery")
    return None if context is None else int(id) in context.query_targets


@in_lists
def glBeginQuery(target: int, id: int) -> None:
    """Begin to count the fragments that pass; with GL_ANY_SAMPLES_PASSED, only whether any pass."""
    context, name = outside_begin("glBeginQuery"), int(id)
    if context is None or not is_one_of("glBeginQuery", "target", target, TARGETS, A_TARGET):
        return
    if context.objects.active_query:
        fail(gl.GL_INVALID_OPERATION, "glBeginQuery", f"query {context.objects.active_query} has not been ended")
    elif name <= 0:
        fail(gl.GL_INVALID_OPERATION, "glBeginQuery", f"id={id}: expected a name from glGenQueries")
    elif context.query_targets.get(name, target) != target:
        fail(gl.GL_INVALID_OPERATION, "glBeginQuery", f"id={id}: expected a query of this target")
    else:
        reserve(context, "query", name)
        context.query_targets[name] = int(target)
        context.execute(BeginQuery(name))


@in_lists
def glEndQuery(target: int) -> None:
    """End the active query."""
    context = outside_begin("glEndQuery")
    if context is None or not is_one_of("glEndQuery", "target", target, TARGETS, A_TARGET):
        return
    active = context.objects.active_query
    if not active or context.query_targets[active] != target:
        fail(gl.GL_INVALID_OPERATION, "glEndQuery", "there was no glBeginQuery with this target before it")
    else:
        context.execute(BeginQuery(0))


def glGetQueryiv(target: int, pname: int, params: Any = None) -> Any:
    """Return the active query of a target, or the number of bits of its counter."""
    context = outside_begin("glGetQueryiv")
    if context is None or not is_one_of("glGetQueryiv", "target", target, TARGETS, A_TARGET):
        return None
    active = context.objects.active_query
    current = active if active and context.query_targets[active] == target else 0
    answers = {gl.GL_CURRENT_QUERY: current, gl.GL_QUERY_COUNTER_BITS: COUNTER_BITS[int(target)]}
    expected = "GL_CURRENT_QUERY or GL_QUERY_COUNTER_BITS"
    if not is_one_of("glGetQueryiv", "pname", pname, answers, expected):
        return None
    return _answer(answers[pname], params)


def glGetQueryObjectiv(id: int, pname: int, params: Any = None) -> Any:
    """Return the result of an ended query: the number of fragments, or whether any passed."""
    return _result("glGetQueryObjectiv", id, pname, params)


def glGetQueryObjectuiv(id: int, pname: int, params: Any = None) -> Any:
    """Return the result of an ended query: the number of fragments, or whether any passed."""
    return _result("glGetQueryObjectuiv", id, pname, params)


def _result(operation: str, id: int, pname: int, params: Any) -> Any:
    context, name = outside_begin(operation), int(id)
    if context is None:
        return None
    if name not in context.query_targets or name == context.objects.active_query:
        return fail(gl.GL_INVALID_OPERATION, operation, f"id={id}: expected a query that has been ended")
    n_passed = context.stream.passed_fragments(name)
    any_passed = context.query_targets[name] == gl.GL_ANY_SAMPLES_PASSED
    answers = {gl.GL_QUERY_RESULT: min(n_passed, 1) if any_passed else n_passed, gl.GL_QUERY_RESULT_AVAILABLE: 1}
    if not is_one_of(operation, "pname", pname, answers, "GL_QUERY_RESULT or GL_QUERY_RESULT_AVAILABLE"):
        return None
    return _answer(answers[pname], params)


def _answer(value: int, params: Any) -> int:
    if params is not None:
        np.asarray(params)[:1] = value
    return value


__all__ = spelled_like_gl(globals())
