"""A small writer of apitrace's format, after its docs/FORMAT.markdown; it also writes what apitrace never would."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from typing import Any

import cramjam


@dataclass(frozen=True)
class Enum:
    """A value with a signature of named values."""

    value: int
    names: tuple[tuple[str, int], ...] = (("GL_SOME", 1),)


@dataclass(frozen=True)
class Bitmask:
    """A mask with a signature of named bits."""

    value: int


@dataclass(frozen=True)
class Pointer:
    """An address that the recorded program used."""

    address: int


@dataclass(frozen=True)
class Struct:
    """A structure."""

    members: tuple[tuple[str, Any], ...]


def uint(number: int) -> bytes:
    """Return a number in seven bits per byte, the lowest first."""
    written = bytearray()
    while True:
        written.append(number & 127 | (128 if number > 127 else 0))
        number >>= 7
        if not number:
            return bytes(written)


def string(text: str) -> bytes:
    """Return a string with its length."""
    return uint(len(text.encode())) + text.encode()


@dataclass
class TraceWriter:
    """Collects the events of a trace."""

    version: int = 6
    content: bytearray = field(default_factory=bytearray)
    _functions: dict[str, int] = field(default_factory=dict)
    _signatures: dict[Any, int] = field(default_factory=dict)
    number: int = 0

    def __post_init__(self) -> None:
        self.content += uint(self.version)
        if self.version >= 6:
            self.content += uint(6) + string("process.name") + string("a program") + string("")

    def call(self, name: str, *arguments: Any, result: Any = None, thread: int = 0, fake: bool = False) -> int:
        """Write a call that returns at once, and return its number."""
        number = self.enter(name, *arguments, thread=thread, fake=fake)
        self.leave(number, result)
        return number

    def enter(self, name: str, *arguments: Any, thread: int = 0, fake: bool = False, backtrace: bytes = b"") -> int:
        """Write the beginning of a call."""
        self.content += b"\0" + (uint(thread) if self.version >= 4 else b"")
        if name in self._functions:
            self.content += uint(self._functions[name])
        else:
            self._functions[name] = len(self._functions)
            self.content += uint(self._functions[name]) + string(name) + uint(len(arguments))
            self.content += b"".join(string(f"argument{i}") for i in range(len(arguments)))
        if fake:
            self.content += b"\5" + uint(1)
        self.content += backtrace
        for index, value in enumerate(arguments):
            self.content += b"\1" + uint(index) + self.value(value)
        self.content += b"\0"
        self.number += 1
        return self.number - 1

    def leave(self, number: int, result: Any = None, outputs: dict[int, Any] | None = None) -> None:
        """Write the end of a call, with its result and the arguments that it has filled."""
        self.content += b"\1" + uint(number)
        for index, value in (outputs or {}).items():
            self.content += b"\1" + uint(index) + self.value(value)
        if result is not None:
            self.content += b"\2" + self.value(result)
        self.content += b"\0"

    def _signature(self, key: Any, definition: bytes) -> bytes:
        known = key in self._signatures
        number = self._signatures.setdefault(key, len(self._signatures))
        return uint(number) + (b"" if known else definition)

    def value(self, value: Any) -> bytes:
        """Return a value with its type."""
        match value:
            case None:
                return b"\0"
            case bool():
                return b"\2" if value else b"\1"
            case int():
                return b"\4" + uint(value) if value >= 0 else b"\3" + uint(-value)
            case float():
                return b"\5" + struct.pack("<f", value)
            case str():
                return b"\7" + string(value)
            case bytes():
                return b"\x08" + uint(len(value)) + value
            case Enum() if self.version < 3:
                return b"\x09" + self._signature(value, string("GL_SOME") + self.value(value.value))
            case Enum():
                names = uint(len(value.names)) + b"".join(string(n) + self.value(v) for n, v in value.names)
                return b"\x09" + self._signature(("enum", value.names), names) + self.value(value.value)
            case Bitmask():
                return b"\x0a" + self._signature("bits", uint(1) + string("GL_BIT") + uint(1)) + uint(value.value)
            case list() | tuple():
                return b"\x0b" + uint(len(value)) + b"".join(map(self.value, value))
            case Struct():
                names = [name for name, _ in value.members]
                definition = string("a structure") + uint(len(names)) + b"".join(map(string, names))
                members = b"".join(self.value(member) for _, member in value.members)
                return b"\x0c" + self._signature(("struct", *names), definition) + members
            case Pointer():
                return b"\x0d" + uint(value.address)
        raise TypeError(value)

    def snappy(self, chunk: int = 1 << 20) -> bytes:
        """Return the file that apitrace writes, with parts of so many bytes."""
        packed = bytearray(b"at")
        for start in range(0, len(self.content), chunk):
            part = bytes(cramjam.snappy.compress_raw(bytes(self.content[start : start + chunk])))
            packed += struct.pack("<I", len(part)) + part
        return bytes(packed)
