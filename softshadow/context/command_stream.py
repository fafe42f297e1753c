"""The commands of a context on their way to the buffers: some draws are late, some wait, and all are recorded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from softshadow.context.late_commands import LateCommands
from softshadow.context.late_draws import LateDraws
from softshadow.context.late_forms import LateDraw, MovedDraw
from softshadow.context.line_pattern import LinePattern
from softshadow.context.precision import Precision
from softshadow.context.recording import Frame
from softshadow.framebuffer import Storage, default_framebuffer
from softshadow.pipeline.commands import OF_FRAMEBUFFERS, Command, Draw
from softshadow.pipeline.draw_kinds import changes_cells_only
from softshadow.pipeline.execute import execute
from softshadow.pipeline.new_texels import NewTexels
from softshadow.pipeline.queue import DrawQueue


class CollectedText(Protocol):
    """Bitmaps in a row, which are drawn together (`softshadow.gl.bitmaps`)."""

    def command(self) -> Draw:
        """Return the draw of all of them."""


class CommandStream:
    """Carries out and records the commands of a context, in the order of its calls.

    Small draws are late at first: their arrays are made when there are many of them, or when another command comes than
    new texels.
    Then most draws wait in a queue, until someone looks at the buffers.

    Parameters
    ----------
    frame : Frame            the recording, still empty
    precision : Precision    makes the arrays of late draws
    compiles : bool          whether to compile the kernels for runs of draws at their first use

    Attributes
    ----------
    frame : Frame
    objects : Storage        what the commands draw to, before the draws that wait
    late : LateDraws
    text : CollectedText or None    comes behind the late draws, and before all that follows
    gate : callable or None  is asked whether a command is carried out; None: all are
    bound_samplers : tuple or None  texture units, and the samplers of the textures bound to them; None after a change
                             of a texture
    complete_framebuffer : int or None  the last framebuffer that was found to be complete; None after a change of any
    """

    def __init__(self, frame: Frame, precision: Precision, compiles: bool) -> None:
        self.frame, self.objects = frame, frame.fresh_storage()
        self.late = LateDraws(precision)
        self.text: CollectedText | None = None
        self.gate: Callable[[Command], bool] | None = None
        self.bound_samplers: tuple[Any, Any] | None = None
        self.complete_framebuffer: int | None = None
        self._queue = DrawQueue(self.objects, compiles)
        self._line_pattern = LinePattern(self.objects)

    def carry_out(self, command: Command) -> None:
        """Carry out and record a command; one that raises is not recorded. New texels wait among late draws."""
        if self.text is not None:
            self.draw_text()
        if self.late.draws:
            if isinstance(command, NewTexels) and self._add_texels(command):
                return
            self.draw_late()
        if self.gate is not None and not self.gate(command):
            return
        if type(command) is Draw and command.state.lines.stippled:
            command = self._line_pattern.continued(command)
        if type(command) is not Draw:
            only_cells = changes_cells_only(command, self.objects)
            if not only_cells:
                self._line_pattern.find_place()
                self.bound_samplers = None
            if not only_cells or isinstance(command, OF_FRAMEBUFFERS):
                self.complete_framebuffer = None
            self._queue.add_other(command, only_cells)
        elif not self._queue.add(command):
            execute(command, self.objects)
        if self.frame.append(command):
            self.frame.shorten(self.objects_after_all())

    def carry_out_alike(self, commands: Sequence[Draw]) -> None:
        """Carry out and record draws that differ from the first one in vertices and indices only."""
        if self.late.draws:
            self.draw_late()
        self._carry_out_several(commands, self._queue.add_alike)

    def carry_out_moved(self, commands: Sequence[Draw]) -> None:
        """Carry out and record draws that differ from the first one in vertices, indices and modelview matrix only.

        No draw is late.
        """
        self._carry_out_several(commands, self._queue.add_like)

    def _carry_out_several(self, commands: Sequence[Draw], add: Callable[[Sequence[Draw]], int]) -> None:
        """Carry out and record draws; `add` lets some of them wait."""
        self._carry_out_parts(
            commands, lambda first: add(commands[first:]), lambda first, end: self.frame.extend(commands[first:end])
        )

    def _carry_out_parts(
        self, commands: Sequence[Draw], add: Callable[[int], int], record: Callable[[int, int], bool]
    ) -> None:
        """Carry out draws; `add` lets some wait, from one on, and `record` records those from one to another."""
        n_done = 0
        while n_done < len(commands):
            first, command = n_done, commands[n_done]
            if self.text is not None or self.gate is not None or command.state.lines.stippled:
                self.carry_out(command)
                n_done += 1
                continue
            n_added = add(first)
            if not n_added:
                execute(command, self.objects)
            n_done += n_added or 1
            if record(first, n_done):
                self.frame.shorten(self.objects_after_all())

    def carry_out_kept(self, commands: Sequence[Command]) -> None:
        """Carry out and record commands that the gate has kept back."""
        gate, self.gate = self.gate, None
        try:
            for command in commands:
                self.carry_out(command)
        finally:
            self.gate = gate

    def add_late(self, draw: LateDraw | MovedDraw) -> None:
        """Let a draw be late."""
        if self.text is not None:
            self.draw_text()
        if self.late.add(draw):
            self.draw_late()

    def _add_texels(self, command: NewTexels) -> bool:
        """Let new texels wait among late draws; return False if they must be carried out."""
        return self.gate is None and changes_cells_only(command, self.objects) and self.late.add_texels(command)

    def draw_text(self) -> None:
        """Carry out and record the bitmaps that are collected."""
        text, self.text = self.text, None
        if text is not None:
            self.carry_out(text.command())

    def draw_late(self) -> None:
        """Carry out and record the draws that are late."""
        for late in self.late.take():
            if not self._let_wait(late):
                for command in late:
                    self.carry_out(command)
            elif self.frame.extend_late(late):
                self.frame.shorten(self.objects_after_all())

    def _let_wait(self, late: LateCommands) -> bool:
        """Let late draws wait in the queue; return False, and do nothing, where each must be looked at."""
        if self.text is not None or self.gate is not None or late.parts[0][0].state.lines.stippled:
            return False
        return self._queue.add_in_turns(late.parts, late.turns, late.texels)

    def carry_out_waiting(self) -> None:
        """Carry out the draws that wait in the queue."""
        self._queue.carry_out()

    def objects_after_all(self) -> Storage:
        """Return the objects after all draws, also the late ones and the bitmaps."""
        self.draw_text()
        self.draw_late()
        self._queue.carry_out()
        return self.objects

    def passed_fragments(self, query: int) -> int:
        """Return how many fragments an ended occlusion query has counted; draws that it does not count may wait."""
        self._queue.finish_query(query)
        return self.objects.queries[query]

    def forget(self) -> None:
        """Forget what is known of the objects; no draw waits."""
        self._line_pattern.find_place()
        self._queue.forget()
        self.bound_samplers = self.complete_framebuffer = None

    def replace_window(self, width: int, height: int) -> None:
        """Replace the window by a cleared one of another size; no draw waits."""
        self.forget()
        before, frame = self.objects.window, self.frame
        window = default_framebuffer(width, height, frame.depth_format, frame.stencil_bits, frame.precision)
        window.draw_buffers, window.read_buffer = before.draw_buffers, before.read_buffer
        self.objects.framebuffers[window.name], self.objects.visibility_cache = window, None
        frame.size = width, height
