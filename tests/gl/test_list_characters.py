"""Characters of a font that glCallLists draws together are drawn exactly as list by list."""

from functools import partial
from typing import Any

import numpy as np
import pytest

from gl.what_happened import SIZE, Call, what_happened
from softshadow import gl
from softshadow.gl import list_characters, lists

MODES = gl.GL_QUADS, gl.GL_TRIANGLES, gl.GL_LINE_STRIP, gl.GL_POINTS, gl.GL_POLYGON, gl.GL_TRIANGLE_FAN
N_LISTS = 8
ATTRIBUTES = {"glTexCoord2f": 2, "glNormal3f": 3, "glMultiTexCoord3f": 3, "glColor3f": 3, "glFogCoordf": 1}


class Author:
    """Writes random fonts, texts, and what stands before and between them."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.mode = int(self.rng.choice(MODES))
        self.names = [name for name in ("glTexCoord2f", "glNormal3f", "glMultiTexCoord3f") if self.chance(0.4)]

    def chance(self, p: float) -> bool:
        return bool(self.rng.random() < p)

    def floats(self, n: int) -> list[float]:
        return [float(x) for x in self.rng.choice([-0.5, 0.0, -0.0, 0.25, 0.3, 1.0], n)]

    def attribute(self, name: str) -> Call:
        unit = (gl.GL_TEXTURE1,) if name == "glMultiTexCoord3f" else ()
        return name, (*unit, *self.floats(ATTRIBUTES[name]))

    def primitive(self) -> list[Call]:
        mode = self.mode if self.chance(0.9) else int(self.rng.choice(MODES))
        names = self.names if self.chance(0.9) else [str(self.rng.choice(list(ATTRIBUTES)))]
        calls: list[Call] = [("glBegin", (mode,))]
        for vertex in range(int(self.rng.integers(0, 7))):
            calls += [self.attribute(name) for name in names if not vertex or self.chance(0.5)]
            calls.append(("glVertex2f", tuple(self.floats(2))))
        return [*calls, ("glEnd", ())]

    def move(self) -> Call:
        if self.chance(0.05):
            return "glRotatef", (30.0, 0.0, 0.0, 1.0)
        return "glTranslatef", (*self.floats(2), 0 if self.chance(0.5) else 0.25)

    def character(self) -> list[Call]:
        n_primitives = int(self.rng.choice([0, 1, 1, 1, 2, 3]))
        primitives = [call for _ in range(n_primitives) for call in self.primitive()]
        return primitives + [self.move() for _ in range(int(self.rng.choice([0, 1, 1, 1, 2])))]

    def between(self) -> list[Call]:
        switch = "glEnable" if self.chance(0.6) else "glDisable"
        caps = gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL, gl.GL_TEXTURE_2D, gl.GL_LINE_STIPPLE, gl.GL_CULL_FACE, gl.GL_FOG
        choices: list[list[Call]] = [
            [(switch, (int(self.rng.choice(caps)),))],
            [self.attribute(str(self.rng.choice(list(ATTRIBUTES))))],
            [("glPushMatrix", ())],
            [("glPopMatrix", ())],
            [("glLoadIdentity", ())],
            [("glScalef", (0.5, 0.5, 1.0))],
            [("glLoadMatrixf", (np.diag([0.5, 0.5, 1, 1]).ravel().tolist(),))],
            [("glMatrixMode", (int(self.rng.choice([gl.GL_MODELVIEW, gl.GL_MODELVIEW, gl.GL_TEXTURE])),))],
            [("glPushAttrib", (gl.GL_ALL_ATTRIB_BITS,))],
            [("glPopAttrib", ())],
            [("glSecondaryColor3f", tuple(self.floats(3)))],
            [("glListBase", (int(self.rng.choice([0, 1])),))],
            [("glBegin", (gl.GL_TRIANGLES,)), *[("glVertex2f", tuple(self.floats(2))) for _ in range(3)],
             ("glEnd", ())],
            [("glBegin", (gl.GL_TRIANGLES,)), self.text(), ("glEnd", ())],
            [("glNewList", (N_LISTS, gl.GL_COMPILE)), self.text(N_LISTS - 1), *self.character(), ("glEndList", ())],
        ]  # fmt: skip
        return choices[int(self.rng.integers(len(choices)))]

    def text(self, end: int = N_LISTS + 1) -> Call:
        """Write a text of lists with names before `end`; the base may be 1."""
        return "glCallLists", (bytes(self.rng.integers(0, end, int(self.rng.integers(0, 12))).tolist()),)

    def program(self) -> list[Call]:
        calls: list[Call] = [("glGenLists", (N_LISTS,))]
        for name in range(1, N_LISTS):
            calls += [("glNewList", (name, gl.GL_COMPILE)), *self.character(), ("glEndList", ())]
        for _ in range(25):
            calls += [self.text()] if self.chance(0.4) else self.between()
        return calls


def list_by_list(monkeypatch, calls: list[Call], precision: str) -> list[Any]:
    """What happens if each list of a text is called on its own."""
    with monkeypatch.context() as patch:
        patch.setattr(lists, "_calls_of", lambda context, names: [partial(lists._call, context, n) for n in names])
        return what_happened(calls, precision)


@pytest.fixture
def drawn(monkeypatch):
    """The numbers of characters of the texts that are drawn together."""
    numbers = []

    def draw_text(context, characters):
        done = list_characters.draw_text(context, characters)
        numbers.extend([len(characters)] if done else [])
        return done

    monkeypatch.setattr(lists, "draw_text", draw_text)
    return numbers


@pytest.mark.parametrize("first", range(0, 40, 10))
def test_texts_leave_what_their_lists_leave_one_by_one(monkeypatch, drawn, first):
    for seed in range(first, first + 10):
        calls, precision = Author(seed).program(), "exact" if seed % 5 == 4 else "mesa"
        ours, expected = what_happened(calls, precision), list_by_list(monkeypatch, calls, precision)
        different = [(a, b) for a, b in zip(ours, expected, strict=True) if a != b]
        assert not different, (seed, different[0])
    assert max(drawn) > 4


def test_values_that_a_text_sets_and_takes_back_count_as_changed(monkeypatch, drawn):
    """Here none of the values that the text begins and ends with tells that there was another one."""
    calls: list[Call] = []
    for name, s in ((1, 0.5), (2, 0.25)):
        calls += [("glNewList", (name, gl.GL_COMPILE)), ("glBegin", (gl.GL_POINTS,)), ("glTexCoord2f", (s, 0.0)),
                  ("glVertex2f", (0.0, 0.0)), ("glEnd", ()), ("glEndList", ())]  # fmt: skip
    calls += [("glTexCoord2f", (0.5, 0.0)), ("glPushAttrib", (gl.GL_ALL_ATTRIB_BITS,)), ("glCallLists", ([1, 2, 1],))]
    assert what_happened(calls, "mesa") == list_by_list(monkeypatch, calls, "mesa")
    assert drawn == [3]


def test_a_font_of_quads_is_drawn_together(drawn):
    with gl.create_context(*SIZE):
        base = gl.glGenLists(3)
        for character in range(2):
            gl.glNewList(base + character, gl.GL_COMPILE)
            gl.glBegin(gl.GL_QUADS)
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                gl.glTexCoord2f(0.5 * (character + u), v)
                gl.glVertex2i(u, v)
            gl.glEnd()
            gl.glTranslated(1, 0, 0)
            gl.glEndList()
        gl.glNewList(base + 2, gl.GL_COMPILE)
        gl.glTranslated(1, 0, 0)
        gl.glEndList()
        gl.glListBase(base)
        gl.glCallLists(bytes([0, 1, 2, 1]))
        assert drawn == [4]
        assert gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)[3, 0] == 4
