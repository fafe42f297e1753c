"""Playing a trace: its calls are made again on contexts of this package.

Object names need no translation: GL lets programs choose them, so textures, lists and buffers have the recorded ones.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from softshadow import gl
from softshadow.context import Context, make_current
from softshadow.gl.errors import GLError
from softshadow.gl.queries import CURRENT_VALUES
from softshadow.pipeline import commands
from softshadow.pipeline.commands import Command, Draw
from softshadow.recordings.arguments import arguments_of
from softshadow.recordings.draw_calls import is_draw, is_query, is_shading
from softshadow.recordings.draw_labels import DrawLabels
from softshadow.recordings.frames import TracedFrame
from softshadow.recordings.left_out import DRAWN_BY_SHADER, ERROR, MISSING, REFUSED, SHADING, LeftOutCalls
from softshadow.recordings.mapped_buffers import MappedBuffers
from softshadow.recordings.unseen_draws import UnseenDraws
from softshadow.recordings.window_systems import MadeCurrent, NewContext, Shared, ShareGroups, event_of
from softshadow.traces import Call

SMALLEST = (1, 1)  # of a context that never draws in its window
HISTORY_BYTES = 1 << 30  # of the recording of one frame
MOST_LABELLED = 5000  # draws of a frame that are told apart by the numbers of their calls
USE_PROGRAM = ("glUseProgram", "glUseProgramObjectARB")
ASSEMBLY = (0x8620, 0x8804)  # GL_VERTEX_PROGRAM_ARB, GL_FRAGMENT_PROGRAM_ARB
# what contexts that share objects see of each other
OBJECT_COMMANDS = (
    commands.DefineImage, commands.UpdateImage, commands.GenerateMipmaps, commands.CreateTexture, commands.SetSampler,
    commands.DeleteTextures, commands.DefineRenderbuffer, commands.DeleteRenderbuffers,
)  # fmt: skip
MAPS = ("glMapBuffer", "glMapBufferARB", "glMapBufferRange")
UNMAPS = ("glUnmapBuffer", "glUnmapBufferARB")


class TracedContext:
    """A context of the recorded program, and which programs in a shading language it has in use."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.unseen = UnseenDraws(context)
        self.program = 0
        self.assembly: set[int] = set()

    @property
    def shades(self) -> bool:
        """Whether a program in a shading language draws, which this package does not have."""
        return bool(self.program or self.assembly)


class Player:
    """Makes the calls of a trace again.

    Parameters
    ----------
    frames : list of TracedFrame from the first one to the chosen one, which is recorded
    size : (width, height)       of the chosen frame's window, instead of that which its viewports need

    Attributes
    ----------
    left_out : LeftOutCalls      what could not be done
    chosen : Context             the one that draws the last frame
    """

    def __init__(self, frames: list[TracedFrame], size: tuple[int, int] | None = None) -> None:
        self._frames, self._size = frames, size
        self._index = 0
        self._groups = ShareGroups()
        self._contexts: dict[int, TracedContext] = {}
        self._current: dict[int, int] = {}  # by thread
        self._active: TracedContext | None = None
        self._mapped = MappedBuffers()
        self._calls: dict[str, Callable[..., Any] | None] = {}
        self._drawing = "", 0  # name and number of the last call that draws
        self._labels = DrawLabels()
        self.left_out = LeftOutCalls()

    @property
    def is_in_frame(self) -> bool:
        """Whether the chosen frame has begun."""
        return self._index == len(self._frames) - 1

    @property
    def chosen(self) -> Context:
        """The context that draws the chosen frame."""
        return self._traced(self._frames[-1].context).context

    # -- frames --------------------------------------------------------------------------------------------------------
    def play(self, call: Call) -> None:
        """Make a call, or count it among those that are left out."""
        event = event_of(call)
        if event is not None:
            self._follow(call, event)
        elif call.name.startswith("gl") and not call.name.startswith("glX"):
            self._activate(call.thread)
            self._make(call)
        elif call.name == "memcpy":
            self._attempt(call, self._mapped.copy, call)
        if call.number == self._frames[self._index].last and not self.is_in_frame:
            self._end_frame()

    def _end_frame(self) -> None:
        for traced in self._contexts.values():
            make_current(traced.context)
            traced.context.flush()
            traced.context.frame.clear()
            if len(self._frames) - self._index == 2:  # the next one is the chosen one
                traced.unseen.carry_out()
        self._active = None
        self._index += 1
        for address in self._frames[self._index].sizes:
            if address in self._contexts:
                traced, size = self._contexts[address], self._size_of(address)
                if traced.context.frame.size != size:
                    make_current(traced.context)
                    traced.unseen.drop()
                    traced.context.resize(*size)
        if self.is_in_frame and self._frames[-1].context in self._contexts:
            make_current(self.chosen)
            self.chosen.begin_recording()

    def _size_of(self, address: int) -> tuple[int, int]:
        frame = self._frames[self._index]
        if self._size is not None and address == self._frames[-1].context:
            return self._size
        later = (each.sizes[address] for each in self._frames[self._index :] if address in each.sizes)
        return frame.sizes.get(address) or next(later, SMALLEST)

    # -- contexts ------------------------------------------------------------------------------------------------------
    def _follow(self, call: Call, event: Any) -> None:
        if isinstance(event, NewContext | Shared):
            self._groups.note(event)
        elif isinstance(event, MadeCurrent):
            self._current[call.thread] = event.context

    def _activate(self, thread: int) -> None:
        """Make the context of a thread current here; all threads of the recorded program are played by one."""
        traced = self._traced(self._current.get(thread, 0))
        if traced is not self._active:
            if self._active is not None:
                self._active.context.finish()
            make_current(traced.context)
            self._active = traced

    def _traced(self, address: int) -> TracedContext:
        if address not in self._contexts:
            context = Context(*self._size_of(address), history_bytes=HISTORY_BYTES, compiles=False)
            self._share_objects(address, context)
            self._contexts[address] = TracedContext(context)
            context.stream.gate = self._gate(self._contexts[address])
        return self._contexts[address]

    def _share_objects(self, address: int, context: Context) -> None:
        shared = self._groups.partner(address, self._contexts)
        if shared is not None:
            other = self._contexts[shared].context
            context.lists, context.buffers, context.names = other.lists, other.buffers, other.names
            context.generated_textures = other.generated_textures
            context.objects.textures = other.objects.textures
            context.objects.renderbuffers = other.objects.renderbuffers
            make_current(context)
            context.begin_recording()

    def _gate(self, traced: TracedContext) -> Callable[[Command], bool]:
        """Return which commands of a context are carried out: no draw of a program in a shading language."""

        def is_carried_out(command: Command) -> bool:
            if isinstance(command, Draw) and traced.shades:
                self._omit_draw()
                return False
            if not self.is_in_frame:
                if isinstance(command, OBJECT_COMMANDS):
                    for other in self._contexts.values():
                        other.unseen.see(command)
                return not traced.unseen.takes(command)
            chosen = self._contexts.get(self._frames[-1].context)
            if (
                isinstance(command, OBJECT_COMMANDS)
                and chosen is not None
                and chosen is not traced
                and chosen.context.objects.textures is traced.context.objects.textures
            ):
                chosen.context.frame.append(command)  # it changes objects of both
            return True

        return is_carried_out

    def _omit_draw(self) -> None:
        name, number = self._drawing
        self.left_out.add(DRAWN_BY_SHADER, name, number, "", self.is_in_frame)

    # -- calls ---------------------------------------------------------------------------------------------------------
    def _make(self, call: Call) -> None:
        name = call.name
        if is_draw(name):
            self._drawing = name, call.number
        assert self._active is not None
        if name in USE_PROGRAM:
            self._use(call)
        elif name in ("glEnable", "glDisable") and call.arguments[:1] and call.arguments[0] in ASSEMBLY:
            self._use_assembly(call)
        elif is_query(name):
            self._ask(call)
        elif name in MAPS:
            self._attempt(call, self._mapped.map, call, self._active.context)
        elif name in UNMAPS:
            self._mapped.unmap(call)
        elif is_shading(name):
            self.left_out.add(SHADING, name, call.number, "", self.is_in_frame)
        else:
            self._call(call)

    def _use(self, call: Call) -> None:
        assert self._active is not None
        self._active.context.flush()  # what was collected is drawn without the program
        self._active.program = call.arguments[0] if isinstance(call.arguments[0], int) else 0
        if self._active.program:
            self.left_out.add(SHADING, call.name, call.number, "", self.is_in_frame)

    def _use_assembly(self, call: Call) -> None:
        assert self._active is not None
        self._active.context.flush()
        if call.name == "glEnable":
            self._active.assembly.add(call.arguments[0])
            self.left_out.add(SHADING, call.name, call.number, "", self.is_in_frame)
        else:
            self._active.assembly.discard(call.arguments[0])

    def _ask(self, call: Call) -> None:
        """Do what a query does besides answering, which matters to the vertices that are collected."""
        assert self._active is not None
        context = self._active.context
        if call.name == "glGetError":
            self.left_out.answer(call.result if isinstance(call.result, int) else 0)
        elif call.name.startswith(("glRead", "glGetTexImage")):
            context.flush()
        elif call.arguments[:1] and call.arguments[0] in CURRENT_VALUES and context.primitive is None:
            context.update_current()

    def _call(self, call: Call) -> None:
        name = call.name
        if name not in self._calls:
            self._calls[name] = getattr(gl, name, None)
        function = self._calls[name]
        if function is None:
            self.left_out.add(MISSING, name, call.number, "", self.is_in_frame)
            return
        assert self._active is not None
        context = self._active.context

        def make() -> None:
            self._attempt(call, function)

        if name == "glEnd":
            self._labels.end(context, make)
        elif self.labels_draws and is_draw(name):
            self._labels.draw(context, f"call {call.number}", make)
        else:
            make()

    @property
    def labels_draws(self) -> bool:
        """Whether draws are named by their calls, so that histories of pixels can tell one from another."""
        return self.is_in_frame and self._frames[-1].draws <= MOST_LABELLED

    def _attempt(self, call: Call, function: Callable[..., Any], *arguments: Any) -> None:
        try:
            function(*(arguments or arguments_of(call.name, call.arguments)))
        except GLError as error:
            reason = str(error)
            self.left_out.add(ERROR, call.name, call.number, reason, self.is_in_frame, error.err)
            gl.glGetError()
        except Exception as error:  # whatever a recorded program passes, the replay goes on
            reason = f"{type(error).__name__}: {error}"[:300]
            self.left_out.add(REFUSED, call.name, call.number, reason, self.is_in_frame)
