"""Primitives in display lists: arrays instead of calls.

A list is compiled once and called often. Where nothing but vertices and their attributes stands between a glBegin and
its glEnd, the calls become arrays (`with_primitives`); each call of the list then draws them at once. The result is
that of the calls (see tests/gl/test_list_primitives.py), which remain for the cases that depend on what came before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.gl import immediate, texture_coordinates, vertex_attributes
from softshadow.gl.array_snapshots import COLOR, NORMAL, POSITION, TEXCOORD
from softshadow.gl.constant_attributes import ConstantAttribute, ConstantSet, constant_attributes
from softshadow.gl.conversions import (
    from_byte,
    from_int,
    from_short,
    from_unsigned_byte,
    from_unsigned_int,
    from_unsigned_short,
    vector,
)
from softshadow.gl.errors import GLError
from softshadow.gl.framebuffers import framebuffer_status
from softshadow.gl.immediate import MODES, consecutive_indices
from softshadow.gl.materials import follow_color
from softshadow.gl.vertex_format import REST
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.mesa.driver_draws import CORNERS
from softshadow.state import TEXTURE_UNITS

MOST_DRAWN = 16  # current values that a primitive was drawn with
EXACT = 2**53  # integers up to here are exact in float64
NAMES = ("position", "color", "normal", *(f"texcoord{unit}" for unit in range(TEXTURE_UNITS)))  # by slot
Values = tuple[float, ...]


# -- which calls -------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class AttributeCall:
    """A call that sets an attribute: how its arguments become values.

    `slot` is None if the first argument names the texture unit. `is_vector`: the only other argument is a vector.
    `rest` are the values that the call adds.
    """

    slot: int | None
    count: int
    is_vector: bool
    convert: Callable[[Any], float] = float
    rest: Values = ()

    def values(self, arguments: Sequence[Any]) -> Values | None:
        """Return the values that are set, or None for arguments that only the call itself can judge."""
        if self.is_vector:
            (params,) = arguments
            return (*(float(value) for value in vector(params, self.count, self.convert)), *self.rest)
        if len(arguments) != self.count or not all(map(_is_plain, arguments)):
            return None
        return (*(float(self.convert(value)) for value in arguments), *self.rest)


def _is_plain(value: Any) -> bool:
    """Return whether a number is the same for all ways of converting it."""
    if isinstance(value, int | np.integer):
        return -EXACT <= int(value) <= EXACT
    return isinstance(value, float | np.float32)


def _undecorated(call: Callable[..., Any]) -> Callable[..., Any]:
    """Return a call as lists record it."""
    return getattr(call, "__wrapped__", call)


def _attribute_calls() -> dict[Callable[..., Any], AttributeCall]:
    """Return all calls that set an attribute or add a vertex."""
    calls: dict[Callable[..., Any], AttributeCall] = {}
    convert: Callable[[Any], float]

    def add(module: Any, name: str, *parameters: Any, **named: Any) -> None:
        calls.setdefault(_undecorated(getattr(module, name)), AttributeCall(*parameters, **named))

    for n in (1, 2, 3, 4):
        for name, slot in (("TexCoord", TEXCOORD), ("MultiTexCoord", None)):
            for suffix, convert in (("f", float), ("fv", float), ("iv", int)):
                add(texture_coordinates, f"gl{name}{n}{suffix}", slot, n, "v" in suffix, convert)
        if n > 1:
            for suffix, convert in (("f", float), ("fv", float), ("iv", int)):
                add(immediate, f"glVertex{n}{suffix}", POSITION, n, "v" in suffix, convert)
    for suffix in ("f", "fv"):
        add(vertex_attributes, f"glNormal3{suffix}", NORMAL, 3, "v" in suffix)
        add(vertex_attributes, f"glColor3{suffix}", COLOR, 3, "v" in suffix)
        add(vertex_attributes, f"glColor4{suffix}", COLOR, 4, "v" in suffix)
    for suffix in ("d", "dv"):  # Mesa sets four components in all glColor3 calls but glColor3f
        add(vertex_attributes, f"glColor3{suffix}", COLOR, 3, "v" in suffix, rest=(1.0,))
    for kind, convert in (
        ("b", from_byte), ("ub", from_unsigned_byte), ("s", from_short), ("us", from_unsigned_short), ("i", from_int),
        ("ui", from_unsigned_int),
    ):  # fmt: skip
        for v in ("", "v"):
            add(vertex_attributes, f"glColor3{kind}{v}", COLOR, 3, bool(v), convert, (1.0,))
            add(vertex_attributes, f"glColor4{kind}{v}", COLOR, 4, bool(v), convert)
            if not kind.startswith("u"):
                add(vertex_attributes, f"glNormal3{kind}{v}", NORMAL, 3, bool(v), convert)
    return calls


CALLS = _attribute_calls()
BEGIN, END = _undecorated(immediate.glBegin), _undecorated(immediate.glEnd)


# -- drawing -----------------------------------------------------------------------------------------------------------
@dataclass(eq=False)
class ListPrimitive:
    """A glBegin ... glEnd pair of a list.

    Attributes
    ----------
    calls : list                 what it stands for
    rows : dict                  slot: one row per vertex, read-only; `indices` name equal vertices several times
    starts : dict                slot: the first vertex that has a value of the list; those before have the current one
    last : dict                  slot: the value after the pair
    sizes : dict                 name: components in the last call
    drawn : dict                 `Vertices` by the current values that they have
    """

    calls: list[Callable[[], Any]]
    mode: int
    rows: dict[int, np.ndarray]
    starts: dict[int, int]
    last: dict[int, Values]
    sizes: dict[str, int]
    indices: np.ndarray
    drawn: dict[tuple[ConstantAttribute, ...], Vertices] = field(default_factory=dict)

    def __call__(self) -> None:
        """Draw the primitive, and make its last attributes current."""
        context = current()
        if not _is_between_primitives(context):
            carry_out(self.calls)
            return
        if context.pending.names:
            context.reset_attributes()
        vertices = self.vertices(constant_attributes(context))
        values: Any = context.current
        for slot, value in self.last.items():
            context.remember_attribute(NAMES[slot])
            if slot == COLOR:
                values.color = value
            elif slot == NORMAL:
                values.normal = value
            else:
                values.texcoords[slot - TEXCOORD] = value
        context.vertex_buffer.active_sizes.update(self.sizes)
        follow_color(context)
        context.pending.reset_due = True
        context.draw(self.mode, vertices, self.indices)

    def vertices(self, constants: ConstantSet) -> Vertices:
        """Return the vertices; the same object for the same current values."""
        count = len(self.rows[POSITION])
        key = tuple(each for slot, each in enumerate(constants.attributes, 1) if self.starts.get(slot, 1))
        vertices = self.drawn.get(key)
        if vertices is None:
            rows = constants.rows(count)
            for slot, start in self.starts.items():
                rows[slot - 1] = self.rows[slot]
                if start:
                    rows[slot - 1] = self.rows[slot].copy()
                    rows[slot - 1][:start] = constants.attributes[slot - 1].row
                    rows[slot - 1].setflags(write=False)
            if len(self.drawn) >= MOST_DRAWN:
                self.drawn.clear()
            vertices = self.drawn[key] = Vertices(self.rows[POSITION], rows[0], rows[1], tuple(rows[2:]))
        return vertices


def _is_between_primitives(context: Context) -> bool:
    """Return whether a glBegin would begin a primitive, in an empty vertex buffer."""
    buffer = context.vertex_buffer
    if context.primitive is not None or not context.list_depth:
        return False
    if buffer.sizes:
        if "position" in buffer.sizes or buffer.n_vertices or buffer.joined_pairs is not None:
            return False
    elif buffer.n_vertices or buffer.joined_pairs is not None:
        return False
    if framebuffer_status(context, context.state.draw_framebuffer) != gl.GL_FRAMEBUFFER_COMPLETE:
        return False
    buffer.sizes.clear()
    return True


def carry_out(calls: Iterable[Callable[[], Any]]) -> None:
    """Make all calls, then raise the first of their errors: GL does not stop at an error."""
    first_error = None
    for call in calls:
        try:
            call()
        except GLError as error:
            first_error = first_error or error
    if first_error is not None:
        raise first_error


# -- compiling ---------------------------------------------------------------------------------------------------------
def with_primitives(context: Context, calls: list[Callable[[], Any]]) -> list[Callable[[], Any]]:
    """Return the calls of a list, with primitives as arrays."""
    compiled: list[Callable[[], Any]] = []
    begin = -1  # place of the last glBegin in `compiled`
    for call in calls:
        compiled.append(call)
        function = getattr(call, "func", None)
        if function is BEGIN:
            begin = len(compiled) - 1
        elif function is END and begin >= 0:
            primitive = _primitive(context, compiled[begin:])
            if primitive is not None:
                compiled[begin:] = [primitive]
            begin = -1
        elif function not in CALLS:
            begin = -1
    return compiled


def _primitive(context: Context, calls: list[Any]) -> ListPrimitive | None:
    """Return a pair of a list as arrays; None if it is empty, or has arguments that may be wrong."""
    begin, *inner, end = calls
    if len(begin.args) != 1 or any(map(_has_names, calls)) or end.args or begin.args[0] not in MODES:
        return None
    columns: dict[int, list[Values]] = {POSITION: []}
    starts: dict[int, int] = {}
    last: dict[int, Values] = {}
    sizes: dict[str, int] = {}
    positions = columns[POSITION]
    for call in inner:
        kind, arguments = CALLS[call.func], call.args
        slot = kind.slot
        try:
            if slot is None:
                slot, arguments = TEXCOORD + int(arguments[0]) % TEXTURE_UNITS, arguments[1:]
            values = kind.values(arguments)
        except Exception:  # the call itself raises the same when the list is called
            return None
        if values is None:
            return None
        sizes[NAMES[slot]] = len(values)
        if slot != NORMAL:
            values = (*values, *REST[len(values) :])
        if slot == POSITION:
            positions.append(values)
            for other, value in last.items():
                columns[other].append(value)
        else:
            if slot not in last:
                starts[slot] = len(positions)
                columns[slot] = [values] * len(positions)  # replaced by the current value of the call
            last[slot] = values
    if not positions:
        return None
    rows = {slot: context.frozen(column) for slot, column in columns.items()}
    mode, indices = int(begin.args[0]), consecutive_indices(len(positions))
    # with vertices left over, the range of the indices would decide how quads are cut (`mesa.quad_cuts`)
    if mode in CORNERS and len(positions) % CORNERS[mode] == 0 and not any(starts.values()):
        rows, indices = _with_equal_vertices_joined(rows, indices)
    return ListPrimitive(calls, mode, rows, starts, last, sizes, indices)


def _with_equal_vertices_joined(
    rows: dict[int, np.ndarray], indices: np.ndarray
) -> tuple[dict[int, np.ndarray], np.ndarray]:
    """Return rows without repetitions, and indices into them: corners of a mesh are shared by several triangles."""
    bits = np.hstack(list(rows.values()))
    keys = bits.view(np.dtype((np.void, bits.strides[0])))[:, 0]
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(keys):
        return rows, indices
    order = np.argsort(first)  # of their first use
    places = np.empty(len(order), np.int32)
    places[order] = np.arange(len(order))
    joined = {slot: array[first[order]] for slot, array in rows.items()}
    indices = places[inverse]
    for array in (*joined.values(), indices):
        array.setflags(write=False)
    return joined, indices


def _has_names(call: partial[Any]) -> bool:
    return bool(call.keywords)


__all__ = ["ListPrimitive", "carry_out", "with_primitives"]
