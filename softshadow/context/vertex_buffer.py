"""Mesa's vertex buffer of immediate mode: which glBegin ... glEnd pairs are drawn together, and when.

Pairs are collected until the buffer is full or something separates them; that decides which vertices are one draw of
the driver (`softshadow.pipeline.mesa.driver_draws`), and with it some bits of the picture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.pipeline.geometry.geometry import offset_mode_of
from softshadow.pipeline.mesa.driver_draws import SEPARATE, CollectedPairs, DriverDraw, JoinedPairs

BYTES = 512 * 1024  # that the vertices are collected in (vbo_exec_draw.c)
LEAST_BYTES = 1024  # with no more than these left, Mesa takes a new buffer


@dataclass
class Primitive:
    """What glBegin ... glEnd has collected: a row per vertex.

    `from_list` says that a display list has begun it, `continued` that a part of it has been sent off.
    """

    mode: int
    from_list: bool = False
    continued: bool = False
    positions: list[tuple[float, float, float, float]] = field(default_factory=list)
    colors: list[tuple[float, float, float, float]] = field(default_factory=list)
    normals: list[tuple[float, float, float]] = field(default_factory=list)
    texcoords: list[tuple[tuple[float, float, float, float], ...]] = field(default_factory=list)
    materials: dict[str, list[Any]] = field(default_factory=dict)  # "front.diffuse": what glMaterial changed in between

    @property
    def rows(self) -> list[list[Any]]:
        """All that there is a row per vertex of."""
        return [self.positions, self.colors, self.normals, self.texcoords, *self.materials.values()]


class VertexBuffer:
    """What was collected and not yet drawn.

    Attributes
    ----------
    sizes : dict             numbers per attribute that the vertices collected last carry
    given_sizes : dict       how many of those the last call gave, as far as Mesa remembers
    stored : int             vertices collected since the last time they were sent off
    used : int               bytes of the buffer before them
    batch : JoinedPairs or None    triangles or quads that wait for more of them
    pairs, run               glBegin ... glEnd pairs and draws since vertices were sent off

    Parameters
    ----------
    carry_out : callable     executes and records a draw
    storage : Storage        that draws of a run are judged by
    """

    def __init__(self, carry_out: Callable[[Draw], None], storage: Storage) -> None:
        self._carry_out, self._storage = carry_out, storage
        self.sizes: dict[str, int] = {}
        self.given_sizes: dict[str, int] = {}
        self.stored, self.used = 0, 0
        self.batch: JoinedPairs | None = None
        self.pairs, self.run = CollectedPairs(), DriverDraw()

    @property
    def room(self) -> int:
        """How many vertices like the last one fit behind those that were sent off."""
        return (BYTES - self.used) // self._vertex_bytes

    @property
    def _vertex_bytes(self) -> int:
        return 4 * sum(self.sizes.values())

    def draw(self, command: Draw) -> None:
        """Draw at once, in the run of draws of the same mode."""
        if command.mode != self.run.mode:
            self.run = DriverDraw(command.mode)
        if not self.run.is_lost:
            self._carry_out(self.run.part(command, lambda draw: offset_mode_of(draw, self._storage)))

    def takes(self, mode: int) -> bool:
        """Return whether vertices of a mode belong to the batch that waits."""
        return self.batch is not None and self.batch.first.mode == mode and self.batch.takes_more

    def begin_batch(self, first: Draw) -> None:
        """Draw what waits, and begin a batch under the state of `first`."""
        self.draw_pending()
        self.batch = JoinedPairs(first)

    def add_to_batch(self, label: str, vertices: Vertices) -> None:
        """Let vertices wait in the batch; `label` names the debug groups they stand in."""
        assert self.batch is not None
        self.batch.parts.append((label, vertices))

    def end_pair(self, mode: int, vertices: int) -> None:
        """Count a pair of glBegin and glEnd; what waits is drawn if an empty one has another mode, or at the 64th."""
        if not vertices and self.pairs.mode != mode:
            self.draw_pending()
            self.run = DriverDraw(mode, is_lost=mode not in SEPARATE)
        self.pairs.add(mode, vertices)
        if self.pairs.too_many:
            self.send_off()

    def draw_pending(self) -> None:
        """Draw what waits."""
        batch, self.batch = self.batch, None
        if batch is not None:
            for command in batch.commands():
                self.draw(command)

    def send_off(self) -> None:
        """Draw what waits; the vertices that follow come after them in Mesa's buffer."""
        self.draw_pending()
        self.run = DriverDraw()
        self.pairs = CollectedPairs()
        self.used += self.stored * self._vertex_bytes
        self.stored = 0
        if self.used + LEAST_BYTES >= BYTES:
            self.used = 0

    def settle(self) -> None:
        """Draw what waits; vertices that follow carry nothing of what these did."""
        if self.stored or self.batch is not None:  # pairs without vertices are still counted after this
            self.send_off()
        self.sizes.clear()
