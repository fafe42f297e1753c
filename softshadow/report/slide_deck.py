"""Slides of a run: one page with a slide for each step, to show with the arrow keys, or to print.

A slide has the GL state that the step changes, the picture after it, the counts of a part of the stencil buffer (or
the depths and maps), and what there is to notice. The page loads nothing from the network.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from softshadow import techniques
from softshadow.inspection import Ledger, Step, Steps
from softshadow.inspection.files import write_whole
from softshadow.inspection.step import shown_buffers
from softshadow.report.commands import heading, options_spelled
from softshadow.report.page import depth_caption, legend, map_note, write_page
from softshadow.report.slide_pictures import digits, marked_picture, plain_picture
from softshadow.report.slide_view import SlideView, counts_anywhere, slide_view
from softshadow.report.state_changes import GONE, NEW, marked_calls
from softshadow.scene import Scene

# set for every object, or the same in every step: they would hide what the step is about
LEFT_OUT = re.compile(
    r"glMaterial|glLoadMatrix|glMatrixMode|glClearColor|glScissor|glTexEnv|glActiveTexture|glEnable\(GL_NORMALIZE"
    r"|glDisable\(|glBindTexture\(\w+, 0\)"
)
CALL_LINES, CALL_WIDTH = 26, 62  # that fit on a slide in two columns: lines, characters in each
FEW_CALLS = 10  # that fit in one column of larger letters
# of the words, in em: sizes, the room with and without pictures beside them, the mean letter, the distance of lines
LETTERS, NARROW, WIDE, HIGH = (1.45, 1.15, 0.95, 0.8, 0.65), 29, 59, 29
LETTER, LINE = 0.55, 1.4
SHOWN_MAPS = 2


class SlideRun(Protocol):
    """What slides are made from; a `Run` is one."""

    @property
    def technique(self) -> str:
        """Its name."""

    @property
    def scene(self) -> Scene | None:
        """The scene, or None for a recorded program."""

    @property
    def options(self) -> Mapping[str, Any]:
        """All options."""

    @property
    def steps(self) -> Steps:
        """The steps."""

    @property
    def ledger(self) -> Ledger:
        """The work of every step."""

    def explain(self, x: int, y: int) -> str:
        """Return why a pixel is lit or in shadow."""


@dataclass(frozen=True)
class Slide:
    """One slide. Texts with HTML: `words`, `figures` (drawing, caption); all others are plain."""

    title: str
    words: str = ""
    figures: tuple[tuple[str, str], ...] = ()
    calls: tuple[tuple[str, str], ...] = ()  # (call, "new" or "gone")
    left_out: int = 0  # calls that have no room
    notes: tuple[str, ...] = ()

    @property
    def letters(self) -> float:
        """The size of the words in em: the largest in which they fit."""
        if "<table" in self.words:
            return 1.0
        paragraphs = [re.sub(r"<.*?>", "", each) for each in re.split(r"</p>|</li>", self.words)]
        for size in LETTERS[1 if self.figures else 0 :]:
            in_line = (NARROW if self.figures else WIDE) / (LETTER * size)
            lines = sum(-(-len(each) // in_line) + 0.5 for each in paragraphs)
            if lines * LINE * size <= HIGH:
                return size
        return LETTERS[-1]

    @property
    def few_calls(self) -> bool:
        """Whether there is room for larger letters."""
        return len(self.calls) <= FEW_CALLS and all(len(call) <= CALL_WIDTH for call, _ in self.calls)


@dataclass(frozen=True, repr=False)
class Slides:
    """Slides, to be saved as one file.

    Attributes
    ----------
    title : str                  of the page
    slides : tuple               of Slide
    """

    title: str
    slides: tuple[Slide, ...]

    def __len__(self) -> int:
        return len(self.slides)

    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the slides to one HTML file, and return its path.

        The arrow keys show the next and the previous slide, F fills the screen; printed, each slide is a page.

        Raises
        ------
        ValueError                   another file name extension
        SoftShadowError              a file exists that this package did not write (`force` overwrites it), or the place
                                     cannot be written; no half-written file is left
        """
        check_path(path)
        return write_whole(
            Path(path), lambda file: write_page(file, "slides.html", title=self.title, slides=self.slides), force
        )

    def __repr__(self) -> str:
        return f"Slides({self.title!r}, {len(self)} slides)"


def check_path(path: str | os.PathLike[str]) -> None:
    """Raise an error if slides cannot have this file name; called before a long drawing."""
    if Path(path).suffix.lower() != ".html":
        raise ValueError(f"{path}: expected a name that ends in .html")


def slides(run: SlideRun) -> Slides:
    """Return the slides of a run: a title, one slide for each step, a question about a pixel, and the answer.

    Parameters
    ----------
    run : Run                    320x240 pixels are enough: a slide enlarges them

    Examples
    --------
    >>> import softshadow as ss
    >>> ss.slides(ss.run("volume-zfail", "torus", (320, 240)))
    Slides('volume-zfail on torus', 7 slides)
    """
    title = heading(run.technique, run.scene, run.options)
    view = slide_view(run.steps)
    return Slides(title, (_title_slide(run, title, view), *step_slides(run, view), *_question_slides(run, view)))


def step_slides(run: SlideRun, view: SlideView | None = None, notes: Sequence[str] = ()) -> list[Slide]:
    """Return a slide for each step.

    Parameters
    ----------
    notes : sequence             for each step a sentence of HTML that comes first among what there is to notice
    """
    view = view or slide_view(run.steps)
    counted = counts_anywhere(run.steps)
    made, before = [], list[str]()
    for step, words in zip(run.steps, notes or [""] * len(run.steps), strict=True):
        now = step.state.calls()
        calls, left_out = shown_calls(before, now)
        facts = [f"<b>{words}</b>"] if words else []
        facts += [escape(fact) for fact in (*_facts(run, step), *_pixel_facts(run.steps, step, view))]
        made.append(Slide(
            f"{step.index}  {step.title}", figures=_figures(step, view, counted), calls=calls, left_out=left_out,
            notes=tuple(facts),
        ))  # fmt: skip
        before = now
    return made


def shown_calls(before: Sequence[str], now: Sequence[str]) -> tuple[tuple[tuple[str, str], ...], int]:
    """Return the calls that change the state, as many as fit on a slide, and the number of the others.

    Calls that set matrices and materials are left out. A value that another one replaces is not named as gone.

    Examples
    --------
    >>> shown_calls(["glEnable(GL_LIGHTING)", "glDepthFunc(GL_LESS)"], ["glDepthFunc(GL_LEQUAL)"])
    ((('glDepthFunc(GL_LEQUAL)', 'new'), ('glEnable(GL_LIGHTING)', 'gone')), 0)
    """
    changed = [each for each in marked_calls(before, now) if each[1] in (NEW, GONE) and not LEFT_OUT.match(each[0])]
    set_now = {_subject(call) for call, kind in changed if kind == NEW}
    changed = [(call, kind) for call, kind in changed if kind == NEW or _subject(call) not in set_now]
    lines, shown = 0, list[tuple[str, str]]()
    for call, kind in changed:
        lines += -(-len(call) // CALL_WIDTH)
        if lines > CALL_LINES:
            break
        shown.append((call, kind))
    return tuple(shown), len(changed) - len(shown)


def _subject(call: str) -> str:
    """Return what a call sets: its name, and the switch or parameter where one function sets several."""
    name, _, arguments = call.partition("(")
    several = name in ("glEnable", "glDisable") or name.startswith(("glTexParameter", "glLight", "glBind"))
    return f"{name}({arguments.rsplit(',', 1)[0] if ',' in arguments else arguments}" if several else name


def _title_slide(run: SlideRun, title: str, view: SlideView) -> Slide:
    known = run.technique in techniques.names()
    words = ""
    if known:
        technique = techniques.get(run.technique)
        idea = [" ".join(paragraph.split()) for paragraph in technique.description.split("\n\n")[:2]]
        words = "".join(f"<p>{escape(each)}</p>" for each in idea)
        words += f"<p class='quiet'>{escape(technique.paper)}</p>" if technique.paper else ""
        changed = options_spelled(run.technique, run.options)
        words += f"<p class='quiet'>Options:{escape(changed)}</p>" if changed else ""
    words += "<ol start='0'>" + "".join(f"<li>{escape(step.title)}</li>" for step in run.steps) + "</ol>"
    picture = marked_picture(run.steps[-1].image, view, f"the picture of {title}")
    framed = "in the frame: the part that the slides enlarge; in the ring: the pixel that they follow"
    return Slide(title, words, ((picture, framed),))


def _question_slides(run: SlideRun, view: SlideView) -> list[Slide]:
    """Return the question why the chosen pixel looks as it does, and the answer; nothing without a scene."""
    if run.scene is None or "visibility" not in run.steps.maps:
        return []
    visible = float(run.steps.maps["visibility"][view.y, view.x])
    question = f"Why is pixel x={view.x}, y={view.y} {'lit' if visible > 0.5 else 'in shadow'}?"
    picture = (marked_picture(run.steps[-1].image, view, "the picture, the pixel in a ring"), "after the last step")
    return [
        Slide(question, "", (picture,)),
        Slide(question, f"<p>{escape(run.explain(view.x, view.y))}</p>", (picture,)),
    ]


def _figures(step: Step, view: SlideView, counted: bool) -> tuple[tuple[str, str], ...]:
    after = f"after step {step.index}, {step.title}"
    pictures = dict(shown_buffers(step))
    figures = list[tuple[str, str]]()
    if "colour" in pictures:
        figures.append((marked_picture(pictures.pop("colour"), view, f"colour {after}"), "colour"))
    depth, stencil = pictures.pop("depth", None), pictures.pop("stencil", None)
    if counted and stencil is not None:
        numbers = ", ".join(f"{count}: {pixels}" for count, _, pixels in legend(step.stencil))
        caption = f"stencil, part in the frame; in all pixels {numbers}"
        figures.append((digits(step.stencil, view, f"stencil counts {after}, in a part of the picture"), caption))
    elif depth is not None:
        figures.append((plain_picture(depth, f"depth {after}"), depth_caption(step.depth)))
    maps = [(name, picture) for name, picture in pictures.items() if name.split(":")[0] not in ("valid", "unknown")]
    for name, picture in maps[:SHOWN_MAPS]:
        note = map_note(name)
        figures.append((plain_picture(picture, f"map {name} {after}"), f"map {name}" + (f": {note}" if note else "")))
    return tuple((drawing, escape(caption)) for drawing, caption in figures)


def _facts(run: SlideRun, step: Step) -> list[str]:
    """Return what the step drew, and at how many pixels it changed each buffer."""
    counts = run.ledger.steps[step.index]
    drawn = f"Drawn: {counts.triangles} triangles, {counts.all_fragments} fragments"
    failed = [f"{pixels} {verdict}" for verdict, pixels in counts.fragments.items() if "failed" in verdict and pixels]
    facts = ["; ".join([drawn, *failed]) + "."] if counts.draws else []
    if step.index == 0:
        return facts
    before = run.steps[step.index - 1]
    pixels = {
        "colour": int((step.image != before.image).any(axis=2).sum()),
        "depth": int((step.depth != before.depth).sum()),
        "stencil": int((step.stencil != before.stencil).sum()),
    }
    changes = [f"{name} at {number} pixels" for name, number in pixels.items() if number]
    return [*facts, f"Changed: {', '.join(changes)}." if changes else "No buffer of the window changes."]


def _pixel_facts(steps: Steps, step: Step, view: SlideView) -> list[str]:
    """Return the values of the chosen pixel before and after the step, those that change."""
    if not step.index:
        return []
    y, x, before = view.y, view.x, steps[step.index - 1]
    parts = []
    if (step.image[y, x] != before.image[y, x]).any():
        parts.append(f"colour {_color(before.image[y, x])} → {_color(step.image[y, x])}")
    if step.depth[y, x] != before.depth[y, x]:
        parts.append(f"depth {before.depth[y, x]:.6g} → {step.depth[y, x]:.6g}")
    if step.stencil[y, x] != before.stencil[y, x]:
        parts.append(f"stencil {before.stencil[y, x]} → {step.stencil[y, x]}")
    return [f"The ringed pixel: {', '.join(parts) if parts else 'unchanged'}."]


def _color(rgb: np.ndarray) -> str:
    return "#{:02x}{:02x}{:02x}".format(*rgb)
