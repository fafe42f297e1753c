"""The values of one quantity in a sweep: lists, ranges (linear or logarithmic), random numbers, paths of points."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, model_validator

from softshadow.sweeps import paths

Scalar = bool | int | float | str


class Strict(BaseModel):
    """A table in which every key must be known."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, populate_by_name=True)


class Range(Strict):
    """`count` numbers from one to another, equally far apart, or with a constant ratio (``scale = "log"``)."""

    start: float = Field(alias="from")
    to: float
    count: Annotated[int, Field(ge=1, le=100_000)]
    scale: Literal["linear", "log"] = "linear"

    @model_validator(mode="after")
    def _logarithms_exist(self) -> Range:
        if self.scale == "log" and not (self.start > 0 and self.to > 0):
            raise ValueError("a logarithmic range: expected from and to above 0")
        return self

    def values(self) -> list[float]:
        """Return the numbers; whole ones as int."""
        if self.scale == "log":
            numbers = np.geomspace(self.start, self.to, self.count)
        else:
            numbers = np.linspace(self.start, self.to, self.count)
        whole = float(self.start).is_integer() and float(self.to).is_integer() and self.scale == "log"
        return [tidy(round(n) if whole else n) for n in numbers.tolist()]


class Random(Strict):
    """A number drawn anew for every sample, uniformly, or with a uniform logarithm (``scale = "log"``)."""

    random: tuple[float, float]
    scale: Literal["linear", "log"] = "linear"
    whole: bool = False

    @model_validator(mode="after")
    def _is_a_range(self) -> Random:
        low, high = self.random
        if not low <= high or (self.scale == "log" and low <= 0):
            raise ValueError("random: expected [low, high] with low <= high, above 0 if logarithmic")
        return self

    def draw(self, generator: np.random.Generator) -> float:
        """Return one number."""
        low, high = self.random
        number = math.exp(generator.uniform(math.log(low), math.log(high))) if self.scale == "log" else None
        number = float(generator.uniform(low, high)) if number is None else number
        return tidy(round(number)) if self.whole else float(f"{number:.6g}")


def axis_form(value: Any) -> str | None:
    """Return which form of an axis a value has, by its keys; None if it has none."""
    if isinstance(value, dict):
        return "random" if "random" in value else "range" if {"from", "to"} & value.keys() else None
    if isinstance(value, Range | Random):
        return type(value).__name__.lower()
    return "list" if isinstance(value, list) else "value" if isinstance(value, Scalar) else None


Axis = Annotated[
    Annotated[Scalar, Tag("value")]
    | Annotated[list[Scalar], Tag("list")]
    | Annotated[Range, Tag("range")]
    | Annotated[Random, Tag("random")],
    Discriminator(
        axis_form,
        custom_error_type="axis",
        custom_error_message="expected a value, a list, {from, to, count} or {random = [low, high]}",
    ),
]
NOWHERE = np.zeros(3)  # paths of sweeps do not depend on where the scene has its light or camera
Place = tuple[float, float, float] | tuple[float, float, float, float]


class Circle(Strict):
    """Points on a horizontal circle, from one angle to another; a whole turn does not repeat its first point."""

    center: tuple[float, float, float]
    radius: Annotated[float, Field(gt=0)]
    count: Annotated[int, Field(ge=1, le=100_000)]
    start_degrees: float = 0.0
    turn_degrees: float = paths.FULL_TURN

    @property
    def route(self) -> paths.Circle:
        """The path, as films have it."""
        return paths.Circle(np.array(self.center), self.radius, self.start_degrees, self.turn_degrees)


class Line(Strict):
    """Points on a line, both ends included."""

    start: Place = Field(alias="from")
    to: Place
    count: Annotated[int, Field(ge=1, le=100_000)]

    @model_validator(mode="after")
    def _ends_are_alike(self) -> Line:
        if len(self.start) != len(self.to):
            raise ValueError("from and to: expected as many numbers in both")
        return self

    @property
    def route(self) -> paths.Polyline:
        """The path, as films have it."""
        return paths.Polyline(np.array([self.start, self.to]))


class CirclePath(Strict):
    """A circle in a table of its own."""

    circle: Circle


class LinePath(Strict):
    """A line in a table of its own."""

    line: Line


def places_form(value: Any) -> str | None:
    """Return which form of a path a value has, by its keys; None if it has none."""
    if isinstance(value, CirclePath | LinePath):
        return "circle" if isinstance(value, CirclePath) else "line"
    if isinstance(value, dict):
        return next((form for form in ("circle", "line") if form in value), None)
    points = value if isinstance(value, list) and value else [None]
    return "points" if all(isinstance(at, list | tuple) and len(at) in (3, 4) for at in points) else None


FORMS = ("value", "list", "range", "random", "points")  # in the places of errors, and no keys of a file
Places = Annotated[
    Annotated[list[tuple[float, ...]], Tag("points")]
    | Annotated[CirclePath, Tag("circle")]
    | Annotated[LinePath, Tag("line")],
    Discriminator(
        places_form,
        custom_error_type="places",
        custom_error_message="expected a list of points [x, y, z], {circle = ...} or {line = {from, to, count}}",
    ),
]


def places_of(path: Places | None) -> list[tuple[float, ...]]:
    """Return the points of a path; one empty tuple, for "as in the scene", if there is none."""
    if path is None:
        return [()]
    if isinstance(path, CirclePath | LinePath):
        drawn = path.circle if isinstance(path, CirclePath) else path.line
        return [tuple(place) for place in drawn.route.points(drawn.count, NOWHERE, NOWHERE).tolist()]
    return [tuple(place) for place in path]


def values_of(axis: Axis) -> list[Any]:
    """Return the values of an axis; a random one is a value itself, to be drawn for each sample."""
    if isinstance(axis, Range):
        return axis.values()
    return list(axis) if isinstance(axis, list) else [axis]


def tidy(number: float) -> float:
    """Return a whole number as int."""
    return int(number) if float(number).is_integer() else float(f"{number:.9g}")
