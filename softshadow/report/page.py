"""What the pages have in common: templates, and the pictures, state and draws of each step."""

from __future__ import annotations

import base64
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import softshadow
from softshadow.inspection import Step, Steps
from softshadow.inspection.files import MARK
from softshadow.inspection.pictures import (
    depth_picture,
    is_visibility,
    map_pictures,
    png,
    save_png,
    stencil_palette,
)

if TYPE_CHECKING:
    from jinja2 import Environment

# what maps hold, by the first word of their name
MAP_NOTES = {
    "visibility": "1 lit, 0 in shadow",
    "valid": "yes where a visibility is defined",
    "unknown": "yes where the map does not reach",
    "ZS": "depth map, seen from the light",
}
SHOWN_COUNTS = 8  # rows of a legend; the remaining counts are summed in one row
PictureWriter = Callable[[np.ndarray, str], str]  # stores a picture under a name and returns its URL


@dataclass(frozen=True)
class Figure:
    """A picture of a page: its URL and size, a description, and a caption."""

    url: str
    size: tuple[int, int]  # pixels: with it the browser keeps the layout stable while pictures load
    alt: str
    caption: str
    counts: tuple[tuple[str, str, int], ...] = ()  # legend of a stencil picture: (count, colour, pixels)


@dataclass(frozen=True)
class Section:
    """One step of a page."""

    index: int
    title: str
    figures: tuple[Figure, ...]
    state: str
    draws: tuple[str, ...]


@cache
def environment() -> Environment:
    """Return the templates' environment; text that templates print is escaped."""
    from jinja2 import Environment, PackageLoader

    templates = Environment(
        loader=PackageLoader("softshadow.report"), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    templates.globals.update(mark=MARK, version=softshadow.__version__)
    return templates


def write_page(path: Path, template: str, **values: Any) -> None:
    """Write the page that a template gives with these values."""
    path.write_text(environment().get_template(template).render(**values), encoding="utf-8")


def named(warnings: Sequence[Warning]) -> list[str]:
    """Return warnings as text, each with the name of its class."""
    return [f"{type(each).__name__}: {each}" for each in warnings]


def map_note(name: str) -> str:
    """Return what a map holds, in words; empty if its name says so."""
    return MAP_NOTES.get(name.replace(":", "").split()[0], "")


def data_url(picture: np.ndarray, name: str = "") -> str:
    """Return a picture as a data URL (a `PictureWriter` that needs no file)."""
    return f"data:image/png;base64,{base64.b64encode(png(picture)).decode()}"


def folder_writer(folder: Path) -> PictureWriter:
    """Return a function that writes pictures to a folder; their URLs are relative to the folder's parent."""

    def write(picture: np.ndarray, name: str) -> str:
        save_png(picture, folder / f"{name}.png")
        return f"{folder.name}/{name}.png"

    return write


def sections(steps: Steps, write: PictureWriter) -> list[Section]:
    """Return a section for each step; its pictures are written with `write`."""
    return [
        Section(
            step.index,
            step.title,
            tuple(_figures(step, write)),
            str(step.state),
            tuple(f"{draw.object}: {draw.triangles} triangles" for draw in step.draws),
        )
        for step in steps
    ]


def _figures(step: Step, write: PictureWriter) -> list[Figure]:
    after = f"after step {step.index}, {step.title}"

    def figure(name: str, picture: np.ndarray, alt: str, caption: str, **more: Any) -> Figure:
        height, width = picture.shape[:2]
        return Figure(write(picture, f"{step.index:02d}-{name}"), (width, height), f"{alt} {after}", caption, **more)

    figures = [
        figure("colour", step.image, "colour", "colour"),
        figure("depth", depth_picture(step.depth), "depth", depth_caption(step.depth)),
        figure("stencil", step.stencil, "stencil counts", "stencil", counts=legend(step.stencil)),
    ]
    for number, (name, picture) in enumerate(map_pictures(step.maps).items()):
        note = f" ({map_note(name)})" if map_note(name) else ""
        caption = f"map: {name}{note}, {picture.shape[1]} x {picture.shape[0]}"
        if is_visibility(name):
            caption += "; white lit, black in shadow, blue where not defined"
        figures.append(figure(f"map{number}", picture, f"map {name}", caption))
    return figures


def depth_caption(depth: np.ndarray) -> str:
    """Return the range of depths that a picture is stretched over."""
    drawn = depth[depth < 1]
    return f"depth (window z), {drawn.min():.4f} to {drawn.max():.4f}" if drawn.size else "depth (window z), all clear"


def legend(stencil: np.ndarray) -> tuple[tuple[str, str, int], ...]:
    """Return (count, colour, number of pixels) for the counts of a stencil buffer."""
    palette = stencil_palette()
    counts, pixels = np.unique(stencil, return_counts=True)
    rows = [(str(c), "#{:02x}{:02x}{:02x}".format(*palette[c]), int(p)) for c, p in zip(counts, pixels, strict=True)]
    rest = sum(p for _, _, p in rows[SHOWN_COUNTS:])
    return (*rows[:SHOWN_COUNTS], *((("more", "transparent", rest),) if rest else ()))
