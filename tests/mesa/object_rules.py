"""Rules of the state machine that are about objects: textures, framebuffers, renderbuffers, queries and lists."""

from typing import Any

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule

from mesa.gl_calls import Call

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
FRAMEBUFFER_TARGETS = ("GL_FRAMEBUFFER", "GL_DRAW_FRAMEBUFFER", "GL_READ_FRAMEBUFFER", "GL_RENDERBUFFER")
POINTS = (
    "GL_COLOR_ATTACHMENT0", "GL_COLOR_ATTACHMENT1", "GL_COLOR_ATTACHMENT7", "GL_DEPTH_ATTACHMENT",
    "GL_STENCIL_ATTACHMENT", "GL_DEPTH_STENCIL_ATTACHMENT", "GL_BACK",
)  # fmt: skip
STORED = ("GL_RGBA8", "GL_RGBA32F", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F", "GL_LUMINANCE8", "GL_LESS")
BUFFERS = ("GL_NONE", "GL_FRONT", "GL_BACK", "GL_RIGHT", "GL_COLOR_ATTACHMENT0", "GL_COLOR_ATTACHMENT1", "GL_LESS")
QUERIES: dict[str, tuple[Any, ...]] = {  # the name of the query comes last where there is one
    "glBeginQuery": ("GL_SAMPLES_PASSED",), "glIsQuery": (), "glDeleteQueries": (1,),
}  # fmt: skip


class ObjectRules(RuleBasedStateMachine):
    """Make, bind, attach, fill, delete: names that are right or wrong."""

    def __init__(self) -> None:
        super().__init__()
        self.calls: list[Call] = []
        self.compiling = False

    def call(self, name: str, *arguments: Any) -> None:
        self.calls.append((name, arguments))

    @initialize(kind=st.sampled_from(sorted(KINDS)))
    def make_objects(self, kind: str) -> None:
        self.call(KINDS[kind][0], 3)

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

    # -- textures and framebuffers -------------------------------------------------------------------------------------
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

    @rule(
        bound=st.sampled_from(FRAMEBUFFER_TARGETS), point=st.sampled_from(POINTS), name=st.integers(0, 3),
        level=st.sampled_from([0, 0, 1, 20]),
    )  # fmt: skip
    def attach_texture(self, bound: str, point: str, name: int, level: int) -> None:
        self.call("glFramebufferTexture2D", bound, point, "GL_TEXTURE_2D", name, level)
        self.call("glCheckFramebufferStatus", bound)

    @rule(bound=st.sampled_from(FRAMEBUFFER_TARGETS), point=st.sampled_from(POINTS), name=st.integers(0, 3))
    def attach_renderbuffer(self, bound: str, point: str, name: int) -> None:
        self.call("glFramebufferRenderbuffer", bound, point, "GL_RENDERBUFFER", name)
        self.call("glCheckFramebufferStatus", bound)

    @rule(stored=st.sampled_from(STORED), width=st.sampled_from([0, 4, 7, -1]))
    def define_renderbuffer(self, stored: str, width: int) -> None:
        self.call("glRenderbufferStorage", "GL_RENDERBUFFER", stored, width, 4)
        self.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")

    @rule(stored=st.sampled_from(STORED), width=st.sampled_from([0, 4, 7, -1]))
    def define_texture(self, stored: str, width: int) -> None:
        client = "GL_DEPTH_COMPONENT" if "DEPTH" in stored else "GL_RGBA"
        self.call("glTexImage2D", "GL_TEXTURE_2D", 0, stored, width, 4, 0, client, "GL_FLOAT", None)
        self.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")

    @rule(mode=st.sampled_from(BUFFERS))
    def choose_draw_buffer(self, mode: str) -> None:
        self.call("glDrawBuffer", mode)
        self.call("glGetIntegerv", "GL_DRAW_BUFFER")

    @rule(mode=st.sampled_from(BUFFERS))
    def choose_read_buffer(self, mode: str) -> None:
        self.call("glReadBuffer", mode)
        self.call("glGetIntegerv", "GL_READ_BUFFER")

    @rule()
    def ask_completeness(self) -> None:
        self.call("glCheckFramebufferStatus", "GL_FRAMEBUFFER")

    # -- queries and lists ---------------------------------------------------------------------------------------------
    @rule(call=st.sampled_from(sorted(QUERIES)), name=st.integers(0, 3))
    def use_query(self, call: str, name: int) -> None:
        self.call(call, *QUERIES[call], [name] if call == "glDeleteQueries" else name)
        self.call("glIsQuery", name)

    @rule()
    def end_query(self) -> None:
        self.call("glEndQuery", "GL_SAMPLES_PASSED")

    @rule(name=st.integers(0, 3), mode=st.sampled_from(["GL_COMPILE", "GL_COMPILE_AND_EXECUTE", "GL_LESS"]))
    def start_list(self, name: int, mode: str) -> None:
        self.call("glNewList", name, mode)
        self.compiling |= name > 0 and mode != "GL_LESS"
        self.call("glIsList", name)

    @rule()
    def end_list(self) -> None:
        self.call("glEndList")
        self.compiling = False

    @rule(name=st.integers(0, 3))
    def call_list(self, name: int) -> None:
        self.call("glCallList", name)

    @rule(name=st.integers(0, 3))
    def delete_lists(self, name: int) -> None:
        self.call("glDeleteLists", name, 2)
        self.call("glIsList", name)
