"""The failure gallery: the known failures of the course's algorithms, each beside its cure.

An entry draws the same scene with two programs that differ in a call or an option, counts the wrong pixels of both, and
lists their difference as GL calls.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from softshadow.errors import nearest
from softshadow.gallery import maps, meshes, planar, soft, stencil, volumes
from softshadow.gallery.calls import AlteredCall
from softshadow.gallery.failure import Failure, Setting
from softshadow.inspection.tables import html_table, text_table

__all__ = ["GALLERY", "AlteredCall", "Failure", "Gallery", "Setting"]


class Gallery(Mapping[str, Failure]):
    """The failures by name, in the order of the course.

    Examples
    --------
    >>> list(GALLERY)[:2]
    ['z-fighting', 'offset-too-large']
    >>> GALLERY["acne"].title
    'Surfaces shadow themselves'
    """

    def __init__(self, failures: tuple[Failure, ...]) -> None:
        self._failures = {failure.name: failure for failure in failures}

    def __getitem__(self, name: str) -> Failure:
        """Return a failure.

        Raises
        ------
        KeyError                     no failure has that name; the message has the nearest one
        """
        if name not in self._failures:
            raise KeyError(f"unknown failure {name!r}: {nearest(str(name), self._failures)}")
        return self._failures[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._failures)

    def __len__(self) -> int:
        return len(self._failures)

    def __repr__(self) -> str:
        return text_table(["name", "family", "what goes wrong"], self._rows())

    def _repr_html_(self) -> str:
        return html_table(["name", "family", "what goes wrong"], self._rows())

    def _rows(self) -> list[list[Any]]:
        return [[each.name, each.family, each.title] for each in self.values()]


GALLERY = Gallery(
    (*planar.FAILURES, *volumes.FAILURES, *stencil.FAILURES, *meshes.FAILURES, *maps.FAILURES, *soft.FAILURES)
)
