"""Which calls in a list set an attribute or add a vertex, and how their arguments become values."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from softshadow.context.arrays import COLOR, NORMAL, POSITION, TEXCOORD
from softshadow.gl import immediate, texture_coordinates, vertex_attributes
from softshadow.gl.conversions import (
    from_byte,
    from_int,
    from_short,
    from_unsigned_byte,
    from_unsigned_int,
    from_unsigned_short,
    vector,
)
from softshadow.state import TEXTURE_UNITS

# calls that lists do not record themselves: they make the call for single numbers, or for one more
MAKE_OTHERS = (
    "glVertex2fv", "glVertex3fv", "glVertex4fv", "glNormal3fv", "glColor3fv", "glColor4fv", "glTexCoord2fv",
    "glColor3ub",
)  # fmt: skip
FLOATS = {float}
EXACT = 2**53  # integers up to here are exact in float64
Values = tuple[float, ...]


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
        if len(arguments) != self.count:
            return None
        if self.convert is float and set(map(type, arguments)) == FLOATS:
            return (*arguments, *self.rest)
        if not all(map(_is_plain, arguments)):
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
    """Return all calls that set an attribute or add a vertex, as lists record them."""
    calls: dict[Callable[..., Any], AttributeCall] = {}
    convert: Callable[[Any], float]

    def add(module: Any, name: str, *parameters: Any, **named: Any) -> None:
        if name not in MAKE_OTHERS:
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


def value_of(call: partial[Any]) -> tuple[int, Values] | None:
    """Return the slot and the value of the attribute that one of `CALLS` sets; None if only the call can judge them."""
    kind, arguments = CALLS[call.func], call.args
    slot = kind.slot
    if call.keywords:
        return None
    try:
        if slot is None:
            slot, arguments = TEXCOORD + int(arguments[0]) % TEXTURE_UNITS, arguments[1:]
        values = kind.values(arguments)
    except Exception:  # the call itself raises the same when the list is called
        return None
    return None if values is None else (slot, values)


CALLS = _attribute_calls()
BEGIN, END = _undecorated(immediate.glBegin), _undecorated(immediate.glEnd)
