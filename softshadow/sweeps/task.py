"""Tasks, what engines compute: points of a sweep, frames of a film. Each gives a row, and possibly a file.

An engine does not know what its tasks are. It gets them with a `Work`, which says how tasks of their kind are computed.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Protocol, TypeVar

import softshadow
from softshadow.errors import SoftShadowError

Row = dict[str, Any]
CANNOT_LOAD = (SoftShadowError, ValueError, OSError)  # what a scene or model file may end in


class Task(Protocol):
    """What an engine computes, on its own: it needs nothing of the other tasks."""

    @property
    def key(self) -> str:
        """A name that is equal for equal tasks, and for no others."""

    @property
    def recipe(self) -> str:
        """A text that says how to compute it again."""

    @property
    def scene(self) -> str:
        """The name of the scene; tasks of one scene are sent together."""


T = TypeVar("T", bound=Task)


@dataclass(frozen=True)
class Result:
    """What a task gave: a row with its `status` ("ok" or "error"), and the bytes of its file, or None."""

    row: Row
    file: bytes | None


@dataclass(frozen=True)
class Work:
    """How tasks of one kind are computed.

    Attributes
    ----------
    compute : callable           returns the result of a task and its loaded scene; workers import it by its name
    described : callable         returns the columns that say what a task is, for one that has no result
    load : callable              returns the scene that is sent to the workers for a task; None if they have it
    """

    compute: Callable[[Any, Any], Result]
    described: Callable[[Any], Row]
    load: Callable[[Any], Any]

    def here(self, tasks: Sequence[T]) -> Iterator[tuple[T, Result]]:
        """Yield each task with its result, in order: the engine that needs nothing, in this process."""
        name, scene = None, None
        for task in tasks:
            try:
                if task.scene != name:
                    name, scene = None, self.load(task)
                    name = task.scene
            except CANNOT_LOAD as error:
                yield task, self.failed(task, error)
                continue
            yield task, self.compute(task, scene)

    def failed(self, task: Any, error: BaseException | str) -> Result:
        """Return the row of a task that has no result."""
        text = error if isinstance(error, str) else f"{type(error).__name__}: {error}"
        return Result({**self.described(task), "status": "error", "error": text}, None)


@cache
def package_digest() -> str:
    """Return a digest of the version and of all sources of this package: what is computed may change with them."""
    root = Path(softshadow.__file__).parent
    digest = hashlib.sha256(softshadow.__version__.encode())
    for file in sorted(root.rglob("*.py")):
        digest.update(f"{file.relative_to(root).as_posix()} {file.stat().st_size} ".encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]
