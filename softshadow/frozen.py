"""Copies of dataclasses with other values in some of their fields."""

from typing import Any, TypeVar

Value = TypeVar("Value")


def evolve(before: Value, **values: Any) -> Value:
    """Return what `dataclasses.replace` returns, in a tenth of the time: most GL calls do little else.

    For classes that compute nothing from their fields when they are made.

    Raises
    ------
    TypeError
        The class has no field of a name.
    """
    made = object.__new__(type(before))
    fields = made.__dict__
    fields.update(before.__dict__)
    known = len(fields)
    fields.update(values)
    if len(fields) != known:
        unknown = ", ".join(values.keys() - before.__dict__.keys())
        raise TypeError(f"{type(before).__name__} has no field {unknown}")
    return made
