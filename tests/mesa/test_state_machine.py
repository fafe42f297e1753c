"""Any sequence of calls, right or wrong, gives the error codes and query results of Mesa.

The state machine collects calls as data; its model of stacks and objects chooses which calls are interesting next. At
the end the calls run on both sides, each followed by glGetError, and all results are compared.
"""

from typing import Any

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import precondition, rule

from gl.gl_state import CAPABILITIES, NAMES, same, state_of
from mesa.gl_calls import Call, as_code
from mesa.object_rules import ObjectRules
from softshadow import gl
from softshadow.testing import run_on_mesa, stop_workers
from strategies import ATTRIBUTE_BITS, state_calls

SIZE = (10, 8)
GETTERS = ("glGetFloatv", "glGetIntegerv", "glGetBooleanv", "glGetDoublev")
STACKS = ("GL_MODELVIEW", "GL_PROJECTION", "GL_TEXTURE")
STORES = ("GL_PACK_ALIGNMENT", "GL_UNPACK_ALIGNMENT", "GL_PACK_ROW_LENGTH", "GL_UNPACK_SKIP_ROWS", "GL_LESS")
DRAWS: tuple[Call, ...] = (
    ("glClear", ("GL_COLOR_BUFFER_BIT",)), ("glClear", ("GL_DEPTH_BUFFER_BIT",)), ("glClear", (0x40000000,)),
    ("glEnd", ()), ("glFinish", ()), ("glBegin", ("GL_LESS",)),
    ("glDrawArrays", ("GL_LESS", 0, 3)), ("glDrawArrays", ("GL_LINES", 0, -1)),
    ("glBlitFramebuffer", (0, 0, 4, 4, 0, 0, 4, 4, "GL_COLOR_BUFFER_BIT", "GL_NEAREST")),
    ("glBlitFramebuffer", (0, 0, 4, 4, 0, 0, 4, 4, "GL_DEPTH_BUFFER_BIT", "GL_LINEAR")),
    ("glCopyTexSubImage2D", ("GL_TEXTURE_2D", 0, 0, 0, 0, 0, 2, 2)),
)  # fmt: skip
BEGUN: tuple[Call, ...] = (  # between glBegin and glEnd: allowed, not allowed, or wrong in itself
    ("glColor3f", (0.5, 0.25, 1.0)), ("glVertex2f", (0.5, 0.5)), ("glNormal3f", (1.0, 0.0, 0.0)),
    ("glMaterialf", ("GL_FRONT", "GL_SHININESS", 200.0)), ("glMaterialf", ("GL_LESS", "GL_SHININESS", 2.0)),
    ("glMultiTexCoord2f", ("GL_TEXTURE1", 0.5, 0.5)), ("glCallList", (0,)), ("glCallList", (1,)),
    ("glEnable", ("GL_BLEND",)), ("glEnable", ("GL_LESS",)), ("glBegin", ("GL_LESS",)), ("glBegin", ("GL_LINES",)),
    ("glFogf", ("GL_LESS", 1.0)), ("glLightf", ("GL_LIGHT0", "GL_LESS", 1.0)), ("glLightModelf", ("GL_LESS", 1.0)),
    ("glGetTexGeniv", ("GL_LESS", "GL_TEXTURE_GEN_MODE")), ("glCheckFramebufferStatus", ("GL_LESS",)),
    ("glGenTextures", (1,)),
    ("glNewList", (1, "GL_COMPILE")), ("glEndList", ()), ("glPushMatrix", ()), ("glPopAttrib", ()),
    ("glBindTexture", ("GL_TEXTURE_2D", 1)), ("glGetFloatv", ("GL_LESS",)), ("glIsEnabled", ("GL_LESS",)),
    ("glBeginQuery", ("GL_SAMPLES_PASSED", 1)), ("glDrawArrays", ("GL_LINES", 0, -1)), ("glFinish", ()),
)  # fmt: skip


def drawable(namespace: Any) -> bool:
    """Return whether the draw framebuffer is complete; otherwise the number of its bits is undefined."""
    status = namespace.glCheckFramebufferStatus(namespace.GL_DRAW_FRAMEBUFFER)
    return bool(status == namespace.GL_FRAMEBUFFER_COMPLETE)


def answers_of(namespace: Any, calls: list[Call]) -> list[Any]:
    """Make the calls, tokens by name, and return (answer, error code) of each; an answer is None after an error.

    Between glBegin and glEnd, glGetError itself would be an error; so the first code is read after glEnd.
    """
    answers, begun = [], False
    for name, arguments in calls:
        values = [getattr(namespace, a) if isinstance(a, str) else a for a in arguments]
        try:
            answer = getattr(namespace, name)(*values)
        except Exception as error:
            if not hasattr(error, "err"):
                raise
            answer = None
        begun = name == "glBegin" or (begun and name != "glEnd")
        code = 0 if begun else int(namespace.glGetError())
        reads = name.startswith(("glGet", "glIs", "glGen", "glCheck")) and code == 0 and not begun
        if reads and str(arguments[0]).endswith("_BITS"):
            reads = drawable(namespace)
        answers.append((np.array(answer).ravel() if reads else None, code))
    return answers


def compare_answers(calls: list[Call]) -> None:
    """Assert that all answers, error codes and the whole state at the end are those of Mesa."""

    def program(namespace: Any) -> Any:
        answers, known = answers_of(namespace, calls), drawable(namespace)
        return answers, {name: value for name, value in state_of(namespace).items() if known or "_BITS" not in name}

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


class Facade(ObjectRules):
    """Set, get, push, pop, make, bind and delete, in any order, within the stacks' depths and beyond."""

    def __init__(self) -> None:
        super().__init__()
        self.pushed = 0

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

    @rule(call=st.sampled_from(DRAWS))
    def draw(self, call: Call) -> None:
        self.calls.append(call)

    @precondition(lambda self: not self.compiling)  # Mesa 22.3 crashes on some wrong calls in half-open lists
    @rule(inside=st.lists(st.sampled_from(BEGUN), max_size=3))
    def begin_and_end(self, inside: list[Call]) -> None:
        self.calls += [("glBegin", ("GL_LINES",)), *inside, ("glEnd", ())]
        self.call("glGetFloatv", "GL_CURRENT_COLOR")

    @rule(name=st.sampled_from(STORES), value=st.sampled_from([0, 1, 2, 3, 4, 8, -1]))
    def set_pixel_store(self, name: str, value: int) -> None:
        self.call("glPixelStorei", name, value)
        self.call("glGetIntegerv", name)

    @rule(
        pname=st.sampled_from(["GL_TEXTURE_ENV_MODE", "GL_COMBINE_RGB", "GL_SOURCE1_RGB", "GL_OPERAND0_ALPHA"]),
        value=st.sampled_from(["GL_REPLACE", "GL_COMBINE", "GL_ADD", "GL_PREVIOUS", "GL_SRC_ALPHA", "GL_LESS"]),
    )
    def set_environment(self, pname: str, value: str) -> None:
        self.call("glTexEnvi", "GL_TEXTURE_ENV", pname, value)
        self.call("glGetTexEnviv", "GL_TEXTURE_ENV", pname)

    @rule(
        coordinate=st.sampled_from(["GL_S", "GL_Q", "GL_LESS"]),
        mode=st.sampled_from(["GL_OBJECT_LINEAR", "GL_EYE_LINEAR", "GL_LESS"]),
    )
    def set_generation(self, coordinate: str, mode: str) -> None:
        self.call("glTexGeni", coordinate, "GL_TEXTURE_GEN_MODE", mode)
        self.call("glGetTexGeniv", coordinate, "GL_TEXTURE_GEN_MODE")

    def teardown(self) -> None:
        if self.calls:
            compare_answers(self.calls)


@pytest.fixture
def own_process() -> None:
    """Start a process of Mesa: wrong calls can make it crash, depending on what it drew before."""
    stop_workers()


TestFacadeIsMesas = Facade.TestCase
TestFacadeIsMesas.settings = settings(max_examples=40, stateful_step_count=25, derandomize=True)
TestFacadeIsMesas.pytestmark = [pytest.mark.mesa, pytest.mark.usefixtures("own_process")]  # type: ignore[attr-defined]
