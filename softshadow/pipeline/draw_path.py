"""The way that a draw went through the pipeline, and why: what `softshadow render --explain-path` prints."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field

_explained: ContextVar[list[DrawPath] | None] = ContextVar("explained", default=None)  # each thread has its own


@dataclass
class DrawPath:
    """The way that one draw went.

    Attributes
    ----------
    label : str              the debug groups of the draw ("step/torus")
    mode : int               GL_POINTS ... GL_POLYGON
    way, fill, shading : str which way it went; "" where nothing was filled or shaded
    reasons : list of str    why, in the order of the decisions
    """

    label: str
    mode: int
    way: str = ""
    fill: str = ""
    shading: str = ""
    reasons: list[str] = field(default_factory=list)

    def note(self, reason: str) -> None:
        """Add a reason, once."""
        if reason not in self.reasons:
            self.reasons.append(reason)


def begin_path(label: str, mode: int) -> DrawPath:
    """Return the path of a draw that begins; `explain_paths` collects it."""
    path, explained = DrawPath(label, mode), _explained.get()
    if explained is not None:
        explained.append(path)
    return path


def is_explained() -> bool:
    """Return whether `explain_paths` collects the paths of draws."""
    return _explained.get() is not None


@contextmanager
def explain_paths() -> Iterator[list[DrawPath]]:
    """Inside, the list in the with statement receives the `DrawPath` of every draw of this thread.

    Examples
    --------
    >>> import softshadow as ss
    >>> with ss.explain_paths() as paths:
    ...     run = ss.run("planar", "boxes", size=(64, 48))
    >>> paths[0].way
    'opaque'
    """
    paths: list[DrawPath] = []
    token = _explained.set(paths)
    try:
        yield paths
    finally:
        _explained.reset(token)
