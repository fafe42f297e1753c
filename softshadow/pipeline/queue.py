"""Draws that wait until someone looks at the buffers, and then are carried out together.

A thousand draws of twelve triangles cost a thousand times what Python needs for one. The triangles of all draws whose
geometry depends on the same state are set up at once, as a batch; consecutive draws under one state, a segment, are
filled and shaded at once. Draws wait only if they cannot fail (`plan.begin_run`), so errors appear at the calls that
make them. Other commands that only change what buffers contain wait among them: a program with many views clears a part
of the window for each, one with many samples of a light accumulates the picture of each.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice, takewhile

from softshadow import tokens as gl
from softshadow.framebuffer import DEFAULT, Storage
from softshadow.pipeline.alike_draws import DrawList, vertex_counts
from softshadow.pipeline.commands import (
    OF_FRAMEBUFFERS,
    Accumulate,
    BeginQuery,
    BlitFramebuffer,
    Clear,
    Command,
    CopyToTexture,
    CreateTexture,
    DefineImage,
    DeleteTextures,
    Draw,
    GenerateMipmaps,
    SetSampler,
    UpdateImage,
)
from softshadow.pipeline.draw_kinds import Kind, Kinds
from softshadow.pipeline.execute import execute
from softshadow.pipeline.execute_waiting import Segment, execute_waiting
from softshadow.pipeline.new_texels import TEXELS, NewTexels, texel_bytes
from softshadow.pipeline.plan import MOST_DRAWS, MOST_VERTICES, SHORT_CUTS_EXIST
from softshadow.state import State

try:
    from softshadow.pipeline.fast.any_state import FILL_KERNELS
    from softshadow.pipeline.fast.batch.admission import continue_moved, continues_moved, least_compared
    from softshadow.pipeline.fast.map_visibility_kernel import VISIBILITY_KERNEL
except ModuleNotFoundError:  # the folder can be deleted: then no draw waits
    pass

MOST_BYTES = 1 << 24  # of texels that wait
FEW = 12  # fewer draws are looked at one by one


class DrawQueue:
    """The draws of a context that are not carried out yet.

    Parameters
    ----------
    storage : Storage        what they will be drawn to
    compiles : bool          whether to compile kernels at the first use: for one picture some of them do not pay
    """

    def __init__(self, storage: Storage, compiles: bool = True) -> None:
        self._storage, self._compiles = storage, compiles
        if compiles and SHORT_CUTS_EXIST:
            FILL_KERNELS.want()
            VISIBILITY_KERNEL.want()
        self._kinds = Kinds(storage, compiles)
        self._kind: Kind | None = None  # of the last draw
        self._like: Draw  # a draw of this kind
        self._batches: dict[int, DrawList] = {}  # by their numbers
        self._segments: list[Segment | Command] = []  # in drawing order
        self._segment: Segment | None = None  # the last one, if only draws follow it
        self._queries: set[int] = set()  # that count fragments of these; 0 if some are not counted
        self._textures: set[int] = set()  # names of those that they may read
        self._framebuffers: set[int] = set()  # that they, and commands among them, write to or read
        self._is_copied = False  # whether the picture so far was copied: then a clear begins another pass
        self._n_commands, self._n_vertices, self._n_bytes, self._are_small = 0, 0, 0, True

    def add(self, command: Draw) -> bool:
        """Let a draw wait; return False if it must be carried out at once (all draws before it have been, then)."""
        n_vertices = len(command.vertices.position)
        if self._n_vertices + n_vertices > MOST_VERTICES:
            self.carry_out()
        kind = self._kind
        if kind is None or not kind.run.continues(command, self._like):
            kind = self._kinds.of(command)
            if kind is None:
                self.carry_out()
                return False
            # large meshes are drawn again under other states: alone, they are found to be equal
            if kind is not self._kind and not (self._are_small and n_vertices < least_compared(command)):
                self.carry_out()
            self._kind, self._like = kind, command
        self._let_wait(kind, (command,), n_vertices)
        self._are_small = self._are_small and n_vertices < least_compared(command)
        if self._n_commands == MOST_DRAWS:
            self.carry_out()
        return True

    def _let_wait(self, kind: Kind, commands: Sequence[Draw], n_vertices: int) -> None:
        """Let draws of a kind and of one state wait, with so many vertices."""
        first, query = self._add_to_batch(kind.batch, commands), self._storage.active_query
        self._add_segment(kind, commands[0], first, first + len(commands), query)
        self._note_uses(kind, commands[0].state, query)
        self._n_commands += len(commands)
        self._n_vertices += n_vertices

    def add_alike(self, commands: Sequence[Draw]) -> int:
        """Let draws wait that differ from the first one in vertices and indices only; return how many do, from it on.

        Where the first one has an array of an attribute, all have one, and where it has one value, all have one.
        """
        if not self.add(commands[0]):
            return 0
        return len(commands) if self._add_others(commands[0], commands[1:]) else 1

    def add_like(self, commands: Sequence[Draw]) -> int:
        """Let draws wait that differ from the first one in vertices and modelview matrix only, as `add_alike` does."""
        if not self.add(commands[0]):
            return 0
        others = list(takewhile(continues_moved, commands[1:]))
        return 1 + len(others) if self._add_others(commands[0], others) else 1

    def add_in_turns(
        self,
        parts: Sequence[Sequence[Draw]],
        turns: Sequence[tuple[int, int]],
        texels: Sequence[NewTexels] = (),
    ) -> bool:
        """Let small draws wait; return False, and do nothing, if they must be looked at one by one.

        The draws of each part differ in vertices and modelview matrix only, as those of `add_like`. `turns` are numbers
        of parts, and how many of its next draws come there: a program that changes the mode or the state between small
        draws goes back and forth between a few kinds. Where the number is `TEXELS`, the next of `texels` come.
        """
        if len(turns) == 1 == len(parts[0]):
            return self.add(parts[0][0])
        kinds: list[Kind] = []
        for part in parts:
            kind = self._kinds.of(part[0])
            if kind is None or not continue_moved(part):
                return False
            kinds.append(kind)
        n_draws, n_vertices = sum(map(len, parts)), sum([sum(vertex_counts(part)) for part in parts])
        n_commands, n_bytes = n_draws + len(texels), sum(map(texel_bytes, texels))
        is_full = self._n_commands + n_commands > MOST_DRAWS or self._n_vertices + n_vertices > MOST_VERTICES
        is_full = is_full or self._n_bytes + n_bytes > MOST_BYTES
        if not self._are_small and n_draws < FEW and kinds[turns[0][0]] is self._kind:
            return False  # the first ones belong to the large draws that wait
        if is_full or not (self._are_small or all(kind is self._kind for kind in kinds)):
            self.carry_out()
        if len({kind.batch for kind in kinds}) == len(parts):
            places = {kind.batch: self._add_to_batch(kind.batch, part) for kind, part in zip(kinds, parts, strict=True)}
        else:
            places = {number: self._add_to_batch(number, own) for number, own in _by_batch(kinds, parts, turns).items()}
        firsts, query = [part[0] for part in parts], self._storage.active_query
        rest = iter(texels)
        for number, count in turns:
            if number == TEXELS:
                self._append(next(rest))
                continue
            last, kind = number, kinds[number]
            place = places[kind.batch]
            places[kind.batch] = end = place + count
            self._add_segment(kind, firsts[number], place, end, query)
        for kind, first in zip(kinds, firsts, strict=True):
            self._note_uses(kind, first.state, query)
        self._textures.update([command.texture for command in texels])
        self._n_commands += n_draws
        self._n_vertices += n_vertices
        self._n_bytes += n_bytes
        self._kind, self._like = kinds[last], firsts[last]
        if self._n_commands >= MOST_DRAWS:
            self.carry_out()
        return True

    def _add_to_batch(self, number: int, commands: Sequence[Draw]) -> int:
        """Append draws to a batch; return the place of the first one."""
        batch = self._batches.get(number)
        if batch is None:
            batch = self._batches[number] = DrawList()
        place = len(batch)
        batch.add(commands)
        return place

    def _add_segment(self, kind: Kind, command: Draw, first: int, end: int, query: int) -> None:
        """Append draws of a kind and of one state, which have these places in their batch; `command` is one of them."""
        last = self._segment
        if last is not None and last.kind is kind and last.end == first and last.continues_with(command.state, query):
            last.end = end
        else:
            self._segment = Segment(kind, command, first, end, query)
            self._segments.append(self._segment)

    def _note_uses(self, kind: Kind, state: State, query: int) -> None:
        """Note what draws of a kind, under this state, read and write."""
        self._queries.add(query)
        self._textures.update(kind.names)
        self._framebuffers.add(state.draw_framebuffer)

    def _add_others(self, first: Draw, others: Sequence[Draw]) -> bool:
        """Let draws wait that continue the first one, the last that waits; do nothing if they are many or large."""
        if not others:
            return True
        counts = [len(command.vertices.position) for command in (first, *others)]
        n_vertices = sum(counts) - counts[0]
        is_full = self._n_commands + len(others) >= MOST_DRAWS or self._n_vertices + n_vertices > MOST_VERTICES
        if is_full or max(counts) >= least_compared(first) or self._kind is None:
            return False
        self._let_wait(self._kind, others, n_vertices)
        return True

    def add_other(self, command: Command, only_cells: bool) -> None:
        """Carry out a command that is no draw, now or later; `only_cells` is what `changes_cells_only` says of it.

        It is carried out at once if it changes nothing for the draws that wait. Else it waits behind them, or they are
        carried out first.
        """
        if not only_cells:
            self._kind = None
            self._kinds.note(command)
        match command:
            case Clear():
                if self._add_clear(command):
                    return
            case Accumulate() | CopyToTexture() | BlitFramebuffer():
                if self._add_copy(command):
                    return
            case UpdateImage() | DefineImage() if only_cells:
                if self._add_texels(command):
                    return
            case BeginQuery(query=query):  # draws that wait remember their query
                self.finish_query(query)  # if it begins anew
            case SetSampler():
                pass  # draws that wait keep their `Texture`
            case CreateTexture(texture=texture) | DefineImage(texture=texture) | GenerateMipmaps(texture=texture):
                self._finish_users(texture)
            case DeleteTextures(textures=textures):
                for texture in textures:
                    self._finish_users(texture)
            case _ if isinstance(command, OF_FRAMEBUFFERS):
                if command.framebuffer in self._framebuffers:
                    self.carry_out()
            case _:
                self.carry_out()
        execute(command, self._storage)

    def _add_clear(self, command: Clear) -> bool:
        """Let a clear wait behind draws; return False if no draws wait.

        A clear of the whole window begins a picture, so what it hides need not wait any longer, unless the pictures are
        the passes of one.
        """
        state = command.state
        is_whole = state.draw_framebuffer == DEFAULT and not state.scissor.enabled
        if is_whole and command.mask & gl.GL_COLOR_BUFFER_BIT and not self._is_copied:
            self.carry_out()
        if not self._segments:
            return False
        self._framebuffers.add(state.draw_framebuffer)
        self._append(command)
        return True

    def _add_copy(self, command: Accumulate | CopyToTexture | BlitFramebuffer) -> bool:
        """Let a command wait that copies what was drawn; return False if no draws wait."""
        if not self._segments:
            return False
        match command:
            case Accumulate(state=state):
                self._framebuffers.add(state.draw_framebuffer)
            case CopyToTexture(framebuffer=framebuffer, texture=texture):
                self._framebuffers.add(framebuffer)
                self._textures.add(texture)
            case BlitFramebuffer(read=read, draw=draw):
                self._framebuffers.update((read, draw))
        self._is_copied = not (isinstance(command, Accumulate) and command.operation == gl.GL_RETURN)
        self._append(command)
        return True

    def _add_texels(self, command: NewTexels) -> bool:
        """Let new texels wait behind draws that may use the texture; return False if none waits."""
        if not self._may_use(command.texture):
            return False
        n_bytes = texel_bytes(command)
        if command.blocks is not None or self._n_bytes + n_bytes > MOST_BYTES:
            self.carry_out()
            return False
        self._n_bytes += n_bytes
        self._append(command)
        return True

    def _append(self, command: Command) -> None:
        self._segments.append(command)
        self._segment = None
        self._n_commands += 1
        if self._n_commands == MOST_DRAWS:
            self.carry_out()

    def forget(self) -> None:
        """Forget what draws have in common, as the window changes; draws that wait keep it."""
        self._kind = None
        self._kinds.forget()

    def finish_query(self, query: int) -> None:
        """Carry out the draws that wait if an occlusion query counts fragments of some; 0 stands for no query."""
        if query and query in self._queries:
            self.carry_out()

    def _finish_users(self, texture: int) -> None:
        """Carry out the draws that wait if one may use a texture."""
        if self._may_use(texture):
            self.carry_out()

    def _may_use(self, texture: int) -> bool:
        """Return whether draws or clears that wait may read a texture object, or write to it."""
        targets = [self._storage.framebuffers[name] for name in self._framebuffers]
        return texture in self._textures or any(target.attaches(texture) for target in targets)

    def carry_out(self) -> None:
        """Carry out the draws that wait."""
        batches, segments = self._batches, self._segments
        if not segments:
            return
        self._kind, self._batches, self._queries = None, {}, set()
        self._segments, self._segment = [], None
        self._textures, self._framebuffers, self._is_copied = set(), set(), False
        self._n_commands, self._n_vertices, self._n_bytes, self._are_small = 0, 0, 0, True
        execute_waiting(batches, segments, self._storage)


def _by_batch(
    kinds: Sequence[Kind], parts: Sequence[Sequence[Draw]], turns: Sequence[tuple[int, int]]
) -> dict[int, list[Draw]]:
    """Return the draws of each batch in their order; `turns` as for `DrawQueue.add_in_turns`."""
    draws: dict[int, list[Draw]] = {kind.batch: [] for kind in kinds}
    rest = list(map(iter, parts))
    for number, count in turns:
        if number != TEXELS:
            draws[kinds[number].batch] += islice(rest[number], count)
    return draws
