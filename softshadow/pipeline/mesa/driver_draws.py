"""Which glBegin ... glEnd pairs Mesa hands to the driver as one draw.

Consecutive pairs of points, lines, triangles or quads with nothing between them are joined to one list of primitives
(`softshadow.context.joined_pairs`). How llvmpipe cuts a quad into triangles depends on whether any vertex of the joined
pairs is clipped, so all pairs must be known before the first one is drawn (`softshadow.pipeline.mesa.segments`). Which
triangles it draws depends on their number (`softshadow.pipeline.mesa.rectangles`).

Mesa does not join pairs of other modes, but those of one mode in a row are still one draw of the driver (`DriverDraw`),
in which the first triangle decides the polygon offset of all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from softshadow import tokens as gl
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.mesa.polygon_rules import effective_modes, offset_is_on
from softshadow.state import State

CORNERS = {gl.GL_TRIANGLES: 3, gl.GL_QUADS: 4}  # vertices per primitive, where the number of all decides what is drawn
SEPARATE = {gl.GL_POINTS: 1, gl.GL_LINES: 2, **CORNERS}  # vertices per primitive, for the modes whose pairs are joined
MAX_PAIRS = 64  # with so many collected pairs, Mesa draws them (VBO_MAX_PRIM)


@dataclass(slots=True)
class CollectedPairs:
    """The glBegin ... glEnd pairs that Mesa has collected: their number, and mode and number of vertices of the last.

    Joined pairs count as one. Too many pairs are drawn, and later ones are not joined to them (vbo_exec_api.c,
    _mesa_End).
    """

    n_pairs: int = 0
    mode: int = -1
    n_vertices: int = 0

    def clear(self) -> None:
        """Forget all pairs: they have been drawn."""
        self.n_pairs, self.mode, self.n_vertices = 0, -1, 0

    def add(self, mode: int, n_vertices: int) -> int:
        """Add a pair, or join it to the one before; return the number of pairs."""
        if mode == self.mode and mode in SEPARATE and self.n_vertices % SEPARATE[mode] == 0:
            self.n_vertices += n_vertices
        else:
            self.n_pairs, self.mode, self.n_vertices = self.n_pairs + 1, mode, n_vertices
        return self.n_pairs

    def add_several(self, mode: int, counts: Sequence[int]) -> int:
        """Add pairs of a mode of which none are joined, with these numbers of vertices; return the number of pairs."""
        self.n_pairs, self.mode, self.n_vertices = self.n_pairs + len(counts), mode, counts[-1]
        return self.n_pairs


@dataclass(slots=True)
class DriverDraw:
    """Draws of one mode that Mesa hands to the driver as one (st_draw_gallium_multimode).

    `is_lost`: it begins with a pair without vertices, so Mesa takes all of it for empty. `offset_mode` is the polygon
    mode of the first triangle that is not culled, whose offset applies to all, or 0 before that.
    """

    mode: int = -1
    is_lost: bool = False
    offset_mode: int = 0

    def part(self, command: Draw, offset_mode_of: Callable[[Draw], int]) -> Draw:
        """Return a draw with the offset mode that an earlier part has decided; the first part decides it.

        `offset_mode_of` returns the mode that a draw decides (`softshadow.pipeline.geometry.geometry`).
        """
        if not offset_depends_on_mode(command.state):
            return command
        part = command._replace(offset_mode=self.offset_mode)
        if not self.offset_mode:
            self.offset_mode = offset_mode_of(part)
        return part


def offset_depends_on_mode(state: State) -> bool:
    """Return whether triangles have an offset that depends on their polygon mode."""
    if not offset_is_on(state.polygon):
        return False
    front, back = effective_modes(state)
    return front != back
