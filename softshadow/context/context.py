"""The current context: state, matrices, bound objects, and the recording of every command.

`softshadow.gl` spells the calls and checks their arguments; what they do to a context is done here.
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
from softshadow.context.vertex_buffer import Primitive, VertexBuffer
from softshadow.errors import StateError
from softshadow.framebuffer import Storage, default_framebuffer
from softshadow.frozen import evolve
from softshadow.pipeline.commands import Command, Draw, Vertices
from softshadow.pipeline.execute import execute
from softshadow.pixel_store import PixelStore
from softshadow.programs import Program
from softshadow.programs.inverse import known_kind
from softshadow.state import TEXTURE_UNITS, State

MATRIX_STACK_DEPTHS = {gl.GL_MODELVIEW: 32, gl.GL_PROJECTION: 32, gl.GL_TEXTURE: 10}


@dataclass
class Frame:
    """The recording: what the window was made with, every command, and where each step ends.

    `steps` holds (title, number of commands until its end).
    """

    size: tuple[int, int]
    depth_format: str
    stencil_bits: int
    precision: str
    commands: list[Command] = field(default_factory=list)
    steps: list[tuple[str, int]] = field(default_factory=list)

    def fresh_storage(self) -> Storage:
        """Return storage as it was before the first command."""
        window = default_framebuffer(*self.size, self.depth_format, self.stencil_bits, self.precision)
        return Storage({window.name: window})


@dataclass
class CurrentVertex:
    """The current values that a vertex takes along: glColor, glNormal, glTexCoord."""

    color: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    texcoords: list[tuple[float, float, float, float]] = field(
        default_factory=lambda: [(0.0, 0.0, 0.0, 1.0)] * TEXTURE_UNITS
    )


@dataclass
class DisplayList:
    """What stands between glNewList and glEndList: calls in order; `mode` is GL_COMPILE or GL_COMPILE_AND_EXECUTE."""

    name: int
    mode: int
    calls: list[Callable[[], Any]] = field(default_factory=list)

    @property
    def executes(self) -> bool:
        """Whether the calls are carried out while the list is made."""
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
    ) -> None:
        if polygon_offset_slope not in ("max", "length", "slide"):
            raise ValueError(f"polygon_offset_slope={polygon_offset_slope!r}: expected 'max', 'length' or 'slide'")
        if polygon_offset_unit not in ("mesa", "spec"):
            raise ValueError(f"polygon_offset_unit={polygon_offset_unit!r}: expected 'mesa' or 'spec'")
        self._frame = Frame((width, height), depth_format, stencil_bits, precision)
        self.storage = self._frame.fresh_storage()  # without what waits: `settle` first
        self.offset_slope, self.offset_unit = polygon_offset_slope, polygon_offset_unit
        self.raise_errors = raise_errors
        self.before: Context | None = None  # what a with statement brings back
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
        # what the calls that made each matrix say of it: how Mesa inverts it (softshadow.programs.inverse)
        self.modelview_kinds, self.projection_kinds = [0], [0]
        self.texture_kinds = [[0] for _ in range(TEXTURE_UNITS)]
        self.programs: dict[int, Program] = {}
        self.uniforms: dict[int, dict[str, Any]] = {}
        self.labels: list[str] = []
        self.primitive: Primitive | None = None  # between glBegin and glEnd
        self.vertex_buffer = VertexBuffer(self._carry_out, self.storage)  # of immediate mode
        self.arrays = ClientArrays()
        self.client_stack: list[Any] = []
        self.buffers: dict[int, BufferObject] = {}
        self.attribute_stack: list[Any] = []
        # since the last glPushAttrib or glPopAttrib: the state as it was, groups of attributes changed beside it
        self.seen, self.touched = self.state, 0
        self.pending = PendingAttributes()
        self.lists: dict[int, DisplayList] = {}
        self.compiled_list: DisplayList | None = None  # between glNewList and glEndList
        self.executes_list = False  # in a call that is carried out while its list is made
        self.list_base = 0
        self.list_depth = 0  # of lists that call each other
        self.hints: dict[int, int] = {}  # where not GL_DONT_CARE
        self.pack_store, self.unpack_store = PixelStore(), PixelStore()
        # the highest name that glGen* has given out, per kind; an object exists in storage once it has been bound
        self.names = dict.fromkeys(("texture", "framebuffer", "renderbuffer", "query", "buffer"), 0)
        self.renderbuffer = 0
        self.query_targets: dict[int, int] = {}  # of the queries that have been begun

    def __enter__(self) -> Context:
        make_current(self)
        return self

    def __exit__(self, *_: object) -> None:
        make_current(self.before)

    @property
    def frame(self) -> Frame:
        """The recording, with everything that was drawn."""
        self.settle()
        return self._frame

    # -- state ---------------------------------------------------------------------------------------------------------
    def set(self, **groups: Any) -> None:
        """Replace whole groups of the state, by their names."""
        self.change_state(evolve(self.state, **groups))

    def change_state(self, state: State) -> None:
        """Replace the state; where that makes a difference to draws, it ends the batch of quads."""
        waits = self.vertex_buffer.sizes or self.pending.stored
        if waits and self.primitive is None and _drawn_under(state) != _drawn_under(self.state):
            before = self.state
            self.settle()
            if self.state is not before:  # materials were handed on
                handed_on: Any = {"front": self.state.lighting.front, "back": self.state.lighting.back}
                state = evolve(state, lighting=evolve(state.lighting, **handed_on))
        self.state = state

    def frozen(self, values: Any) -> np.ndarray:
        """Return the values as a read-only array of the context's precision; what is too large becomes infinite."""
        with np.errstate(over="ignore"):
            array = np.array(values, self.real)
        array.setflags(write=False)
        return array

    @property
    def matrix_stack(self) -> list[np.ndarray]:
        """The stack that matrix calls work on; its last entry is the current matrix."""
        if self.matrix_mode == gl.GL_PROJECTION:
            return self.projection_stack
        return self.texture_stacks[self.active_unit] if self.matrix_mode == gl.GL_TEXTURE else self.modelview_stack

    @property
    def kind_stack(self) -> list[int]:
        """The kinds of the matrices of `matrix_stack`."""
        if self.matrix_mode == gl.GL_PROJECTION:
            return self.projection_kinds
        return self.texture_kinds[self.active_unit] if self.matrix_mode == gl.GL_TEXTURE else self.modelview_kinds

    def settle_kinds(self) -> None:
        """Read unknown kinds of the current matrices off their elements, as Mesa does when something is drawn."""
        for matrices, kinds in (
            (self.modelview_stack, self.modelview_kinds),
            (self.projection_stack, self.projection_kinds),
        ):
            kinds[-1] = known_kind(matrices[-1], kinds[-1])

    # -- commands ------------------------------------------------------------------------------------------------------
    def execute(self, command: Command) -> None:
        """Carry a command out, then record it: a command that raises has changed nothing."""
        self.settle()
        self._carry_out(command)

    def settle(self) -> None:
        """Draw what waits; what is drawn next begins a batch of its own. Not between glBegin and glEnd."""
        if self.primitive is None:
            self.vertex_buffer.settle()
            if self.pending.stored:
                self.pending.forget(self)

    def _carry_out(self, command: Command) -> None:
        execute(command, self.storage)
        self._frame.commands.append(command)

    def draw(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None) -> None:
        """Draw primitives under the present state. The arrays must be read-only and the caller's own no more."""
        self.settle()
        self.pending.read(self)
        self._carry_out(self._draw_command(mode, vertices, indices))

    def draw_primitive(self, mode: int, vertices: Vertices) -> None:
        """Draw a primitive of immediate mode: vertices that follow may still carry the same attributes."""
        self.vertex_buffer.draw_pending()
        self.vertex_buffer.draw(self._draw_command(mode, vertices))

    def collect(self, mode: int, vertices: Vertices) -> None:
        """Draw triangles or quads of immediate mode, later: the ones that follow may belong to the same batch."""
        if not self.vertex_buffer.takes(mode):
            self.vertex_buffer.begin_batch(self._draw_command(mode, vertices))
        self.vertex_buffer.add_to_batch("/".join(self.labels), vertices)

    # -- current values ------------------------------------------------------------------------------------------------
    def attribute(self, name: str) -> Any:
        """Return a current value by its name: "color", "normal", "texcoord0", "front.diffuse" ..."""
        if name.startswith("texcoord"):
            return self.current.texcoords[int(name.removeprefix("texcoord"))]
        side, _, material = name.partition(".")
        return getattr(getattr(self.state.lighting, side), material) if material else getattr(self.current, name)

    def set_attribute(self, name: str, value: Any) -> None:
        """Set a current value by its name. A material ends no batch of quads by this."""
        side, _, material = name.partition(".")
        if name.startswith("texcoord"):
            self.current.texcoords[int(name.removeprefix("texcoord"))] = value
        elif material:
            lighting = self.state.lighting
            made: Any = {side: evolve(getattr(lighting, side), **{material: value})}
            self.state = evolve(self.state, lighting=evolve(lighting, **made))
        else:
            setattr(self.current, name, value)

    def _draw_command(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None) -> Draw:
        self.settle_kinds()
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
        """Mark the end of a step of the recording."""
        self.settle()
        self._frame.steps.append((title, len(self._frame.commands)))


def _drawn_under(state: State) -> State:
    """Return the state without what draws do not depend on: the values that glClear writes."""
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
    """Make a context this thread's current one; return the one before."""
    before: Context | None = getattr(_thread, "context", None)
    if before is not None:
        before.settle()
    _thread.context = context
    return before
