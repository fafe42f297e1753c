"""Draws of lists and arrays that wait leave the commands, the state and the answers of draws carried out at once."""

from typing import Any

import numpy as np
import pytest

from gl.random_author import RandomAuthor
from gl.what_happened import Call, what_happened
from softshadow import gl
from softshadow.context import Context, late_commands
from softshadow.gl import array_draws, list_primitives, moved_draws
from softshadow.pipeline.commands import Vertices

LISTS = range(1, 6)
MODES = (gl.GL_QUADS, gl.GL_TRIANGLES, gl.GL_LINES, gl.GL_POINTS, gl.GL_TRIANGLE_STRIP, gl.GL_POLYGON)
CAPS = (
    gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL, gl.GL_TEXTURE_2D, gl.GL_CULL_FACE, gl.GL_BLEND, gl.GL_LINE_STIPPLE,
    gl.GL_POLYGON_OFFSET_FILL,
)  # fmt: skip
STATES = gl.GL_NORMAL_ARRAY, gl.GL_COLOR_ARRAY, gl.GL_TEXTURE_COORD_ARRAY, gl.GL_EDGE_FLAG_ARRAY


class Author(RandomAuthor):
    """Writes random programs: most draws follow a change of the matrix or of the colour only."""

    def array(self, width: int) -> np.ndarray:
        numbers = self.rng.uniform(-1, 1, (8, width)).astype(np.float32)
        numbers.setflags(write=self.chance(0.7))
        return numbers

    def a_list(self, name: int) -> list[Call]:
        """A list of one pair or several, often with a call before or behind."""
        calls: list[Call] = [("glNewList", (name, gl.GL_COMPILE))]
        if self.chance(0.3):
            calls.append((self.one_of(("glEnable", "glDisable")), (self.one_of(CAPS),)))
        for _ in range(self.one_of((1, 1, 2, 3))):
            calls.append(("glBegin", (self.one_of(MODES),)))
            colored, with_normals = self.chance(0.3), self.chance(0.5)
            for _ in range(4):
                calls += [("glColor3f", tuple(self.numbers(3)))] if colored else []
                calls += [("glNormal3f", tuple(self.numbers(3)))] if with_normals else []
                calls.append(("glVertex3f", tuple(self.numbers(3))))
            calls.append(("glEnd", ()))
        return [*calls, ("glEndList", ())]

    def pointers(self) -> list[Call]:
        return [
            ("glEnableClientState", (gl.GL_VERTEX_ARRAY,)),
            ("glVertexPointer", (3, gl.GL_FLOAT, 0, self.array(3))),
            ("glNormalPointer", (gl.GL_FLOAT, 0, self.array(3))),
            ("glColorPointer", (4, gl.GL_FLOAT, 0, self.array(4))),
            ("glTexCoordPointer", (2, gl.GL_FLOAT, 0, self.array(2))),
            ("glEdgeFlagPointer", (0, self.rng.random(8) < 0.5)),
        ]

    def draw(self) -> Call:
        if self.chance(0.5):
            return "glCallList", (self.one_of(LISTS),)
        if self.chance(0.4):
            return "glDrawArrays", (self.one_of(MODES), 0, self.one_of((3, 4, 8)))
        indices = self.rng.integers(0, 8, 12).astype(np.uint16)
        return "glDrawElements", (self.one_of(MODES), self.one_of((3, 6, 12)), gl.GL_UNSIGNED_SHORT, indices)

    def moved(self) -> list[Call]:
        """A change that draws may wait after."""
        if self.chance(0.3):
            return [("glColor3f", tuple(self.numbers(3)))]
        if self.chance(0.3) and self.depth < 4:
            self.depth += 1
            return [("glPushMatrix", ())]
        if self.chance(0.3) and self.depth:
            self.depth -= 1
            return [("glPopMatrix", ())]
        return [("glTranslatef", tuple(self.numbers(3)))]

    def scaled(self, mode: int) -> list[Call]:
        return [("glMatrixMode", (mode,)), ("glScalef", (0.5, 1.0, 1.0)), ("glMatrixMode", (gl.GL_MODELVIEW,))]

    def change(self) -> list[Call]:
        choices: list[list[Call]] = [
            [(self.one_of(("glEnable", "glDisable")), (self.one_of(CAPS),))],
            [(self.one_of(("glEnableClientState", "glDisableClientState")), (self.one_of(STATES),))],
            [("glMaterialfv", (gl.GL_FRONT, gl.GL_DIFFUSE, tuple(self.numbers(4))))],
            [("glShadeModel", (self.one_of((gl.GL_FLAT, gl.GL_SMOOTH)),))],
            [("glNormal3f", tuple(self.numbers(3)))],
            [("glTexCoord2f", tuple(self.numbers(2)))],
            [("glEdgeFlag", (self.chance(0.5),))],
            [("glSecondaryColor3f", tuple(self.numbers(3)))],
            [("glFogCoordf", (0.5,))],
            [("glPushDebugGroup", (gl.GL_DEBUG_SOURCE_APPLICATION, 1, -1, "group"))],
            [("glPopDebugGroup", ())],
            [
                ("glMatrixMode", (gl.GL_PROJECTION,)),
                ("glScalef", (0.5, 1.0, 1.0)),
                ("glMatrixMode", (gl.GL_MODELVIEW,)),
            ],
            [("glMatrixMode", (gl.GL_TEXTURE,)), ("glScalef", (0.5, 1.0, 1.0)), ("glMatrixMode", (gl.GL_MODELVIEW,))],
            [("glPushAttrib", (gl.GL_ALL_ATTRIB_BITS,)), ("glColor3f", tuple(self.numbers(3)))],
            [("glPopAttrib", ())],
            [("glClear", (gl.GL_COLOR_BUFFER_BIT,))],
            [("glReadPixels", (3, 3, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))],
            [("glRectf", (-0.5, -0.5, 0.5, 0.5))],
            [("glBegin", (gl.GL_TRIANGLES,)), *[("glVertex2f", tuple(self.numbers(2)))] * 3, ("glEnd", ())],
            self.a_list(self.one_of(LISTS)),
            self.pointers(),
        ]
        return self.one_of(choices)

    def program(self) -> list[Call]:
        calls = [call for name in LISTS for call in self.a_list(name)] + self.pointers()
        for _ in range(40):
            draw = self.draw()
            for _ in range(self.one_of((1, 2, 5))):
                calls += self.moved() if self.chance(0.8) else []
                calls.append(draw if self.chance(0.8) else self.draw())
            if self.chance(0.5):
                calls += self.change()
        return calls


class CalmAuthor(Author):
    """Writes programs of which most calls of lists differ from the last one in the modelview matrix only."""

    def a_list(self, name: int) -> list[Call]:
        if self.chance(0.6):
            return super().a_list(name)
        mode = self.one_of(MODES)
        enabled = [("glEnableClientState", (state,)) for state in STATES if self.chance(0.4)]
        draw = ("glDrawArrays", (mode, 0, 4))
        return [*self.pointers(), *enabled, ("glNewList", (name, gl.GL_COMPILE)), draw, ("glEndList", ())]

    def moved(self) -> list[Call]:
        return super().moved() if self.chance(0.1) else [("glTranslatef", tuple(self.numbers(3)))]

    def draw(self) -> Call:
        return ("glCallList", (self.one_of(LISTS),)) if self.chance(0.8) else super().draw()


def at_once(
    context: Context, mode: int, vertices: Vertices, indices: Any, slots: tuple[int, ...], pairs_mode: int = 0
) -> None:
    context.draw(mode, vertices, indices, pairs_mode)


@pytest.mark.parametrize(
    ("author", "seed"), [*((Author, seed) for seed in range(24)), *((CalmAuthor, seed) for seed in range(8))]
)
def test_draws_that_wait_leave_what_draws_at_once_leave(monkeypatch, author, seed):
    calls, precision = author(seed).program(), "exact" if seed % 5 == 4 else "mesa"
    monkeypatch.setattr(late_commands, "MANY", (2, late_commands.MANY)[seed % 2])  # else few are alike
    ours = what_happened(calls, precision)
    for module in (array_draws, list_primitives):
        monkeypatch.setattr(module, "draw_maybe_later", at_once)
    expected = what_happened(calls, precision)
    different = [(number, a, b) for number, (a, b) in enumerate(zip(ours, expected, strict=True)) if a != b]
    assert not different, different[0]


def test_a_list_that_is_called_again_and_again_repeats_its_last_draw(monkeypatch):
    draws, draw = [], list_primitives.draw_maybe_later
    monkeypatch.setattr(list_primitives, "draw_maybe_later", lambda *values: draws.append(values) or draw(*values))
    with gl.create_context(8, 8) as context:
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(gl.GL_TRIANGLES)
        for corner in ((0, 0), (1, 0), (1, 1)):
            gl.glNormal3f(0, 0, -1)
            gl.glVertex2f(*corner)
        gl.glEnd()
        gl.glEndList()
        for number in range(6):
            gl.glTranslatef(0.1, 0, 0)
            gl.glCallList(1)
            if number == 4:
                gl.glColor3f(0, 1, 0)
        assert len(context.frame.commands) == 6
        assert len(draws) == 3  # the first two, and that of another colour
        assert context.current.normal == (0, 0, -1)


def test_array_that_changes_after_a_draw_that_waits():
    """The draw has the numbers of its call, not those of the time when it is carried out."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float32)
    with gl.create_context(8, 8) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, corners)
        gl.glScalef(0.25, 0.25, 1)
        for _ in range(3):
            gl.glTranslatef(1, 1, 0)
            gl.glDrawArrays(gl.GL_QUADS, 0, 4)
        assert len(context.stream.late.draws) == 2
        corners[:] = 0
        drawn = context.storage.window.color.view[..., 0] if context.finish() is None else None
    assert (drawn > 0).sum() == 4 + 3 + 3


def test_large_draws_do_not_wait():
    corners = np.zeros((moved_draws.MOST_VERTICES + 1, 2), np.float32)
    with gl.create_context(8, 8) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(2, gl.GL_FLOAT, 0, corners)
        for _ in range(3):
            gl.glTranslatef(1, 1, 0)
            gl.glDrawArrays(gl.GL_POINTS, 0, len(corners))
        assert not context.stream.late.draws
