"""Which context is current: a new one, and after a with statement the one before it; nobody keeps all earlier ones."""

import gc
import weakref

import pytest

from softshadow import gl
from softshadow.context import Context, make_current, thread


@pytest.fixture(autouse=True)
def _none_before():
    before = make_current(None)
    yield
    make_current(before)


def current() -> Context | None:
    return thread.context or None


def test_contexts_that_follow_each_other_are_freed():
    made = []
    for _ in range(10):
        made.append(weakref.ref(gl.create_context(4, 4)))
        gl.glRectf(0, 0, 1, 1)
        gl.glFinish()
    gc.collect()
    assert [made.index(each) for each in made if each() is not None] == [8, 9]  # a with statement could return to 8


def test_a_with_statement_restores_the_context_before_a_new_one():
    first = gl.create_context(4, 4)
    with gl.create_context(4, 4) as second:
        assert current() is second
        gl.create_context(4, 4)
        gl.create_context(4, 4)
    assert current() is first


def test_a_with_statement_restores_what_was_current_when_it_began():
    first = gl.create_context(4, 4)
    second = gl.create_context(4, 4)
    with first:
        assert current() is first
        with second:
            with first:
                assert current() is first
            assert current() is second
        with first:
            pass
        assert current() is first
    assert current() is second


def test_the_first_context_leaves_none():
    with gl.create_context(4, 4) as context:
        with context:
            pass
        assert current() is context
    assert current() is None
    with context:
        assert current() is context
    assert current() is None
