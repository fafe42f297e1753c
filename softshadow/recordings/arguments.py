"""The arguments of recorded calls, as `softshadow.gl` takes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow import tokens as gl

NAME_TYPES = {
    gl.GL_BYTE: "i1", gl.GL_UNSIGNED_BYTE: "u1", gl.GL_SHORT: "<i2", gl.GL_UNSIGNED_SHORT: "<u2", gl.GL_INT: "<i4",
    gl.GL_UNSIGNED_INT: "<u4", gl.GL_FLOAT: "<f4",
}  # fmt: skip


def arguments_of(name: str, recorded: list[Any]) -> list[Any]:
    """Return the arguments of a call; most are as they were recorded."""
    convert = CONVERSIONS.get(name)
    return recorded if convert is None else convert(recorded)


def _called_lists(recorded: list[Any]) -> list[Any]:
    """Return (n, type, lists) with the names of the lists as an array: a trace has their bytes."""
    n, type, lists = recorded
    if isinstance(lists, bytes) and type in NAME_TYPES:
        dtype = np.dtype(NAME_TYPES[type])
        lists = np.frombuffer(lists[: len(lists) // dtype.itemsize * dtype.itemsize], dtype)
    return [n, type, lists]


def _indices(place: int) -> Callable[[list[Any]], list[Any]]:
    """Return a function that replaces the bytes of indices by an array."""
    dtypes = {gl.GL_UNSIGNED_BYTE: "u1", gl.GL_UNSIGNED_SHORT: "<u2", gl.GL_UNSIGNED_INT: "<u4"}

    def convert(recorded: list[Any]) -> list[Any]:
        indices, type = recorded[place], recorded[place - 1]
        if not isinstance(indices, bytes) or type not in dtypes:
            return recorded
        dtype = np.dtype(dtypes[type])
        array = np.frombuffer(indices[: len(indices) // dtype.itemsize * dtype.itemsize], dtype)
        return [*recorded[:place], array, *recorded[place + 1 :]]

    return convert


CONVERSIONS: dict[str, Callable[[list[Any]], list[Any]]] = {
    "glCallLists": _called_lists,
    "glDrawElements": _indices(3),
    "glDrawRangeElements": _indices(5),
    "glSelectBuffer": lambda recorded: recorded[:1],  # the memory that the call gets is GL's to fill
    "glFeedbackBuffer": lambda recorded: recorded[:2],
}
