"""The GL calls of a Python program, as `softshadow run` makes them, so that Mesa can make the same ones."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.recordings.draw_calls import is_query
from softshadow.runs import Run
from softshadow.windows import facades, run_script
from softshadow.windows.glut import drawing, fonts, loop


class LoggedGL:
    """`softshadow.gl`, with a list of all calls that are made by it."""

    def __init__(self) -> None:
        self.calls: list[tuple[str, tuple[Any, ...]]] = []

    def __getattr__(self, name: str) -> Any:
        value = getattr(gl, name)
        if not name.startswith("gl") or not callable(value) or is_query(name):
            return value

        def call(*arguments: Any) -> Any:
            self.calls.append((name, tuple(map(_copied, arguments))))
            return value(*arguments)

        return call


def _copied(value: Any) -> Any:
    return value.copy() if isinstance(value, np.ndarray) else value


def run_logged(monkeypatch: pytest.MonkeyPatch, path: Path, **options: Any) -> tuple[Run, Callable[[Any], None]]:
    """Return the last frame of a program, and ``program(gl)`` that makes all its calls."""
    log = LoggedGL()
    for module in (facades, drawing, fonts, loop):
        monkeypatch.setattr(module, "gl", log)
    run = run_script(path, **options)
    return run, partial(_play, log.calls)


def _play(calls: list[tuple[str, tuple[Any, ...]]], namespace: Any) -> None:
    for name, arguments in calls:
        getattr(namespace, name)(*arguments)
