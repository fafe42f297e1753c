"""A sweep file: what is varied, as TOML, and the points that it makes."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field, ValidationError, field_validator

from softshadow import techniques
from softshadow.errors import SoftShadowError, nearest
from softshadow.scene import scene_names
from softshadow.sweeps.axes import FORMS, Axis, Places, Random, Strict, places_of, values_of
from softshadow.sweeps.point import MEASURES, Point

MOST_POINTS = 1_000_000
MOST_BYTES = 1_000_000  # of a sweep file
Names = str | list[str]


class Specification(Strict):
    """What a sweep varies. Every combination is a point; with `samples`, random values are drawn that often for each.

    Attributes
    ----------
    technique, scene : str or list of str     scenes are names, scene files or model files
    options : table              of lists, ranges and random numbers; a technique takes the options that it has
    size : list of "WxH"
    light, eye, target : list of points, or a path
    fov : list of numbers        degrees
    threads : list of int
    measure : list of str        some of hard, soft, counts, time, memory
    frames, repetitions : int
    samples, seed : int          for random numbers
    picture : bool
    """

    technique: Names
    scene: Names = "torus"
    options: dict[str, Axis] = Field(default_factory=dict)
    size: Names = "320x240"
    light: Places | None = None
    eye: Places | None = None
    target: Places | None = None
    fov: Axis = 0.0
    threads: int | list[int] = 1
    measure: tuple[str, ...] = ("hard", "counts", "time")
    frames: Annotated[int, Field(ge=1, le=10_000)] = 3
    repetitions: Annotated[int, Field(ge=1, le=10_000)] = 1
    samples: Annotated[int, Field(ge=1, le=MOST_POINTS)] = 1
    seed: int = 0
    picture: bool = False

    @field_validator("technique")
    @classmethod
    def _techniques_exist(cls, names: Names) -> Names:
        for name in listed(names):
            if name not in techniques.names():
                raise ValueError(f"unknown technique {name!r}: {nearest(name, techniques.names())}")
        return names

    @field_validator("scene")
    @classmethod
    def _scenes_exist(cls, names: Names) -> Names:
        for name in listed(names):
            if not Path(name).suffix and name not in scene_names():
                raise ValueError(f"unknown scene {name!r}: {nearest(name, scene_names())}")
        return names

    @field_validator("size")
    @classmethod
    def _sizes_are_numbers(cls, sizes: Names) -> Names:
        for size in listed(sizes):
            size_of(size)
        return sizes

    @field_validator("measure")
    @classmethod
    def _measures_exist(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        for name in names:
            if name not in MEASURES:
                raise ValueError(f"unknown measure {name!r}: {nearest(name, MEASURES)}")
        return names

    def points(self) -> list[Point]:
        """Return the points, in the order of the keys above; equal ones once.

        Raises
        ------
        ValueError                   an option that no technique has, or a value that it does not take
        """
        chosen = listed(self.technique)
        known = {name: techniques.get(name).options for name in chosen}
        for option in self.options:
            if not any(option in options for options in known.values()):
                every = dict.fromkeys(key for options in known.values() for key in options)
                raise ValueError(f"options.{option}: no technique here has it; {nearest(option, every)}")
        points = dict.fromkeys(self._points(known))
        return list(points)

    def _points(self, known: dict[str, Any]) -> Iterator[Point]:
        generator = np.random.default_rng(self.seed)
        places = [places_of(path) for path in (self.light, self.eye, self.target)]
        sizes = [size_of(each) for each in listed(self.size)]
        threads = self.threads if isinstance(self.threads, list) else [self.threads]
        count = 0
        for name, scene in product(listed(self.technique), listed(self.scene)):
            own = {key: values_of(axis) for key, axis in self.options.items() if key in known[name]}
            axes = (*own.values(), sizes, *places, values_of(self.fov), threads, range(self.samples))
            for *values, size, light, eye, target, fov, n_threads, _ in product(*axes):
                drawn = [each.draw(generator) if isinstance(each, Random) else each for each in (*values, fov)]
                options = validated(name, dict(zip(own, drawn[:-1], strict=True)))
                for repetition in range(self.repetitions):
                    count += 1
                    if count > MOST_POINTS:
                        raise ValueError(f"the sweep has more than {MOST_POINTS} points; expected fewer values")
                    yield Point(
                        name, scene, options, size, light, eye, target, float(drawn[-1]), n_threads, self.frames,
                        repetition, self.measure, self.picture,
                    )  # fmt: skip


def validated(technique: str, options: dict[str, Any]) -> dict[str, Any]:
    """Return the options as the technique takes them; one with its default value stays, as a column of the table.

    Raises
    ------
    ValueError, TypeError        a value that the option does not take
    """
    values = techniques.get(technique).validate_options(options)
    return {key: values[key] for key in options}


def listed(names: Names) -> list[str]:
    """Return one name or several as a list."""
    return [names] if isinstance(names, str) else names


def size_of(text: str) -> tuple[int, int]:
    """Return the numbers of a size such as "320x240"."""
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 1 <= int(width) <= 16384 and 1 <= int(height) <= 16384):
        raise ValueError(f'size {text!r}: expected WIDTHxHEIGHT in pixels, as in "320x240"')
    return int(width), int(height)


def read_specification(path: str | os.PathLike[str]) -> Specification:
    """Return what a sweep file says; model and scene files in it are relative to its folder.

    Raises
    ------
    SoftShadowError              the file cannot be read, or is not such a file: its name, the key, what was expected
    """
    file = Path(path)
    try:
        if not file.is_file():
            raise SoftShadowError(f"{path}: there is no such file; expected a sweep file (.toml)")
        if file.stat().st_size > MOST_BYTES:
            raise SoftShadowError(f"{path}: larger than {MOST_BYTES} bytes; expected a sweep file (.toml)")
        table = tomllib.loads(file.read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise SoftShadowError(f"{path}: expected a sweep file in TOML: {str(error)[:200]}") from None
    except OSError as error:
        raise SoftShadowError(f"{path}: cannot be read: {error.strerror}") from None
    return specified(table, str(path), file.parent)


def specified(table: dict[str, Any], origin: str, folder: Path | None = None) -> Specification:
    """Return the specification of a table; `origin` is named in errors.

    Raises
    ------
    SoftShadowError              see `read_specification`
    """
    try:
        specification = Specification.model_validate(table)
    except ValidationError as error:
        first = min(error.errors(), key=lambda each: len(each["loc"]))
        keys = key_of(first["loc"], table)
        said = first["msg"].removeprefix("Value error, ").replace("Input should be", "expected")
        if first["type"] == "extra_forbidden":
            said = "unknown key"
            if len(first["loc"]) == 1:
                said += f": {nearest(str(first['loc'][0]), Specification.model_fields)}"
        raise SoftShadowError(f"{origin}: {keys}: {said}") from None
    if folder is not None:
        scenes = [str(folder / name) if Path(name).suffix else name for name in listed(specification.scene)]
        specification = specification.model_copy(update={"scene": scenes})
    return specification


def key_of(location: tuple[int | str, ...], table: Any) -> str:
    """Return the place of an error in a file, such as "options.bias.from", without the names of types on the way."""
    parts: list[str] = []
    for index, part in enumerate(location):
        inside = isinstance(table, dict) and part in table
        if inside or (isinstance(table, list) and isinstance(part, int) and part < len(table)):
            table = table[part]
            parts.append(str(part))
        elif index == 0 or (index == len(location) - 1 and isinstance(table, dict) and part not in FORMS):
            parts.append(str(part))  # a key that is missing
    return ".".join(parts)
