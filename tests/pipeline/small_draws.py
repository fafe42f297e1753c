"""Small draws that wait, and fixtures that tell which batches are set up and how many draws are planned."""

from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.pipeline import draw_kinds, execute_waiting
from softshadow.pipeline.commands import Draw

SIZE = 32


@pytest.fixture
def planned(monkeypatch):
    """Return a list that grows by 1 for each draw that is planned."""
    planned, plan_draw = [], draw_kinds.plan_draw
    monkeypatch.setattr(draw_kinds, "plan_draw", lambda *arguments: planned.append(1) or plan_draw(*arguments))
    return planned


@pytest.fixture
def batches(monkeypatch):
    """Return a list that gets the number of draws of each batch that is set up."""
    batches: list[int] = []
    geometry_of = execute_waiting.geometry_of

    def note_batch(run: Any, setting: Any, draws: list[Draw], *rest: Any) -> Any:
        batches.append(len(draws))
        return geometry_of(run, setting, draws, *rest)

    monkeypatch.setattr(execute_waiting, "geometry_of", note_batch)
    return batches


def draw_triangle(y: float = -1) -> None:
    """Draw the lower left half of the window, above y."""
    gl.glBegin(gl.GL_TRIANGLES)
    for corner in ((-1, y), (1, y), (-1, 1)):
        gl.glVertex2f(*corner)
    gl.glEnd()


def load_texture(name: int, gray: int) -> None:
    """Load a texture of one gray."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    image = np.full((2, 2, 3), gray, np.uint8)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 2, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, image)
