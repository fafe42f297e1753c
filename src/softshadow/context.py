"""The current context: state, matrices, bound objects, and the recording of every command.

`softshadow.gl` spells the calls and checks their arguments; what they do to a context is done here.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.framebuffer import Storage, default_framebuffer
from softshadow.pipeline.batches import SEPARATE, Batch, Pairs, Run
from softshadow.pipeline.commands import Command, Draw, Vertices
from softshadow.pixel_store import PixelStore
from softshadow.programs import Program
from softshadow.programs.inverse import known_kind
from softshadow.state import TEXTURE_UNITS, State

VERTEX_BUFFER_BYTES = 512 * 1024  # that Mesa collects the vertices of immediate mode in (vbo_exec_draw.c)
LEAST_BYTES = 1024  # with no more than these left, it takes a new buffer
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
class GivenAttributes:
    """Attributes that were given and not yet handed on to the current values, which Mesa keeps elsewhere.

    That decides what glPopAttrib brings back: it takes the current values along, and sees as changed what was handed on
    (vbo_exec_api.c; NeedFlush in mtypes.h).

    Attributes
    ----------
    names : set of str       "color", "normal", "texcoord0", "front.diffuse" ...: given since they were last forgotten
    before : dict            name: the current value, of those given and not handed on
    waiting : dict           name: what was given, where glPopAttrib has brought another current value back since
    stored : bool            whether the next change of state hands them on and forgets them
    """

    names: set[str] = field(default_factory=set)
    before: dict[str, Any] = field(default_factory=dict)
    waiting: dict[str, Any] = field(default_factory=dict)
    stored: bool = False


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


@dataclass(frozen=True)
class ArrayLayout:
    """What a pointer call said besides the array: numbers per vertex, GL's type, bytes from vertex to vertex."""

    size: int = 4
    type: int = gl.GL_FLOAT
    stride: int = 0


@dataclass
class BufferObject:
    """The bytes of a buffer object, and the usage it was given."""

    content: np.ndarray = field(default_factory=lambda: np.zeros(0, np.uint8))
    usage: int = gl.GL_STATIC_DRAW


@dataclass
class ClientArrays:
    """Vertex arrays: which are enabled, the array each pointer call gave, and what drawn arrays were converted to.

    Names are "position", "color", "normal", "texcoord0" ...
    """

    enabled: set[str] = field(default_factory=set)
    pointers: dict[str, np.ndarray] = field(default_factory=dict)
    offsets: dict[str, tuple[int, int]] = field(default_factory=dict)  # (buffer object, byte) instead of an array
    array_buffer: int = 0
    element_buffer: int = 0
    layouts: dict[str, ArrayLayout] = field(default_factory=dict)
    converted: dict[Any, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    active_unit: int = 0

    def layout(self, name: str) -> ArrayLayout:
        """Return the layout of an array, GL's initial one where there was no pointer call."""
        return self.layouts.get(name, ArrayLayout())


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
        viewport = replace(State().viewport, width=width, height=height)
        scissor = replace(State().scissor, width=width, height=height)
        self.state = replace(State(), viewport=viewport, scissor=scissor)
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
        self.batch: Batch | None = None  # triangles or quads that wait for more of them
        self.pairs, self.run = Pairs(), Run()  # of glBegin and glEnd, since vertices were sent off
        self.vertex_sizes: dict[str, int] = {}  # what the vertices collected last carry: numbers per attribute
        self.given_sizes: dict[str, int] = {}  # how many of those the last call gave, as far as Mesa remembers
        self.stored_vertices = 0  # how many were collected since the last time they were sent off
        self.buffer_used = 0  # bytes of the vertex buffer before them
        self.arrays = ClientArrays()
        self.client_stack: list[Any] = []
        self.buffers: dict[int, BufferObject] = {}
        self.attribute_stack: list[Any] = []
        # since the last glPushAttrib or glPopAttrib: the state as it was, groups of attributes changed beside it
        self.seen, self.touched = self.state, 0
        self.given = GivenAttributes()
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
        self.change_state(replace(self.state, **groups))

    def change_state(self, state: State) -> None:
        """Replace the state; where that makes a difference to draws, it ends the batch of quads."""
        waits = self.vertex_sizes or self.given.stored
        if waits and self.primitive is None and _drawn_under(state) != _drawn_under(self.state):
            before = self.state
            self.settle()
            if self.state is not before:  # materials were handed on
                handed_on: Any = {"front": self.state.lighting.front, "back": self.state.lighting.back}
                state = replace(state, lighting=replace(state.lighting, **handed_on))
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

    def _carry_out(self, command: Command) -> None:
        command.apply(self.storage)
        self._frame.commands.append(command)

    def draw(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None) -> None:
        """Draw primitives under the present state. The arrays must be read-only and the caller's own no more."""
        self.settle()
        self.read_given()
        self._carry_out(self._draw_command(mode, vertices, indices))

    def draw_primitive(self, mode: int, vertices: Vertices) -> None:
        """Draw a primitive of immediate mode: vertices that follow may still carry the same attributes."""
        self.draw_waiting()
        self._draw_in_run(self._draw_command(mode, vertices, None))

    def _draw_in_run(self, command: Draw) -> None:
        if command.mode != self.run.mode:
            self.run = Run(command.mode)
        if not self.run.is_lost:
            self._carry_out(self.run.part(command, self.storage))

    def end_pair(self, mode: int, vertices: int) -> None:
        """Count a pair of glBegin and glEnd; what waits is drawn if an empty one has another mode, or at the 64th."""
        if not vertices and self.pairs.mode != mode:
            self.draw_waiting()
            self.run = Run(mode, is_lost=mode not in SEPARATE)
        self.pairs.add(mode, vertices)
        if self.pairs.too_many:
            self.send_off_vertices()

    def collect(self, mode: int, vertices: Vertices) -> None:
        """Draw triangles or quads of immediate mode, later: the ones that follow may belong to the same batch."""
        if self.batch is None or self.batch.first.mode != mode or not self.batch.takes_more:
            self.draw_waiting()
            self.batch = Batch(self._draw_command(mode, vertices, None))
        self.batch.parts.append(("/".join(self.labels), vertices))

    def draw_waiting(self) -> None:
        """Draw what waits."""
        batch, self.batch = self.batch, None
        if batch is not None:
            for command in batch.commands():
                self._draw_in_run(command)

    def settle(self) -> None:
        """Draw what waits; what is drawn next begins a batch of its own. Not between glBegin and glEnd."""
        if self.primitive is None:
            if self.stored_vertices or self.batch is not None:  # pairs without vertices are still counted after this
                self.send_off_vertices()
            self.vertex_sizes.clear()
            if self.given.stored:
                self.forget_given()

    @property
    def vertex_bytes(self) -> int:
        """The size of a vertex of immediate mode in Mesa's buffer."""
        return 4 * sum(self.vertex_sizes.values())

    def send_off_vertices(self) -> None:
        """Draw what waits; the vertices of immediate mode that follow come after them in Mesa's buffer."""
        self.draw_waiting()
        self.run = Run()
        self.pairs = Pairs()
        self.buffer_used += self.stored_vertices * self.vertex_bytes
        self.stored_vertices = 0
        if self.buffer_used + LEAST_BYTES >= VERTEX_BUFFER_BYTES:
            self.buffer_used = 0

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
            made: Any = {side: replace(getattr(lighting, side), **{material: value})}
            self.state = replace(self.state, lighting=replace(lighting, **made))
        else:
            setattr(self.current, name, value)

    def about_to_give(self, name: str) -> None:
        """Remember that an attribute is given, and over which current value."""
        given = self.given
        if name not in given.before:
            given.names.add(name)
            given.before[name] = self.attribute(name)
            given.waiting.pop(name, None)

    def hand_on_given(self) -> None:
        """Make current what was given, and mark the groups of attributes that this changes."""
        given = self.given
        for name, value in given.waiting.items():
            given.before.setdefault(name, self.attribute(name))
            self.set_attribute(name, value)
        for name, before in given.before.items():
            if before != self.attribute(name):
                self.touched |= gl.GL_LIGHTING_BIT if "." in name else gl.GL_CURRENT_BIT
        given.waiting.clear()
        given.before.clear()

    def read_given(self) -> None:
        """Hand on what was given since the last time, as queries of current values do."""
        if self.given.before:
            self.hand_on_given()
            self.given.stored = True

    def forget_given(self) -> None:
        """Hand on what was given; the vertices to come do not carry it by themselves any more."""
        self.hand_on_given()
        self.given.names.clear()
        self.given.stored = False

    def _draw_command(self, mode: int, vertices: Vertices, indices: np.ndarray | None) -> Draw:
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
    return replace(
        state,
        color=replace(state.color, clear=State().color.clear, clear_accum=State().color.clear_accum),
        depth=replace(state.depth, clear=State().depth.clear),
        stencil=replace(state.stencil, clear=State().stencil.clear, active_back=False),
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
