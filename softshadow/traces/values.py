"""The bytes of a trace, read as numbers, strings, arrays and the other values that calls have.

The file is read as a stream: memory holds one part of it, and the names in it.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from softshadow.errors import TraceError
from softshadow.traces.container import unpacked_parts

# bounds that no recorded program comes near, so that a damaged file cannot fill the memory
DEEPEST_VALUE = 32
LARGEST_STRING = 1 << 29
MOST_ELEMENTS = 1 << 24  # of all arrays of a call
LARGEST_CALL = 1 << 30
MOST_ARGUMENTS = 256
MOST_NAMES = 1 << 20
LONGEST_UINT = 70  # bits; more than any that is written

FLOAT, DOUBLE = struct.Struct("<f"), struct.Struct("<d")


class NeedsMore(Exception):
    """The unpacked bytes end before the event does; `end` is a place that is needed, if it is known."""

    def __init__(self, end: int = 0) -> None:
        self.end = end


@dataclass
class Names:
    """The signatures that the file has defined so far; each is written once, where it is first used."""

    functions: dict[int, tuple[str, int]] = field(default_factory=dict)  # id: name, number of arguments
    structs: dict[int, tuple[str, ...]] = field(default_factory=dict)  # id: names of the members
    enums: dict[int, int] = field(default_factory=dict)  # id: value, up to version 2
    bitmasks: dict[int, None] = field(default_factory=dict)
    frames: dict[int, None] = field(default_factory=dict)  # of backtraces


class ValueReader:
    """Reads what a trace consists of, one value after the other; the names that values have are kept."""

    version = 0  # of the format: values of enums depend on it

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = str(path)
        self._parts = unpacked_parts(path)
        self._bytes, self._at, self._place = b"", 0, 0  # unpacked, the next one to read, place of the part in the file
        self._names, self._new_names = Names(), 0
        self._defined: list[tuple[dict[int, Any], int]] = []  # by the event that is being read
        self._depth = self._n_elements = 0  # of the event that is being read

    def _where(self) -> str:
        """Return the last call that was read, in words, for messages."""
        return "before the first call"

    # -- bytes ---------------------------------------------------------------------------------------------------------
    def _load(self, end: int = 0) -> bool:
        """Unpack more of the file, at least up to `end`; return whether there is more."""
        loaded = [self._bytes[self._at :]]
        n_bytes = len(loaded[0])
        for place, part in self._parts:
            self._place = place
            loaded.append(part)
            n_bytes += len(part)
            if n_bytes >= end - self._at and part:
                break
        if len(loaded) == 1:
            return False
        self._bytes, self._at = b"".join(loaded), 0
        return True

    def _whole(self, read: Callable[[], Any]) -> Any:
        """Return what `read` reads; if the bytes end within it, unpack more, and read it again from its beginning."""
        while True:
            start = self._at
            self._defined.clear()
            self._depth = self._n_elements = 0
            try:
                return read()
            except (NeedsMore, IndexError, struct.error) as stopped:
                end = stopped.end if isinstance(stopped, NeedsMore) else 0
            for table, key in self._defined:
                del table[key]
            available, self._at = len(self._bytes) - start, start
            if available > LARGEST_CALL:
                raise self._error(f"a call has more than {LARGEST_CALL >> 20} MB")
            if not self._load(max(end, start + 2 * available)):  # twice as much, so that long calls are not read often
                raise self._error("the file ends within a call")

    def _error(self, text: str) -> TraceError:
        where = f"byte {self._at} of the part that begins at byte {self._place} of the file"
        return TraceError(f"{self.path}: {text}, {self._where()}, at {where}")

    # -- names ---------------------------------------------------------------------------------------------------------
    def _struct_members(self) -> tuple[str, ...]:
        known, key = self._names.structs, self._uint()
        if key not in known:
            self._string()
            n_members = self._count("a structure", MOST_ARGUMENTS)
            self._define(known, key, tuple(self._string() for _ in range(n_members)))
        return known[key]

    def _define(self, known: dict[int, Any], key: int, value: Any) -> None:
        self._count_name()
        known[key] = value
        self._defined.append((known, key))

    def _count_name(self) -> None:
        self._new_names += 1
        if self._new_names > MOST_NAMES:
            raise self._error(f"the file defines more than {MOST_NAMES} names")

    # -- values --------------------------------------------------------------------------------------------------------
    def _byte(self) -> int:
        value = self._bytes[self._at]
        self._at += 1
        return value

    def _uint(self) -> int:
        data, at = self._bytes, self._at
        byte = data[at]
        at += 1
        if byte < 128:
            self._at = at
            return byte
        value, shift = byte & 127, 7
        while True:
            byte = data[at]
            at += 1
            value |= (byte & 127) << shift
            if byte < 128:
                self._at = at
                return value
            shift += 7
            if shift > LONGEST_UINT:
                raise self._error("a number has more than 64 bits")

    def _count(self, what: str, most: int) -> int:
        number = self._uint()
        if number > most:
            raise self._error(f"{what} has {number} elements; expected at most {most}")
        return number

    def _memory(self) -> bytes:
        n_bytes = self._count("a string or block of memory", LARGEST_STRING)
        start, end = self._at, self._at + n_bytes
        if end > len(self._bytes):
            raise NeedsMore(end)
        self._at = end
        return self._bytes[start:end]

    def _string(self) -> str:
        return self._memory().decode("utf-8", "replace")

    def _signed(self) -> int:
        kind = self._byte()
        if kind not in (3, 4):
            raise self._error(f"expected a whole number, found a value of type {kind}")
        return -self._uint() if kind == 3 else self._uint()

    def _value(self) -> Any:
        kind = self._byte()
        if kind == 4:  # the most frequent ones
            return self._uint()
        if kind == 5:
            (value,) = FLOAT.unpack_from(self._bytes, self._at)
            self._at += 4
            return value
        if kind >= len(READERS):
            raise self._error(f"expected a value, found type {kind}")
        self._depth += 1
        if self._depth > DEEPEST_VALUE:
            raise self._error(f"a value is nested deeper than {DEEPEST_VALUE} levels")
        value = READERS[kind](self)
        self._depth -= 1
        return value

    def _double(self) -> float:
        (value,) = DOUBLE.unpack_from(self._bytes, self._at)
        self._at += 8
        return float(value)

    def _enum(self) -> int:
        known, key = self._names.enums, self._uint()
        if key not in known:
            if self.version < 3:
                self._string()
                self._define(known, key, self._signed())
            else:
                for _ in range(self._count("an enum", MOST_ELEMENTS)):
                    self._string()
                    self._signed()
                    self._count_name()
                self._define(known, key, 0)
        return known[key] if self.version < 3 else self._signed()

    def _bitmask(self) -> int:
        known, key = self._names.bitmasks, self._uint()
        if key not in known:
            for _ in range(self._count("a bitmask", MOST_ELEMENTS)):
                self._string()
                self._uint()
                self._count_name()
            self._define(known, key, None)
        return self._uint()

    def _array(self) -> list[Any]:
        n_elements = self._count("an array", MOST_ELEMENTS - self._n_elements)
        self._n_elements += n_elements
        return [self._value() for _ in range(n_elements)]

    def _struct(self) -> dict[str, Any]:
        return {name: self._value() for name in self._struct_members()}

    def _both(self) -> Any:
        """Read a value for people, and return the one for machines that follows it."""
        self._value()
        return self._value()

    def _wide_string(self) -> str:
        codes = [self._uint() for _ in range(self._count("a string", LARGEST_STRING))]
        return "".join(chr(code) if code < 0x110000 else "\ufffd" for code in codes)


# by the type of a value: null, false, true, negative and other integers, float, double, string, memory, enum, bitmask,
# array, structure, address, value in two forms, string of wide characters
READERS: tuple[Callable[[ValueReader], Any], ...] = (
    lambda _: None,
    lambda _: False,
    lambda _: True,
    lambda reader: -reader._uint(),
    ValueReader._uint,
    lambda reader: reader._value(),
    ValueReader._double,
    ValueReader._string,
    ValueReader._memory,
    ValueReader._enum,
    ValueReader._bitmask,
    ValueReader._array,
    ValueReader._struct,
    ValueReader._uint,
    ValueReader._both,
    ValueReader._wide_string,
)
