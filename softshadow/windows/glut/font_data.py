"""The nine fonts of GLUT, read at their first use from `bitmap_fonts.txt` and `stroke_fonts.txt`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import numpy as np


@dataclass(frozen=True)
class Glyph:
    """A character of a bitmap font: its width in pixels, and its rows from bottom to top as glBitmap reads them."""

    width: int
    rows: np.ndarray


@dataclass(frozen=True)
class BitmapFont:
    """A font of 256 bitmaps, all of one height; `origin` is the place of the raster position in each."""

    height: int
    origin: tuple[float, float]
    glyphs: list[Glyph]


@dataclass(frozen=True)
class StrokeCharacter:
    """A character of a stroke font: the distance to the next one, and polylines, float32 (n, 2)."""

    width: np.float32
    strips: list[np.ndarray]


@dataclass(frozen=True)
class StrokeFont:
    """A font of lines: the distance of two lines of text, and the characters by their codes; some codes have none."""

    height: np.float32
    n_codes: int
    characters: dict[int, StrokeCharacter]


def _fonts(name: str) -> list[tuple[list[str], list[str]]]:
    """Return the words of each font's first line, and its other lines."""
    fonts: list[tuple[list[str], list[str]]] = []
    for line in files(__package__).joinpath(name).read_text(encoding="ascii").splitlines():
        if line.startswith("font "):
            fonts.append((line.split()[1:], []))
        elif not line.startswith("#"):
            fonts[-1][1].append(line)
    return fonts


@cache
def bitmap_fonts() -> dict[str, BitmapFont]:
    """Return the bitmap fonts, by the names of their tokens."""
    fonts = {}
    for (name, height, x, y, _), lines in _fonts("bitmap_fonts.txt"):
        glyphs: dict[int, Glyph] = {}
        for codes, width, rows in (line.split() for line in lines):
            glyph = Glyph(int(width), np.frombuffer(bytes.fromhex(rows), np.uint8))
            for part in codes.split(","):
                first, _, last = part.partition("-")
                glyphs.update(dict.fromkeys(range(int(first), int(last or first) + 1), glyph))
        fonts[name] = BitmapFont(int(height), (float(x), float(y)), [glyphs[code] for code in range(256)])
    return fonts


@cache
def stroke_fonts() -> dict[str, StrokeFont]:
    """Return the stroke fonts, by the names of their tokens."""
    fonts = {}
    for (name, height, n_codes), lines in _fonts("stroke_fonts.txt"):
        characters = {}
        for line in lines:
            head, _, strips = line.partition(":")
            code, width = head.split()
            polylines = [
                np.array([point.split(",") for point in strip.split()], np.float32).reshape(-1, 2)
                for strip in strips.split(";")
            ]
            characters[int(code)] = StrokeCharacter(np.float32(width), polylines if strips else [])
        fonts[name] = StrokeFont(np.float32(height), int(n_codes), characters)
    return fonts
