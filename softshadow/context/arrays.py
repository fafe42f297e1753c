"""Vertex arrays and buffer objects: what the pointer calls have set, and the caches of their contents."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.state import TEXTURE_UNITS

CACHE_BYTES = 256 << 20  # of each cache: a few meshes of a million triangles
CACHE_ENTRIES = 4096
POSITION, COLOR, NORMAL, TEXCOORD = range(4)  # slots of the attributes; texture coordinates of the other units follow
EDGE = TEXCOORD + TEXTURE_UNITS
SECONDARY, FOG_COORDINATE = EDGE + 1, EDGE + 2
SLOTS = {"position": POSITION, "color": COLOR, "normal": NORMAL}
SLOTS |= {f"texcoord{unit}": TEXCOORD + unit for unit in range(TEXTURE_UNITS)}
SLOTS |= {"edge": EDGE, "secondary": SECONDARY, "fog_coordinate": FOG_COORDINATE, "index": FOG_COORDINATE + 1}
SLOT_NAMES = tuple(SLOTS)
INITIAL_SIZES = {"normal": 3, "secondary": 3, "fog_coordinate": 1}  # of arrays that do not begin with 4 components


@dataclass(frozen=True)
class ArrayLayout:
    """The layout of a vertex array: components per vertex, GL's type, bytes from vertex to vertex."""

    size: int = 4
    type: int = gl.GL_FLOAT
    stride: int = 0


class Cache:
    """Values by key, each with its size in bytes; the oldest ones are evicted beyond the bounds."""

    def __init__(self, bytes: int = CACHE_BYTES, entries: int = CACHE_ENTRIES) -> None:
        self._bounds = bytes, entries
        self._entries: OrderedDict[Hashable, tuple[Any, int]] = OrderedDict()  # the oldest first
        self.bytes = 0

    def __len__(self) -> int:
        return len(self._entries)

    def get(self, key: Hashable) -> Any:
        """Return the value of a key, or None."""
        entry = self._entries.get(key)
        return None if entry is None else entry[0]

    def use(self, key: Hashable) -> Any:
        """Return the value of a key, or None; it becomes the newest."""
        entry = self._entries.get(key)
        if entry is None:
            return None
        self._entries.move_to_end(key)
        return entry[0]

    def put(self, key: Hashable, value: Any, bytes: int) -> None:
        """Set the value of a key; it stays until the next call even if it is larger than the bound."""
        self.drop(key)
        self._entries[key] = value, bytes
        self.bytes += bytes
        most_bytes, most_entries = self._bounds
        while len(self._entries) > 1 and (self.bytes > most_bytes or len(self._entries) > most_entries):
            self.bytes -= self._entries.popitem(last=False)[1][1]

    def drop(self, key: Hashable) -> None:
        """Remove a key, if it is there."""
        entry = self._entries.pop(key, None)
        if entry is not None:
            self.bytes -= entry[1]


@dataclass(eq=False, slots=True)
class RowSnapshot:
    """The rows [first, end) of a vertex array at a draw, which never change.

    Attributes
    ----------
    slot : int                   of the attribute, see `VertexArray`
    rows : (end - first, width)  as they are drawn, read-only
    content : bytes or None      the source of a small array; None if nobody can change it
    raw : ndarray or None        the source of a larger one, contiguous, with its address
    drawn : dict                 `Vertices` with these positions, by range, other arrays and constant attributes
    slices : dict                parts of `rows` by range
    """

    slot: int
    first: int
    end: int
    rows: np.ndarray
    content: bytes | None = None
    raw: np.ndarray | None = None
    address: int = 0
    drawn: dict[Any, Any] = field(default_factory=dict)
    slices: dict[tuple[int, int], np.ndarray] = field(default_factory=dict)

    @property
    def bytes(self) -> int:
        """The size in bytes, the copy of the source included."""
        raw = 0 if self.raw is None or self.raw is self.rows else self.raw.nbytes
        return self.rows.nbytes + raw + len(self.content or b"")


@dataclass(eq=False, slots=True)
class VertexArray:
    """The array of one attribute as rows of numbers: the user's memory, a copy of it, or bytes of a buffer object.

    Attributes
    ----------
    slot : int                   0 position, 1 colour, 2 normal, 3 ... texture coordinates
    owner : object               the pointer argument; an id stays unique only while its object lives
    is_fixed : bool              nobody writes to the rows
    root : ndarray or None       what owns the memory of a fixed array of the user, who may make it writeable later
    address, row_bytes : int     of contiguous rows; else `row_bytes` is 0
    snapshot : RowSnapshot       the last one
    """

    slot: int
    rows: np.ndarray
    layout: ArrayLayout
    owner: Any
    is_fixed: bool
    root: np.ndarray | None = None
    address: int = 0
    row_bytes: int = 0
    snapshot: RowSnapshot | None = None


@dataclass(frozen=True)
class Mapping:
    """The bytes [offset, offset + length) of a buffer object that the client may use; `access` are GL_MAP_*_BIT."""

    offset: int
    length: int
    access: int
    pointer: Any


@dataclass
class BufferObject:
    """The bytes of a buffer object, and its usage hint; `mapping` is not None between glMapBuffer and glUnmapBuffer.

    `views` holds what has been read from the present contents; while it is empty, nobody else knows these bytes.
    """

    content: np.ndarray = field(default_factory=lambda: np.zeros(0, np.uint8))
    usage: int = gl.GL_STATIC_DRAW
    views: dict[Hashable, Any] = field(default_factory=dict)
    mapping: Mapping | None = None

    def view(self, key: Hashable, make: Callable[[], Any]) -> Any:
        """Return what was read under a key; read it if it is new."""
        if key not in self.views:
            if len(self.views) >= CACHE_ENTRIES:
                self.views.clear()
            self.views[key] = make()
        return self.views[key]


class LatestIndices(NamedTuple):
    """The argument of the latest draw with an index array, and what was found for it in `ClientArrays.indices`."""

    argument: Any
    n_indices: int
    dtype: Any
    found: Any


@dataclass
class ClientArrays:
    """Vertex arrays: which are enabled, the array or buffer of each, and what draws have read from them.

    Names are keys of `SLOTS`: "position", "color", "texcoord0" ... `active` holds the arrays that a draw reads,
    position first; None after a change. `active_slots` are theirs. `constants` are the attributes without an array as
    the last draw had them.
    """

    enabled: set[str] = field(default_factory=set)
    pointers: dict[str, VertexArray] = field(default_factory=dict)
    offsets: dict[str, tuple[int, int]] = field(default_factory=dict)  # (buffer object, byte) instead of an array
    array_buffer: int = 0
    element_buffer: int = 0
    layouts: dict[str, ArrayLayout] = field(default_factory=dict)
    active_unit: int = 0
    active: tuple[VertexArray, ...] | None = None
    active_slots: tuple[int, ...] = ()
    readers: tuple[tuple[VertexArray, ...], Any] | None = None  # of glArrayElement, for these active arrays
    constants: Any = None
    sources: Cache = field(default_factory=Cache)  # vertex arrays by the pointer argument
    indices: Cache = field(default_factory=Cache)  # index arrays by the argument
    latest_indices: LatestIndices | None = None
    latest_rows: tuple[Any, tuple[VertexArray, ...], Any] | None = None  # of these arrays, which indices have named
    snapshots: Cache = field(default_factory=Cache)  # of both, by their contents

    def layout(self, name: str) -> ArrayLayout:
        """Return the layout of an array; before its first pointer call, GL's initial one."""
        return self.layouts.get(name) or ArrayLayout(INITIAL_SIZES.get(name, 4))
