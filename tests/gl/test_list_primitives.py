"""Primitives of display lists are drawn from arrays exactly as by their calls."""

from typing import Any

import numpy as np
import pytest

from gl.what_happened import SIZE, Call, what_happened
from softshadow import gl
from softshadow.gl import constant_attributes, list_compiling, list_primitives, lists
from softshadow.gl.list_calls import CALLS, MAKE_OTHERS
from softshadow.gl.list_compiling import with_primitives
from softshadow.gl.list_primitives import ListPrimitive
from softshadow.gl.list_vertices import MixedPrimitive
from softshadow.state import TEXTURE_UNITS


# -- random programs ---------------------------------------------------------------------------------------------------
class Author:
    """Writes random calls around display lists: what they contain, and what stands before, between and after them."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)

    def chance(self, p: float) -> bool:
        return bool(self.rng.random() < p)

    def floats(self, n: int) -> list[float]:
        return [float(x) for x in self.rng.choice([-1.0, -0.5, 0.0, -0.0, 0.25, 0.7, 1.0, 1.5], n)]

    def ints(self, n: int) -> list[int]:
        return [int(x) for x in self.rng.integers(-128, 300, n)]

    def attribute(self) -> Call:
        kind = str(self.rng.choice(["Color", "Color", "Normal", "Normal", "TexCoord", "MultiTexCoord"]))
        if kind == "Color":
            n = int(self.rng.integers(3, 5))
            letter = str(self.rng.choice(["f", "f", "f", "d", "ub", "b", "us", "ui", "i", "s"]))
        elif kind == "Normal":
            n, letter = 3, str(self.rng.choice(["f", "f", "b", "s", "i"]))
        else:
            n, letter = int(self.rng.integers(1, 5)), "f"
        values: list[Any] = self.floats(n) if letter in "fd" else self.ints(n)
        first = (gl.GL_TEXTURE0 + int(self.rng.integers(0, TEXTURE_UNITS)),) if kind == "MultiTexCoord" else ()
        if self.chance(0.4):
            vector: Any = values if self.chance(0.5) else np.array(values, np.float32 if letter in "fd" else np.int64)
            return f"gl{kind}{n}{letter}v", (*first, vector)
        return f"gl{kind}{n}{letter}", (*first, *values)

    def vertex(self) -> Call:
        n = int(self.rng.integers(2, 5))
        w = [1.0] if n == 4 else []
        if self.chance(0.03):
            return "glVertex3f", ("x", 0, 0) if self.chance(0.3) else (1, 2)  # wrong
        if self.chance(0.2):
            return f"glVertex{n}iv", (self.ints(n),)
        values = self.floats(n - len(w)) + w
        return (f"glVertex{n}fv", (values,)) if self.chance(0.3) else (f"glVertex{n}f", tuple(values))

    def pair(self) -> list[Call]:
        mode = int(self.rng.integers(gl.GL_POINTS, gl.GL_POLYGON + (2 if self.chance(0.05) else 1)))
        calls: list[Call] = [("glBegin", (mode,))] if self.chance(0.95) else []
        shares, corners = self.chance(0.3), [self.vertex(), self.vertex()]  # one vertex several times
        for _ in range(int(self.rng.integers(0, 9))):
            if shares and calls:
                calls.append(corners[int(self.chance(0.5))])
                continue
            calls += [self.attribute() for _ in range(int(self.rng.integers(0, 3)))]
            if self.chance(0.04):
                calls.append(self.between())
            if self.chance(0.03):
                calls.append(("glMaterialfv", (gl.GL_FRONT, gl.GL_DIFFUSE, self.floats(4))))
            calls.append(self.vertex())
        calls += [self.attribute() for _ in range(int(self.rng.integers(0, 2)))]
        return [*calls, ("glEnd", ())] if self.chance(0.95) else calls

    def between(self) -> Call:
        which = int(self.rng.integers(9))
        if which == 0:
            return "glTranslatef", tuple(self.floats(3))
        if which == 1:
            capability = int(self.rng.choice([gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL, gl.GL_DEPTH_TEST, gl.GL_LIGHT0]))
            return ("glEnable" if self.chance(0.6) else "glDisable"), (capability,)
        if which == 2:
            return "glMaterialfv", (gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT, self.floats(4))
        if which == 3:
            return "glCallList", (int(self.rng.integers(0, 5)),)
        if which == 4:
            return "glPushAttrib", (
                int(self.rng.choice([gl.GL_CURRENT_BIT, gl.GL_LIGHTING_BIT, gl.GL_ALL_ATTRIB_BITS])),
            )
        if which == 5:
            return "glPopAttrib", ()
        if which == 6:
            return "glRectf", tuple(self.floats(4))
        if which == 7:
            return "glBindFramebuffer", (gl.GL_FRAMEBUFFER, int(self.chance(0.2)))  # 1 is incomplete
        return "glShadeModel", (int(self.rng.choice([gl.GL_FLAT, gl.GL_SMOOTH])),)

    def similar_pairs(self) -> list[Call]:
        """Pairs in a row whose vertices all set the same attributes."""
        kinds = self.rng.permutation(["glNormal3f", "glTexCoord2f", "glColor3f"])[: int(self.rng.integers(0, 3))]
        calls: list[Call] = []
        for _ in range(int(self.rng.integers(2, 5))):
            calls.append(("glBegin", (int(self.rng.integers(gl.GL_POINTS, gl.GL_POLYGON + 1)),)))
            for _ in range(int(self.rng.integers(4, 7))):
                calls += [(str(kind), tuple(self.floats(2 if kind == "glTexCoord2f" else 3))) for kind in kinds]
                calls.append(("glVertex3f", tuple(self.floats(3))))
            calls.append(("glEnd", ()))
        return calls

    def mixed_pair(self) -> list[Call]:
        """A pair with calls among its vertices that are in no array of lists, rarely with more or fewer components."""
        kinds = self.rng.permutation(["glNormal3f", "glTexCoord2f", "glColor3f"])[: int(self.rng.integers(0, 3))]
        first = [(str(kind), tuple(self.floats(2 if kind == "glTexCoord2f" else 3))) for kind in kinds]
        calls: list[Call] = [("glBegin", (int(self.rng.integers(gl.GL_POINTS, gl.GL_POLYGON + 1)),)), *first]
        others: list[Call] = [
            ("glMaterialfv", (gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE, self.floats(4))),
            ("glMaterialf", (gl.GL_FRONT, gl.GL_SHININESS, 7.0)),
            ("glSecondaryColor3f", tuple(self.floats(3))),
            ("glFogCoordf", (0.5,)),
            ("glEdgeFlag", (self.chance(0.5),)),
            ("glCallList", (int(self.rng.integers(0, 5)),)),
        ]
        for _ in range(int(self.rng.integers(2, 12))):
            if self.chance(0.3):
                calls.append(others[int(self.rng.integers(len(others)))])
            if self.chance(0.05):
                calls.append(self.attribute())
            calls += [(name, tuple(self.floats(len(values)))) for name, values in first if self.chance(0.7)]
            calls.append(self.vertex() if self.chance(0.05) else ("glVertex3f", tuple(self.floats(3))))
        return [*calls, ("glEnd", ())]

    def some(self) -> list[Call]:
        which = self.rng.random()
        if which < 0.2:
            return self.similar_pairs()
        if which < 0.35:
            return self.mixed_pair()
        return self.pair() if which < 0.6 else [self.attribute()] if which < 0.75 else [self.between()]

    def program(self) -> list[Call]:
        calls: list[Call] = []
        for _ in range(12):
            if self.chance(0.4):
                mode = gl.GL_COMPILE if self.chance(0.7) else gl.GL_COMPILE_AND_EXECUTE
                calls.append(("glNewList", (int(self.rng.integers(1, 5)), mode)))
                for _ in range(int(self.rng.integers(1, 6))):
                    calls += self.some()
                calls.append(("glEndList", ()))
            else:
                calls += self.some()
            calls += [("glCallList", (int(self.rng.integers(1, 5)),)) for _ in range(int(self.rng.integers(0, 3)))]
        return calls


# -- comparison --------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("seed", range(30))
def test_lists_of_arrays_draw_what_their_calls_draw(monkeypatch, seed):
    calls, precision = Author(seed).program(), "exact" if seed % 5 == 4 else "mesa"
    # rules of Mesa's arrays: see mesa/test_list_contents.py and mesa/test_incomplete_primitives_in_lists.py
    monkeypatch.setattr(list_compiling, "joined", lambda run, **_: run)
    monkeypatch.setattr(list_primitives, "_is_left_out", lambda _: False)
    monkeypatch.setattr(list_primitives, "can_be_joined", lambda _: False)  # see test_joined_strips.py
    ours = what_happened(calls, precision)
    monkeypatch.setattr(lists, "with_primitives", lambda context, calls: calls)
    expected = what_happened(calls, precision)
    different = [(a, b) for a, b in zip(ours, expected, strict=True) if a != b]
    assert not different, different[0]


# -- what becomes an array ---------------------------------------------------------------------------------------------
def compiled(*calls: Call) -> list[Any]:
    gl.glNewList(1, gl.GL_COMPILE)
    for name, arguments in calls:
        getattr(gl, name)(*arguments)
    gl.glEndList()
    return gl.current().lists[1].calls


@pytest.fixture
def context():
    with gl.create_context(*SIZE) as context:
        yield context


TRIANGLE = [("glBegin", (gl.GL_TRIANGLES,)), *[("glVertex2f", (x, x * x)) for x in (-1, 0, 1)], ("glEnd", ())]


@pytest.mark.parametrize("color", [("glColor3f", (1, 0, 0)), ("glColor3ub", (255, 0, 0)), ("glColor4ub", (9, 0, 0, 1))])
def test_primitives_become_arrays(context, color):
    colored = [TRIANGLE[0], color, *TRIANGLE[1:]]
    calls = compiled(color, *TRIANGLE, ("glTranslatef", (1, 0, 0)), *colored)
    assert [type(call) is ListPrimitive for call in calls] == [False, True, False, True]


def test_all_calls_that_set_attributes_are_known(context):
    names = [
        name for name in dir(gl)
        if name.startswith(("glVertex", "glColor", "glNormal", "glTexCoord", "glMultiTexCoord"))
        and name[-1:] in "dfisbv" and any(digit in name for digit in "1234")
        and not name.endswith(("ARB", "EXT"))
    ]  # fmt: skip
    known, others = (
        {getattr(getattr(gl, name), "__wrapped__", getattr(gl, name)) for name in these}
        for these in (names, MAKE_OTHERS)
    )
    assert known - others == set(CALLS)


@pytest.mark.parametrize("name", [name for name in MAKE_OTHERS if name.endswith("v")])
def test_wrong_vectors_are_refused_before_they_are_recorded(context, name):
    with pytest.raises(ValueError, match=rf"{name}\(v=\[0\]\).*expected [234] numbers"):
        compiled((name, ([0],)))
    gl.glEndList()


@pytest.mark.parametrize(
    "call",
    [("glMaterialfv", (gl.GL_FRONT, gl.GL_DIFFUSE, (1, 0, 0, 1))), ("glCallList", (7,)), ("glVertex3iv", ([0, 1],)),
     ("glVertex2f", (2**60, 1)), ("glNormal3iv", ([0, 1],)), ("glBegin", (gl.GL_LINES,))],
)  # fmt: skip
def test_other_calls_stay_calls(context, call):
    assert not any(type(each) is ListPrimitive for each in compiled(*TRIANGLE[:2], call, *TRIANGLE[2:-1]))


def test_wrong_or_empty_primitives_stay_calls(context):
    for calls in (TRIANGLE[:1] + TRIANGLE[-1:], [("glBegin", (77,)), *TRIANGLE[1:]], TRIANGLE[1:], TRIANGLE[:-1]):
        assert not any(type(each) is ListPrimitive for each in compiled(*calls))
    assert with_primitives(context, []) == []


def test_the_same_vertices_are_drawn_again(context):
    compiled(("glNormal3f", (0, 1, 0)), *TRIANGLE)
    for red in (0.0, 0.5, -0.0, 0.5):
        gl.glColor3f(red, 0, 0)
        gl.glCallList(1)
    drawn = [command.vertices for command in context.frame.commands]
    assert drawn[1] is drawn[3]
    assert len({id(vertices) for vertices in drawn}) == 3
    assert [float(np.copysign(1, vertices.color[0, 0])) for vertices in drawn] == [1, 1, -1, 1]


def vertices_of_frames(context, frames, reds):
    """Return the vertices of each draw of some frames that call list 1 with several colours, by frame."""
    drawn = []
    for _ in range(frames):
        start = len(context.frame.commands)
        for red in reds:
            gl.glColor3f(red, 0, 0)
            gl.glCallList(1)
        drawn.append([command.vertices for command in context.frame.commands[start:]])
    return drawn


def test_vertices_are_kept_for_all_colours_of_a_frame(context):
    compiled(("glNormal3f", (0, 1, 0)), *TRIANGLE)
    first, second = vertices_of_frames(context, 2, np.linspace(0, 1, 100).tolist())
    assert list(map(id, second)) == list(map(id, first))
    assert len(set(map(id, first))) == 100


def test_the_number_of_kept_vertices_is_bounded_but_for_one_of_each_primitive(context, monkeypatch):
    monkeypatch.setattr(constant_attributes, "MOST_DRAWN", 20)
    compiled(*[call for _ in range(30) for call in (("glTranslatef", (0, 0, 0)), *TRIANGLE)])
    first, second = vertices_of_frames(context, 2, [0.5])
    assert list(map(id, second)) == list(map(id, first))
    vertices_of_frames(context, 2, np.linspace(0, 1, 10).tolist())
    primitives = [call for call in context.lists[1].calls if isinstance(call, ListPrimitive)]
    assert len(primitives) == 30
    assert sum(len(primitive.drawn._by_set) for primitive in primitives) <= 20 + 2 * 30


def test_equal_corners_are_one_vertex(context):
    corners = [("glVertex2f", corner) for corner in ((0, 0), (1, 0), (0, 1), (0, 1), (1, 0), (1, 1), (-0.0, 0))]
    for mode, count, n_vertices in ((gl.GL_TRIANGLES, 6, 4), (gl.GL_QUADS, 4, 3), (gl.GL_QUADS, 5, 5)):
        (primitive,) = compiled(("glBegin", (mode,)), *corners[:count], ("glEnd", ()))
        assert (len(primitive.rows[0]), len(primitive.indices)) == (n_vertices, count)
    (primitive,) = compiled(("glBegin", (gl.GL_TRIANGLES,)), *corners[:2], corners[-1], ("glEnd", ()))
    assert len(primitive.rows[0]) == 3
    assert primitive.indices.tolist() == [0, 1, 2]


def test_vertices_among_materials_have_the_same_arrays_each_time(context):
    material = "glMaterialfv", (gl.GL_FRONT, gl.GL_DIFFUSE, (1.0, 0.5, 0.0, 1.0))
    normals = [("glNormal3f", (0.0, 0.0, z)) for z in (1.0, -1.0, 0.5)]
    vertices = [("glVertex3f", (x, x * x, 0.0)) for x in (-1.0, 0.0, 1.0)]
    first, second, third = zip(normals, vertices, strict=True)
    (pair,) = compiled(("glBegin", (gl.GL_TRIANGLES,)), *first, *second, material, *third, ("glEnd", ()))
    assert type(pair) is MixedPrimitive
    for _ in range(2):
        gl.glCallList(1)
    one, other = (command.vertices for command in context.frame.commands)
    assert one.position is other.position
    assert one.normal is other.normal
    assert one.normal[:, 2].tolist() == [1.0, -1.0, 0.5]
    assert one.materials["front.diffuse"][:, 0].tolist() == pytest.approx([0.8, 0.8, 1.0])  # the default is 0.8


@pytest.mark.parametrize("face", [gl.GL_FRONT, gl.GL_BACK, gl.GL_FRONT_AND_BACK])
@pytest.mark.parametrize("follows", [gl.GL_FRONT, gl.GL_FRONT_AND_BACK, None])
@pytest.mark.parametrize("precision", ["mesa", "exact"])
def test_materials_of_a_list_are_arrays_with_the_numbers_of_the_calls(monkeypatch, face, follows, precision):
    """Those that follow glColor do not change; a value from the middle on is none of the first vertices."""
    calls: list[Call] = [("glNewList", (1, gl.GL_COMPILE)), ("glBegin", (gl.GL_TRIANGLES,))]
    for vertex in range(9):
        if vertex % 2 == 0:
            calls.append(("glMaterialfv", (face, gl.GL_AMBIENT_AND_DIFFUSE, [0.1 * vertex, 0.3, 1.5, 1])))
        if vertex == 4:
            calls.append(("glMaterialfv", (face, gl.GL_SPECULAR, np.array([1, 2, 3, 4], np.float32))))
        calls += [("glNormal3f", (0.0, 0.1 * vertex, 1.0)), ("glVertex2f", (0.1 * vertex, 0.0))]
    calls += [("glEnd", ()), ("glEndList", ())]
    if follows is not None:
        calls += [("glEnable", (gl.GL_COLOR_MATERIAL,)), ("glColorMaterial", (follows, gl.GL_DIFFUSE))]
    calls += [("glCallList", (1,)), ("glCallList", (1,))]
    ours = what_happened(calls, precision)
    monkeypatch.setattr(lists, "with_primitives", lambda context, calls: calls)
    assert what_happened(calls, precision) == ours


def test_a_list_keeps_the_arrays_of_its_materials(context):
    material = "glMaterialfv", (gl.GL_FRONT, gl.GL_DIFFUSE, (1.0, 0.5, 0.0, 1.0))
    vertices = [("glVertex3f", (x, x * x, 0.0)) for x in (-1.0, 0.0, 1.0)]
    compiled(("glBegin", (gl.GL_TRIANGLES,)), material, *vertices, material, *vertices, ("glEnd", ()))
    for _ in range(2):
        gl.glCallList(1)
    one, other = (command.vertices.materials["front.diffuse"] for command in context.frame.commands)
    assert one is other
