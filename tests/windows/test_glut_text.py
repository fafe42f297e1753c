"""Text of GLUT: sizes of the nine fonts, where strings go, and what the functions refuse."""

import ctypes
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from recordings.logged_calls import run_logged
from softshadow.errors import CallsLeftOut, SoftShadowError
from softshadow.testing import run_on_mesa
from softshadow.testing.comparison import differences
from softshadow.testing.trace_comparison import window_of
from softshadow.windows import run_script
from softshadow.windows.glut import fonts
from softshadow.windows.glut.font_data import bitmap_fonts, stroke_fonts

F = fonts.FONTS
PIXELS = [  # "AV" in the font 8x13 of X11
    "...##...#.....#.",
    "..#..#..#.....#.",
    ".#....#..#...#..",
    ".#....#..#...#..",
    ".#....#..#...#..",
    ".######...#.#...",
    ".#....#...#.#...",
    ".#....#...#.#...",
    ".#....#....#....",
]
LARGEST = 150_000  # bytes of all font data


def program(body: str, size: tuple[int, int] = (48, 24)) -> str:
    """Return a program whose display callback is `body`."""
    lines = "\n".join(f"    {line}" for line in body.strip().splitlines())
    return f"""
import ctypes
from OpenGL.GL import *
from OpenGL.GLUT import *
def display():
    glClear(GL_COLOR_BUFFER_BIT)
{lines}
    glutSwapBuffers()
glutInit()
glutInitDisplayMode(GLUT_DOUBLE | GLUT_DEPTH)
glutInitWindowSize{size}
glutCreateWindow("text")
glutDisplayFunc(display)
glutMainLoop()
"""


def written(folder: Path, body: str, size: tuple[int, int] = (48, 24)) -> Path:
    path = folder / "program.py"
    path.write_text(program(body, size))
    return path


@pytest.mark.parametrize(
    ("name", "height", "widths"),  # of "i", "W" and "~", as freeglut 3.4 returns them
    [
        ("9_BY_15", 16, [9, 9, 9]),
        ("8_BY_13", 14, [8, 8, 8]),
        ("TIMES_ROMAN_10", 14, [3, 10, 7]),
        ("TIMES_ROMAN_24", 29, [6, 23, 13]),
        ("HELVETICA_10", 14, [2, 9, 7]),
        ("HELVETICA_12", 16, [3, 11, 7]),
        ("HELVETICA_18", 23, [4, 18, 10]),
    ],
)
def test_bitmap_fonts_have_the_sizes_of_freeglut(name: str, height: int, widths: list[int]) -> None:
    font = F[f"GLUT_BITMAP_{name}"]
    assert fonts.bitmap_height(font) == height
    assert [fonts.bitmap_width(font, ord(character)) for character in "iW~"] == widths
    assert fonts.bitmap_length(font, b"iW\n~") == widths[0] + widths[1]
    assert [fonts.bitmap_width(font, code) for code in (-1, 0, 256)] == [0, 0, 0]


def test_stroke_fonts_have_the_sizes_of_freeglut() -> None:
    roman, mono = F["GLUT_STROKE_ROMAN"], F["GLUT_STROKE_MONO_ROMAN"]
    assert fonts.stroke_height(roman) == float(np.float32(152.381))
    assert [fonts.stroke_width(roman, ord(character)) for character in "iW~"] == [29, 101, 91]
    assert [fonts.stroke_width(mono, code) for code in (32, 105, 126)] == [105, 105, 105]
    assert fonts.stroke_length(roman, b"iW\n~") == 129
    assert fonts.stroke_width_f(roman, ord("i")) == float(np.float32(28.8638))
    assert [fonts.stroke_width(roman, code) for code in (-1, 10, 200)] == [0, 0, 0]


def test_a_string_is_drawn_as_its_characters_are(tmp_path: Path) -> None:
    text = "glRasterPos2f(-0.9, 0.2)\nglutBitmapString(GLUT_BITMAP_8_BY_13, b'AV')"
    one = run_script(written(tmp_path, text)).image
    text = "glRasterPos2f(-0.9, 0.2)\nfor c in 'AV': glutBitmapCharacter(GLUT_BITMAP_8_BY_13, ord(c))"
    assert np.array_equal(run_script(written(tmp_path, text)).image, one)
    assert ["".join(".#"[bool(pixel)] for pixel in row) for row in one[1:10, 2:18, 0]] == PIXELS


def test_a_newline_goes_back_to_where_the_string_began(tmp_path: Path) -> None:
    body = """
glOrtho(0, 48, 0, 40, -1, 1)
glRasterPos2f(5, 30)
glutBitmapString(GLUT_BITMAP_HELVETICA_12, b"one\\ntwo")
x, y = glGetFloatv(GL_CURRENT_RASTER_POSITION)[:2]
width = sum(glutBitmapWidth(GLUT_BITMAP_HELVETICA_12, ord(c)) for c in "two")
assert abs(x - 5 - width) < 1e-4 and abs(y - (30 - 16)) < 1e-4  # the raster position is transformed in float32
glLoadIdentity()
glutStrokeString(GLUT_STROKE_ROMAN, b"one\\ntwo")
x, y = glGetFloatv(GL_MODELVIEW_MATRIX)[3][:2]
assert abs(x - glutStrokeLength(GLUT_STROKE_ROMAN, b"two")) <= 1 and abs(y + glutStrokeHeight(GLUT_STROKE_ROMAN)) < 1e-4
"""
    run_script(written(tmp_path, body, (48, 40)))


def test_text_does_not_change_the_pixel_store(tmp_path: Path) -> None:
    body = """
glPixelStorei(GL_UNPACK_ROW_LENGTH, 5)
glPixelStorei(GL_UNPACK_LSB_FIRST, 1)
glRasterPos2f(-0.9, 0)
glutBitmapString(GLUT_BITMAP_9_BY_15, b"a")
glutBitmapCharacter(GLUT_BITMAP_9_BY_15, 98)
store = GL_UNPACK_ROW_LENGTH, GL_UNPACK_LSB_FIRST, GL_UNPACK_ALIGNMENT
assert [int(glGetIntegerv(each)) for each in store] == [5, 1, 4]
"""
    assert run_script(written(tmp_path, body)).image.any()


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("glutBitmapCharacter(GLUT_BITMAP_9_BY_15, 'a')", r"glutBitmapCharacter\(character='a'\): expected an int"),
        ("glutBitmapString(GLUT_BITMAP_9_BY_15, 'text')", r"glutBitmapString\(string='text'\): expected bytes"),
        ("glutStrokeString(GLUT_STROKE_ROMAN, [65])", r"glutStrokeString\(string=\[65\]\): expected bytes"),
        ("glutBitmapWidth(7, 65)", r"glutBitmapWidth\(font=7\): expected one of GLUT_BITMAP_9_BY_15"),
    ],
)
def test_what_pyopengl_refuses_is_refused(tmp_path: Path, call: str, expected: str) -> None:
    with pytest.raises(SoftShadowError, match=f"program.py line 7: TypeError: {expected}"):
        run_script(written(tmp_path, call))


@pytest.mark.parametrize("string", [b"ab", b"ab\0c", ctypes.c_char_p(b"ab"), (ctypes.c_ubyte * 3)(97, 98, 0)])
def test_strings_end_at_their_first_zero(string: Any) -> None:
    assert fonts.bitmap_length(F["GLUT_BITMAP_8_BY_13"], string) == 16


def test_a_font_of_the_other_kind_draws_nothing_and_is_told(tmp_path: Path) -> None:
    path = written(tmp_path, "glutBitmapCharacter(GLUT_STROKE_ROMAN, 65)")
    with pytest.warns(CallsLeftOut, match="GLUT_STROKE_ROMAN\\) does nothing: this is no bitmap font"):
        assert not run_script(path).image.any()


def test_fonts_are_complete_small_and_have_their_notice() -> None:
    assert all(len(font.glyphs) == 256 for font in bitmap_fonts().values())
    assert [sorted(font.characters) for font in stroke_fonts().values()] == [list(range(32, 128))] * 2
    folder = files("softshadow.windows.glut")
    sizes = [len(folder.joinpath(name).read_bytes()) for name in ("bitmap_fonts.txt", "stroke_fonts.txt")]
    assert sum(sizes) < LARGEST
    notice = folder.joinpath("NOTICE.txt").read_text(encoding="ascii")
    assert all(holder in notice for holder in ("Pawel W. Olszta", "Adobe Systems", "Digital Equipment"))


@pytest.mark.mesa
def test_text_and_shapes_equal_those_of_mesa(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = """
glClear(GL_DEPTH_BUFFER_BIT)
glEnable(GL_DEPTH_TEST)
glRasterPos2f(-0.95, 0.3)
glutBitmapString(GLUT_BITMAP_TIMES_ROMAN_10, b"Shadow\\nvolume")
glutSolidTeacup(0.5)
glScalef(0.005, 0.005, 1)
glutStrokeString(GLUT_STROKE_ROMAN, b"Ab")
"""
    run, played = run_logged(monkeypatch, written(tmp_path, body, (64, 48)))
    told = differences(window_of(run), run_on_mesa(played, run.size))
    assert not told, "\n".join(map(str, told))
