"""The calls of a trace as a program for `softshadow.testing`, which runs on Mesa as well."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.recordings.arguments import arguments_of
from softshadow.recordings.draw_calls import is_query
from softshadow.traces import Trace

ARRAY_BUFFER = 0x8892
TYPES = {0x1406: np.float32, 0x140A: np.float64, 0x1402: np.int16, 0x1404: np.int32}
ELSEWHERE = ("glX", "glMapBuffer", "glUnmapBuffer")
NAMES = ("glGenTextures", "glGenBuffers", "glGenFramebuffers", "glGenRenderbuffers", "glGenQueries", "glGenLists")


def program_of(path: Path, last: int) -> Any:
    """Return ``program(gl)`` that makes the GL calls of a trace up to a number, with one context."""
    calls: list[tuple[str, list[Any]]] = []
    for call in Trace(path):
        if call.number > last:
            break
        if call.name == "memcpy":  # to the array buffer, in the traces of the tests
            calls.append(("glBufferSubData", [ARRAY_BUFFER, 0, call.arguments[2], call.arguments[1]]))
        elif call.name.startswith("gl") and not call.name.startswith(ELSEWHERE) and not is_query(call.name):
            arguments = arguments_of(call.name, call.arguments)
            calls.append((call.name, [_memory(call.name, arguments, value) for value in arguments]))
    return partial(_play, calls)


def _memory(name: str, arguments: list[Any], value: Any) -> Any:
    """Return bytes as an array of their type: PyOpenGL converts arrays of another one."""
    if not isinstance(value, bytes):
        return value
    type = arguments[-3] if name.endswith("Pointer") else None
    return np.frombuffer(value, TYPES.get(type, np.uint8))


def _play(calls: list[tuple[str, list[Any]]], gl: Any) -> None:
    for name, arguments in calls:
        if name == "glGenLists":
            gl.glGenLists(*arguments)
        elif name not in NAMES:
            getattr(gl, name)(*arguments)
