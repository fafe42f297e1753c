"""Triangles of the latest draws; equals `geometry.geometry.process_geometry`, see fast/test_recent_triangles.py.

Frames draw the same mesh several times: shadow volumes once for their front faces and once for their back faces, and
what the lights shine on once for each light. The triangles in the window are a pure function of the positions, the
indices, the matrices and the viewport, which are compared; the draws may differ in face culling, in lighting, and in
all that happens to fragments.

Other than in `geometry_cache`, a draw is remembered at once, but only the latest few are.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.frozen import remembered
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.state.common import in_full

MOST_RECENT = 6  # draws
MOST_BYTES = 32 << 20  # of one of them


class Remembered(NamedTuple):
    """What is remembered of a draw; `alive` are the arrays that the key names by their ids, so no others get them."""

    content: Any
    alive: Sequence[Any]


class RecentTriangles:
    """The triangles of the latest draws, by keys."""

    def __init__(self) -> None:
        self._draws: dict[Hashable, Remembered] = {}

    def look_up(self, key: Hashable) -> Any:
        """Return what is remembered of an equal draw, or None."""
        found = self._draws.pop(key, None)
        if found is None:
            return None
        self._draws[key] = found
        return found.content

    def add(self, key: Hashable, content: Any, arrays: Sequence[np.ndarray], alive: Sequence[Any]) -> None:
        """Remember a draw with so many bytes of `arrays`; the least recent one makes room for it."""
        if sum(array.nbytes for array in arrays) <= MOST_BYTES:
            self._draws[key] = Remembered(content, alive)
            if len(self._draws) > MOST_RECENT:
                del self._draws[next(iter(self._draws))]


def triangles_key(command: Draw) -> tuple[Hashable, ...]:
    """Return what the clipped triangles of a draw depend on besides its state."""
    return (
        id(command.vertices.position), id(command.indices), command.mode, command.pairs_mode,
        command.modelview.tobytes(), command.projection.tobytes(), command.modelview_kind, command.projection_kind,
    )  # fmt: skip


_text_of = remembered(in_full)


def window_key(command: Draw, target: Framebuffer) -> tuple[Hashable, ...]:
    """Return what the clipped triangles in a window depend on besides vertices and matrices; text, as 0 is not -0.

    For draws that do not pass the stages of `polygon_rules.passes_stages`.
    """
    state = command.state
    text = _text_of(state.viewport, state.clip_planes, state.polygon)
    return text, state.depth.clamp, first_provokes(state), target.size, target.flipped
