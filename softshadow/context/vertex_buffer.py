"""Mesa's vertex buffer of immediate mode: which glBegin ... glEnd pairs are drawn together, and when.

Mesa collects pairs until the buffer is full or a call separates them. This decides which vertices form one draw of the
driver (`softshadow.pipeline.mesa.driver_draws`), and so some bits of the image.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import dropwhile, groupby
from operator import attrgetter
from typing import NamedTuple

from softshadow.context.command_stream import CommandStream
from softshadow.context.joined_pairs import JoinedPairs
from softshadow.context.late_forms import LateDraw
from softshadow.context.primitive import Primitive
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.geometry import offset_mode_of
from softshadow.pipeline.mesa.driver_draws import (
    MAX_PAIRS,
    SEPARATE,
    CollectedPairs,
    DriverDraw,
    offset_depends_on_mode,
)
from softshadow.state import TEXTURE_UNITS

BYTES = 512 * 1024  # size of the vertex buffer (vbo_exec_draw.c)
LEAST_BYTES = 1024  # Mesa takes a new buffer when no more than these are left
NO_DRAW = DriverDraw()  # the driver has drawn all


class PairFormat(NamedTuple):
    """What the vertices of a pair carry whose calls have set all of it before the first vertex.

    sizes: components by attribute, without the position; carried: their names and the position's, as in the buffer.
    """

    sizes: Mapping[str, int]
    position_size: int
    vertex_bytes: int
    carried: tuple[str, ...]


NO_FORMAT = PairFormat({}, 0, 0, ())
# attributes whose calls look first whether they are steady (`Primitive`)
CAN_EXPECT = frozenset(("color", "normal", *[f"texcoord{unit}" for unit in range(TEXTURE_UNITS)]))
MOST_WAITS = 64


class VertexBuffer:
    """The vertices that have been collected and not yet drawn.

    Attributes
    ----------
    sizes : dict             attribute: number of components in the collected vertices
    active_sizes : dict      attribute: number of components in the last call (Mesa's active_size)
    expected : PairFormat    that of the last pair that was drawn alone; `NO_FORMAT` if the next one may have another
    n_vertices : int         number of vertices collected since the last submission
    used_bytes : int         bytes of the buffer before these vertices
    joined_pairs : JoinedPairs or None    those that are not drawn yet, since more may follow
    paused : Primitive or None    the last of them, if the next pair of its mode may add its vertices to it
    pairs : CollectedPairs   glBegin ... glEnd pairs since the last submission
    driver_draw : DriverDraw the driver's draw that the next pair of the same mode belongs to

    Parameters
    ----------
    stream : CommandStream   carries out the draws; by its buffers a driver's draw chooses its polygon offset
    """

    def __init__(self, stream: CommandStream) -> None:
        self._stream = stream
        self.sizes: dict[str, int] = {}
        self.active_sizes: dict[str, int] = {}
        self.expected, self._n_waits, self._waits = NO_FORMAT, 0, 0
        self.n_vertices, self.used_bytes = 0, 0
        self.joined_pairs: JoinedPairs | None = None
        self.paused: Primitive | None = None
        self.pairs, self.driver_draw = CollectedPairs(), NO_DRAW

    @property
    def room(self) -> int:
        """The number of vertices like the last one that fit behind the submitted ones."""
        return self.room_for(self.sizes)

    def room_for(self, sizes: Mapping[str, int]) -> int:
        """Return how many vertices fit behind the submitted ones, if their attributes have so many components."""
        return (BYTES - self.used_bytes) // (4 * sum(sizes.values()))

    def draw(self, command: Draw) -> None:
        """Draw at once; consecutive draws of one mode are one draw of the driver."""
        driver_draw = self._part_of(command.called_mode)
        if not driver_draw.is_lost:
            self._stream.carry_out(driver_draw.part(command, self._offset_mode_of))

    def _part_of(self, mode: int) -> DriverDraw:
        """Return the driver's draw that a draw of a mode belongs to."""
        if mode != self.driver_draw.mode:
            self.driver_draw = DriverDraw(mode)
        return self.driver_draw

    def draw_pairs(self, commands: Sequence[Draw], modes: Sequence[int], counts: Sequence[int]) -> None:
        """Draw glBegin ... glEnd pairs, none of which Mesa joins, that differ in their modes and vertices only.

        `commands` are draws of each or of several, in their order; `modes` and `counts` the modes and numbers of
        vertices of each pair. Those of a driver's draw that is lost have a command of their own.
        """
        self.n_vertices += sum(counts)
        self.draw_joined_pairs()
        if offset_depends_on_mode(commands[0].state):
            for command in commands:
                self.draw(command)
        else:
            if self.driver_draw.is_lost and self.driver_draw.mode == modes[0]:
                commands = list(dropwhile(lambda command: command.called_mode == modes[0], commands))
            for _, same in groupby(commands, attrgetter("mode")):
                self._stream.carry_out_alike(list(same))
            self._part_of(modes[-1])
        if self.pairs.add_several(modes[-1], counts) >= MAX_PAIRS:
            self.submit()

    def _offset_mode_of(self, draw: Draw) -> int:
        return offset_mode_of(draw, self._stream.objects)

    def pairs_to_join(self, mode: int) -> JoinedPairs | None:
        """Return the pairs that a pair of a mode can be added to, after those before their last turn are drawn.

        None, and nothing is drawn, if it cannot be joined to the pairs that are not drawn yet.
        """
        joined = self.joined_pairs
        if joined is None:
            return None
        joined.unturn()
        if joined.like.mode != mode or not joined.takes_more:
            return None
        self._draw_all(joined.take_before_last_turn())
        return joined

    def begin_joined_pairs(self, first: Draw | LateDraw, n_vertices: int) -> None:
        """Draw the joined pairs, and begin new ones with a draw of so many vertices."""
        before = self.joined_pairs
        self.draw_joined_pairs()
        self.joined_pairs = JoinedPairs(first, n_vertices, before)

    def split(self, primitive: Primitive) -> None:
        """Leave the pairs before an open one, with which it began, to be drawn without it."""
        assert self.joined_pairs is not None
        self.joined_pairs.replace_primitive(primitive.split())
        self.joined_pairs.unturn()
        self.paused = None

    def end_pair(self, mode: int, vertices: int) -> None:
        """Count a glBegin ... glEnd pair; draw if it is empty and of another mode, or the 64th."""
        if not vertices and self.pairs.mode != mode:
            self.draw_joined_pairs()
            self.driver_draw = DriverDraw(mode, is_lost=mode not in SEPARATE)
        if self.pairs.add(mode, vertices) >= MAX_PAIRS:
            self.submit()

    def draw_joined_pairs(self) -> None:
        """Draw the joined pairs, if there are any."""
        joined, self.joined_pairs, self.paused = self.joined_pairs, None, None
        if joined is not None:
            self._draw_all(joined.commands())

    def _draw_all(self, commands: Sequence[Draw | LateDraw]) -> None:
        for command in commands:
            if not isinstance(command, LateDraw):
                self.draw(command)
            elif not self._part_of(command.form.like.mode).is_lost:
                self._stream.add_late(command)

    def submit(self) -> None:
        """Draw the collected vertices; those that follow lie behind them in Mesa's buffer."""
        if self.joined_pairs is not None:
            self.draw_joined_pairs()
        self.driver_draw = NO_DRAW
        if self.pairs.n_pairs:
            self.pairs.clear()
        if self.n_vertices:
            self._use(self.n_vertices * 4 * sum(self.sizes.values()))
            self.n_vertices = 0

    def _use(self, n_bytes: int) -> None:
        used = self.used_bytes + n_bytes
        self.used_bytes = used if used + LEAST_BYTES < BYTES else 0

    def flush(self) -> None:
        """Draw the collected vertices and reset the vertex format."""
        if self.n_vertices or self.joined_pairs is not None:  # pairs without vertices are still counted after this
            if self._waits:
                self._waits -= 1
            else:
                self.expected = self._format_of_only_pair()
            self.submit()
        self.sizes.clear()

    # -- pairs that are drawn one by one (`softshadow.gl.deferred_pairs`) ----------------------------------------------
    def _format_of_only_pair(self) -> PairFormat:
        """Return the format of the collected pair, if it is the only one, and the next one may be expected to be alike.

        Its calls have set all that its vertices carry before the first vertex.
        """
        draw = None if self.joined_pairs is None else self.joined_pairs.only_late
        if (
            draw is None
            or draw.primitive.from_list
            or self.pairs.n_pairs != 1
            or self.pairs.n_vertices != self.n_vertices
        ):
            return NO_FORMAT
        primitive, sizes = draw.primitive, dict(self.sizes)
        carried, position_size = tuple(sizes), sizes.pop("position")
        if primitive.steady != sizes or not CAN_EXPECT.issuperset(sizes) or primitive.position_size != position_size:
            return NO_FORMAT
        first_places = [[place for place, _ in primitive.changes[name][1:2]] for name in sizes]
        if any(places != [0] for places in first_places):
            return NO_FORMAT
        return PairFormat(sizes, position_size, 4 * (position_size + sum(sizes.values())), carried)

    def expects_alike(self, n_vertices: int) -> bool:
        """Return whether the next pair, of at most so many vertices, is expected to have the format of the last one."""
        if self.expected is NO_FORMAT or self.n_vertices or self.joined_pairs is not None or self.pairs.n_pairs:
            return False
        return self.used_bytes + self.expected.vertex_bytes * (n_vertices + 2) < BYTES  # one may end a line loop

    def forget_format(self) -> None:
        """Expect nothing of the next pairs; of the more, the oftener it has been in vain."""
        self._n_waits = self._waits = min(2 * self._n_waits + 1, MOST_WAITS)
        self.expected = NO_FORMAT

    def carry(self, pair: PairFormat) -> None:
        """Let the vertices carry what those of a pair do."""
        self.driver_draw = NO_DRAW
        for sizes in (self.sizes, self.active_sizes):
            sizes.update(pair.sizes)
            sizes["position"] = pair.position_size

    def note_drawn(self, pair: PairFormat, n_vertices: int) -> None:
        """Note that a pair has been drawn, after which the buffer is empty again."""
        self._n_waits, self.driver_draw = 0, NO_DRAW
        self.active_sizes.update(pair.sizes)
        self.active_sizes["position"] = pair.position_size
        self._use(n_vertices * pair.vertex_bytes)
