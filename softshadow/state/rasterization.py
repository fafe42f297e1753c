"""State of rasterization: viewport, scissor box, culling, polygons, lines and points, clip planes."""

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


SOLID = b"\xff" * 128  # 32 rows of 32 bits


@dataclass(frozen=True, repr=False)
class Polygon:
    """Polygon mode, polygon offset and stipple, and the sizes of lines and points.

    `stipple` holds the pattern of glPolygonStipple as GL stores it: 32 rows from bottom to top, four bytes each, the
    highest bit is left. With `upper_edges`, samples on upper edges are inside, and those on lower edges are not, in a
    framebuffer object, too: so Mesa draws the rectangles of glDrawPixels and glCopyPixels.
    """

    mode_front: int = gl.GL_FILL
    mode_back: int = gl.GL_FILL
    offset_fill: bool = False
    offset_line: bool = False
    offset_point: bool = False
    factor: float = 0.0
    units: float = 0.0
    line_width: float = 1.0
    point_size: float = 1.0
    smooth: bool = False
    stippled: bool = False
    stipple: bytes = SOLID
    upper_edges: bool = False

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
            switch("GL_POLYGON_SMOOTH", self.smooth),
            switch("GL_POLYGON_STIPPLE", self.stippled),
            f"glPolygonStipple(bytes.fromhex('{self.stipple.hex()}'))",
        ]


@dataclass(frozen=True, repr=False)
class Lines:
    """GL_LINE_SMOOTH, GL_LINE_STIPPLE and glLineStipple; the width is in `Polygon`."""

    smooth: bool = False
    stippled: bool = False
    factor: int = 1
    pattern: int = 0xFFFF

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            switch("GL_LINE_SMOOTH", self.smooth),
            switch("GL_LINE_STIPPLE", self.stippled),
            f"glLineStipple({self.factor}, 0x{self.pattern:04X})",
        ]


@dataclass(frozen=True, repr=False)
class Points:
    """GL_POINT_SMOOTH, glPointParameter and point sprites; the size is in `Polygon`.

    `replaced` says of each texture unit whether GL_COORD_REPLACE is on.
    """

    smooth: bool = False
    smallest: float = 0.0
    largest: float = 255.0
    fade_threshold: float = 1.0
    attenuation: tuple[float, float, float] = (1.0, 0.0, 0.0)
    sprites: bool = False
    replaced: tuple[bool, ...] = (False,) * 8
    origin: int = gl.GL_UPPER_LEFT

    __repr__ = printed_calls

    def calls(self) -> list[str]:
        """Return the GL calls that make this state."""
        return [
            switch("GL_POINT_SMOOTH", self.smooth),
            f"glPointParameterf(GL_POINT_SIZE_MIN, {numbers(self.smallest)})",
            f"glPointParameterf(GL_POINT_SIZE_MAX, {numbers(self.largest)})",
            f"glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, {numbers(self.fade_threshold)})",
            f"glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, ({numbers(*self.attenuation)}))",
            switch("GL_POINT_SPRITE", self.sprites),
            *(
                f"glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, {on:d})  # of GL_TEXTURE{unit}"
                for unit, on in enumerate(self.replaced)
            ),
            f"glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, {token_name(self.origin)})",
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
