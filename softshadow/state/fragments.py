"""State of the fragment operations: alpha, stencil and depth test, blending, colour mask."""

from __future__ import annotations

from dataclasses import dataclass

from softshadow import tokens as gl
from softshadow.state.common import Color, numbers, printed_calls, switch
from softshadow.tokens import token_name

ALL_BITS = 0xFF  # initial masks: every bit that a stencil buffer can have

STENCIL_OPS = ("GL_KEEP", "GL_ZERO", "GL_REPLACE", "GL_INCR", "GL_DECR", "GL_INVERT", "GL_INCR_WRAP", "GL_DECR_WRAP")
BLEND_FACTORS = ("GL_ZERO", "GL_ONE")


@dataclass(frozen=True, repr=False)
class AlphaTest:
    """State of glAlphaFunc and GL_ALPHA_TEST."""

    enabled: bool = False
    func: int = gl.GL_ALWAYS
    ref: float = 0.0

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [switch("GL_ALPHA_TEST", self.enabled), f"glAlphaFunc({token_name(self.func)}, {self.ref:g})"]


@dataclass(frozen=True, repr=False)
class StencilFace:
    """The state of glStencilFunc, glStencilOp and glStencilMask for one facing."""

    func: int = gl.GL_ALWAYS
    ref: int = 0
    read_mask: int = ALL_BITS
    sfail: int = gl.GL_KEEP
    zfail: int = gl.GL_KEEP
    zpass: int = gl.GL_KEEP
    write_mask: int = ALL_BITS

    __repr__ = printed_calls

    def calls(self, face: str = "") -> list[str]:
        """Return the GL calls that make this state."""
        suffix, first = ("Separate", f"{face}, ") if face else ("", "")
        ops = ", ".join(token_name(op, STENCIL_OPS) for op in (self.sfail, self.zfail, self.zpass))
        return [
            f"glStencilFunc{suffix}({first}{token_name(self.func)}, {self.ref}, 0x{self.read_mask & 0xFF:02X})",
            f"glStencilOp{suffix}({first}{ops})",
            f"glStencilMask{suffix}({first}0x{self.write_mask & 0xFF:02X})",
        ]


@dataclass(frozen=True, repr=False)
class Stencil:
    """Stencil test of both facings, and the clear value.

    There are two back states: one of GL 2.0, one of GL_EXT_stencil_two_side. `back` is the one in use: the extension's
    while `two_side` is on. `other_back` is the other one. `active_back`: glActiveStencilFaceEXT has chosen GL_BACK.
    """

    enabled: bool = False
    front: StencilFace = StencilFace()
    back: StencilFace = StencilFace()
    clear: int = 0
    two_side: bool = False
    active_back: bool = False
    other_back: StencilFace = StencilFace()

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        if self.two_side:
            both = ["glActiveStencilFaceEXT(GL_FRONT)", *self.front.calls()]
            both += ["glActiveStencilFaceEXT(GL_BACK)", *self.back.calls()]
            faces = ["glEnable(GL_STENCIL_TEST_TWO_SIDE_EXT)", *both]
        elif self.front == self.back:
            faces = self.front.calls()
        else:
            faces = self.front.calls("GL_FRONT") + self.back.calls("GL_BACK")
        return [switch("GL_STENCIL_TEST", self.enabled), *faces, f"glClearStencil({self.clear})"]


@dataclass(frozen=True, repr=False)
class Depth:
    """Depth test, write mask, clear value and GL_DEPTH_CLAMP."""

    enabled: bool = False
    func: int = gl.GL_LESS
    write: bool = True
    clear: float = 1.0
    clamp: bool = False

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            switch("GL_DEPTH_TEST", self.enabled),
            f"glDepthFunc({token_name(self.func)})",
            f"glDepthMask({'GL_TRUE' if self.write else 'GL_FALSE'})",
            switch("GL_DEPTH_CLAMP", self.clamp),
            f"glClearDepth({self.clear:g})",
        ]


@dataclass(frozen=True, repr=False)
class Blend:
    """State of blending and of the logical operation on colours."""

    enabled: bool = False
    src_rgb: int = gl.GL_ONE
    dst_rgb: int = gl.GL_ZERO
    src_alpha: int = gl.GL_ONE
    dst_alpha: int = gl.GL_ZERO
    equation_rgb: int = gl.GL_FUNC_ADD
    equation_alpha: int = gl.GL_FUNC_ADD
    color: Color = (0.0, 0.0, 0.0, 0.0)
    logic_enabled: bool = False
    logic_op: int = gl.GL_COPY

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        factors = (self.src_rgb, self.dst_rgb, self.src_alpha, self.dst_alpha)
        return [
            switch("GL_BLEND", self.enabled),
            f"glBlendFuncSeparate({', '.join(token_name(f, BLEND_FACTORS) for f in factors)})",
            f"glBlendEquationSeparate({token_name(self.equation_rgb)}, {token_name(self.equation_alpha)})",
            f"glBlendColor({numbers(*self.color)})",
            switch("GL_COLOR_LOGIC_OP", self.logic_enabled),
            f"glLogicOp({token_name(self.logic_op)})",
        ]


@dataclass(frozen=True, repr=False)
class ColorBuffer:
    """Colour mask and clear colours.

    GL_DITHER and GL_MULTISAMPLE are on initially. With 8 bits per channel and one sample per pixel they have no effect,
    nor have the state of glSampleCoverage and its capabilities.
    """

    mask: tuple[bool, bool, bool, bool] = (True, True, True, True)
    clear: Color = (0.0, 0.0, 0.0, 0.0)
    clear_accum: Color = (0.0, 0.0, 0.0, 0.0)
    dither: bool = True
    multisample: bool = True
    alpha_to_coverage: bool = False
    alpha_to_one: bool = False
    sample_coverage: bool = False
    coverage_value: float = 1.0
    coverage_inverted: bool = False

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            f"glColorMask({', '.join('GL_TRUE' if on else 'GL_FALSE' for on in self.mask)})",
            f"glClearColor({numbers(*self.clear)})",
            f"glClearAccum({numbers(*self.clear_accum)})",
            switch("GL_DITHER", self.dither),
            switch("GL_MULTISAMPLE", self.multisample),
            switch("GL_SAMPLE_ALPHA_TO_COVERAGE", self.alpha_to_coverage),
            switch("GL_SAMPLE_ALPHA_TO_ONE", self.alpha_to_one),
            switch("GL_SAMPLE_COVERAGE", self.sample_coverage),
            f"glSampleCoverage({self.coverage_value:g}, {'GL_TRUE' if self.coverage_inverted else 'GL_FALSE'})",
        ]
