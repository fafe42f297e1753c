"""Fast copies of dataclasses with some fields changed."""

from dataclasses import fields
from operator import is_
from typing import Any, TypeVar

Value = TypeVar("Value")
NAMES: dict[type, tuple[str, ...]] = {}  # of the fields, by class


def evolve(before: Value, **values: Any) -> Value:
    """Return what `dataclasses.replace` returns, in a tenth of the time; most GL calls do little else.

    For dataclasses without ``__post_init__``.

    Raises
    ------
    TypeError
        The class has no field of that name.
    """
    copy = object.__new__(type(before))
    contents = copy.__dict__
    contents.update(before.__dict__)
    known = len(contents)
    contents.update(values)
    if len(contents) != known:
        unknown = ", ".join(values.keys() - before.__dict__.keys())
        raise TypeError(f"{type(before).__name__} has no field {unknown}")
    return copy


def evolve_to(goal: Value, before: Value, **values: Any) -> Value:
    """Return what `evolve` returns, or `before` or `goal` itself if all its fields are the same objects.

    Then what was derived from it is found again.
    """
    copy = evolve(before, **values)
    for known in (goal, before):
        if all(map(is_, copy.__dict__.values(), known.__dict__.values())):
            return known
    return copy


def create(kind: type[Value], **values: Any) -> Value:
    """Return an instance with all its fields, in a third of the time of the constructor.

    For frozen dataclasses without ``__post_init__``.

    Raises
    ------
    TypeError
        A field is missing, or the class has no field of that name.
    """
    instance = object.__new__(kind)
    instance.__dict__.update(values)
    names = NAMES.get(kind) or NAMES.setdefault(kind, tuple([field.name for field in fields(kind)]))  # type: ignore[arg-type]
    if (*values,) != names and values.keys() != {*names}:
        wrong = ", ".join(sorted(values.keys() ^ {*names}))
        raise TypeError(f"{kind.__name__}: missing or unknown fields {wrong}")
    return instance
