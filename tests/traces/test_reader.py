"""Reading traces: every kind of value, version and packing, and files that are damaged."""

import gzip
import sys
from pathlib import Path
from typing import Any

import cramjam
import pytest

from softshadow.errors import SoftShadowError, TraceError
from softshadow.traces import Call, Trace
from traces.trace_writer import Bitmask, Enum, Pointer, Struct, TraceWriter, string, uint

MANY = [None, True, False, 3, -3, 1 << 40, 0.5, "text", b"\0\1\2", Enum(1), Bitmask(5), [1, [2.0, None]], Pointer(99)]
STRUCT = Struct((("x", 1), ("y", "two")))
READ = [None, True, False, 3, -3, 1 << 40, 0.5, "text", b"\0\1\2", 1, 5, [1, [2.0, None]], 99, {"x": 1, "y": "two"}]


def written(tmp_path: Path, content: bytes) -> Path:
    path = tmp_path / "a.trace"
    path.write_bytes(content)
    return path


def calls_of(tmp_path: Path, content: bytes) -> list[Call]:
    return list(Trace(written(tmp_path, content)))


@pytest.mark.parametrize("version", range(7))
@pytest.mark.parametrize("chunk", [1, 7, 1 << 20])
def test_every_kind_of_value_is_read(tmp_path: Path, version: int, chunk: int) -> None:
    writer = TraceWriter(version)
    for _ in range(2):  # names are written once
        writer.call("glThing", *MANY, STRUCT, result=Enum(1), thread=2, fake=version >= 6)
    first, second = calls_of(tmp_path, writer.snappy(chunk))
    assert first.arguments == second.arguments == READ
    assert (first.name, first.result, first.number, second.number) == ("glThing", 1, 0, 1)
    assert first.thread == (2 if version >= 4 else 0)
    assert first.is_fake == (version >= 6)
    assert first.has_returned


def test_calls_come_in_the_order_in_which_they_return(tmp_path: Path) -> None:
    writer = TraceWriter()
    outer = writer.enter("outer", None)
    writer.call("inner")
    writer.leave(outer, outputs={0: [7]})
    writer.enter("last")
    calls = calls_of(tmp_path, writer.snappy())
    assert [(call.number, call.name, call.has_returned) for call in calls] == [
        (1, "inner", True), (0, "outer", True), (2, "last", False),
    ]  # fmt: skip
    assert calls[1].arguments == [[7]]


def test_backtraces_are_skipped(tmp_path: Path) -> None:
    frame = uint(3) + b"\1" + string("a.so") + b"\2" + string("main") + b"\3" + string("a.c") + b"\4" + uint(9) + b"\0"
    writer = TraceWriter()
    writer.enter("one", 1, backtrace=b"\4" + uint(1) + frame)
    writer.enter("two", 2, backtrace=b"\4" + uint(2) + uint(3) + uint(3))
    assert [call.arguments for call in calls_of(tmp_path, writer.snappy())] == [[1], [2]]


def test_memory_larger_than_many_chunks_is_read_at_once(tmp_path: Path) -> None:
    memory = bytes(range(256)) * 4096
    writer = TraceWriter()
    writer.call("glTexImage2D", memory)
    (call,) = calls_of(tmp_path, writer.snappy(1000))
    assert call.arguments == [memory]


def packed_by(kind: str, content: bytes) -> bytes:
    if kind == "gzip":
        return gzip.compress(content)
    if kind == "brotli":
        return bytes(cramjam.brotli.compress(content))
    table = b"\x5e\x2a\x4d\x18" + (9).to_bytes(4, "little") + bytes(9)  # apitrace's table of offsets
    half = len(content) // 2
    return bytes(cramjam.zstd.compress(content[:half])) + bytes(cramjam.zstd.compress(content[half:])) + table


@pytest.mark.parametrize("kind", ["gzip", "zstd", "brotli"])
def test_other_packings_are_read(tmp_path: Path, kind: str) -> None:
    writer = TraceWriter(5)
    for number in range(1000):
        writer.call("glVertex2f", number / 8, "text" * (number % 7))
    calls = calls_of(tmp_path, packed_by(kind, bytes(writer.content)))
    assert [call.arguments[0] for call in calls] == [number / 8 for number in range(1000)]


@pytest.mark.parametrize("kind", ["snappy", "zstd", "brotli"])
def test_a_missing_library_is_named_with_its_extra(tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    writer = TraceWriter()
    packed = writer.snappy() if kind == "snappy" else packed_by(kind, bytes(writer.content))
    monkeypatch.setitem(sys.modules, "cramjam", None)
    with pytest.raises(SoftShadowError, match=rf"packed by {kind}, .*softshadow\[trace\]"):
        calls_of(tmp_path, packed)


def test_gzip_needs_no_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "cramjam", None)
    writer = TraceWriter()
    writer.call("glEnd")
    assert len(calls_of(tmp_path, packed_by("gzip", bytes(writer.content)))) == 1


# -- damage ------------------------------------------------------------------------------------------------------------
def test_an_error_names_the_last_call_and_the_place(tmp_path: Path) -> None:
    writer = TraceWriter()
    writer.call("glBegin", 4)
    writer.call("glEnd")
    writer.content += b"\x2a"
    trace = Trace(written(tmp_path, writer.snappy()))
    with pytest.raises(TraceError, match=r"found 42, after call 1, glEnd, at byte \d+ of the part .* byte 2 of the"):
        list(trace)
    assert trace.last is not None
    assert trace.last.number == 1


@pytest.mark.parametrize("kind", ["snappy", "gzip", "zstd", "brotli"])
def test_a_truncated_file_is_an_error_after_its_last_calls(tmp_path: Path, kind: str) -> None:
    writer = TraceWriter()
    for number in range(3000):
        writer.call("glVertex3f", number * 0.37, number * 0.11, -number * 0.77)
    packed = writer.snappy(4096) if kind == "snappy" else packed_by(kind, bytes(writer.content))
    with pytest.raises(TraceError, match=r"ends at byte|damaged|ends within"):
        calls_of(tmp_path, packed[: len(packed) * 2 // 3])


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"", "the file is empty"),
        (b"at", "ends within a call, before the first call"),
        (b"at\1\0\0", "within the length of a chunk"),
        (b"at\x08\0\0\0abc", "within a chunk of 8 bytes"),
        (b"at\x05\0\0\0\xff\xff\xff\xff\x0f", "damaged .*5 bytes cannot unpack to 4294967295"),
        (b"hello, this is no trace", "not a trace that apitrace has recorded"),
        (b"\x1f\x8bxxxxxxxxxxxxxxxxxxx", "damaged after byte 0"),
        (b"\x28\xb5\x2f\xfd\x00\x00", "within a block header"),
    ],
)  # fmt: skip
def test_what_is_no_trace_is_named(tmp_path: Path, content: bytes, expected: str) -> None:
    with pytest.raises(TraceError, match=expected):
        calls_of(tmp_path, content)


def test_a_folder_and_a_missing_file_are_errors(tmp_path: Path) -> None:
    for path, expected in ((tmp_path, "a folder or a device"), (tmp_path / "no.trace", "no such file")):
        with pytest.raises(SoftShadowError, match=expected):
            Trace(path)


def of_value(value: bytes) -> bytes:
    """Return a trace whose only call has one argument of these bytes."""
    writer = TraceWriter()
    writer.content += b"\0\0\0" + string("f") + uint(1) + string("x") + b"\1\0" + value + b"\0\1\0\0"
    return writer.snappy()


HUGE = b"\xff" * 9 + b"\1"


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (b"\x0b\1" * 100 + b"\0", "nested deeper than 32 levels"),
        (b"\x0b" + HUGE, "an array has .* expected at most"),
        (b"\x08" + HUGE, "block of memory has .* expected at most"),
        (b"\x04" + b"\xff" * 30, "more than 64 bits"),
        (b"\x63", "expected a value, found type 99"),
        (b"\x09\0\1" + string("GL_A") + b"\x07", "expected a whole number"),
    ],
)
def test_a_value_that_no_program_has_is_an_error(tmp_path: Path, value: bytes, expected: str) -> None:
    with pytest.raises(TraceError, match=expected):
        calls_of(tmp_path, of_value(value))


def test_calls_that_never_return_do_not_fill_the_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.traces.reader.MOST_OPEN_CALLS", 100)
    writer = TraceWriter()
    for _ in range(200):
        writer.enter("glBegin")
    with pytest.raises(TraceError, match="100 calls have not returned"):
        calls_of(tmp_path, writer.snappy())


def test_a_newer_version_is_refused(tmp_path: Path) -> None:
    content: Any = bytes(cramjam.snappy.compress_raw(uint(7)))
    with pytest.raises(TraceError, match="version 6 or older, not 7"):
        calls_of(tmp_path, b"at" + len(content).to_bytes(4, "little") + content)
