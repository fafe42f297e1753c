"""One frame of a film, as a task: drawn from its own recipe alone, it gives the values of its panels.

The values are kept, not a picture, because the greys of depths are chosen over the whole film.
"""

from __future__ import annotations

import dataclasses
import hashlib
import inspect
import io
import json
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from softshadow import errors
from softshadow.pipeline import set_threads
from softshadow.pipeline.memory.threads import threads
from softshadow.runs import run
from softshadow.scene import Scene
from softshadow.sweeps.films.changes import Move, moved_scene
from softshadow.sweeps.films.panels import Panel, panels_of
from softshadow.sweeps.task import Result, Row, package_digest
from softshadow.techniques import Technique

FILES = (".film-frames", ".npz")  # where a journal keeps the panels


@dataclass(frozen=True, eq=False)
class Frame:
    """What one frame is drawn from.

    Attributes
    ----------
    technique : Technique
    scene : str                  digest of the scene, without the moves (`scene_digest`)
    moves : tuple of Move        where its light and camera stand
    options : mapping            all options of the technique
    size : (width, height)       of a panel, in pixels
    show : tuple of str          buffers and maps
    steps : bool                 after every step
    label : str                  what messages call it
    threads : int | None         number of kernel threads; None leaves it as it is. The picture does not depend on it
    """

    technique: Technique
    scene: str
    moves: tuple[Move, ...]
    options: Mapping[str, Any]
    size: tuple[int, int]
    show: tuple[str, ...]
    steps: bool
    label: str
    threads: int | None

    @cached_property
    def key(self) -> str:
        """A name: equal for equal frames, scenes and sources of this package and of the technique, otherwise not."""
        facts = [
            source_of(self.technique), self.scene, self.moves, sorted(self.options.items()), self.size, self.show,
            self.steps, package_digest(),
        ]  # fmt: skip
        return hashlib.sha256(json.dumps(facts, default=str).encode()).hexdigest()[:24]

    @property
    def recipe(self) -> str:
        """Which frame it is, and what changes."""
        return self.label


@dataclass(frozen=True, eq=False)
class DrawnFrame:
    """The panels of a frame, and the warnings of its run."""

    panels: tuple[Panel, ...]
    warnings: tuple[errors.Warning, ...]


def described(frame: Frame) -> Row:
    """Return what a frame is."""
    return {"technique": frame.technique.name, "width_px": frame.size[0], "height_px": frame.size[1]}


def draw_frame(frame: Frame, scene: Scene) -> Result:
    """Draw a frame of a scene; one that the technique cannot draw gives a row with its error."""
    row: Row = {**described(frame), "status": "ok", "error": ""}
    before = threads()
    try:
        if frame.threads is not None:
            set_threads(frame.threads)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", errors.Warning)  # the film has them
            drawn = run(frame.technique, moved_scene(scene, frame.moves), frame.size, **frame.options)
        panels = panels_of(drawn, frame.show, frame.steps)
    except Exception as error:  # whatever it is, the animation says which frame it was
        return Result({**row, "status": "error", "error": f"{type(error).__name__}: {error}"}, None)
    finally:
        set_threads(before)
    row["warnings"] = [[type(each).__name__, str(each)] for each in drawn.warnings]
    row["panels"] = [[panel.title, panel.buffer] for panel in panels]
    contents = io.BytesIO()
    np.savez_compressed(contents, *(panel.values for panel in panels))
    return Result(row, contents.getvalue())


def drawn_frame(row: Row, contents: bytes) -> DrawnFrame:
    """Return a frame from the row and the file of its result.

    Raises
    ------
    ValueError, OSError          the file is not that of the row
    """
    with np.load(io.BytesIO(contents), allow_pickle=False) as arrays:
        values = [arrays[f"arr_{index}"] for index in range(len(row["panels"]))]
    panels = (Panel(title, buffer, array) for (title, buffer), array in zip(row["panels"], values, strict=True))
    return DrawnFrame(
        tuple(panels), tuple(getattr(errors, name, errors.Warning)(text) for name, text in row["warnings"])
    )


# -- digests -----------------------------------------------------------------------------------------------------------
def source_of(technique: Technique) -> str:
    """Return the name of a technique, with the source of one that is not part of this package."""
    steps = technique.steps
    if getattr(steps, "__module__", "").startswith("softshadow."):
        return technique.name
    try:
        return f"{technique.name}: {inspect.getsource(steps)}"
    except (OSError, TypeError):  # typed into an interpreter
        code = getattr(steps, "__code__", None)
        return f"{technique.name}: {code.co_code.hex() if code else repr(steps)}"


def scene_digest(scene: Scene) -> str:
    """Return a digest of all that a scene contains."""
    digest = hashlib.sha256()
    _add(digest, scene)
    return digest.hexdigest()[:24]


def _add(digest: Any, value: Any) -> None:
    if dataclasses.is_dataclass(value):
        digest.update(type(value).__name__.encode())
        for field in dataclasses.fields(value):
            digest.update(field.name.encode())
            _add(digest, getattr(value, field.name))
    elif isinstance(value, np.ndarray):
        digest.update(f"{value.dtype}{value.shape}".encode())
        digest.update(np.ascontiguousarray(value).tobytes())
    elif isinstance(value, tuple | list):
        digest.update(f"{len(value)}".encode())
        for each in value:
            _add(digest, each)
    else:
        digest.update(repr(value).encode())
