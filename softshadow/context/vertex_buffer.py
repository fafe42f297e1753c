"""Mesa's vertex buffer of immediate mode: which glBegin ... glEnd pairs are drawn together, and when.

Mesa collects pairs until the buffer is full or a call separates them. This decides which vertices form one draw of the
driver (`softshadow.pipeline.mesa.driver_draws`), and so some bits of the image.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.geometry.geometry import offset_mode_of
from softshadow.pipeline.mesa.driver_draws import SEPARATE, CollectedPairs, DriverDraw, JoinedPairs

BYTES = 512 * 1024  # size of the vertex buffer (vbo_exec_draw.c)
LEAST_BYTES = 1024  # Mesa takes a new buffer when no more than these are left


@dataclass
class Primitive:
    """The vertices between glBegin and glEnd: one row per vertex.

    `from_list`: glBegin was called by a display list. `continued`: a part of the primitive has already been submitted.
    """

    mode: int
    from_list: bool = False
    continued: bool = False
    positions: list[tuple[float, float, float, float]] = field(default_factory=list)
    colors: list[tuple[float, float, float, float]] = field(default_factory=list)
    normals: list[tuple[float, float, float]] = field(default_factory=list)
    texcoords: list[tuple[tuple[float, float, float, float], ...]] = field(default_factory=list)
    materials: dict[str, list[Any]] = field(default_factory=dict)  # "front.diffuse": values set between the vertices

    @property
    def rows(self) -> list[list[Any]]:
        """The lists that have one row per vertex."""
        return [self.positions, self.colors, self.normals, self.texcoords, *self.materials.values()]


class VertexBuffer:
    """The vertices that have been collected and not yet drawn.

    Attributes
    ----------
    sizes : dict             attribute: number of components in the collected vertices
    active_sizes : dict      attribute: number of components in the last call (Mesa's active_size)
    n_vertices : int         number of vertices collected since the last submission
    used_bytes : int         bytes of the buffer before these vertices
    joined_pairs : JoinedPairs or None    triangles or quads that are not drawn yet, since more may follow
    pairs : CollectedPairs   glBegin ... glEnd pairs since the last submission
    driver_draw : DriverDraw the driver's draw that the next pair of the same mode belongs to

    Parameters
    ----------
    carry_out : callable     executes and records a draw
    storage : Storage        buffers to draw to: a driver's draw chooses its polygon offset by them
    """

    def __init__(self, carry_out: Callable[[Draw], None], storage: Storage) -> None:
        self._carry_out, self._storage = carry_out, storage
        self.sizes: dict[str, int] = {}
        self.active_sizes: dict[str, int] = {}
        self.n_vertices, self.used_bytes = 0, 0
        self.joined_pairs: JoinedPairs | None = None
        self.pairs, self.driver_draw = CollectedPairs(), DriverDraw()

    @property
    def room(self) -> int:
        """The number of vertices like the last one that fit behind the submitted ones."""
        return (BYTES - self.used_bytes) // self._vertex_bytes

    @property
    def _vertex_bytes(self) -> int:
        return 4 * sum(self.sizes.values())

    def draw(self, command: Draw) -> None:
        """Draw at once; consecutive draws of one mode are one draw of the driver."""
        if command.mode != self.driver_draw.mode:
            self.driver_draw = DriverDraw(command.mode)
        if not self.driver_draw.is_lost:
            self._carry_out(self.driver_draw.part(command, lambda draw: offset_mode_of(draw, self._storage)))

    def can_join(self, mode: int) -> bool:
        """Return whether vertices of a mode can be joined to the pairs that are not drawn yet."""
        joined = self.joined_pairs
        return joined is not None and joined.first.mode == mode and joined.takes_more

    def begin_joined_pairs(self, first: Draw) -> None:
        """Draw the joined pairs, and begin new ones under the state of `first`."""
        self.draw_joined_pairs()
        self.joined_pairs = JoinedPairs(first)

    def join(self, label: str, vertices: Vertices) -> None:
        """Add the vertices of a pair to the joined pairs; `label` names the debug groups they belong to."""
        assert self.joined_pairs is not None
        self.joined_pairs.parts.append((label, vertices))

    def end_pair(self, mode: int, vertices: int) -> None:
        """Count a glBegin ... glEnd pair; draw if it is empty and of another mode, or the 64th."""
        if not vertices and self.pairs.mode != mode:
            self.draw_joined_pairs()
            self.driver_draw = DriverDraw(mode, is_lost=mode not in SEPARATE)
        self.pairs.add(mode, vertices)
        if self.pairs.too_many:
            self.submit()

    def draw_joined_pairs(self) -> None:
        """Draw the joined pairs, if there are any."""
        joined, self.joined_pairs = self.joined_pairs, None
        if joined is not None:
            for command in joined.commands():
                self.draw(command)

    def submit(self) -> None:
        """Draw the collected vertices; those that follow lie behind them in Mesa's buffer."""
        self.draw_joined_pairs()
        self.driver_draw = DriverDraw()
        self.pairs = CollectedPairs()
        self.used_bytes += self.n_vertices * self._vertex_bytes
        self.n_vertices = 0
        if self.used_bytes + LEAST_BYTES >= BYTES:
            self.used_bytes = 0

    def flush(self) -> None:
        """Draw the collected vertices and reset the vertex format."""
        if self.n_vertices or self.joined_pairs is not None:  # pairs without vertices are still counted after this
            self.submit()
        self.sizes.clear()
