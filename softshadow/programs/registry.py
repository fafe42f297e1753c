"""The programs by name: the built-in ones and those that users register."""

from __future__ import annotations

from functools import cache

from softshadow.errors import StateError, nearest
from softshadow.programs.program import Program

_PROGRAMS: dict[str, Program] = {}


def register(program: Program) -> Program:
    """Register a program under its name for `gl.program`; it replaces an earlier one of the same name."""
    _PROGRAMS[program.name] = program
    return program


def get(name: str) -> Program:
    """Return the program with this name.

    Raises
    ------
    StateError                   unknown name; the message suggests the nearest one
    """
    _register_builtin()
    if name not in _PROGRAMS:
        raise StateError(f"program {name!r} is not known: {nearest(name, sorted(_PROGRAMS))}")
    return _PROGRAMS[name]


@cache
def _register_builtin() -> None:
    from softshadow.programs.builtin import BUILTIN  # loads the kernels, so only on the first use of a program

    for program in BUILTIN:
        register(program)
