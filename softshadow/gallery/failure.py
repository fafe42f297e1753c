"""A failure of a shadow algorithm: the program that fails, the corrected one, and the pixels they differ in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow import techniques
from softshadow.course import explain_codes
from softshadow.gallery.call_difference import call_difference
from softshadow.gallery.calls import AlteredCall, Call, recorded
from softshadow.gallery.expected import without_warnings
from softshadow.gallery.measures import STRICTER, deepest, share_of_light
from softshadow.inspection.explanation import causes_of, explain
from softshadow.inspection.pictures import Shown, notebook_display
from softshadow.inspection.words import place_in_words
from softshadow.runs import Run, run
from softshadow.scene import Scene
from softshadow.techniques import Technique

if TYPE_CHECKING:
    from PIL.Image import Image

SIZE = (240, 180)


@dataclass(frozen=True, eq=False)
class Setting:
    """A technique, its options, the GL calls that are altered in it, and its own scene if the scene is at fault."""

    technique: Technique | str
    options: Mapping[str, Any] = field(default_factory=dict)
    altered_calls: tuple[AlteredCall, ...] = ()
    make_scene: Callable[[], Scene] | None = None

    def draw(self, scene: Scene, size: tuple[int, int]) -> tuple[Run, list[Call]]:
        """Return the run and its GL calls; warnings are silenced, because the failure is intended."""
        scene = self.make_scene() if self.make_scene else scene
        calls: list[Call] = []
        technique = techniques.get(self.technique)
        with without_warnings():
            return run(recorded(technique, self.altered_calls, calls), scene, size, **self.options), calls


@dataclass(frozen=True, eq=False, repr=False)
class Failure:
    """A known failure and its cure. The runs are drawn, and the wrong pixels counted, when they are first needed.

    Attributes
    ----------
    name, title, family : str
    reference : str              place in the course, like "E38, CA:470"; the E-numbers are those of docs/corrections.md
    reason : str                 one sentence
    make_scene : callable        returns the scene that is drawn, and that the ray caster judges by
    with_failure, with_cure : Setting
    measure : callable           returns the wrong pixels of a run, (H, W) bool
    counted : str                which pixels count as wrong, in words
    floor : int                  the most wrong pixels that the cure leaves, in pictures of the default size
    why_floor : str              why it leaves some there, or in larger pictures, or where the measure does not count
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

    @property
    def technique(self) -> str:
        """The name of the technique that fails."""
        technique = self.with_failure.technique
        return technique.name if isinstance(technique, Technique) else technique

    # -- runs ----------------------------------------------------------------------------------------------------------
    @cached_property
    def scene(self) -> Scene:
        """The scene that is drawn."""
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
        """Number of wrong pixels with the failure."""
        return int(self.wrong_pixels(self.wrong).sum())

    @cached_property
    def number_cured(self) -> int:
        """Number of wrong pixels with the cure."""
        return int(self.wrong_pixels(self.cured).sum())

    @cached_property
    def number_uncounted(self) -> int:
        """Number of wrong pixels with the cure that `number_cured` leaves out: at creases, or on casters."""
        strict = STRICTER.get(self.measure)
        return (
            int((strict(replace(self.cured, scene=self.scene)) & ~self.wrong_pixels(self.cured)).sum()) if strict else 0
        )

    @property
    def remark(self) -> str:
        """What the cure leaves wrong, and why; empty if nothing."""
        why = f" ({self.why_floor})" if self.why_floor else ""
        parts = [self.why_floor] if self.number_cured and self.why_floor else []
        if self.number_uncounted:
            plural = "" if self.number_uncounted == 1 else "s"
            parts.append(f"not counted: {self.number_uncounted} wrong pixel{plural}{'' if parts else why}")
        return "; ".join(parts)

    @cached_property
    def pixel(self) -> tuple[int, int]:
        """x, y of the pixel to look at, amid pixels that are wrong with the failure and right with the cure.

        Raises
        ------
        ValueError                   there is none: the failure is not visible in pictures of this size
        """
        repaired = self.wrong_pixels(self.wrong) & ~self.wrong_pixels(self.cured)
        if not repaired.any():
            raise ValueError(
                f"failure {self.name!r} is not visible at {self.size[0]} x {self.size[1]}; expected another size, "
                f"like {SIZE[0]} x {SIZE[1]}"
            )
        return deepest(repaired)

    def wrong_pixels(self, run: Run) -> np.ndarray:
        """Return the wrong pixels of either run, (H, W) bool, row 0 on top."""
        return self.measure(replace(run, scene=self.scene))

    # -- words and pictures --------------------------------------------------------------------------------------------
    @cached_property
    def diff(self) -> str:
        """The cure as a diff of GL calls: - with the failure, + with the cure."""
        return call_difference(self._wrong[1], self._cured[1])

    @property
    def codes(self) -> list[str]:
        """What the codes of `reference` mean, a sentence each."""
        return explain_codes(self.reference)

    def explain(self) -> str:
        """Return a text: reason, numbers of wrong pixels, cure, and an explanation of `pixel` in both runs."""
        remark = f": {self.remark}" if self.remark else ""
        return "\n".join(
            [
                f"{self.name}: {self.title} ({self.reference})",
                "",
                self.reason,
                "",
                f"{self.counted}, of {self.size[0]} x {self.size[1]} on scene {self.scene.name}:",
                f"  with the failure  {self.number_wrong}",
                f"  with the cure     {self.number_cured}{remark}",
                "",
                self.diff,
                "",
                f"with the failure: {self._explained(self.wrong)}",
                f"with the cure:    {self._explained(self.cured)}",
                *(["", *self.codes] if self.codes else []),
            ]
        )

    def _explained(self, run: Run) -> str:
        """Return one sentence about the pixel, judged by its colour: the run's own visibility may be wrong, too."""
        x, y = self.pixel
        history = run.pixel(x, y)
        colored = any(row.color_written for row in history)
        share = share_of_light(replace(run, scene=self.scene), x, y, self.flat)
        hidden = {light.name: share for light in self.scene.lights if share < 1}
        return explain(history, share, colored, causes=causes_of(run.frame, history, self.scene, hidden))

    def picture(self) -> Image:
        """Return both pictures side by side, with a ring around `pixel`."""
        from softshadow.gallery.side_by_side import side_by_side  # loads Pillow

        panels = [
            (f"{self.name}: {self.number_wrong} wrong pixels", self.wrong.image),
            (f"cured: {self.number_cured}", self.cured.image),
        ]
        return side_by_side(panels, self.pixel)

    def __repr__(self) -> str:
        return f"Failure({self.name!r}: {self.title})"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Shown:
        """Return what a notebook displays: the pictures."""
        return notebook_display(self.explain(), np.asarray(self.picture()), self.describe())

    def describe(self) -> str:
        """Return what both pictures show, in words: the numbers of wrong pixels, and where the pictures differ."""
        differ = place_in_words((self.wrong.image != self.cured.image).any(axis=-1), "differ")
        return (
            f"{self.title}: scene {self.scene.name}, drawn by {self.technique}. On the left, with the failure, "
            f"{self.number_wrong:,} pixels are wrong; on the right, with the cure, {self.number_cured:,}. "
            f"Of the two pictures {differ}. A ring marks the pixel {self.pixel[0]}, {self.pixel[1]}."
        )
