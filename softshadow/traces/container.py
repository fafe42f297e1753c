"""The compressed parts of a trace file, unpacked one after the other.

apitrace writes chunks packed by Snappy; its old versions wrote gzip, and ``apitrace repack`` writes zstd and Brotli.
All but gzip need the library cramjam.
"""

from __future__ import annotations

import importlib
import os
import zlib
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any, BinaryIO

from softshadow.errors import SoftShadowError, TraceError

SNAPPY, GZIP, ZSTD = b"at", b"\x1f\x8b", b"\x28\xb5\x2f\xfd"
SKIPPABLE = range(0x184D2A50, 0x184D2A60)  # zstd's frames of other data, such as apitrace's table of offsets
LARGEST_PART = 1 << 30  # bytes of an unpacked part; apitrace's have a megabyte or two
SNAPPY_RATIO = 22  # three bytes of Snappy stand for 64 at most
READ_BYTES = 1 << 20
BLOCK_BYTES = 128 << 10  # the largest block of a zstd frame, unpacked
FIRST_BROTLI = 1 << 26


def unpacked_parts(path: str | os.PathLike[str]) -> Generator[tuple[int, bytes], None, None]:
    """Yield (place in the file, unpacked bytes) of each part.

    Raises
    ------
    SoftShadowError              the file cannot be read, or needs a library that is not installed
    TraceError                   it is none of the four kinds, damaged, or it ends within a part
    """
    target = Path(path)
    if target.exists() and not target.is_file():
        raise SoftShadowError(f"{path}: expected a trace file, it is a folder or a device")
    try:
        with open(target, "rb") as file:
            yield from _parts(file, str(path))
    except FileNotFoundError:
        raise SoftShadowError(f"{path}: there is no such file") from None
    except OSError as error:
        raise SoftShadowError(f"{path}: cannot be read ({error.strerror})") from None


def _parts(file: BinaryIO, name: str) -> Iterator[tuple[int, bytes]]:
    start = file.read(4)
    file.seek(0)
    if start[:2] == SNAPPY:
        return _snappy(file, name)
    if start[:2] == GZIP:
        return _gzip(file, name)
    if start == ZSTD:
        return _zstd(file, name)
    if start:
        return _brotli(file, name)
    raise TraceError(f"{name}: the file is empty; expected a trace that apitrace has recorded")


def _library(name: str, kind: str) -> Any:
    """Return cramjam, which is loaded for the traces that need it."""
    try:
        return importlib.import_module("cramjam")
    except ImportError:
        raise SoftShadowError(
            f"{name}: this trace is packed by {kind}, and reading it needs cramjam: pip install 'softshadow[trace]'"
        ) from None


def _exactly(file: BinaryIO, n_bytes: int, name: str, what: str) -> bytes:
    """Return the next bytes of a file."""
    place = file.tell()
    packed = file.read(n_bytes)
    if len(packed) < n_bytes:
        raise TraceError(f"{name}: the file ends at byte {place + len(packed)}, within {what} of {n_bytes} bytes")
    return packed


def _snappy(file: BinaryIO, name: str) -> Iterator[tuple[int, bytes]]:
    cramjam = _library(name, "snappy")
    file.seek(len(SNAPPY))
    while length := file.read(4):
        place = file.tell() - len(length)
        if len(length) < 4:
            raise TraceError(f"{name}: the file ends at byte {place + len(length)}, within the length of a chunk")
        packed_bytes = int.from_bytes(length, "little")
        if packed_bytes == 0:  # the end, for apitrace
            return
        packed = _exactly(file, packed_bytes, name, "a chunk")
        try:
            unpacked_bytes = cramjam.snappy.decompress_raw_len(packed)
            if unpacked_bytes > SNAPPY_RATIO * packed_bytes + 64:
                raise ValueError(f"{packed_bytes} bytes cannot unpack to {unpacked_bytes}")
            yield place, bytes(cramjam.snappy.decompress_raw(packed))
        except (ValueError, cramjam.DecompressionError) as error:
            raise TraceError(f"{name}: the chunk at byte {place} is damaged ({error})") from None


def _gzip(file: BinaryIO, name: str) -> Iterator[tuple[int, bytes]]:
    unpacker = zlib.decompressobj(wbits=16 + zlib.MAX_WBITS)
    place, packed = 0, b""
    while True:
        packed = packed or file.read(READ_BYTES)
        if not packed:
            if not unpacker.eof:
                raise TraceError(f"{name}: the file ends at byte {file.tell()}, within its packed content")
            return
        try:
            unpacked = unpacker.decompress(packed, READ_BYTES)
        except zlib.error as error:
            raise TraceError(f"{name}: damaged after byte {place} ({error})") from None
        if unpacked:
            yield place, unpacked
        place = file.tell()
        packed = unpacker.unconsumed_tail
        if unpacker.eof:
            if not unpacker.unused_data.strip(b"\0"):
                return
            packed, unpacker = unpacker.unused_data, zlib.decompressobj(wbits=16 + zlib.MAX_WBITS)


def _zstd(file: BinaryIO, name: str) -> Iterator[tuple[int, bytes]]:
    """Yield the content of each frame; apitrace begins a new one every two megabytes."""
    cramjam = _library(name, "zstd")
    while True:
        place = file.tell()
        magic = file.read(4)
        if not magic:
            return
        if int.from_bytes(magic, "little") in SKIPPABLE:
            file.seek(int.from_bytes(_exactly(file, 4, name, "a frame header"), "little"), os.SEEK_CUR)
            continue
        if magic != ZSTD:
            raise TraceError(f"{name}: damaged at byte {place}: expected the beginning of a zstd frame")
        n_blocks = _skip_zstd_frame(file, name)
        if n_blocks * BLOCK_BYTES > LARGEST_PART:
            raise TraceError(f"{name}: the frame at byte {place} would unpack to more than {LARGEST_PART >> 20} MB")
        end = file.tell()
        file.seek(place)
        try:
            unpacked = bytes(cramjam.zstd.decompress(file.read(end - place)))
        except (ValueError, cramjam.DecompressionError) as error:
            raise TraceError(f"{name}: the frame at byte {place} is damaged ({error})") from None
        yield place, unpacked


def _skip_zstd_frame(file: BinaryIO, name: str) -> int:
    """Move behind a frame whose magic number has been read, and return the number of its blocks (RFC 8878, 3.1.1)."""
    header = _exactly(file, 1, name, "a frame header")[0]
    single_segment = bool(header & 0x20)
    window, dictionary = 0 if single_segment else 1, (0, 1, 2, 4)[header & 3]
    content_size = (1 if single_segment else 0, 2, 4, 8)[header >> 6]
    _exactly(file, window + dictionary + content_size, name, "a frame header")
    n_blocks, is_last = 0, False
    while not is_last:
        block = int.from_bytes(_exactly(file, 3, name, "a block header"), "little")
        is_last, kind, n_bytes = bool(block & 1), block >> 1 & 3, block >> 3
        _exactly(file, 1 if kind == 1 else n_bytes, name, "a block")
        n_blocks += 1
    if header & 4:
        _exactly(file, 4, name, "a checksum")
    return n_blocks


def _brotli(file: BinaryIO, name: str) -> Iterator[tuple[int, bytes]]:
    """Yield the content of the file, which has no marks at which it could be divided, nor at its beginning."""
    cramjam = _library(name, "brotli")
    packed = file.read(LARGEST_PART)
    room = FIRST_BROTLI
    while room <= LARGEST_PART:
        memory = bytearray(room)
        try:
            n_bytes = cramjam.brotli.decompress_into(packed, memory)
        except (ValueError, cramjam.DecompressionError) as error:
            if "whole buffer" in str(error):  # it is larger
                room *= 4
                continue
            raise TraceError(f"{name}: not a trace that apitrace has recorded, or damaged ({error})") from None
        yield 0, bytes(memoryview(memory)[:n_bytes])
        return
    raise TraceError(f"{name}: its content is larger than {LARGEST_PART >> 20} MB; apitrace repack can pack it anew")
