"""Text in the fonts of GLUT, by the same GL calls as freeglut 3.4 makes.

Bitmaps are drawn at the raster position and move it; strokes are line strips, followed by a translation. In a string,
a newline goes back to where the string began, and down by the height of the font.
"""

from __future__ import annotations

import ctypes
import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import gl
from softshadow.windows.desktop import desktop
from softshadow.windows.glut.font_data import (
    BitmapFont,
    Glyph,
    StrokeCharacter,
    StrokeFont,
    bitmap_fonts,
    stroke_fonts,
)

BITMAP_NAMES = (
    "GLUT_BITMAP_9_BY_15", "GLUT_BITMAP_8_BY_13", "GLUT_BITMAP_TIMES_ROMAN_10", "GLUT_BITMAP_TIMES_ROMAN_24",
    "GLUT_BITMAP_HELVETICA_10", "GLUT_BITMAP_HELVETICA_12", "GLUT_BITMAP_HELVETICA_18",
)  # fmt: skip
STROKE_NAMES = ("GLUT_STROKE_ROMAN", "GLUT_STROKE_MONO_ROMAN")
NEWLINE = ord("\n")
HALF = np.float32(0.5)
UNPACKED = (
    ("GL_UNPACK_SWAP_BYTES", 0), ("GL_UNPACK_LSB_FIRST", 0), ("GL_UNPACK_ROW_LENGTH", 0), ("GL_UNPACK_SKIP_ROWS", 0),
    ("GL_UNPACK_SKIP_PIXELS", 0), ("GL_UNPACK_ALIGNMENT", 1),
)  # fmt: skip


class Font:
    """A font, as programs pass it to the functions below: an opaque value."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return self.name


# -- arguments ---------------------------------------------------------------------------------------------------------
def _named(call: str, font: Any, names: tuple[str, ...]) -> str | None:
    """Return the name of a font, or None for one of the other kind, which is told."""
    if font is not None and not isinstance(font, Font):
        raise TypeError(f"{call}(font={font!r}): expected one of {', '.join(names)}")
    if font is None or font.name not in names:
        kind = "bitmap" if names is BITMAP_NAMES else "stroke"
        desktop().tell(f"{call}(font={font}) does nothing: this is no {kind} font")
        return None
    return font.name


def _bitmap_font(call: str, font: Any) -> BitmapFont | None:
    name = _named(call, font, BITMAP_NAMES)
    return None if name is None else bitmap_fonts()[name]


def _stroke_font(call: str, font: Any) -> StrokeFont | None:
    name = _named(call, font, STROKE_NAMES)
    return None if name is None else stroke_fonts()[name]


def _code(call: str, character: Any) -> int:
    if isinstance(character, ctypes.c_int):
        return character.value
    try:
        return operator.index(character)
    except TypeError:
        raise TypeError(f"{call}(character={character!r}): expected an int, as ord(character) gives") from None


def _codes(call: str, string: Any) -> bytes:
    """Return the bytes of a string up to its first zero."""
    if isinstance(string, ctypes.c_char_p | ctypes.Array):
        string = string.value if isinstance(string, ctypes.c_char_p) else bytes(string)
    if string is None:
        return b""
    if not isinstance(string, bytes):
        raise TypeError(f"{call}(string={string!r}): expected bytes, such as b'text' or text.encode()")
    return string.split(b"\0")[0]


# -- bitmaps -----------------------------------------------------------------------------------------------------------
def _unpack_bytes() -> None:
    """Save how bitmaps lie in memory, and set it to rows of whole bytes."""
    gl.glPushClientAttrib(gl.GL_CLIENT_PIXEL_STORE_BIT)
    for name, value in UNPACKED:
        gl.glPixelStorei(getattr(gl, name), value)


def _draw_glyph(font: BitmapFont, glyph: Glyph) -> None:
    gl.glBitmap(glyph.width, font.height, *font.origin, float(glyph.width), 0.0, glyph.rows)


def bitmap_character(font: Any, character: Any) -> None:
    """Draw a character at the raster position, and move this by the character's width."""
    code, shapes = _code("glutBitmapCharacter", character), _bitmap_font("glutBitmapCharacter", font)
    if shapes is None or not 1 <= code < 256:
        return
    _unpack_bytes()
    _draw_glyph(shapes, shapes.glyphs[code])
    gl.glPopClientAttrib()


def bitmap_string(font: Any, string: Any) -> None:
    """Draw characters one after another."""
    codes, shapes = _codes("glutBitmapString", string), _bitmap_font("glutBitmapString", font)
    if shapes is None or not codes:
        return
    _unpack_bytes()
    x = 0.0
    for code in codes:
        if code == NEWLINE:
            gl.glBitmap(0, 0, 0.0, 0.0, -x, -float(shapes.height), None)
            x = 0.0
        else:
            _draw_glyph(shapes, shapes.glyphs[code])
            x += shapes.glyphs[code].width
    gl.glPopClientAttrib()


def bitmap_width(font: Any, character: Any) -> int:
    """Return the width of a character in pixels."""
    code, shapes = _code("glutBitmapWidth", character), _bitmap_font("glutBitmapWidth", font)
    return 0 if shapes is None or not 0 < code < 256 else shapes.glyphs[code].width


def bitmap_length(font: Any, string: Any) -> int:
    """Return the width of a string's longest line in pixels."""
    codes, shapes = _codes("glutBitmapLength", string), _bitmap_font("glutBitmapLength", font)
    if shapes is None:
        return 0
    return max(sum(shapes.glyphs[code].width for code in line) for line in codes.split(b"\n"))


def bitmap_height(font: Any) -> int:
    """Return the distance of two lines of text in pixels."""
    shapes = _bitmap_font("glutBitmapHeight", font)
    return 0 if shapes is None else shapes.height


# -- strokes -----------------------------------------------------------------------------------------------------------
def _draw_strips(character: StrokeCharacter) -> None:
    for strip in character.strips:
        gl.glBegin(gl.GL_LINE_STRIP)
        for x, y in strip.tolist():
            gl.glVertex2f(x, y)
        gl.glEnd()
    gl.glTranslatef(float(character.width), 0.0, 0.0)


def stroke_character(font: Any, character: Any) -> None:
    """Draw the lines of a character, and translate by its width."""
    code, shapes = _code("glutStrokeCharacter", character), _stroke_font("glutStrokeCharacter", font)
    if shapes is not None and code in shapes.characters:
        _draw_strips(shapes.characters[code])


def stroke_string(font: Any, string: Any) -> None:
    """Draw the lines of characters one after another."""
    codes, shapes = _codes("glutStrokeString", string), _stroke_font("glutStrokeString", font)
    if shapes is None:
        return
    length = np.float32(0)
    for code in codes:
        if code == NEWLINE:
            gl.glTranslatef(-float(length), -float(shapes.height), 0.0)
            length = np.float32(0)
        elif code in shapes.characters:
            _draw_strips(shapes.characters[code])
            length += shapes.characters[code].width


def stroke_width_f(font: Any, character: Any, call: str = "glutStrokeWidthf") -> float:
    """Return the width of a character in its own units."""
    code, shapes = _code(call, character), _stroke_font(call, font)
    return 0.0 if shapes is None or code not in shapes.characters else float(shapes.characters[code].width)


def stroke_width(font: Any, character: Any) -> int:
    """Return the width of a character, rounded."""
    return int(np.float32(stroke_width_f(font, character, "glutStrokeWidth")) + HALF)


def stroke_length_f(font: Any, string: Any, call: str = "glutStrokeLengthf") -> float:
    """Return the width of a string's longest line."""
    codes, shapes = _codes(call, string), _stroke_font(call, font)
    if shapes is None:
        return 0.0
    longest = np.float32(0)
    for line in codes.split(b"\n"):
        length = np.float32(0)
        for code in line:
            if code in shapes.characters:
                length += shapes.characters[code].width
        longest = max(longest, length)
    return float(longest)


def stroke_length(font: Any, string: Any) -> int:
    """Return the width of a string's longest line, rounded."""
    return int(np.float32(stroke_length_f(font, string, "glutStrokeLength")) + HALF)


def stroke_height(font: Any) -> float:
    """Return the distance of two lines of text."""
    shapes = _stroke_font("glutStrokeHeight", font)
    return 0.0 if shapes is None else float(shapes.height)


FONTS = {name: Font(name) for name in (*BITMAP_NAMES, *STROKE_NAMES)}
CALLS: dict[str, Callable[..., Any]] = {
    "glutBitmapCharacter": bitmap_character,
    "glutBitmapString": bitmap_string,
    "glutBitmapWidth": bitmap_width,
    "glutBitmapLength": bitmap_length,
    "glutBitmapHeight": bitmap_height,
    "glutStrokeCharacter": stroke_character,
    "glutStrokeString": stroke_string,
    "glutStrokeWidth": stroke_width,
    "glutStrokeWidthf": stroke_width_f,
    "glutStrokeLength": stroke_length,
    "glutStrokeLengthf": stroke_length_f,
    "glutStrokeHeight": stroke_height,
}
