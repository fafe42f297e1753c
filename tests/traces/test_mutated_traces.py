"""Traces with random changes: each is read, or gives the error of a damaged file, and nothing else."""

import random
import struct
from contextlib import suppress
from pathlib import Path

import cramjam
import pytest

import softshadow as ss
from conftest import ALL_LANES
from paths import TRACE
from softshadow.errors import SoftShadowError
from softshadow.traces import Trace
from softshadow.traces.container import unpacked_parts
from traces.trace_writer import Enum, TraceWriter

SEEDS = range(4000 if ALL_LANES else 150)
DRAWN = range(400 if ALL_LANES else 12)


def small_trace() -> bytes:
    writer = TraceWriter()
    writer.call("glXMakeCurrent", 1, 2, 3, result=True)
    writer.call("glViewport", 0, 0, 16, 12)
    for _ in range(2):
        writer.call("glClear", 16384)
        writer.call("glBegin", Enum(4))
        for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)):
            writer.call("glVertex2f", x, y)
        writer.call("glEnd")
        writer.call("glXSwapBuffers", 1, 2)
    return bytes(writer.content)


def mutated(content: bytes, seed: int) -> bytes:
    """Return bytes with some of them replaced, removed, doubled or swapped."""
    dice, changed = random.Random(seed), bytearray(content)
    for _ in range(dice.randint(1, 6)):
        at, n_bytes = dice.randrange(len(changed)), dice.randint(1, 12)
        match dice.randrange(5):
            case 0:
                changed[at] = dice.randrange(256)
            case 1:
                changed[at] ^= 1 << dice.randrange(8)
            case 2:
                del changed[at : at + n_bytes]
            case 3:
                changed[at:at] = changed[at : at + n_bytes]
            case 4:
                changed[at : at + n_bytes] = bytes([dice.choice((0, 127, 128, 255))] * n_bytes)
        changed = changed or bytearray(b"\0")
    return bytes(changed)


def packed(content: bytes) -> bytes:
    part = bytes(cramjam.snappy.compress_raw(content))
    return b"at" + struct.pack("<I", len(part)) + part


@pytest.mark.parametrize("kind", ["file", "content"])
def test_a_damaged_trace_is_read_or_refused(tmp_path: Path, kind: str) -> None:
    whole = b"".join(part for _, part in unpacked_parts(TRACE))
    for seed in SEEDS:
        content = TRACE.read_bytes() if kind == "file" and seed % 2 else packed(small_trace())
        if kind == "content":
            content = packed(mutated(whole if seed % 8 == 0 else small_trace(), seed))
        else:
            content = mutated(content, seed)
        path = tmp_path / "damaged.trace"
        path.write_bytes(content)
        with suppress(SoftShadowError):
            for _ in Trace(path):
                pass


@pytest.mark.filterwarnings("ignore::softshadow.Warning")
def test_a_damaged_trace_is_replayed_or_refused(tmp_path: Path) -> None:
    for seed in DRAWN:
        path = tmp_path / "damaged.trace"
        path.write_bytes(packed(mutated(small_trace(), seed)))
        with suppress(SoftShadowError):
            run = ss.replay(path, -1)
            assert run.image.shape == (run.size[1], run.size[0], 3)
