"""A trace, call by call: apitrace's binary format, versions 0 to 6, as its docs/FORMAT.markdown specifies it.

The file is read as a stream: memory holds one part of it, the names in it, and the calls that have not returned yet.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from softshadow.traces.values import MOST_ARGUMENTS, MOST_ELEMENTS, ValueReader

NEWEST_VERSION = 6
ENTER, LEAVE = 0, 1
END, ARGUMENT, RESULT, THREAD, BACKTRACE, FLAGS = range(6)  # details of a call
FAKE = 1  # a flag: apitrace made the call, to tell what memory held
FRAME_END, FRAME_MODULE, FRAME_FUNCTION, FRAME_FILE, FRAME_LINE, FRAME_OFFSET = range(6)  # of a backtrace
MOST_OPEN_CALLS = 1 << 16  # more than any recorded program has


@dataclass(slots=True)
class Call:
    """A recorded call.

    Attributes
    ----------
    number : int                 from 0, counted in the order in which the calls began
    name : str                   "glVertex3f"
    arguments : list             numbers, str, bytes (memory), lists, dict (a structure), None; enums and addresses are
                                 numbers
    result                       the same, or None
    thread : int
    is_fake : bool               apitrace made it, to record memory that the program has written
    has_returned : bool
    """

    number: int
    name: str
    arguments: list[Any]
    result: Any = None
    thread: int = 0
    is_fake: bool = False
    has_returned: bool = False


class Trace(ValueReader):
    """A trace file; iterating yields its calls in the order in which they returned. It can be iterated once.

    Attributes
    ----------
    version : int                of the format
    properties : dict            of the recorded process
    last : Call or None          the last call that was read

    Raises
    ------
    SoftShadowError              the file cannot be read, or needs a library that is not installed
    TraceError                   it is no trace, or damaged; later, while iterating, too
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        super().__init__(path)
        self._open: dict[int, Call] = {}
        self._n_calls = 0
        self.last: Call | None = None
        try:
            self.version, self.properties = self._whole(self._header)
        except BaseException:
            self._parts.close()
            raise

    def __iter__(self) -> Iterator[Call]:
        try:
            while self._at < len(self._bytes) or self._load():
                call = self._whole(self._event)
                if call is not None:
                    self.last = call
                    yield call
            for call in self._open.values():  # the program ended within them
                self.last = call
                yield call
        finally:
            self._parts.close()

    def _where(self) -> str:
        return f"after call {self.last.number}, {self.last.name}" if self.last else super()._where()

    # -- events --------------------------------------------------------------------------------------------------------
    def _header(self) -> tuple[int, dict[str, str]]:
        version = self._uint()
        if version > NEWEST_VERSION:
            raise self._error(
                f"expected a trace of version {NEWEST_VERSION} or older, not {version} (or this is no trace)"
            )
        properties: dict[str, str] = {}
        if version >= 6:
            self._uint()  # the version of the meaning of calls
            while name := self._string():
                properties[name] = self._string()
                self._count_name()
        return version, properties

    def _event(self) -> Call | None:
        """Read an event; return the call that it ends, or None."""
        kind = self._byte()
        if kind == ENTER:
            thread = self._uint() if self.version >= 4 else 0
            name, n_arguments = self._function()
            call = Call(self._n_calls, name, [None] * n_arguments, None, thread)
            self._details(call)
            if len(self._open) >= MOST_OPEN_CALLS:
                raise self._error(f"{MOST_OPEN_CALLS} calls have not returned")
            self._open[call.number] = call
            self._n_calls += 1
            return None
        if kind != LEAVE:
            raise self._error(f"expected the beginning or end of a call, found {kind}")
        number = self._uint()
        begun = self._open.get(number)
        call = begun or Call(number, "", [])
        self._details(call)
        if begun is None:  # a repacked part of a longer trace
            return None
        del self._open[number]
        call.has_returned = True
        return call

    def _details(self, call: Call) -> None:
        while (kind := self._byte()) != END:
            if kind == ARGUMENT:
                index = self._uint()
                value = self._value()
                if index >= MOST_ARGUMENTS:
                    raise self._error(f"{call.name or 'a call'} has an argument {index}")
                while index >= len(call.arguments):
                    call.arguments.append(None)
                call.arguments[index] = value
            elif kind == RESULT:
                call.result = self._value()
            elif kind == THREAD:
                call.thread = self._uint()
            elif kind == BACKTRACE:
                for _ in range(self._count("a backtrace", MOST_ELEMENTS)):
                    self._frame()
            elif kind == FLAGS:
                call.is_fake = bool(self._uint() & FAKE)
            else:
                raise self._error(f"expected an argument or the result of {call.name or 'a call'}, found {kind}")

    # -- names ---------------------------------------------------------------------------------------------------------
    def _function(self) -> tuple[str, int]:
        known, key = self._names.functions, self._uint()
        if key not in known:
            name, n_arguments = self._string(), self._count("a function", MOST_ARGUMENTS)
            for _ in range(n_arguments):
                self._string()
            self._define(known, key, (name, n_arguments))
        return known[key]

    def _frame(self) -> None:
        known, key = self._names.frames, self._uint()
        if key in known:
            return
        while (kind := self._byte()) != FRAME_END:
            if kind in (FRAME_MODULE, FRAME_FUNCTION, FRAME_FILE):
                self._string()
            elif kind in (FRAME_LINE, FRAME_OFFSET):
                self._uint()
            else:
                raise self._error(f"expected a detail of a backtrace, found {kind}")
        self._define(known, key, None)
