"""Strips, fans, loops and polygons as separate triangles or lines: many of them are one draw then.

The primitives of a draw reach the setup as triangles or lines in any case. Those of a draw with these indices are the
same, with the same corners in the same order, which decides the last bits of interpolated values. Only the triangles
of quads of strips change places in pairs where a strip is clipped (`assembly.order_of_joined_strips`).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import lru_cache

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.assembly import assemble
from softshadow.pipeline.geometry.lines import LINES, assemble_lines
from softshadow.pipeline.mesa.driver_draws import SEPARATE
from softshadow.pipeline.mesa.polygon_rules import effective_modes, is_stippled
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.state import State

SEPARABLE = {
    gl.GL_TRIANGLE_STRIP: gl.GL_TRIANGLES, gl.GL_TRIANGLE_FAN: gl.GL_TRIANGLES, gl.GL_POLYGON: gl.GL_TRIANGLES,
    gl.GL_QUAD_STRIP: gl.GL_TRIANGLES, gl.GL_LINE_STRIP: gl.GL_LINES, gl.GL_LINE_LOOP: gl.GL_LINES,
}  # fmt: skip
STRIPS = frozenset((gl.GL_TRIANGLE_STRIP, gl.GL_TRIANGLE_FAN, gl.GL_QUAD_STRIP))  # with each other, too
MOST_KNOWN = 64  # arrays of indices that are kept: a program draws the same primitives in every frame


def can_be_separated(state: State, mode: int, modes: Collection[int] = ()) -> bool:
    """Return whether a draw of a mode in `SEPARABLE` under a state has the same pixels with separate primitives.

    Not where lines may be stippled, as separate ones begin the pattern anew, nor where the first vertex gives flat
    colours, as that is another one then. Of polygons that are filled on one side only, Mesa treats a draw as a whole.
    `modes` are those of all primitives, if they are in `STRIPS` and not all `mode`: then polygons must be filled, as
    the edges of quads and of triangles are not the same ones.
    """
    if is_stippled(state.lines) or first_provokes(state):
        return False
    front, back = effective_modes(state)
    if len(set(modes)) > 1 and front != gl.GL_FILL:
        return False
    return mode in LINES or front == back


def separated(command: Draw, counts: tuple[int, ...], modes: tuple[int, ...] = ()) -> Draw:
    """Return a draw of separate primitives, for one of several primitives of a mode in `SEPARABLE`.

    `counts` are the numbers of vertices of these, one after the other; a single primitive is left as it is. `modes`
    are those of each in `STRIPS`, if they are not all of the draw's mode.
    """
    if len(counts) == 1:
        return command
    modes = modes or (command.mode,) * len(counts)
    return command._replace(
        mode=SEPARABLE[command.mode], indices=separate_indices(modes, counts), pairs_mode=pairs_mode_of(modes)
    )


def pairs_mode_of(modes: Sequence[int]) -> int:
    """Return the `pairs_mode` of a draw of primitives of several modes: the triangles of quads may change places."""
    return gl.GL_QUAD_STRIP if gl.GL_QUAD_STRIP in modes else modes[0]


def is_separated(command: Draw) -> bool:
    """Return whether a draw has a mode and indices as `separated` gives them."""
    corners = SEPARATE.get(command.mode, 0)
    has_mode = SEPARABLE.get(command.pairs_mode) == command.mode
    return has_mode and command.indices is not None and len(command.indices) % corners == 0


@lru_cache(MOST_KNOWN)
def separate_indices(modes: tuple[int, ...], counts: tuple[int, ...]) -> np.ndarray:
    """Return the indices (N,) int32 of separate triangles or lines, read-only, for primitives of these modes."""
    primitives = [_indices_of_one(mode, count) for mode, count in zip(modes, counts, strict=True)]
    starts = np.cumsum((0, *counts[:-1]), dtype=np.int32)
    indices = np.concatenate(primitives) + np.repeat(starts, [len(each) for each in primitives])
    indices.setflags(write=False)
    return indices


@lru_cache(MOST_KNOWN)
def _indices_of_one(mode: int, count: int) -> np.ndarray:
    return (assemble_lines(mode, count) if mode in LINES else assemble(mode, count).corners).reshape(-1)
