"""Modules that stand in for PyOpenGL, GLUT, pygame and GLFW while a program runs."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any

from softshadow import gl
from softshadow.context import thread
from softshadow.errors import SoftShadowError
from softshadow.gl import GLError
from softshadow.recordings.draw_calls import is_draw
from softshadow.recordings.draw_labels import DrawLabels
from softshadow.windows import buffer_objects
from softshadow.windows.c_types import C_TYPES
from softshadow.windows.desktop import desktop
from softshadow.windows.glfw_window import Glfw
from softshadow.windows.glut import Glut
from softshadow.windows.pygame_window import pygame_modules

CALL = re.compile(r"\bgl(?:u|ut)?[A-Z]\w*")
DRAWN_BY_GLUT = re.compile("glut(Solid|Wire|(Bitmap|Stroke)(Character|String))")
LABELS = DrawLabels()
MOST_FILES = 200  # of the program's folder that are searched for the names of calls
REPLACED = ("OpenGL", "pygame", "glfw")


class Facade(ModuleType):
    """A module whose names are looked up when they are used.

    Parameters
    ----------
    find : callable              returns the value of a name; AttributeError for others
    names : list of str          what ``from module import *`` imports
    """

    def __init__(self, name: str, find: Callable[[str], Any], names: list[str]) -> None:
        super().__init__(name)
        self.__path__: list[str] = []  # it has submodules
        self._find = find
        self.__all__ = names

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        value = self._find(name)
        setattr(self, name, value)
        return value


def labelled(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a call that names its draws by the line of the program that makes it."""

    def draw(*arguments: Any, **named: Any) -> Any:
        context = desktop().context
        if context is None or thread.context is not context:
            return function(*arguments, **named)
        return LABELS.draw(context, _line_of(sys._getframe(1)), lambda: function(*arguments, **named))

    def end(*arguments: Any) -> Any:
        context = desktop().context
        if context is None or thread.context is not context:
            return function(*arguments)
        return LABELS.end(context, lambda: function(*arguments))

    call = end if name == "glEnd" else draw
    call.__name__ = name
    return call


def _line_of(frame: FrameType) -> str:
    """Return the line that a call stands in, with the name of its file if that is not the program's."""
    file = frame.f_code.co_filename
    where = "" if file == desktop().program else f"{Path(file).name} "
    return f"{where}line {frame.f_lineno}"


def left_out(name: str) -> Callable[..., None]:
    """Return a function that does nothing but count that a program has called it."""

    def call(*_: Any, **__: Any) -> None:
        desktop().leave_out(name)

    call.__name__ = name
    return call


def _gl_name(name: str) -> Any:
    """Return a name of GL or GLU; a call that this package does not have is left out, and counted."""
    if name in C_TYPES:
        return C_TYPES[name]
    try:
        value = getattr(gl, name)
    except AttributeError:
        if CALL.fullmatch(name):
            return left_out(name)
        raise
    return labelled(name, value) if is_draw(name) or name == "glEnd" else value


def _of(names: Mapping[str, Any], module: str) -> Callable[[str], Any]:
    def find(name: str) -> Any:
        if name in names:
            return labelled(name, names[name]) if DRAWN_BY_GLUT.match(name) else names[name]
        if CALL.fullmatch(name):
            return left_out(name)
        raise AttributeError(f"module {module!r} has no attribute {name!r} here")

    return find


def _no_shaders(name: str) -> Any:
    """Refuse OpenGL.GL.shaders: GLSL is not part of this package."""
    raise SoftShadowError(f"OpenGL.GL.shaders.{name}: shaders in GLSL cannot be run here, only OpenGL's fixed function")


def calls_in(folder: Path) -> set[str]:
    """Return the names of GL, GLU and GLUT calls in the Python files of a folder."""
    found: set[str] = set()
    for file in sorted(folder.glob("*.py"))[:MOST_FILES]:
        found.update(CALL.findall(file.read_text(encoding="utf-8", errors="replace")))
    return found


def modules_for(program: Path) -> dict[str, ModuleType]:
    """Return the modules that a program gets, by name."""
    used, glut = calls_in(program.parent), Glut().names()
    calls = [name for name in used if not name.startswith(("glu", "glut"))]
    gl_names = sorted({*gl.__all__, *calls, *C_TYPES} - {"record", "step", "program", "create_context", "Context"})
    glu_names = [name for name in gl.__all__ if name.startswith("glu")]
    glu_names += [name for name in used if name.startswith("glu") and not name.startswith("glut")]
    glut_names = sorted({*glut, *(name for name in used if name.startswith("glut"))})
    errors = {"GLError": GLError, "GLUError": GLError, "NullFunctionError": AttributeError, "Error": GLError}
    modules: dict[str, ModuleType] = {
        "OpenGL": Facade("OpenGL", _of({"ERROR_CHECKING": True, "__version__": "3.1"}, "OpenGL"), []),
        "OpenGL.GL": Facade("OpenGL.GL", _gl_name, gl_names),
        "OpenGL.GLU": Facade("OpenGL.GLU", _gl_name, sorted(set(glu_names))),
        "OpenGL.GLUT": Facade("OpenGL.GLUT", _of(glut, "OpenGL.GLUT"), glut_names),
        "OpenGL.error": Facade("OpenGL.error", _of(errors, "OpenGL.error"), list(errors)),
    }
    modules["OpenGL.arrays"] = Facade("OpenGL.arrays", _of({}, "OpenGL.arrays"), ["vbo"])
    vbo = Facade("OpenGL.arrays.vbo", _of(buffer_objects.NAMES, "OpenGL.arrays.vbo"), list(buffer_objects.NAMES))
    modules["OpenGL.arrays.vbo"] = modules["OpenGL.arrays"].vbo = vbo  # type: ignore[attr-defined]
    modules["OpenGL.GL.shaders"] = Facade("OpenGL.GL.shaders", _no_shaders, [])
    for name in ("GL", "GLU", "GLUT", "error", "arrays"):
        setattr(modules["OpenGL"], name, modules[f"OpenGL.{name}"])
    glfw = Glfw().names()
    modules["glfw"] = Facade("glfw", _of(glfw, "glfw"), list(glfw))
    for name, names in pygame_modules().items():
        modules[name] = Facade(name, _of(names, name), list(names))
    for name in list(modules):
        parent, dot, child = name.rpartition(".")
        if dot and parent == "pygame":
            setattr(modules[parent], child, modules[name])
    return modules


@contextmanager
def replaced_modules(modules: dict[str, ModuleType]) -> Iterator[None]:
    """Let programs import these modules in place of installed ones of the same names."""
    before = {name: module for name, module in sys.modules.items() if name.split(".")[0] in REPLACED}
    for name in before:
        del sys.modules[name]
    sys.modules.update(modules)
    try:
        yield
    finally:
        for name in [name for name in sys.modules if name.split(".")[0] in REPLACED]:
            del sys.modules[name]
        sys.modules.update(before)
