"""State of rasterization: viewport, scissor box, culling, polygon modes and offset, clip planes."""

from __future__ import annotations

from dataclasses import dataclass

from softshadow import tokens as gl
from softshadow.state.common import Color, numbers, printed_calls, switch
from softshadow.tokens import token_name


@dataclass(frozen=True, repr=False)
class Viewport:
    """glViewport and glDepthRange, in pixels; y counts from the bottom."""

    x: int = 0
    y: int = 0
    width: int = 0
    height: int = 0
    near: float = 0.0
    far: float = 1.0

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            f"glViewport({self.x}, {self.y}, {self.width}, {self.height})",
            f"glDepthRange({numbers(self.near, self.far)})",
        ]


@dataclass(frozen=True, repr=False)
class Scissor:
    """GL_SCISSOR_TEST and glScissor, in pixels; y counts from the bottom."""

    enabled: bool = False
    x: int = 0
    y: int = 0
    width: int = 0
    height: int = 0

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            switch("GL_SCISSOR_TEST", self.enabled),
            f"glScissor({self.x}, {self.y}, {self.width}, {self.height})",
        ]


@dataclass(frozen=True, repr=False)
class Cull:
    """State of face culling, and which winding is the front."""

    enabled: bool = False
    face: int = gl.GL_BACK
    front_face: int = gl.GL_CCW

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            switch("GL_CULL_FACE", self.enabled),
            f"glCullFace({token_name(self.face)})",
            f"glFrontFace({token_name(self.front_face)})",
        ]


@dataclass(frozen=True, repr=False)
class Polygon:
    """Polygon mode, polygon offset, and the sizes of lines and points."""

    mode_front: int = gl.GL_FILL
    mode_back: int = gl.GL_FILL
    offset_fill: bool = False
    offset_line: bool = False
    offset_point: bool = False
    factor: float = 0.0
    units: float = 0.0
    line_width: float = 1.0
    point_size: float = 1.0

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            f"glPolygonMode(GL_FRONT, {token_name(self.mode_front)})",
            f"glPolygonMode(GL_BACK, {token_name(self.mode_back)})",
            switch("GL_POLYGON_OFFSET_FILL", self.offset_fill),
            switch("GL_POLYGON_OFFSET_LINE", self.offset_line),
            switch("GL_POLYGON_OFFSET_POINT", self.offset_point),
            f"glPolygonOffset({numbers(self.factor, self.units)})",
            f"glLineWidth({self.line_width:g})",
            f"glPointSize({self.point_size:g})",
        ]


@dataclass(frozen=True, repr=False)
class ClipPlanes:
    """User clip planes in eye space, as GL stores them."""

    enabled: tuple[bool, ...] = (False,) * 6
    equations: tuple[Color, ...] = ((0.0, 0.0, 0.0, 0.0),) * 6

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            call
            for i, (on, plane) in enumerate(zip(self.enabled, self.equations, strict=True))
            if on
            for call in (f"glClipPlane(GL_CLIP_PLANE{i}, ({numbers(*plane)}))", switch(f"GL_CLIP_PLANE{i}", True))
        ]
