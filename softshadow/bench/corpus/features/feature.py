"""A feature of GL, added to a mesh that is otherwise drawn in the usual way: lit, textured, tested for depth.

The programs of the corpus show what people draw; features show what each setting costs, alone or several together.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from typing import Any

from softshadow.bench.corpus.program import DrawNumberedFrame, Program
from softshadow.bench.corpus.shapes import checkers, torus
from softshadow.bench.corpus.views import draw, light, look, upload

Around = Callable[[], AbstractContextManager[Any]]
FAMILY = "features"
PLAIN = "plain"  # the mesh without any feature
AND = "+"  # between the names of features that are measured together
COLUMNS, ROWS = 64, 24  # of the mesh: 3,072 triangles


@dataclass(frozen=True)
class Feature:
    """A feature with what sets it.

    Attributes
    ----------
    name, title : str
    prepare : gl -> None or Around     sets the feature once; the context manager is entered around each drawing
    """

    name: str
    title: str
    prepare: Callable[[Any], Around | None]


def feature(prepare: Callable[[Any], Around | None]) -> Feature:
    """Return the feature of a function: its name with dashes, and the first sentence of its docstring."""
    return Feature(prepare.__name__.replace("_", "-"), (prepare.__doc__ or "").partition(".")[0], prepare)


def setting(name: str, title: str, *capabilities: str, **settings: tuple[Any, ...]) -> Feature:
    """Return a feature that only enables capabilities and makes calls, as in ``glFogi=("GL_FOG_MODE", "GL_LINEAR")``.

    Arguments that are str are names of tokens.
    """

    def prepare(gl: Any) -> None:
        for capability in capabilities:
            gl.glEnable(getattr(gl, capability))
        for call, arguments in settings.items():
            getattr(gl, call)(*[getattr(gl, each) if isinstance(each, str) else each for each in arguments])

    return Feature(name, title, prepare)


def program_of(features: tuple[Feature, ...]) -> Program:
    """Return the program that draws the mesh with all these features."""

    def prepare(gl: Any, size: tuple[int, int]) -> DrawNumberedFrame:
        mesh = torus(1.0, 0.45, COLUMNS, ROWS)
        look(gl, size, (0.0, 1.5, 2.6))
        light(gl)
        upload(gl, checkers(), gl.GL_LINEAR_MIPMAP_LINEAR, gl.GL_REPEAT)  # with mipmaps, which some filters use
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glClearColor(0.1, 0.15, 0.25, 1.0)
        gl.glColor4f(0.9, 0.8, 0.7, 0.6)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)  # a feature may keep later ones from some pixels
        around = [each for each in (feature.prepare(gl) for feature in features) if each is not None]

        def frame(number: int) -> None:
            gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
            look(gl, size, (0.0, 1.5, 2.6))
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [2.0, 5.0, 3.0, 1.0])
            gl.glRotatef(3.0 * number, 0.3, 1.0, 0.2)
            with ExitStack() as stack:
                for each in around:
                    stack.enter_context(each())
                draw(gl, mesh, texture=True)

        return frame

    names = AND.join(each.name for each in features) or PLAIN
    return Program(f"{FAMILY}/{names}", ", ".join(each.title for each in features) or "the mesh alone", prepare)
