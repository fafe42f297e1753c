"""One failure of a shadow algorithm: a program that goes wrong, the one that does not, and what tells them apart."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow import techniques
from softshadow.failures.call_difference import call_difference
from softshadow.failures.calls import Call, Change, recorded
from softshadow.failures.expected import without_warnings
from softshadow.failures.measures import deepest, share_of_light
from softshadow.inspection.explanation import explain
from softshadow.run import Run, run
from softshadow.scene import Scene
from softshadow.techniques import Technique

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

SIZE = (240, 180)


@dataclass(frozen=True, eq=False)
class Setting:
    """A technique, its options, the GL calls of it that are altered, and a scene that is not as it should be."""

    technique: Technique | str
    options: Mapping[str, Any] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()
    make_scene: Callable[[], Scene] | None = None

    def draw(self, scene: Scene, size: tuple[int, int]) -> tuple[Run, list[Call]]:
        """Return the run and its calls; of what goes wrong it says nothing, that is the point."""
        drawn = self.make_scene() if self.make_scene else scene
        calls: list[Call] = []
        technique = self.technique if isinstance(self.technique, Technique) else techniques.get(self.technique)
        with without_warnings():
            return run(recorded(technique, self.changes, calls), drawn, size, **self.options), calls


@dataclass(frozen=True, eq=False, repr=False)
class Failure:
    """A known failure and its cure. The runs are made, and the numbers measured, when they are first asked for.

    Attributes
    ----------
    name, title, family : str
    reference : str              where the course tells of it, as in "E38, CA:470"; E-numbers are docs/corrections.md
    reason : str                 one sentence
    make_scene : callable        what it is shown on, and what is right is found on
    with_failure, with_cure : Setting
    measure : callable           the pixels of a run that are wrong, (H, W) bool
    counted : str                what the numbers are, in words
    floor : int                  what the cure leaves of the number at most, in pictures of the default size
    why_floor : str              why it leaves some there, or in larger pictures
    flat : bool                  whether lit surfaces have their plain colour, as in the listings of shadow maps
    size : (width, height)
    """

    name: str
    title: str
    family: str
    reference: str
    reason: str
    make_scene: Callable[[], Scene]
    with_failure: Setting
    with_cure: Setting
    measure: Callable[[Run], np.ndarray]
    counted: str
    floor: int = 0
    why_floor: str = ""
    flat: bool = False
    size: tuple[int, int] = SIZE

    def at(self, size: tuple[int, int]) -> Failure:
        """Return the same failure in pictures of another size."""
        return replace(self, size=size)

    # -- runs ----------------------------------------------------------------------------------------------------------
    @cached_property
    def scene(self) -> Scene:
        """What it is shown on."""
        return self.make_scene()

    @property
    def wrong(self) -> Run:
        """The run with the failure."""
        return self._wrong[0]

    @property
    def cured(self) -> Run:
        """The run with the cure."""
        return self._cured[0]

    @cached_property
    def _wrong(self) -> tuple[Run, list[Call]]:
        return self.with_failure.draw(self.scene, self.size)

    @cached_property
    def _cured(self) -> tuple[Run, list[Call]]:
        return self.with_cure.draw(self.scene, self.size)

    # -- numbers -------------------------------------------------------------------------------------------------------
    @cached_property
    def number_wrong(self) -> int:
        """How many pixels are wrong with the failure."""
        return int(self.wrong_pixels(self.wrong).sum())

    @cached_property
    def number_cured(self) -> int:
        """How many pixels are wrong with the cure."""
        return int(self.wrong_pixels(self.cured).sum())

    @cached_property
    def pixel(self) -> tuple[int, int]:
        """x, y of the pixel to click: deepest among those that are wrong with the failure and right with the cure.

        Raises
        ------
        ValueError                   there is none: in pictures of this size the failure does not show
        """
        found = self.wrong_pixels(self.wrong) & ~self.wrong_pixels(self.cured)
        if not found.any():
            raise ValueError(
                f"failure {self.name!r} does not show at {self.size[0]} x {self.size[1]}; expected another size, "
                f"as {SIZE[0]} x {SIZE[1]}"
            )
        return deepest(found)

    def wrong_pixels(self, run: Run) -> np.ndarray:
        """Return the pixels (H, W) bool of either run that are wrong, row 0 on top."""
        return self.measure(replace(run, scene=self.scene))

    # -- words and pictures --------------------------------------------------------------------------------------------
    @cached_property
    def diff(self) -> str:
        """The cure as a diff of GL calls: - with the failure, + with the cure."""
        return call_difference(self._wrong[1], self._cured[1])

    def explain(self) -> str:
        """Return the story: the reason, both numbers, the cure, and why the pixel to click is what it is in both."""
        left = f" ({self.why_floor})" if self.number_cured and self.why_floor else ""
        return "\n".join(
            [
                f"{self.name}: {self.title} ({self.reference})",
                "",
                self.reason,
                "",
                f"{self.counted}, of {self.size[0]} x {self.size[1]} on scene {self.scene.name}:",
                f"  with the failure  {self.number_wrong}",
                f"  with the cure     {self.number_cured}{left}",
                "",
                self.diff,
                "",
                f"with the failure: {self._told(self.wrong)}",
                f"with the cure:    {self._told(self.cured)}",
            ]
        )

    def _told(self, run: Run) -> str:
        """Return one sentence about the pixel by its colour: what a failing program says of its light may be wrong."""
        x, y = self.pixel
        history = run.pixel(x, y)
        colored = any(row.color_written for row in history)
        return explain(history, share_of_light(replace(run, scene=self.scene), x, y, self.flat), colored)

    def picture(self) -> Picture:
        """Return both pictures side by side, a ring around the pixel to click."""
        from softshadow.failures.picture import side_by_side

        return side_by_side(self)

    def __repr__(self) -> str:
        return f"Failure({self.name!r}: {self.title})"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        """Return what a notebook shows: the pictures."""
        from softshadow.inspection.pictures import shown

        return shown(self.explain(), self.picture())
