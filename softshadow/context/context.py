"""The current context: state, matrices and bound objects.

`softshadow.gl` defines the calls and checks their arguments. What they draw goes through the context's command stream.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable
from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context.arrays import BufferObject, ClientArrays
from softshadow.context.color_indices import ColorIndices
from softshadow.context.command_stream import CommandStream
from softshadow.context.current_values import CurrentValues, CurrentVertex
from softshadow.context.display_list import DisplayList
from softshadow.context.evaluators import EvaluatorSettings, initial_maps
from softshadow.context.kept_materials import with_kept_materials
from softshadow.context.matrix_stacks import MatrixStack
from softshadow.context.pending_attributes import PendingAttributes
from softshadow.context.precision import Precision
from softshadow.context.recording import Frame
from softshadow.context.render_mode import RenderMode
from softshadow.context.state_groups import StateGroups
from softshadow.context.vertex_buffer import Primitive, VertexBuffer
from softshadow.errors import StateError
from softshadow.framebuffer import Storage
from softshadow.frozen import evolve
from softshadow.image import Format, Image
from softshadow.pipeline.commands import NO_UNIFORMS, Command, Draw, Origin, Vertices, draws_like, moved_draws
from softshadow.pixel_store import PixelStore
from softshadow.pixel_transfer import PixelTransfer
from softshadow.programs import Program
from softshadow.state import BLACK, TEXTURE_UNITS, State

MATRIX_STACK_DEPTHS = {gl.GL_MODELVIEW: 32, gl.GL_PROJECTION: 32, gl.GL_TEXTURE: 10}


class Context(CurrentValues, Precision):
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
    compiles : compile the kernels for runs of draws at their first use; for one picture that does not pay
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
        compiles: bool = True,
    ) -> None:
        if polygon_offset_slope not in ("max", "length", "slide"):
            raise ValueError(f"polygon_offset_slope={polygon_offset_slope!r}: expected 'max', 'length' or 'slide'")
        if polygon_offset_unit not in ("mesa", "spec"):
            raise ValueError(f"polygon_offset_unit={polygon_offset_unit!r}: expected 'mesa' or 'spec'")
        frame = Frame((width, height), depth_format, stencil_bits, precision, history_bytes=history_bytes)
        self.stream = CommandStream(frame, self, compiles)
        self.objects = self.stream.objects
        self.raise_errors = raise_errors
        # no list is compiled, no primitive is open, nothing is collected: a call may change the state at once.
        # Not always True then, but always False otherwise.
        self.ready = False
        self.before: Context | None = None  # the context that the first with statement restores
        self._restored: list[Context | None] = []  # by the with statements that this context is in
        self.error = gl.GL_NO_ERROR
        viewport = evolve(State().viewport, width=width, height=height)
        scissor = evolve(State().scissor, width=width, height=height)
        self.set_precision(precision)
        self.state_groups = StateGroups(evolve(State(), viewport=viewport, scissor=scissor), self.real is np.float32)
        self.groups, self.changed = self.state_groups.groups, self.state_groups.changed  # see `change`
        self.current = CurrentVertex()
        self.identity = self.frozen(np.eye(4))
        self.modelview_stack, self.projection_stack = (
            MatrixStack(MATRIX_STACK_DEPTHS[mode], self.real) for mode in (gl.GL_MODELVIEW, gl.GL_PROJECTION)
        )
        self.texture_stacks = [MatrixStack(MATRIX_STACK_DEPTHS[gl.GL_TEXTURE], self.real) for _ in range(TEXTURE_UNITS)]
        self._texture_matrices: tuple[np.ndarray, ...] | None = None  # None while calls can change them
        # set by `select_matrices` and `select_unit`; the last entry of the stack is the current matrix
        self.matrix_mode, self.active_unit, self.matrix_stack = gl.GL_MODELVIEW, 0, self.modelview_stack
        self.programs: dict[int, Program] = {}
        self.uniforms: dict[int, dict[str, Any]] = {}
        self.labels: list[str] = []
        self.origin: Origin | None = None  # what the primitives of the next draws were made from
        self.open_step: str | None = None  # title of a step that has begun
        self.primitive: Primitive | None = None  # between glBegin and glEnd
        # immediate mode
        self.vertex_buffer = VertexBuffer(self.stream)
        self.deferred = None
        self.deferred_before: Any = None  # what `deferred` was before, to be used again
        self.arrays = ClientArrays()
        self.client_stack: list[Any] = []
        self._offset_slope, self._offset_unit = polygon_offset_slope, polygon_offset_unit
        self.buffers: dict[int, BufferObject] = {}
        self.attribute_stack: list[Any] = []
        # the state at the last glPushAttrib or glPopAttrib; bits of the groups that calls have marked as changed since,
        # and between the push that the next pop belongs to and the last pop
        self.state_at_push, self.touched, self.touched_before = self.state, 0, 0
        self.others_at_push: tuple[Any, ...] | None = None  # attributes outside the state, while none is marked
        self.pending = PendingAttributes()
        # texture matrices and coordinates, and their products at the last raster position
        self.raster_texcoords: tuple[Any, Any, tuple[tuple[float, ...], ...]] | None = None
        # textures that show rectangles of pixels, by format, width and height; the latest one comes last
        self.rectangle_textures: dict[tuple[Format, int, int], int] = {}
        self.lists: dict[int, DisplayList] = {}
        self.compiled_list: DisplayList | None = None  # between glNewList and glEndList; whoever sets it clears `ready`
        self.executes_list = False  # while a compiled call is also being executed
        self.list_base = 0
        self.list_depth = 0  # nesting of lists that call each other
        self.hints: dict[int, int] = {}  # those that are not GL_DONT_CARE
        self.pack_store, self.unpack_store = PixelStore(), PixelStore()
        self.pixel_zoom = (1.0, 1.0)
        self.color_indices = ColorIndices()
        self.pixel_transfer = PixelTransfer()
        self.proxies: dict[tuple[int, int], Image] = {}  # by (target, level): images without cells
        # the highest name returned by glGen*, per kind; an object exists in storage once it has been bound
        self.names = dict.fromkeys(("texture", "framebuffer", "renderbuffer", "query", "buffer", "list"), 0)
        self.generated_textures: dict[int, float] = {}  # names that glGenTextures has returned: their priorities
        self.renderbuffer = 0
        self.render_mode = RenderMode()
        self.maps, self.evaluators = initial_maps(), EvaluatorSettings()
        self.meshes: dict[tuple[Any, ...], Any] = {}  # of evaluators, drawn lately (`softshadow.gl.evaluators`)
        self.query_targets: dict[int, int] = {}  # name: target of the queries that have been begun

    def __enter__(self) -> Context:
        before = make_current(self)
        is_new = before is self and not self._restored
        self._restored.append(self.before if is_new else before)
        self.before = None
        return self

    def __exit__(self, *_: object) -> None:
        make_current(self._restored.pop())

    def set_before(self, before: Context | None) -> None:
        """Let the context that was current before be the one that a with statement restores.

        That one forgets its own: else each context would keep all earlier ones, with their buffers and recordings.
        """
        self.before = before
        if before is not None:
            before.before = None

    @property
    def storage(self) -> Storage:
        """The storage, after all draws that wait; `objects` is the same before them, for what no draw changes.

        Collected vertices of immediate mode are not drawn to it yet: `flush` first.
        """
        return self.stream.objects_after_all()

    @property
    def frame(self) -> Frame:
        """The recording, after drawing everything that is still collected."""
        self.flush()
        return self.stream.frame

    # -- matrices and units --------------------------------------------------------------------------------------------
    def select_matrices(self, mode: int) -> None:
        """Select the stack that matrix calls work on."""
        self.matrix_mode = mode
        if mode == gl.GL_TEXTURE:
            self.matrix_stack = self.texture_stacks[self.active_unit]
            self._texture_matrices = None
        else:
            self.matrix_stack = self.modelview_stack if mode == gl.GL_MODELVIEW else self.projection_stack

    def select_unit(self, unit: int) -> None:
        """Select the texture unit that texture calls and the texture matrix stack apply to."""
        self.active_unit = unit
        self.select_matrices(self.matrix_mode)

    def texture_matrices(self) -> tuple[np.ndarray, ...]:
        """Return the texture matrices: the same tuple until calls can change them."""
        if self._texture_matrices is not None:
            return self._texture_matrices
        matrices = tuple([stack.current for stack in self.texture_stacks])
        if self.matrix_mode != gl.GL_TEXTURE:
            self._texture_matrices = matrices
        return matrices

    # -- commands ------------------------------------------------------------------------------------------------------
    def execute(self, command: Command) -> None:
        """Carry out a command, then record it; a command that raises is not recorded."""
        self.separate()
        self.stream.carry_out(command)

    def flush(self) -> None:
        """Draw what is collected, and what is late. Between glBegin and glEnd nothing is collected."""
        self.separate()
        if self.stream.late.draws:
            self.stream.draw_late()

    def separate(self) -> None:
        """Draw what is collected, maybe later: later pairs are not joined to it. Not between glBegin and glEnd."""
        if self.primitive is None:
            if self.stream.text is not None:
                self.stream.draw_text()
            self.flush_vertices()

    def flush_vertices(self) -> None:
        """Draw the collected vertices; bitmaps can still be joined to those that are collected."""
        if self.deferred is not None and self.primitive is None:
            self.deferred.draw()
        elif self.primitive is None:
            buffer = self.vertex_buffer
            if buffer.sizes or buffer.n_vertices or buffer.joined_pairs is not None:
                buffer.flush()
            if self.pending.reset_due:
                self.reset_attributes()

    def finish(self) -> None:
        """Draw the collected vertices, and carry out the draws that wait: then the buffers can be read."""
        self.flush()
        self.stream.carry_out_waiting()

    def begin_recording(self) -> None:
        """Let the recording begin here, with all buffers and textures as they are now."""
        self.flush()
        self.stream.frame.begin(self.storage)

    def resize(self, width: int, height: int) -> None:
        """Replace the window by a cleared one of another size; the recording begins with it."""
        self.finish()
        self.stream.replace_window(width, height)
        self.begin_recording()

    def draw(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None, pairs_mode: int = 0) -> Draw:
        """Draw primitives under the current state; nobody may change the arrays afterwards.

        `pairs_mode` is the mode of several strips that are separate primitives here (`Draw`).
        """
        if not self.ready:
            self.flush()
        self.update_current()
        return self.draw_prepared(mode, vertices, indices, pairs_mode)

    def draw_prepared(self, mode: int, vertices: Vertices, indices: np.ndarray | None, pairs_mode: int) -> Draw:
        """Draw primitives as `draw` does, where nothing is collected any more and all attributes are current."""
        command = self.draw_command(mode, self._with_current(vertices), indices)
        if pairs_mode:
            command = command._replace(pairs_mode=pairs_mode)
        self.stream.carry_out(command)
        return command

    def draw_like(self, before: Draw, others: Iterable[tuple[int, Vertices, np.ndarray | None]]) -> None:
        """Draw other primitives like those of the latest draw: nothing has changed since.

        `others` are modes, vertices with arrays of the same attributes, and indices.
        """
        for mode, same in groupby(others, itemgetter(0)):
            with_current = [(self._with_current(vertices), indices) for _, vertices, indices in same]
            self.stream.carry_out_alike(draws_like(before._replace(mode=mode), *zip(*with_current, strict=True)))

    def draw_moved(self, before: Draw, others: Iterable[tuple[Vertices, np.ndarray | None, np.ndarray, int]]) -> None:
        """Draw other primitives like those of the latest draw, of which only the modelview matrix has changed since.

        `others` are vertices with arrays of the same attributes, indices, modelview matrices and their kinds.
        """
        draws = moved_draws(before, [(self._with_current(each[0]), each[1], each[2], each[3]) for each in others])
        self.stream.carry_out_moved(draws)

    def _with_current(self, vertices: Vertices) -> Vertices:
        """Return vertices with the current edge flag, secondary colour and fog coordinate, where they have no array."""
        current = self.current
        if current.is_plain:
            return vertices
        added: dict[str, Any] = {}
        if not current.edge and vertices.edges is None:
            added["edges"] = np.broadcast_to(False, len(vertices.position))
        if current.secondary != BLACK and vertices.secondary is None:
            added["secondary"] = np.broadcast_to(self.frozen(current.secondary), (len(vertices.position), 4))
        if current.fog_coordinate != 0 and vertices.fog_coordinates is None:
            added["fog_coordinates"] = np.broadcast_to(self.frozen(current.fog_coordinate), len(vertices.position))
        return vertices._replace(**added) if added else vertices

    def draw_primitive(self, mode: int, vertices: Vertices) -> None:
        """Draw a primitive of immediate mode at once; the vertex format stays for those that follow."""
        self.vertex_buffer.draw_joined_pairs()
        self.vertex_buffer.draw(self.draw_command(mode, vertices))

    # -- recording -----------------------------------------------------------------------------------------------------
    def draw_command(self, mode: int, vertices: Vertices, indices: np.ndarray | None = None) -> Draw:
        """Return a draw under the current state."""
        state = self.state_groups.drawn()
        if not self.has_followed(state):
            state = with_kept_materials(self.state, vertices.color)
        program = state.program
        modelview, modelview_kind = self.modelview_stack.drawn()
        projection, projection_kind = self.projection_stack.drawn()
        command = Draw(
            state,
            mode,
            vertices,
            indices,
            modelview,
            projection,
            self._texture_matrices or self.texture_matrices(),
            offset_slope=self._offset_slope,
            offset_unit=self._offset_unit,
            modelview_kind=modelview_kind,
            projection_kind=projection_kind,
            origin=self.origin,
        )
        if program or self.labels:
            uniforms = dict(self.uniforms[program]) if program else NO_UNIFORMS
            name = self.programs[program].name if program else ""
            command = command._replace(uniforms=uniforms, program_name=name, label="/".join(self.labels))
        return command

    def has_followed(self, state: State) -> bool:
        """Return whether materials that follow the colour, if any do, have followed the current one."""
        lighting, groups, color = state.lighting, self.state_groups, self.current.color
        if not lighting.color_material or (groups.followed is not None and groups.followed[2] is color):
            return True
        return groups.have_followed(color, lighting)

    def end_step(self, title: str) -> None:
        """Mark the end of a step in the recording."""
        self.flush()
        frame = self.stream.frame
        frame.steps.append((title, frame.n_commands))

    def begin_step(self, title: str) -> None:
        """Begin a step, which ends where the next one begins; what was drawn before the first one is a step, too."""
        if self.open_step is not None:
            self.end_step(self.open_step)
        elif self.frame.n_commands:
            self.end_step(f"before {title!r}")
        self.open_step = title

    def end_open_step(self) -> None:
        """End the step that was begun last, if there is one."""
        if self.open_step is not None:
            self.end_step(self.open_step)
            self.open_step = None


class _NoContext:
    """What is current in a thread without a context: the first use of it raises an error."""

    def __getattr__(self, name: str) -> Any:
        raise StateError("no current context: call softshadow.gl.create_context(width, height) first")

    def __bool__(self) -> bool:
        return False


class _Thread(threading.local):
    """`context` is this thread's current context; each thread has its own."""

    context: Context = _NoContext()  # type: ignore[assignment]


thread = _Thread()


def current() -> Context:
    """Return this thread's current context.

    Raises
    ------
    StateError
        There is none yet.
    """
    context = thread.context
    context.error  # noqa: B018 - raises an error without a context
    return context


def make_current(context: Context | None) -> Context | None:
    """Make a context this thread's current one; return the previous one."""
    before = thread.context or None
    if before is not None:
        before.flush()
        if context and context is not before and context.objects.textures is before.objects.textures:
            before.finish()
            context.stream.forget()  # `before` may have changed the objects that both share
    thread.context = context or _Thread.context
    return before
