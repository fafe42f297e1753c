"""The recording of a context: every command, where each step ends, and the state of the storage before the first one.

An animation runs for as long as its user likes, so a recording may be bounded: then it forgets its earliest commands
and begins with a copy of the storage as they left it. Replayed from there, it gives every buffer again, bit for bit.
"""

from __future__ import annotations

import warnings
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from typing import Any

import numpy as np

from softshadow.context.late_commands import LateCommands
from softshadow.errors import HistoryCut
from softshadow.framebuffer import Framebuffer, Storage, default_framebuffer
from softshadow.image import Image
from softshadow.pipeline.commands import Command, DefineImage, Draw, UpdateImage, Vertices
from softshadow.pipeline.new_texels import texel_arrays

COMMAND_BYTES = 1300  # of a command without its arrays: about this much for a draw with two matrices and a new state
# of a vertex at most: position, two colours, normal, eight texture coordinates, fog, materials, in float64; edge flag
VERTEX_BYTES = 8 * (4 + 2 * 4 + 3 + 8 * 4 + 1 + 2 * 17) + 1


class Contents:
    """The bytes of a part of the recording; an array that several commands share counts once."""

    def __init__(self, before: Contents | None = None) -> None:
        self.commands = 0
        self.new_bytes = 0  # those that the part before does not hold, too
        self._own_bytes = 0  # of arrays that belong to one draw (`Context.packed`)
        self._sizes: dict[int, int] = {}  # by id: the commands keep the arrays alive
        self._before = {} if before is None else before._sizes

    @property
    def bytes(self) -> int:
        """The bytes of all commands and arrays of this part."""
        return self.commands * COMMAND_BYTES + self._own_bytes + sum(self._sizes.values())

    def add(self, command: Command) -> None:
        """Count a command."""
        self.commands += 1
        self.new_bytes += COMMAND_BYTES
        kind = type(command)
        if kind is Draw:
            self._add_vertices(command.vertices)  # type: ignore[union-attr]
            if command.indices is not None:  # type: ignore[union-attr]
                self._add_indices(command.indices)  # type: ignore[union-attr]
            if command.joined_positions is not None:  # type: ignore[union-attr]
                self._add_array(command.joined_positions)  # type: ignore[union-attr]
        elif kind is DefineImage or kind is UpdateImage:
            for array in texel_arrays(command):  # type: ignore[arg-type]
                self._add_array(array)

    def add_late(self, draws: LateCommands) -> None:
        """Count draws that may not be made yet."""
        self.commands += len(draws)
        self.new_bytes += COMMAND_BYTES * len(draws)
        for array in draws.arrays:
            self._add_array(array)
        for vertices in draws.vertices:
            self._add_vertices(vertices)
        for indices in draws.indices:
            self._add_indices(indices)

    def _add_indices(self, indices: np.ndarray) -> None:
        if id(indices) not in self._sizes:
            self._add_array(indices)

    def _add_vertices(self, vertices: Vertices) -> None:
        sizes, texcoords = self._sizes, vertices.texcoords
        if id(vertices) in sizes:
            return
        sizes[id(vertices)] = 0
        attributes = [vertices.position, vertices.color, vertices.normal]
        if id(texcoords) not in sizes:
            sizes[id(texcoords)] = 0
            attributes += texcoords
        for optional in (vertices.edges, vertices.secondary, vertices.fog_coordinates):
            if optional is not None:
                attributes.append(optional)
        for array in attributes:
            if array.strides[0]:  # a constant attribute is one row
                self._add_array(array)
        for array in vertices.materials.values():
            self._add_array(array)

    def _add_array(self, array: np.ndarray) -> None:
        sizes, base = self._sizes, array.base
        if type(base) is bytes:  # nobody else has this part of it
            self._own_bytes += array.nbytes
            self.new_bytes += array.nbytes
            return
        while isinstance(base, np.ndarray):
            sizes[id(array)] = 0
            array, base = base, base.base
        self._add_memory(array)

    def _add_memory(self, array: np.ndarray) -> None:
        if id(array) not in self._sizes:
            size = self._sizes[id(array)] = array.nbytes
            if id(array) not in self._before:
                self.new_bytes += size


class RecordedCommands:
    """The commands of a frame: the draws among them that are not made yet are made when someone looks at the list."""

    def __get__(self, frame: Frame | None, kind: type) -> Sequence[Command]:
        if frame is None:
            return ()  # the default of the field
        made, following = frame.made, frame.following
        if following:
            made.extend(chain.from_iterable(following))
            following.clear()
        return made

    def __set__(self, frame: Frame, commands: Sequence[Command]) -> None:
        frame.made, frame.following = list(commands), []


ALL_COMMANDS: Any = RecordedCommands()


@dataclass(repr=False)
class Frame:
    """The recording: the parameters of the window, every command, and where each step ends.

    `steps` holds (title, number of commands until its end). A bounded recording (`history_bytes`, None for all) keeps
    between half of these bytes and all of them: `start` is the storage before the first command that it still has,
    None if that is the first one of a new context, and `dropped` the number of commands that were dropped before it.
    Steps that have ended before it are dropped, too; `dropped_steps` is their number. `answers` keeps what questions
    about the frame have computed.
    """

    size: tuple[int, int]
    depth_format: str
    stencil_bits: int
    precision: str
    commands: list[Command] = ALL_COMMANDS
    steps: list[tuple[str, int]] = field(default_factory=list)
    start: Storage | None = None
    dropped: int = 0
    dropped_steps: int = 0
    history_bytes: int | None = None
    answers: dict[str, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __repr__(self) -> str:
        width, height = self.size
        return f"Frame({width} x {height}, {self.n_commands} commands, {len(self.steps)} steps)"

    def __post_init__(self) -> None:
        self.made: list[Command]
        self.following: list[Collection[Command]]  # behind those that are made
        self._older, self._newer = Contents(), Contents()  # before and after the mark
        self._uncounted: list[Draw] = []  # draws that `_newer` does not contain yet
        self._most_bytes = 0  # that it has at most with them
        self._mark: tuple[int, Storage] | None = None  # number of commands, and the storage after them

    @property
    def bytes(self) -> int:
        """The bytes of commands and arrays, if the recording is bounded; an array that several share counts once."""
        self._count()
        return self._older.bytes + self._newer.new_bytes

    @property
    def n_commands(self) -> int:
        """The number of commands."""
        return len(self.made) + sum(map(len, self.following))

    def clear(self) -> None:
        """Forget all commands."""
        self.made.clear()
        self.following.clear()

    def append(self, command: Command) -> bool:
        """Record a command that is carried out; return whether `shorten` must be called when all of them have been."""
        if self.following:
            self.following.append((command,))
        else:
            self.made.append(command)
        return self.history_bytes is not None and self._note(command)

    def extend(self, draws: Sequence[Draw]) -> bool:
        """Record several draws; return what `append` returns."""
        self.following.append(draws)
        is_long = False
        if self.history_bytes is not None:
            for draw in draws:
                is_long = self._note(draw)
        return is_long

    def extend_late(self, draws: LateCommands) -> bool:
        """Record draws that are made when someone looks at them; return what `append` returns."""
        self.following.append(draws)
        if self.history_bytes is None:
            return False
        before = self._newer.new_bytes
        self._newer.add_late(draws)
        self._most_bytes += self._newer.new_bytes - before
        return self._is_long()

    def _note(self, command: Command) -> bool:
        """Count the bytes of a command; return whether there are too many."""
        assert self.history_bytes is not None
        if type(command) is Draw and type(command.vertices.position.base) is bytes and command.joined_positions is None:
            # its arrays are its own: they are counted when their bound no longer suffices, which is seldom
            self._uncounted.append(command)
            self._most_bytes += COMMAND_BYTES + VERTEX_BYTES * len(command.vertices.position)
            if command.indices is not None:
                self._most_bytes += command.indices.nbytes
        else:
            before = self._newer.new_bytes
            self._newer.add(command)
            self._most_bytes += self._newer.new_bytes - before
        return self._is_long()

    def _is_long(self) -> bool:
        """Return whether the commands since the mark take half of the bytes of the recording."""
        assert self.history_bytes is not None
        if self._most_bytes * 2 <= self.history_bytes:
            return False
        self._count()
        return self._newer.new_bytes * 2 > self.history_bytes

    def _count(self) -> None:
        """Count the draws that are not counted yet."""
        for command in self._uncounted:
            self._newer.add(command)
        self._uncounted.clear()
        self._most_bytes = self._newer.new_bytes

    def shorten(self, storage: Storage) -> None:
        """Drop the commands before the mark, and set it here; `storage` is as all commands left it."""
        if self._mark is not None:
            count, self.start = self._mark
            self._drop(count)
            steps = [(title, end - count) for title, end in self.steps if end > count]
            self.dropped += count
            self.dropped_steps += len(self.steps) - len(steps)
            self.steps[:] = steps
        self._mark = self.n_commands, copy_storage(storage)
        self._older, self._newer, self._most_bytes = self._newer, Contents(self._newer), 0

    def _drop(self, count: int) -> None:
        """Forget the first commands; draws among them that are not made yet need not be made."""
        rest, n_whole = count - len(self.made), 0
        del self.made[:count]
        for commands in self.following:
            if rest < len(commands):
                break
            rest -= len(commands)
            n_whole += 1
        del self.following[:n_whole]
        if rest > 0:  # the last one goes on behind
            del self.commands[:rest]

    def begin(self, storage: Storage) -> None:
        """Begin with a copy of a storage: what has been recorded is its past, and no part of the recording."""
        self.clear()
        self.steps.clear()
        self.start, self.dropped, self.dropped_steps = copy_storage(storage), 0, 0
        self._older, self._newer, self._mark = Contents(), Contents(), None
        self._uncounted.clear()
        self._most_bytes = 0
        self.answers.clear()

    def fresh_storage(self) -> Storage:
        """Return new storage in its state before the first command.

        Warns
        -----
        HistoryCut                   the recording has dropped earlier commands
        """
        if self.start is not None:
            if self.dropped:
                warnings.warn(HistoryCut(self._cut_message()), stacklevel=2)
            return copy_storage(self.start)
        window = default_framebuffer(*self.size, self.depth_format, self.stencil_bits, self.precision)
        return Storage({window.name: window})

    def _cut_message(self) -> str:
        bound = "" if self.history_bytes is None else f" (history_mb={self.history_bytes / (1 << 20):g})"
        steps = f" and {self.dropped_steps} steps" if self.dropped_steps else ""
        return (
            f"the recording keeps the last {self.n_commands} commands{bound}: {self.dropped} earlier commands"
            f"{steps} are not in it; with gl.create_context(..., history_mb=None) it keeps all"
        )


def copy_storage(storage: Storage) -> Storage:
    """Return a copy of all objects; images that several of them share are shared in the copy, too."""
    images: dict[int, Image] = {}

    def copied(image: Image) -> Image:
        if id(image) not in images:
            images[id(image)] = image.copy()
            if image.stencil is not None:
                images[id(image.stencil)] = images[id(image)].stencil  # type: ignore[assignment]
        return images[id(image)]

    def copied_framebuffer(target: Framebuffer) -> Framebuffer:
        attachments = {point: replace(each, image=copied(each.image)) for point, each in target.attachments.items()}
        accumulation = None if target.accumulation is None else target.accumulation.copy()
        return replace(target, attachments=attachments, accumulation=accumulation)

    everything: list[Any] = [image for texture in storage.textures.values() for image in texture.images.values()]
    everything += storage.renderbuffers.values()
    everything += [each.image for target in storage.framebuffers.values() for each in target.attachments.values()]
    for image in sorted(everything, key=lambda image: image.stencil is None):  # a packed one before its stencil image
        copied(image)
    return replace(
        storage,
        framebuffers={name: copied_framebuffer(target) for name, target in storage.framebuffers.items()},
        textures={
            name: replace(texture, images={place: copied(image) for place, image in texture.images.items()})
            for name, texture in storage.textures.items()
        },
        renderbuffers={name: copied(image) for name, image in storage.renderbuffers.items()},
        queries=dict(storage.queries),
        visibility_cache=None,
        geometry_cache=None,
    )
