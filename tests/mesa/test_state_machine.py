"""Any sequence of calls, right or wrong, answers here what it answers on Mesa: every error code and every query.

The machine collects calls as data, with a model of the stacks and objects that says which calls are interesting next;
when it ends, the calls run on both sides, each followed by glGetError, and all answers are compared.
"""

from typing import Any

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, precondition, rule

from gl.gl_state import CAPABILITIES, NAMES, same, state_of
from mesa.gl_calls import Call, as_code
from softshadow import gl
from softshadow.testing import run_on_mesa
from strategies import ATTRIBUTE_BITS, state_calls

SIZE = (10, 8)
GETTERS = ("glGetFloatv", "glGetIntegerv", "glGetBooleanv", "glGetDoublev")
STACKS = ("GL_MODELVIEW", "GL_PROJECTION", "GL_TEXTURE")
KINDS = {  # how objects are made, bound, deleted and asked for
    kind: (f"glGen{kind}s", f"glBind{kind}", f"glDelete{kind}s", f"glIs{kind}", target)
    for kind, target in (
        ("Texture", "GL_TEXTURE_2D"),
        ("Framebuffer", "GL_FRAMEBUFFER"),
        ("Renderbuffer", "GL_RENDERBUFFER"),
    )
}
BINDINGS = ("GL_TEXTURE_BINDING_2D", "GL_DRAW_FRAMEBUFFER_BINDING", "GL_RENDERBUFFER_BINDING")
WRAPS = ("GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_MIRRORED_REPEAT", "GL_LESS")
FILTERS = ("GL_NEAREST", "GL_LINEAR", "GL_NEAREST_MIPMAP_LINEAR", "GL_CW")


def answers_of(namespace: Any, calls: list[Call]) -> list[Any]:
    """Make the calls, tokens by name, and return (answer, error code) of each; an answer is None after an error."""
    answers = []
    for name, arguments in calls:
        values = [getattr(namespace, a) if isinstance(a, str) else a for a in arguments]
        try:
            answer = getattr(namespace, name)(*values)
        except Exception as error:
            if not hasattr(error, "err"):
                raise
            answer = None
        code = int(namespace.glGetError())
        reads = name.startswith(("glGet", "glIs", "glGen", "glCheck")) and code == 0
        answers.append((np.array(answer).ravel() if reads else None, code))
    return answers


def compare_answers(calls: list[Call]) -> None:
    """Assert that all answers, error codes and the whole state at the end are those of Mesa."""

    def program(namespace: Any) -> Any:
        return answers_of(namespace, calls), state_of(namespace)

    with gl.create_context(*SIZE):
        ours, our_state = program(gl)
    theirs, their_state = run_on_mesa(program, SIZE).returned
    for number, (mine, other) in enumerate(zip(ours, theirs, strict=True)):
        agree = mine[1] == other[1] and (mine[0] is None or same(mine[0], other[0]))
        assert agree, f"here {mine}, on Mesa {other}: the last call of\n{as_code(calls[: number + 1])}"
    differing = [
        (name, our_state[name], their_state[name]) for name in our_state if not same(our_state[name], their_state[name])
    ]
    assert differing == [], as_code(calls)


class Facade(RuleBasedStateMachine):
    """Set, get, push, pop, make, bind and delete, in any order, within the stacks' depths and beyond."""

    def __init__(self) -> None:
        super().__init__()
        self.calls: list[Call] = []
        self.pushed = 0

    def call(self, name: str, *arguments: Any) -> None:
        self.calls.append((name, arguments))

    @initialize(kind=st.sampled_from(sorted(KINDS)))
    def make_objects(self, kind: str) -> None:
        self.call(KINDS[kind][0], 3)

    @rule(calls=state_calls())
    def set_state(self, calls: list[Call]) -> None:
        # the attribute stack has rules of its own
        self.calls += [call for call in calls[:4] if "Attrib" not in call[0]]

    @rule(name=st.sampled_from(NAMES), getter=st.sampled_from(GETTERS))
    def get(self, name: str, getter: str) -> None:
        self.call(getter, name)

    @rule(name=st.sampled_from(CAPABILITIES))
    def ask_capability(self, name: str) -> None:
        self.call("glIsEnabled", name)

    @rule(stack=st.sampled_from(STACKS), times=st.sampled_from([1, 1, 2, 12, 35]))
    def push_matrix(self, stack: str, times: int) -> None:
        self.call("glMatrixMode", stack)
        for _ in range(times):
            self.call("glPushMatrix")
        self.call("glGetIntegerv", f"{stack}_STACK_DEPTH")

    @rule(stack=st.sampled_from(STACKS), times=st.sampled_from([1, 2, 12]))
    def pop_matrix(self, stack: str, times: int) -> None:
        self.call("glMatrixMode", stack)
        for _ in range(times):
            self.call("glPopMatrix")
        self.call("glGetFloatv", f"{stack}_MATRIX")

    @rule(bits=st.sampled_from(ATTRIBUTE_BITS))
    def push_attributes(self, bits: str) -> None:
        self.call("glPushAttrib", bits)
        self.pushed += 1

    @precondition(lambda self: self.pushed > 0)
    @rule()
    def pop_attributes(self) -> None:
        self.call("glPopAttrib")
        self.pushed -= 1

    @rule()
    def pop_more_attributes_than_were_pushed(self) -> None:
        for _ in range(self.pushed + 1):
            self.call("glPopAttrib")
        self.pushed = 0

    @rule(kind=st.sampled_from(sorted(KINDS)), count=st.integers(1, 3))
    def generate(self, kind: str, count: int) -> None:
        self.call(KINDS[kind][0], count)

    @rule(kind=st.sampled_from(sorted(KINDS)), name=st.integers(0, 4))
    def bind(self, kind: str, name: int) -> None:
        _, bind, _, ask, target = KINDS[kind]
        self.call(bind, target, name)
        self.call(ask, name)
        for binding in BINDINGS:
            self.call("glGetIntegerv", binding)

    @rule(kind=st.sampled_from(sorted(KINDS)), name=st.integers(0, 5))
    def delete(self, kind: str, name: int) -> None:
        _, _, delete, ask, _ = KINDS[kind]
        self.call(delete, 1, [name])
        self.call(ask, name)
        for binding in BINDINGS:
            self.call("glGetIntegerv", binding)

    @rule(side=st.sampled_from(["GL_TEXTURE_WRAP_S", "GL_TEXTURE_WRAP_T"]), wrap=st.sampled_from(WRAPS))
    def set_wrap(self, side: str, wrap: str) -> None:
        self.call("glTexParameteri", "GL_TEXTURE_2D", side, wrap)
        self.call("glGetTexParameteriv", "GL_TEXTURE_2D", side)

    @rule(
        side=st.sampled_from(["GL_TEXTURE_MIN_FILTER", "GL_TEXTURE_MAG_FILTER"]),
        texture_filter=st.sampled_from(FILTERS),
    )
    def set_filter(self, side: str, texture_filter: str) -> None:
        self.call("glTexParameteri", "GL_TEXTURE_2D", side, texture_filter)
        self.call("glGetTexParameteriv", "GL_TEXTURE_2D", side)

    @rule()
    def ask_completeness(self) -> None:
        self.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")

    def teardown(self) -> None:
        if self.calls:
            compare_answers(self.calls)


TestFacadeIsMesas = Facade.TestCase
TestFacadeIsMesas.settings = settings(max_examples=40, stateful_step_count=25, derandomize=True)
TestFacadeIsMesas.pytestmark = [pytest.mark.mesa]
