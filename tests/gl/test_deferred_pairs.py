"""Pairs whose work is deferred leave the commands, the state and the answers of pairs whose calls work at once."""

from typing import Any

import numpy as np
import pytest

from gl.random_author import RandomAuthor
from gl.what_happened import Call, what_happened
from softshadow import gl
from softshadow.context import vertex_buffer
from softshadow.gl import deferred_pairs, immediate

MODES = (
    gl.GL_QUADS, gl.GL_TRIANGLES, gl.GL_LINES, gl.GL_LINE_LOOP, gl.GL_POINTS, gl.GL_POLYGON, gl.GL_TRIANGLE_FAN,
    gl.GL_LINE_STRIP,
)  # fmt: skip
ATTRIBUTES = {
    "glColor3f": 3, "glColor4f": 4, "glColor4ub": 4, "glNormal3f": 3, "glTexCoord2f": 2, "glMultiTexCoord2f": 2,
}  # fmt: skip
VERTICES = {"glVertex2f": 2, "glVertex3f": 3, "glVertex4f": 4, "glVertex2iv": 2}
CAPS = gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL, gl.GL_TEXTURE_2D, gl.GL_LINE_STIPPLE, gl.GL_CULL_FACE, gl.GL_BLEND
SMALL_BUFFER = 8192  # bytes: it is full after some pairs


class Author(RandomAuthor):
    """Writes random programs: most pairs are alike, and most are followed by a change of the matrix."""

    def attribute(self, name: str) -> Call:
        if name == "glColor4ub":
            return name, tuple(int(x) for x in self.rng.integers(0, 256, 4))
        unit = (gl.GL_TEXTURE1,) if name == "glMultiTexCoord2f" else ()
        return name, (*unit, *self.numbers(ATTRIBUTES[name]))

    def vertex(self, name: str) -> Call:
        if name == "glVertex2iv":
            return name, ([int(x) for x in self.rng.integers(-1, 2, 2)],)
        return name, tuple(self.numbers(VERTICES[name]))

    def rare(self) -> Call:
        """A call that may stand among vertices."""
        choices: list[Call] = [
            ("glMaterialf", (gl.GL_FRONT, gl.GL_SHININESS, 5.0)),
            ("glMaterialfv", (gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE, tuple(self.numbers(4)))),
            ("glSecondaryColor3f", tuple(self.numbers(3))),
            ("glFogCoordf", (0.5,)),
            ("glEdgeFlag", (self.chance(0.5),)),
            ("glEvalCoord1f", (0.25,)),
            ("glCallList", (self.one_of((1, 2, 3)),)),
            ("glArrayElement", (1,)),
            ("glRotatef", (30.0, 0.0, 0.0, 1.0)),  # an error there
            ("glGetIntegerv", (gl.GL_VIEWPORT,)),
            self.attribute(self.one_of(ATTRIBUTES)),
            self.vertex(self.one_of(VERTICES)),
        ]
        return self.one_of(choices)

    def pair(self, mode: int, names: list[str], vertex: str, count: int) -> list[Call]:
        calls: list[Call] = [("glBegin", (mode,))]
        for number in range(count):
            calls += [self.attribute(name) for name in names if number == 0 or self.chance(0.2)]
            calls.append(self.vertex(vertex))
            if self.chance(0.01):
                calls.insert(int(self.rng.integers(1, len(calls) + 1)), self.rare())
        return [*calls, ("glEnd", ())]

    def change(self) -> list[Call]:
        """Calls between two pairs."""
        if self.chance(0.75):
            moves: list[Call] = [("glTranslatef", tuple(self.numbers(3))), ("glRotatef", (20.0, 0.0, 0.0, 1.0))]
            if self.depth and self.chance(0.5):
                self.depth -= 1
                return [("glPopMatrix", ())]
            self.depth += 1
            return [("glPushMatrix", ()), self.one_of(moves)]
        choices: list[list[Call]] = [
            [],
            [("glEnable" if self.chance(0.5) else "glDisable", (self.one_of(CAPS),))],
            [("glLineWidth", (self.one_of((1.0, 3.0)),))],
            [self.attribute(self.one_of(ATTRIBUTES))],
            [self.rare()],
            [("glPushAttrib", (gl.GL_ALL_ATTRIB_BITS,)), self.attribute("glColor3f"), ("glPopAttrib", ())],
            [("glGetFloatv", (gl.GL_CURRENT_COLOR,))],
            [("glGetFloatv", (gl.GL_MODELVIEW_MATRIX,))],
            [("glRasterPos2f", tuple(self.numbers(2)))],
            [("glBitmap", (8, 1, 0.0, 0.0, 1.0, 0.0, b"\xaa"))],
            [("glRectf", tuple(self.numbers(4)))],
            [("glClear", (gl.GL_DEPTH_BUFFER_BIT,))],
            [("glPushDebugGroup", (gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, "group"))],
            [("glPopDebugGroup", ())],
            [("glMatrixMode", (self.one_of((gl.GL_PROJECTION, gl.GL_TEXTURE)),)), ("glLoadIdentity", ()),
             ("glMatrixMode", (gl.GL_MODELVIEW,))],
            [("glPolygonMode", (gl.GL_FRONT, self.one_of((gl.GL_LINE, gl.GL_FILL))))],
            [("glBegin", (self.one_of(MODES),)), self.attribute("glColor3f"), ("glEnd", ())],
            [("glReadPixels", (3, 4, 1, 1, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))],
        ]  # fmt: skip
        return self.one_of(choices)

    def program(self) -> list[Call]:
        lists: list[list[Call]] = [
            [self.attribute("glColor3f")],
            [self.vertex("glVertex2f")],
            [("glEnd", ()), ("glTranslatef", (0.5, 0.0, 0.0))],
        ]
        calls: list[Call] = [
            ("glMap1f", (gl.GL_MAP1_VERTEX_3, 0, 1, [(0, 0, 0), (1, 2, 4)])),
            ("glEnable", (gl.GL_MAP1_VERTEX_3,)),
            ("glEnable", (gl.GL_LIGHT0,)),
            ("glVertexPointer", (2, gl.GL_FLOAT, 0, np.zeros((2, 2), np.float32))),
            ("glEnableClientState", (gl.GL_VERTEX_ARRAY,)),
        ]
        for number, listed in enumerate(lists, 1):
            calls += [("glNewList", (number, gl.GL_COMPILE)), *listed, ("glEndList", ())]
        for _ in range(3):
            mode, vertex = self.one_of(MODES), self.one_of(VERTICES)
            names = [name for name in ATTRIBUTES if self.chance(0.25)]
            are_rectangles = self.chance(0.15)
            outside = [name for name in ("glColor3f", "glNormal3f", "glTexCoord2f") if self.chance(0.2)]
            for _ in range(10):
                calls += self.change()
                calls += [self.attribute(name) for name in outside if self.chance(0.9)]
                count = int(self.rng.choice([0, 1, 2, 3, 4, 4, 4, 5, 8]))
                own = [name for name in names if self.chance(0.97)]
                if are_rectangles and self.chance(0.9):
                    calls.append(("glRectf", tuple(self.numbers(4))))
                else:
                    calls += self.pair(mode if self.chance(0.9) else self.one_of(MODES), own, vertex, count)
        return calls


SEEDS = [
    pytest.param(range(start, start + 20), id=str(start), marks=[] if start < 100 else [pytest.mark.slow])
    for start in range(0, 1000, 20)
]


@pytest.mark.parametrize("seeds", SEEDS)
def test_deferred_pairs_do_what_others_do(seeds: range, monkeypatch: pytest.MonkeyPatch) -> None:
    for seed in seeds:
        author = Author(seed)
        calls = author.program()
        chance = author.one_of((0.0, 0.05, 1.0))
        looks = {number for number in range(len(calls)) if author.chance(chance)}
        with monkeypatch.context() as patches, np.errstate(all="ignore"):
            if seed % 4 == 0:
                patches.setattr(vertex_buffer, "BYTES", SMALL_BUFFER)
            precision = "exact" if seed % 5 == 0 else "mesa"
            deferred = what_happened(calls, precision, looks)
            patches.setattr(immediate, "defer", lambda context, mode: False)
            assert deferred == what_happened(calls, precision, looks), seed


def turned_lines(n_lines: int) -> None:
    """Lines with a matrix each, and one at the end that sets no colour."""
    for number in range(n_lines + 1):
        gl.glPushMatrix()
        gl.glRotatef(10.0 * number, 0, 0, 1)
        gl.glBegin(gl.GL_LINES)
        if number < n_lines:
            gl.glColor3f(0.1 * number, 0.5, 1)
        gl.glVertex2f(0, 0)
        gl.glVertex2f(0, 1)
        gl.glEnd()
        gl.glPopMatrix()


def test_pairs_after_the_first_are_deferred(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    for name in ("begin", "end", "draw", "settle"):
        method = getattr(deferred_pairs.DeferredPair, name)

        def noted(pair: Any, *arguments: Any, name: str = name, method: Any = method) -> Any:
            answer = method(pair, *arguments)
            done.append(name if answer is not False else f"no {name}")
            return answer

        monkeypatch.setattr(deferred_pairs.DeferredPair, name, noted)
    with gl.create_context(8, 8) as context:
        turned_lines(4)
        assert done == ["begin", "end", "draw"] * 3 + ["begin", "settle"]  # the last one at its first vertex
        assert len(context.frame.commands) == 5
        assert context.current.color == (pytest.approx(0.3), 0.5, 1.0, 1.0)


def test_formats_that_are_expected_in_vain_are_expected_less_often() -> None:
    n_begun = 0

    def alternating_pairs() -> None:
        for number in range(200):
            gl.glBegin(gl.GL_LINES)
            if number % 2:
                gl.glNormal3f(0, 1, 0)
            gl.glVertex2f(0, 0)
            gl.glVertex2f(0, 1)
            gl.glEnd()
            gl.glTranslatef(0.01, 0, 0)

    with gl.create_context(8, 8) as context, pytest.MonkeyPatch.context() as patches:

        def counted(context: Any, mode: int) -> bool:
            nonlocal n_begun
            is_deferred = deferred_pairs.defer(context, mode)
            n_begun += is_deferred
            return is_deferred

        patches.setattr(immediate, "defer", counted)
        alternating_pairs()
        assert 2 <= n_begun < 20
        assert len(context.frame.commands) == 200


@pytest.mark.parametrize("settles", [False, True], ids=["followed", "stored in the materials"])
def test_lit_pairs_in_the_current_colour_are_late(settles: bool) -> None:
    """Materials that follow the colour have its value, also if a call has set the same colour again."""
    with gl.create_context(8, 8) as context:
        for cap in (gl.GL_LIGHTING, gl.GL_LIGHT0, gl.GL_COLOR_MATERIAL):
            gl.glEnable(cap)
        for number in range(6):
            gl.glColor3f(0.5, 0.25, 1.0)
            if settles:
                assert context.state.lighting.color_material
            gl.glRectf(-0.5, -0.5, 0.5, 0.5)
            gl.glTranslatef(0.01, 0, 0)
            assert len(context.stream.late.draws) == number + 1
