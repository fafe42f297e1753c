"""Vectors may be lists, tuples, arrays of any kind or bytes: GL gets the numbers that PyOpenGL passes."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.testing import run_on_mesa

SIZE = (4, 4)
NUMBERS = (0.25, 1.75, -2.5, 0.5)
KINDS = ("f4", "f8", "f2", "i1", "u1", "i2", "u2", "i4", "u4", "i8")
# call: how many numbers it takes, what its first arguments are, and what answers afterwards
CALLS: dict[str, tuple[int, tuple[str, ...], str]] = {
    **{f"glColor3{t}v": (3, (), "GL_CURRENT_COLOR") for t in ("b", "ub", "s", "us", "i", "ui", "f", "d")},
    **{f"glColor4{t}v": (4, (), "GL_CURRENT_COLOR") for t in ("b", "ub", "s", "us", "i", "ui", "f", "d")},
    **{f"glNormal3{t}v": (3, (), "GL_CURRENT_NORMAL") for t in ("b", "s", "i", "f", "d")},
    **{f"glTexCoord{n}{t}v": (n, (), "GL_CURRENT_TEXTURE_COORDS") for n in (1, 2, 3, 4) for t in "ifd"},
    **{f"glMultiTexCoord2{t}v": (2, ("GL_TEXTURE0",), "GL_CURRENT_TEXTURE_COORDS") for t in "ifd"},
    **{f"glFog{t}v": (4, ("GL_FOG_COLOR",), "GL_FOG_COLOR") for t in ("f", "i")},
    **{f"glLightModel{t}v": (4, ("GL_LIGHT_MODEL_AMBIENT",), "GL_LIGHT_MODEL_AMBIENT") for t in ("f", "i")},
}
OBJECT_CALLS = {
    **{f"glLight{t}v": (n, ("GL_LIGHT1", p)) for t in "fi" for n, p in ((4, "GL_DIFFUSE"), (4, "GL_POSITION"))},
    **{f"glMaterial{t}v": (4, ("GL_FRONT", "GL_SPECULAR")) for t in "fi"},
    **{f"glTexEnv{t}v": (4, ("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_COLOR")) for t in "fi"},
    **{f"glTexGen{t}v": (4, ("GL_S", "GL_OBJECT_PLANE")) for t in "fid"},
    **{f"glTexParameter{t}v": (4, ("GL_TEXTURE_2D", "GL_TEXTURE_BORDER_COLOR")) for t in "fi"},
}


def vectors(length: int, integers: bool) -> Iterator[tuple[str, Any]]:
    """The same numbers in all the forms that PyOpenGL takes; of lists it does not cut the numbers for integer calls."""
    given = NUMBERS[:length]
    with np.errstate(invalid="ignore"):
        yield from ((kind, np.array(given).astype(np.int64 if kind[0] == "u" else kind).astype(kind)) for kind in KINDS)
    yield "strided", np.repeat(np.array(given, np.float32), 2)[::2]
    if not integers:
        yield from (("list", list(given)), ("tuple", given), ("nested", [list(given)]))
        yield "scalars", [np.float32(number) for number in given]


def all_answers(gl: Any) -> dict[str, Any]:
    """What every call leaves behind, by the form of its vector."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    answers = {}

    def ask(name: str, length: int, before: tuple[str, ...], question: Callable[[], Any]) -> None:
        for form, values in vectors(length, integers=name[-2] not in "fd"):
            gl.glColor4f(0.1, 0.2, 0.3, 0.4)
            gl.glTexCoord4f(5, 6, 7, 8)
            getattr(gl, name)(*(getattr(gl, token) for token in before), values)
            answers[f"{name}{before} {form}"] = np.array(question()).tolist()

    for name, (length, before, query) in CALLS.items():
        ask(name, length, before, lambda query=query: gl.glGetFloatv(getattr(gl, query)))
    for name, (length, before) in OBJECT_CALLS.items():
        getter = getattr(gl, name.replace("gl", "glGet", 1)[:-2] + "fv")
        ask(name, length, before, lambda g=getter, b=before: g(*(getattr(gl, token) for token in b)))
    return answers


def all_matrices(gl: Any) -> dict[str, Any]:
    """The modelview matrix after each way to give 16 numbers."""
    given = np.arange(16) * 1.5
    forms = {
        "list": given.tolist(), "nested": given.reshape(4, 4).tolist(), "f8": given, "f4": given.astype("f4"),
        "i4": given.astype("i4"), "turned": given.reshape(4, 4).T, "fortran": np.asfortranarray(given.reshape(4, 4)),
    }  # fmt: skip
    answers = {}
    for name in ("glLoadMatrixf", "glLoadMatrixd", "glMultMatrixf", "glMultMatrixd"):
        for form, values in {**forms, "bytes": given.astype(f"f{8 if name[-1] == 'd' else 4}").tobytes()}.items():
            gl.glLoadIdentity()
            getattr(gl, name)(values)
            answers[f"{name} {form}"] = np.array(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX)).tolist()
    return answers


def wrapped_numbers(gl: Any) -> list[Any]:
    """Integers that do not fit lose their upper bits; masks and references may be given as -1 or 0xFFFFFFFF."""
    answers = []
    for name, value in (("ub", 300), ("b", 200), ("s", 40000), ("us", -1), ("i", 2**31), ("ui", -1)):
        getattr(gl, f"glColor3{name}")(value, 0, 1)
        answers.append(np.array(gl.glGetFloatv(gl.GL_CURRENT_COLOR)).tolist())
    gl.glStencilFunc(gl.GL_LESS, 0xFFFFFFFF, -1)
    gl.glClearStencil(0xFFFFFFFF)
    names = ("GL_STENCIL_REF", "GL_STENCIL_VALUE_MASK", "GL_STENCIL_CLEAR_VALUE")
    return answers + [int(gl.glGetIntegerv(getattr(gl, name))) for name in names]


def kept_components(gl: Any) -> list[Any]:
    """Alpha and q after calls that give fewer numbers than the ones before."""
    answers = []
    for _ in range(3):
        gl.glColor4f(0.1, 0.2, 0.3, 0.4)
        gl.glColor3f(1, 0, 0)
        answers.append(np.array(gl.glGetFloatv(gl.GL_CURRENT_COLOR)).tolist())
        gl.glTexCoord4f(1, 2, 3, 4)
        gl.glTexCoord1f(9)
        gl.glTexCoord2f(5, 6)
        answers.append(np.array(gl.glGetFloatv(gl.GL_CURRENT_TEXTURE_COORDS)).tolist())
    gl.glColor4f(0.1, 0.2, 0.3, 0.4)
    gl.glColor3ub(255, 0, 0)
    answers.append(np.array(gl.glGetFloatv(gl.GL_CURRENT_COLOR)).tolist())
    gl.glEnable(gl.GL_FOG)
    gl.glColor3f(0, 1, 0)
    return [*answers, np.array(gl.glGetFloatv(gl.GL_CURRENT_COLOR)).tolist()]


def kept_alpha(gl: Any) -> None:
    """Blended quads whose last glColor3f comes after two glColor4f: Mesa draws the last one translucent."""
    gl.glClearColor(0.25, 0.5, 0.75, 1)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glBegin(gl.GL_QUADS)
    for row in range(4):
        (gl.glColor4f if row % 2 == 0 else gl.glColor3f)(*(1, 0.5, 0.25, 0.375)[: 4 - row % 2])
        for x, y in ((-1, row), (1, row), (1, row + 1), (-1, row + 1)):
            gl.glVertex2f(x, y / 2 - 1)
    gl.glEnd()


PROGRAMS = {f.__name__: f for f in (all_answers, all_matrices, wrapped_numbers, kept_components)}


@pytest.mark.mesa
@pytest.mark.parametrize("name", PROGRAMS)
def test_numbers_arrive_as_on_mesa(name):
    with gl.create_context(*SIZE):
        ours = PROGRAMS[name](gl)
    assert ours == run_on_mesa(PROGRAMS[name], SIZE).returned


@pytest.mark.mesa
def test_alpha_of_three_numbers_is_that_of_mesa():
    with gl.create_context(*SIZE):
        kept_alpha(gl)
        ours = gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
    theirs = run_on_mesa(kept_alpha, SIZE).color
    np.testing.assert_array_equal(ours, theirs)
    assert len(np.unique(ours[:, 0], axis=0)) == 2  # rows 0, 2 and 3 translucent, row 1 opaque


def test_too_few_numbers_are_refused():
    with gl.create_context(*SIZE), pytest.raises(ValueError, match="expected 3 numbers"):
        gl.glColor3fv([1, 2])


def test_sizes_may_be_numpy_integers():
    size = np.int64(4)
    texels = np.arange(64, dtype=np.uint8).reshape(4, 4, 4)
    with gl.create_context(8, 8):
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, size, size, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, texels)
        gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
        assert (gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE).ravel() == texels.ravel()).all()
        assert gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 1, gl.GL_TEXTURE_WIDTH) == 2
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, np.int32(0), 0, size, size, 0)
        gl.glGenerateMipmap(gl.GL_TEXTURE_2D)
        assert gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 2, gl.GL_TEXTURE_WIDTH) == 1
