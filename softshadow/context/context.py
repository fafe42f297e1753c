"""The current context: state, matrices, bound objects, and the recording of every command.

`softshadow.gl` defines the calls and checks their arguments; this module carries them out.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context.arrays import BufferObject, ClientArrays
from softshadow.context.pending_attributes import PendingAttributes
from softshadow.context.recording import Frame
from softshadow.context.vertex_buffer import Primitive, VertexBuffer
from softshadow.errors import StateError
from softshadow.framebuffer import Storage
from softshadow.frozen import evolve
from softshadow.pipeline.commands import Clear, Command, Draw, Vertices
from softshadow.pipeline.execute import execute
from softshadow.pipeline.queue import DrawQueue
from softshadow.pixel_store import PixelStore
from softshadow.programs import Program
from softshadow.programs.inverse import known_kind
from softshadow.state import TEXTURE_UNITS, State

MATRIX_STACK_DEPTHS = {gl.GL_MODELVIEW: 32, gl.GL_PROJECTION: 32, gl.GL_TEXTURE: 10}


@dataclass
class CurrentVertex:
    """The current colour, normal and texture coordinates, which each new vertex gets."""

    color: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    texcoords: list[tuple[float, float, float, float]] = field(
        default_factory=lambda: [(0.0, 0.0, 0.0, 1.0)] * TEXTURE_UNITS
    )


@dataclass
class DisplayList:
    """The calls between glNewList and glEndList, in order; `mode` is GL_COMPILE or GL_COMPILE_AND_EXECUTE."""

    name: int
    mode: int
    calls: list[Callable[[], Any]] = field(default_factory=list)

    @property
    def executes(self) -> bool:
        """Whether the calls are also carried out while the list is compiled."""
        return self.mode == gl.GL_COMPILE_AND_EXECUTE


class Context:
    """A GL context in its initial state, with a window of the given size.

    Parameters
    ----------
    width, height : int, pixels
    depth_format : "d24" or "d32f"
    stencil_bits : 1 to 8; counters saturate at ``2**stencil_bits - 1``
    precision : "mesa" (float32, the bits of llvmpipe) or "exact" (float64, depth not rounded)
    polygon_offset_slope : "max", "length" or "slide" (no absolute value, as printed on the slide)
    polygon_offset_unit : "mesa" (two depth steps) or "spec" (one)
    raise_errors : raise `GLError` besides recording the error for glGetError
    history_bytes : how much of the recording to keep at most, None for all
    """

    def __init__(
        self,
        width: int,
        height: int,
        depth_format: str = "d24",
        stencil_bits: int = 8,
        precision: str = "mesa",
        polygon_offset_slope: str = "max",
        polygon_offset_unit: str = "mesa",
        raise_errors: bool = True,
        history_bytes: int | None = None,
    ) -> None:
        if polygon_offset_slope not in ("max", "length", "slide"):
            raise ValueError(f"polygon_offset_slope={polygon_offset_slope!r}: expected 'max', 'length' or 'slide'")
        if polygon_offset_unit not in ("mesa", "spec"):
            raise ValueError(f"polygon_offset_unit={polygon_offset_unit!r}: expected 'mesa' or 'spec'")
        self._frame = Frame((width, height), depth_format, stencil_bits, precision, history_bytes=history_bytes)
        self.objects = self._frame.fresh_storage()
        self._waiting = DrawQueue(self.objects)
        self.offset_slope, self.offset_unit = polygon_offset_slope, polygon_offset_unit
        self.raise_errors = raise_errors
        self.before: Context | None = None  # the context that a with statement restores
        self.error = gl.GL_NO_ERROR
        viewport = evolve(State().viewport, width=width, height=height)
        scissor = evolve(State().scissor, width=width, height=height)
        self.state = evolve(State(), viewport=viewport, scissor=scissor)
        self.real: type[np.floating] = np.float64 if precision == "exact" else np.float32
        self.current = CurrentVertex()
        self.matrix_mode = gl.GL_MODELVIEW
        self.active_unit = 0
        identity = self.frozen(np.eye(4))
        self.modelview_stack = [identity]
        self.projection_stack = [identity]
        self.texture_stacks = [[identity] for _ in range(TEXTURE_UNITS)]
        # which kind each matrix is by the calls that made it: Mesa inverts by kind (softshadow.programs.inverse)
        self.modelview_kinds, self.projection_kinds = [0], [0]
        self.texture_kinds = [[0] for _ in range(TEXTURE_UNITS)]
        self.programs: dict[int, Program] = {}
        self.uniforms: dict[int, dict[str, Any]] = {}
        self.labels: list[str] = []
        self.primitive: Primitive | None = None  # between glBegin and glEnd
        self.vertex_buffer = VertexBuffer(self._carry_out, self.objects)  # immediate mode
        self.arrays = ClientArrays()
        self.client_stack: list[Any] = []
        self.buffers: dict[int, BufferObject] = {}
        self.attribute_stack: list[Any] = []
        # the state at the last glPushAttrib or glPopAttrib; bits of the groups that calls have marked as changed since
        self.state_at_push, self.touched = self.state, 0
        self.pending = PendingAttributes()
        self.lists: dict[int, DisplayList] = {}
        self.compiled_list: DisplayList | None = None  # between glNewList and glEndList
        self.executes_list = False  # while a compiled call is also being executed
        self.list_base = 0
        self.list_depth = 0  # nesting of lists that call each other
        self.hints: dict[int, int] = {}  # those that are not GL_DONT_CARE
        self.pack_store, self.unpack_store = PixelStore(), PixelStore()
        # the highest name returned by glGen*, per kind; an object exists in storage once it has been bound
        self.names = dict.fromkeys(("texture", "framebuffer", "renderbuffer", "query", "buffer"), 0)
        self.renderbuffer = 0
        self.query_targets: dict[int, int] = {}  # name: target of the queries that have been begun

    def __enter__(self) -> Context:
        make_current(self)
        return self

    def __exit__(self, *_: object) -> None:
        make_current(self.before)

    @property
    def storage(self) -> Storage:
        """The storage, after all draws that wait; `objects` is the same before them, for what no draw changes.

        Collected vertices of immediate mode are not drawn to it yet: `flush` first.
        """
        self._waiting.carry_out()
        return self.objects

    @property
    def frame(self) -> Frame:
        """The recording, after drawing everything that is still collected."""
        self.flush()
        return self._frame

    # -- state ---------------------------------------------------------------------------------------------------------
    def set(self, **groups: Any) -> None:
        """Replace groups of the state, each by its name."""
        self.change_state(evolve(self.state, **groups))

    def change_state(self, state: State) -> None:
        """Replace the state; if the change affects draws, draw the collected vertices first."""
        collected = self.vertex_buffer.sizes or self.pending.reset_due
        if collected and self.primitive is None and _draw_state(state) != _draw_state(self.state):
            before = self.state
            self.flush()
            if self.state is not before:  # the flush has made pending materials current
                materials: Any = {"front": self.state.lighting.front, "back": self.state.lighting.back}
                state = evolve(state, lighting=evolve(state.lighting, **materials))
        self.state = state

    def frozen(self, values: Any) -> np.ndarray:
        """Return the values as a read-only array in the context's precision; too large ones become infinite."""
        with np.errstate(over="ignore"):
            array = np.array(values, self.real)
        array.setflags(write=False)
        return array

    @property
    def matrix_stack(self) -> list[np.ndarray]:
        """The stack chosen by glMatrixMode; its last entry is the current matrix."""
        if self.matrix_mode == gl.GL_PROJECTION:
            return self.projection_stack
        return self.texture_stacks[self.active_unit] if self.matrix_mode == gl.GL_TEXTURE else self.modelview_stack

    @property
    def kind_stack(self) -> list[int]:
        """The kinds of the matrices of `matrix_stack`."""
        if self.matrix_mode == gl.GL_PROJECTION:
            return self.projection_kinds
        return self.texture_kinds[self.active_unit] if self.matrix_mode == gl.GL_TEXTURE else self.modelview_kinds

    def resolve_matrix_kinds(self) -> None:
        """Determine unknown kinds of the current matrices from their elements, as Mesa does at each draw."""
        for matrices, kinds in (
            (self.modelview_stack, self.modelview_kinds),
            (self.projection_stack, self.projection_kinds),
        ):
            kinds[-1] = known_kind(matrices[-1], kinds[-1])

    # -- commands ------------------------------------------------------------------------------------------------------
    def execute(self, command: Command) -> None:
        """Carry out a command, then record it; a command that raises is not recorded."""
        self.flush()
        self._carry_out(command)

    def flush(self) -> None:
        """Draw the collected vertices: later pairs are not joined to them. Do nothing between glBegin and glEnd."""
        if self.primitive is None:
            self.vertex_buffer.flush()
            if self.pending.reset_due:
                self.reset_attributes()

    def finish(self) -> None:
        """Draw the collected vertices, and carry out the draws that wait: then the buffers can be read."""
        self.flush()
        self._waiting.carry_out()

    def _carry_out(self, command: Command) -> None:
        if type(command) is not Draw:
            if type(command) is not Clear:
                self._waiting.forget()
            execute(command, self.storage)
        elif not self._waiting.add(command):
            execute(command, self.objects)
        if self._frame.append(command):
            self._frame.shorten(self.storage)

    def draw(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None) -> None:
        """Draw primitives under the current state; nobody may change the arrays afterwards."""
        self.flush()
        self.update_current()
        self._carry_out(self._draw_command(mode, vertices, indices))

    def draw_primitive(self, mode: int, vertices: Vertices) -> None:
        """Draw a primitive of immediate mode at once; the vertex format stays for those that follow."""
        self.vertex_buffer.draw_joined_pairs()
        self.vertex_buffer.draw(self._draw_command(mode, vertices))

    def collect(self, mode: int, vertices: Vertices) -> None:
        """Collect triangles or quads of immediate mode, to draw them together with pairs that follow."""
        if not self.vertex_buffer.can_join(mode):
            self.vertex_buffer.begin_joined_pairs(self._draw_command(mode, vertices))
        self.vertex_buffer.join("/".join(self.labels), vertices)

    # -- current values ------------------------------------------------------------------------------------------------
    def attribute(self, name: str) -> Any:
        """Return a current value by its name: "color", "normal", "texcoord0", "front.diffuse" ..."""
        if name.startswith("texcoord"):
            return self.current.texcoords[int(name.removeprefix("texcoord"))]
        side, _, material = name.partition(".")
        return getattr(getattr(self.state.lighting, side), material) if material else getattr(self.current, name)

    def set_attribute(self, name: str, value: Any) -> None:
        """Set a current value by its name, without drawing the collected vertices first."""
        side, _, material = name.partition(".")
        if name.startswith("texcoord"):
            self.current.texcoords[int(name.removeprefix("texcoord"))] = value
        elif material:
            lighting = self.state.lighting
            materials: Any = {side: evolve(getattr(lighting, side), **{material: value})}
            self.state = evolve(self.state, lighting=evolve(lighting, **materials))
        else:
            setattr(self.current, name, value)

    def remember_attribute(self, name: str) -> None:
        """Remember the current value of an attribute that is about to be set."""
        pending = self.pending
        if name not in pending.old_values:
            pending.names.add(name)
            pending.old_values[name] = self.attribute(name)
            pending.hidden.pop(name, None)

    def update_current(self) -> None:
        """Make pending attributes current, as queries of current values do (Mesa's FLUSH_CURRENT)."""
        if self.pending.old_values:
            self._make_pending_current()
            self.pending.reset_due = True

    def reset_attributes(self) -> None:
        """Make pending attributes current; the vertices that follow do not carry them (Mesa's vbo_reset_all_attr)."""
        self._make_pending_current()
        self.pending.names.clear()
        self.pending.reset_due = False

    def _make_pending_current(self) -> None:
        pending = self.pending
        for name, value in pending.hidden.items():
            pending.old_values.setdefault(name, self.attribute(name))
            self.set_attribute(name, value)
        for name, old_value in pending.old_values.items():
            if old_value != self.attribute(name):
                self.touched |= gl.GL_LIGHTING_BIT if "." in name else gl.GL_CURRENT_BIT
        pending.hidden.clear()
        pending.old_values.clear()

    # -- recording -----------------------------------------------------------------------------------------------------
    def _draw_command(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None) -> Draw:
        self.resolve_matrix_kinds()
        return Draw(
            state=self.state,
            mode=mode,
            vertices=vertices,
            indices=indices,
            modelview=self.modelview_stack[-1],
            projection=self.projection_stack[-1],
            texture_matrices=tuple(stack[-1] for stack in self.texture_stacks),
            uniforms=self._uniform_values(),
            program_name=self.programs[self.state.program].name if self.state.program else "",
            label="/".join(self.labels),
            offset_slope=self.offset_slope,
            offset_unit=self.offset_unit,
            modelview_kind=self.modelview_kinds[-1],
            projection_kind=self.projection_kinds[-1],
        )

    def _uniform_values(self) -> Mapping[str, Any]:
        return dict(self.uniforms[self.state.program]) if self.state.program else {}

    def end_step(self, title: str) -> None:
        """Mark the end of a step in the recording."""
        self.flush()
        self._frame.steps.append((title, len(self._frame.commands)))


def _draw_state(state: State) -> State:
    """Return the state without the fields that draws do not use: clear values and the active stencil face."""
    return evolve(
        state,
        color=evolve(state.color, clear=State().color.clear, clear_accum=State().color.clear_accum),
        depth=evolve(state.depth, clear=State().depth.clear),
        stencil=evolve(state.stencil, clear=State().stencil.clear, active_back=False),
    )


_thread = threading.local()


def current() -> Context:
    """Return this thread's current context.

    Raises
    ------
    StateError
        There is none yet.
    """
    context = getattr(_thread, "context", None)
    if context is None:
        raise StateError("no current context: call softshadow.gl.create_context(width, height) first")
    return context


def make_current(context: Context | None) -> Context | None:
    """Make a context this thread's current one; return the previous one."""
    before: Context | None = getattr(_thread, "context", None)
    if before is not None:
        before.flush()
    _thread.context = context
    return before
