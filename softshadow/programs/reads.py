"""The texture reads of a shading program, noted while someone asks for them: pixel histories show them.

`sample` notes every read. A program that compares depths says before it reads which depths these are (`note_depths`).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from softshadow.texture import Texture


class ComparedDepths(NamedTuple):
    """What a program compares with its next reads of a texture.

    depths (n,), from which `bias` has been subtracted; weights (n,) of the results, or None for equal ones; rows (n,):
    which fragments they belong to, or None for all; purpose: what the reads are for, where a program has several;
    measure: "depth", or "distance" if the program compares distances with colours one by one; farthest: greater ones
    count as this one.
    """

    depths: np.ndarray
    bias: float
    weights: np.ndarray | None = None
    rows: np.ndarray | None = None
    purpose: str = ""
    measure: str = "depth"
    farthest: float = 1.0


class Read(NamedTuple):
    """One call of `sample`: texture, coordinates (n, 3 or 4), results (n, k), and what they are compared with."""

    texture: Texture
    coordinates: np.ndarray
    values: np.ndarray
    compared: ComparedDepths | None


@dataclass
class Notes:
    """The reads so far, in order, and the compared depths of each texture, by its identity."""

    reads: list[Read] = field(default_factory=list)
    compared: dict[int, ComparedDepths] = field(default_factory=dict)


_notes: ContextVar[Notes | None] = ContextVar("notes", default=None)


@contextmanager
def noted_reads() -> Iterator[list[Read]]:
    """Note the reads of everything that is shaded inside, in this thread."""
    notes = Notes()
    token = _notes.set(notes)
    try:
        yield notes.reads
    finally:
        _notes.reset(token)


def is_noting() -> bool:
    """Return whether reads are noted: then programs take no short cut around `sample`."""
    return _notes.get() is not None


def note_depths(texture: Texture, depths: np.ndarray, bias: Any, **more: Any) -> None:
    """Say which depths a program compares with its next reads of a texture; `more` are fields of `ComparedDepths`."""
    notes = _notes.get()
    if notes is not None:
        notes.compared[id(texture)] = ComparedDepths(depths.copy(), float(bias), **more)


def note_weights(texture: Texture, column: np.ndarray, row: np.ndarray) -> None:
    """Say how much a program's next reads of a texture weigh: each the product of a column's weight and a row's."""
    notes = _notes.get()
    if notes is not None:
        notes.compared[id(texture)] = notes.compared[id(texture)]._replace(weights=column * row)


def note_read(texture: Texture, coordinates: np.ndarray, values: np.ndarray) -> None:
    """Note a read, if reads are noted."""
    notes = _notes.get()
    if notes is not None:
        notes.reads.append(Read(texture, coordinates.copy(), values.copy(), notes.compared.get(id(texture))))
