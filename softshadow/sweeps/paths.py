"""Paths of lights and cameras: the points where something stands in each frame of a film, or point of a sweep.

For a film, a path is written as a text, ``orbit``, ``circle:0,4,0,3``, ``line:-2,4,1:2,4,1`` or
``points:2,4,1:0,5,2:-2,4,1``, or as a TOML file with the same words. A path that ends where it began has no point
twice, so that a film of it can be repeated without a stop.
"""

from __future__ import annotations

import math
import os
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.errors import SceneError, nearest
from softshadow.scene.validate import validate_number, validate_numbers

FULL_TURN = 360.0  # degrees
DIGITS = 10  # of the largest coordinate of a path: sines and cosines leave no digits of noise in recipes and captions
FORMS = (
    "orbit, orbit:DEGREES, circle:X,Y,Z,RADIUS, line:X,Y,Z:X,Y,Z, points:X,Y,Z:X,Y,Z:... (with :closed at the end, "
    "back to the first) or FILE.toml"
)
KEYS = {
    "orbit": ("degrees",),
    "circle": ("center", "radius", "start_degrees", "turn_degrees"),
    "line": ("from", "to"),
    "points": ("points", "closed"),
}
OPTIONAL = ("degrees", "start_degrees", "turn_degrees", "closed")


def shares(n_frames: int, closed: bool) -> np.ndarray:
    """Return how far along a path each frame is, (n_frames,) float64 from 0; a closed path does not reach 1."""
    return np.arange(n_frames) / max(1, n_frames if closed else n_frames - 1)


def rounded(points: np.ndarray) -> np.ndarray:
    """Return points with `DIGITS` digits, counted from the first one of the largest coordinate; no zero has a sign."""
    largest = float(np.abs(points).max())
    return points if largest == 0 else np.round(points, DIGITS - 1 - math.floor(math.log10(largest))) + 0.0


@dataclass(frozen=True)
class Orbit:
    """A turn around the vertical axis through a centre, from where the thing stands; its height does not change."""

    degrees: float = FULL_TURN

    @property
    def closed(self) -> bool:
        """Whether the last point leads to the first."""
        return self.degrees % FULL_TURN == 0

    def points(self, n_frames: int, start: np.ndarray, center: np.ndarray) -> np.ndarray:
        """Return the positions (n_frames, 3) float64.

        Parameters
        ----------
        start, center : (3,) float64     where the thing stands, and a point of the axis; world space
        """
        if np.array_equal(start[[0, 2]], center[[0, 2]]):
            raise SceneError(
                f"orbit: {start.tolist()} stands on the axis that it would turn around, the vertical one through "
                f"{center.tolist()}; expected another position, or another path"
            )
        angles = np.radians(self.degrees) * shares(n_frames, self.closed)
        x, y, z = start - center
        turned = [
            x * np.cos(angles) + z * np.sin(angles),
            np.full(n_frames, y),
            z * np.cos(angles) - x * np.sin(angles),
        ]
        return rounded(center + np.stack(turned, axis=1))


@dataclass(frozen=True, eq=False)
class Circle:
    """A horizontal circle, anticlockwise seen from above: angle 0 is at the largest x, 90 degrees at the smallest z."""

    center: np.ndarray
    radius: float
    start_degrees: float = 0.0
    turn_degrees: float = FULL_TURN

    def points(self, n_frames: int, start: np.ndarray, center: np.ndarray) -> np.ndarray:
        """Return the positions (n_frames, 3) float64; `start` and `center` do not matter."""
        angle = np.radians(self.start_degrees)
        first = self.center + self.radius * np.array([np.cos(angle), 0, -np.sin(angle)])
        return Orbit(self.turn_degrees).points(n_frames, first, self.center)


@dataclass(frozen=True, eq=False)
class Polyline:
    """Straight lines from point to point, passed at constant speed; `closed` leads back to the first point."""

    corners: np.ndarray
    closed: bool = False

    def points(self, n_frames: int, start: np.ndarray, center: np.ndarray) -> np.ndarray:
        """Return the positions, with as many numbers as the corners have; `start` and `center` do not matter."""
        corners = np.concatenate([self.corners, self.corners[:1]]) if self.closed else self.corners
        lengths = np.linalg.norm(np.diff(corners, axis=0), axis=1)
        passed = np.concatenate([[0], np.cumsum(lengths)])
        at = passed[-1] * shares(n_frames, self.closed)
        return rounded(np.stack([np.interp(at, passed, numbers) for numbers in corners.T], axis=1))


Route = Orbit | Circle | Polyline


def route_of(path: Any, name: str) -> Route:
    """Return the path that a text, a TOML file, a list of points or a path describes.

    Parameters
    ----------
    name : str                   what messages call it, such as "light path"

    Raises
    ------
    SceneError                   no known form, or other numbers than it needs
    """
    if isinstance(path, Orbit | Circle | Polyline):
        return path
    if not isinstance(path, str | os.PathLike):
        return _polyline(path, False, name)
    text = os.fspath(path)
    if text.lower().endswith(".toml"):
        return _from_table(_read(Path(text), name), f"{text}")
    kind, *values = text.split(":")
    if kind not in KEYS:
        raise SceneError(f"{name} {text!r}: {nearest(kind, KEYS)}; the forms are {FORMS}")
    where = f"{name} {text!r}"
    if kind == "orbit" and len(values) <= 1:
        return _from_table({"kind": kind, **({"degrees": _numbers(values[0], 1, where)[0]} if values else {})}, where)
    if kind == "circle" and len(values) == 1:
        *middle, radius = _numbers(values[0], 4, where)
        return _from_table({"kind": kind, "center": middle, "radius": radius}, where)
    if kind == "line" and len(values) == 2:
        return _polyline([_numbers(value, 3, where) for value in values], False, where)
    if kind == "points" and len(values) >= 2:
        closed = values[-1] == "closed"
        return _polyline([_numbers(value, 3, where) for value in (values[:-1] if closed else values)], closed, where)
    raise SceneError(f"{where}: expected {next(form for form in FORMS.split(', ') if form.startswith(kind + ':'))}")


def _from_table(table: dict[str, Any], where: str) -> Route:
    """Return the path that a table of a TOML file describes."""
    kind = table.get("kind")
    if kind not in KEYS:
        raise SceneError(f"{where}: kind: {nearest(str(kind), KEYS)}")
    for key in table:
        if key != "kind" and key not in KEYS[kind]:
            raise SceneError(f"{where}: {key}: a path of kind {kind!r} has no such key; {nearest(key, KEYS[kind])}")
    missing = [key for key in KEYS[kind] if key not in table and key not in OPTIONAL]
    if missing:
        raise SceneError(f"{where}: a path of kind {kind!r} needs {' and '.join(missing)}")
    match kind:
        case "orbit":
            return Orbit(_turn(f"{where}: degrees", table.get("degrees", FULL_TURN)))
        case "circle":
            radius = validate_number(f"{where}: radius", table["radius"])
            if radius <= 0:
                raise SceneError(f"{where}: radius: expected a number above 0, got {radius:g}")
            begin = validate_number(f"{where}: start_degrees", table.get("start_degrees", 0))
            turn = _turn(f"{where}: turn_degrees", table.get("turn_degrees", FULL_TURN))
            return Circle(validate_numbers(f"{where}: center", table["center"], 3), radius, begin, turn)
        case "line":
            return _polyline([table["from"], table["to"]], False, where)
    closed = table.get("closed", False)
    if not isinstance(closed, bool):
        raise SceneError(f"{where}: closed: expected true or false, got {closed!r}")
    return _polyline(table["points"], closed, where)


def _turn(where: str, degrees: Any) -> float:
    number = validate_number(where, degrees)
    if not number:
        raise SceneError(f"{where}: expected a turn, such as 360 or -90, got 0")
    return number


def _polyline(points: Any, closed: bool, where: str) -> Polyline:
    if not isinstance(points, Sequence | np.ndarray) or len(points) < 2:
        raise SceneError(f"{where}: expected at least two points; the forms are {FORMS}")
    corners = np.stack([validate_numbers(f"{where}: point {i + 1}", point, 3) for i, point in enumerate(points)])
    if (corners == corners[0]).all():
        raise SceneError(f"{where}: all points are {corners[0].tolist()}; expected different ones")
    return Polyline(corners, closed)


def _numbers(text: str, count: int, where: str) -> list[float]:
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count:
        expected = "a number" if count == 1 else f"{count} numbers with commas between them"
        raise SceneError(f"{where}: {text!r}: expected {expected}")
    return numbers


def _read(file: Path, name: str) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise SceneError(f"{name} {file}: cannot be read ({error.strerror}); expected a path (TOML)") from None
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise SceneError(f"{name} {file}: is not TOML: {error}") from None
