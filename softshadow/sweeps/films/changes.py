"""What changes from frame to frame: the position of a light or camera, or the value of an option.

A change knows its value in every frame and how a caption writes it. All values of one change are written with the same
number of digits, so that captions do not jump.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from softshadow.errors import SceneError, nearest
from softshadow.scene import Scene
from softshadow.sweeps.paths import route_of
from softshadow.techniques import Option, Technique

MOST_DIGITS = 6  # after the point
Move = tuple[str, str, tuple[float, ...]]  # "light" or "camera", its name, its position


@dataclass(frozen=True)
class Change:
    """A value in each frame, and its text in the caption.

    `target` says what it is set on: "light", "camera" or "option".
    """

    target: str
    name: str
    values: tuple[Any, ...]
    labels: tuple[str, ...]


# -- lights and cameras ------------------------------------------------------------------------------------------------
def light_change(scene: Scene, path: Any, n_frames: int, of_light: str | None) -> Change:
    """Return the homogeneous positions (4,) of a light along a path; a light at infinity stays there.

    Raises
    ------
    SceneError                   a path that is wrong, or no light of this name
    """
    names = [light.name for light in scene.lights]
    name = names[0] if of_light is None else of_light
    if name not in names:
        raise SceneError(f"light {name!r}: {nearest(name, names)}")
    position = scene.lights[names.index(name)].position
    center = scene.camera.target if position[3] else np.zeros(3)
    points = route_of(path, "light path").points(n_frames, position[:3], center)
    values = tuple(np.append(point, position[3]) for point in points)
    return Change("light", name, values, position_labels(name, points))


def camera_change(scene: Scene, path: Any, n_frames: int) -> Change:
    """Return the eye positions (3,) of the camera along a path; it goes on looking at its target."""
    camera = scene.camera
    points = route_of(path, "camera path").points(n_frames, camera.eye, camera.target)
    return Change("camera", "camera", tuple(points), position_labels("camera", points))


def position_labels(name: str, points: np.ndarray) -> tuple[str, ...]:
    """Return texts such as "light 2.00 5.00 3.00"."""
    digits = digits_for(float(np.ptp(points, axis=0).max()), len(points))
    return tuple(" ".join([name, *(fixed(value, digits) for value in point)]) for point in points.tolist())


# -- options -----------------------------------------------------------------------------------------------------------
def option_change(technique: Technique, text: str, n_frames: int) -> Change:
    """Return the values of an option, from a text such as "units=0..8", "map_size=32..1024:log" or "cull=none,back".

    A range is passed in equal steps (with ``:log`` in equal factors), and whole numbers are rounded. A list is divided
    evenly among the frames.

    Raises
    ------
    ValueError                   the technique has no such option, or the option does not take such a value
    """
    key, equals, spelled = text.partition("=")
    key = key.strip().replace("-", "_")
    if not equals or not spelled:
        raise ValueError(f"vary {text!r}: expected OPTION=A..B, OPTION=A..B:log or OPTION=A,B,C")
    if key not in technique.options:
        raise ValueError(f"vary {text!r}: technique {technique.name!r} has no option {key!r}; {_known(technique, key)}")
    option = technique.options[key]
    values = _range(option, text, spelled, n_frames) if ".." in spelled else _list(option, text, spelled, n_frames)
    for value in values:
        option.validate(key, value)
    return Change("option", key, values, option_labels(key, values))


def _known(technique: Technique, key: str) -> str:
    return nearest(key, technique.options) if technique.options else "it has none"


def _range(option: Option, text: str, spelled: str, n_frames: int) -> tuple[Any, ...]:
    ends, _, spacing = spelled.partition(":")
    if spacing not in ("", "log"):
        raise ValueError(f"vary {text!r}: expected nothing or :log after the range, got :{spacing}")
    if option.kind not in (int, float):
        raise ValueError(f"vary {text!r}: this option takes {option.expected}; expected a list, OPTION=A,B,C")
    try:
        start, end = (float(part) for part in ends.split(".."))
    except ValueError:
        raise ValueError(f"vary {text!r}: expected two numbers with .. between them, as in 0..8") from None
    if not (math.isfinite(start) and math.isfinite(end)):
        raise ValueError(f"vary {text!r}: expected two finite numbers")
    if spacing and not (start > 0 and end > 0):
        raise ValueError(f"vary {text!r}: expected two numbers above 0 for :log")
    numbers = np.geomspace(start, end, n_frames) if spacing else np.linspace(start, end, n_frames)
    return tuple(round(number) if option.kind is int else number for number in numbers.tolist())


def _list(option: Option, text: str, spelled: str, n_frames: int) -> tuple[Any, ...]:
    chosen = [_value(option, text, part.strip()) for part in spelled.split(",")]
    if len(chosen) > n_frames:
        raise ValueError(f"vary {text!r}: {len(chosen)} values for {n_frames} frames; expected a frame for each")
    return tuple(chosen[frame * len(chosen) // n_frames] for frame in range(n_frames))


def _value(option: Option, text: str, spelled: str) -> Any:
    if option.kind is bool:
        if spelled.lower() in ("true", "false"):
            return spelled.lower() == "true"
        raise ValueError(f"vary {text!r}: {spelled!r}: expected true or false")
    try:
        return option.kind(spelled)
    except ValueError:
        raise ValueError(f"vary {text!r}: {spelled!r}: expected {option.expected}") from None


def option_labels(key: str, values: Sequence[Any]) -> tuple[str, ...]:
    """Return texts such as "units=2.50"."""
    if all(isinstance(value, float) for value in values):
        smallest = min((abs(value) for value in values if value), default=1.0)
        digits = digits_for(min(max(values) - min(values) or 1.0, smallest * len(values)), len(values))
        return tuple(f"{key}={fixed(value, digits)}" for value in values)
    return tuple(f"{key}={str(value).lower() if isinstance(value, bool) else value}" for value in values)


def digits_for(span: float, n_frames: int) -> int:
    """Return how many digits after the point tell `n_frames` equal parts of a span from each other, 2 to 6."""
    step = span / max(1, n_frames)
    return min(MOST_DIGITS, max(2, math.ceil(-math.log10(step)))) if step else 2


def fixed(value: float, digits: int) -> str:
    """Return a number with a fixed number of digits after the point; a rounded zero has no sign."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


# -- frames ------------------------------------------------------------------------------------------------------------
def moves_of(changes: Sequence[Change], frame: int) -> tuple[Move, ...]:
    """Return where the changes put lights and camera in a frame."""
    return tuple(
        (change.target, change.name, tuple(change.values[frame].tolist()))
        for change in changes
        if change.target != "option"
    )


def moved_scene(scene: Scene, moves: Sequence[Move]) -> Scene:
    """Return the scene with its lights and camera where the moves put them."""
    for target, name, position in moves:
        if target == "light":
            lights = tuple(
                replace(light, position=np.array(position)) if light.name == name else light for light in scene.lights
            )
            scene = replace(scene, lights=lights)
        else:
            scene = replace(scene, camera=replace(scene.camera, eye=np.array(position)))
    return scene


def changed_options(changes: Sequence[Change], frame: int) -> dict[str, Any]:
    """Return the options that the changes set in a frame."""
    return {change.name: change.values[frame] for change in changes if change.target == "option"}
