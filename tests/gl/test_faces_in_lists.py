"""Faces of a model in a display list, each in a glBegin and glEnd, are one draw with the pixels of single ones."""

from random import Random

import numpy as np
import pytest

from gl.primitives_in_a_row import buffers_and_draws, set_where_order_matters
from softshadow import gl
from softshadow.gl import list_compiling, lists
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.commands import Draw

MODES = range(gl.GL_POINTS, gl.GL_POLYGON + 1)
SWITCHES = (
    gl.GL_CULL_FACE, gl.GL_LIGHTING, gl.GL_COLOR_MATERIAL, gl.GL_CLIP_PLANE0, gl.GL_BLEND, gl.GL_POLYGON_STIPPLE,
    gl.GL_LINE_STIPPLE, gl.GL_TEXTURE_2D, gl.GL_POLYGON_OFFSET_LINE,
)  # fmt: skip
CORNERS = {gl.GL_POINTS: 1, gl.GL_LINES: 2, gl.GL_TRIANGLES: 3, gl.GL_QUADS: 4}


def textures(rng: np.random.Generator) -> list[int]:
    names = [int(name) for name in gl.glGenTextures(2)]
    for name in names:
        gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        pixels = rng.integers(0, 256, (4, 4, 3), np.uint8)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 4, 4, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, pixels)
    return names


def compile_faces(random: Random, names: list[int]) -> None:
    """Compile a list of faces of one mode or two, with the materials before each, most of them the same again."""
    colors = [tuple(random.random() for _ in range(random.choice((3, 4)))) for _ in range(2)]
    modes, sets_colors, binds = (
        random.choices(MODES, k=random.choice((1, 1, 2))),
        random.random() < 0.7,
        random.random() < 0.3,
    )
    color, name = random.choice(colors), random.choice(names)
    gl.glNewList(1, random.choice((gl.GL_COMPILE, gl.GL_COMPILE, gl.GL_COMPILE_AND_EXECUTE)))
    for _ in range(random.randint(2, 9)):
        color, name = (
            random.choices((color, random.choice(colors)), (5, 1))[0],
            random.choices((name, names[0]), (5, 1))[0],
        )
        if binds:
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        if sets_colors:
            (gl.glColor3f if len(color) == 3 else gl.glColor4f)(*color)
        mode = random.choice(modes)
        gl.glBegin(mode)
        for _ in range(CORNERS.get(mode, random.choice((3, 4, 4, 5, 6))) * random.choice((1, 1, 2))):
            gl.glNormal3f(*[random.uniform(-1.0, 1.0) for _ in range(3)])
            gl.glTexCoord2f(random.random(), random.random())
            gl.glVertex3f(*[random.uniform(-1.3, 1.3) for _ in range(3)])
        gl.glEnd()
    if random.random() < 0.2:
        gl.glColor3f(*color[:3])
    gl.glEndList()


def drawn(seed: int) -> tuple[list[bytes], list[Draw]]:
    """Return the buffers and the current values that lists of faces under random states leave, and the draws."""
    random = Random(seed)
    with gl.create_context(24, 18) as context:
        names = textures(np.random.default_rng(seed))
        set_where_order_matters()
        gl.glEnable(gl.GL_LIGHT0)
        for _ in range(5):
            random.choice((gl.glEnable, gl.glDisable))(random.choice(SWITCHES))
            if random.random() < 0.3:
                gl.glShadeModel(random.choice((gl.GL_FLAT, gl.GL_SMOOTH)))
            if random.random() < 0.2:
                gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, [random.random() for _ in range(4)])
            if random.random() < 0.3:
                faces = random.choice((gl.GL_FRONT, gl.GL_FRONT_AND_BACK, gl.GL_FRONT_AND_BACK))
                gl.glPolygonMode(faces, random.choice((gl.GL_FILL, gl.GL_FILL, gl.GL_LINE, gl.GL_POINT)))
            compile_faces(random, names)
            for _ in range(random.randint(1, 2)):
                gl.glCallList(1)
                if random.random() < 0.3:
                    gl.glRectf(-0.5, -0.5, 0.3, 0.4)
        buffers, draws = buffers_and_draws(context)
        for name in (gl.GL_CURRENT_COLOR, gl.GL_CURRENT_NORMAL, gl.GL_TEXTURE_BINDING_2D):
            buffers.append(np.asarray(gl.glGetFloatv(name)).tobytes())
        buffers.append(np.asarray(gl.glGetMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE)).tobytes())
        return buffers, draws


@pytest.mark.parametrize("seeds", [range(start, start + 25) for start in range(0, 200, 25)], ids=str)
def test_faces_of_a_list_have_the_pixels_of_single_ones(seeds: range, monkeypatch: pytest.MonkeyPatch) -> None:
    # what Mesa joins itself is other primitives: see mesa/test_list_contents.py
    monkeypatch.setattr(list_compiling, "joined", lambda run, **_: run)
    joined = {seed: drawn(seed) for seed in seeds}
    with use_short_cuts(False):
        assert {seed: drawn(seed)[0] for seed in seeds[:5]} == {seed: joined[seed][0] for seed in seeds[:5]}
    monkeypatch.setattr(lists, "with_primitives", lambda _, calls: calls)
    n_joined = n_single = 0
    for seed in seeds:
        buffers, draws = drawn(seed)
        assert buffers == joined[seed][0], seed
        n_joined, n_single = n_joined + len(joined[seed][1]), n_single + len(draws)
    assert n_joined < 0.85 * n_single


def faces(mode: int, *, colors: bool, texture: int = 0) -> None:
    for face in range(20):
        if texture:
            gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        if colors:
            gl.glColor3f(0.5, 0.25, float(face // 10))
        gl.glBegin(mode)
        for x, y in ((0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1))[: CORNERS.get(mode, 4)]:
            gl.glVertex2f(x + 0.05 * face - 0.5, y)
        gl.glEnd()


@pytest.mark.parametrize("mode", [mode for mode in MODES if mode != gl.GL_LINE_STRIP], ids=str)
@pytest.mark.parametrize("colors", [False, True])
def test_faces_of_one_material_are_one_draw(mode: int, colors: bool) -> None:
    with gl.create_context(8, 8) as context:
        (texture,) = textures(np.random.default_rng(0))[:1]
        gl.glNewList(1, gl.GL_COMPILE)
        faces(mode, colors=colors, texture=texture)
        gl.glEndList()
        before = len(context.frame.commands)
        gl.glCallList(1)
        draws = context.frame.commands[before:]
    assert len(draws) == (2 if colors else 1)
    assert sum(len(draw.vertices.position) for draw in draws) >= 20 * min(CORNERS.get(mode, 4), 2)


def test_what_may_change_the_colour_lets_it_be_set_again() -> None:
    with gl.create_context(8, 8) as context:
        gl.glNewList(2, gl.GL_COMPILE)
        gl.glColor3f(0.0, 0.0, 1.0)
        gl.glEndList()
        gl.glNewList(1, gl.GL_COMPILE)
        faces(gl.GL_TRIANGLES, colors=True)
        gl.glCallList(2)
        gl.glColor3f(0.5, 0.25, 1.0)
        gl.glColor3f(0.5, 0.25, -0.0)
        gl.glColor3f(0.5, 0.25, 0.0)
        gl.glEndList()
        names = [getattr(call, "func", None) for call in context.lists[1].calls]
        assert sum(getattr(each, "__name__", "") == "glColor3f" for each in names) == 5
        gl.glCallList(1)
        assert gl.glGetFloatv(gl.GL_CURRENT_COLOR).tolist() == [0.5, 0.25, 0.0, 1.0]


def test_a_face_that_sets_colours_lets_the_one_before_be_set_again() -> None:
    with gl.create_context(8, 8):
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glColor3f(1.0, 0.0, 0.0)
        gl.glBegin(gl.GL_TRIANGLES)
        for x, y in ((0.0, 0.0), (0.1, 0.0), (0.1, 0.1)):
            gl.glColor3f(0.0, 0.0, 1.0)
            gl.glVertex2f(x, y)
        gl.glEnd()
        gl.glColor3f(1.0, 0.0, 0.0)
        gl.glEndList()
        gl.glCallList(1)
        assert gl.glGetFloatv(gl.GL_CURRENT_COLOR).tolist() == [1.0, 0.0, 0.0, 1.0]
