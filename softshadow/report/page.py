"""The report of one run: every step's pictures, state and counts, and the exact values under the pointer."""

from __future__ import annotations

import base64
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import softshadow
from softshadow.inspection.files import MARK
from softshadow.inspection.pictures import (
    color_picture,
    depth_picture,
    is_visibility,
    map_pictures,
    save_png,
    stencil_palette,
    stencil_picture,
)
from softshadow.report.commands import options_spelled, scene_spelled

if TYPE_CHECKING:
    from jinja2 import Environment
    from PIL.Image import Image as Picture

    from softshadow.inspection import Step
    from softshadow.run import Run

SHOWN_COUNTS = 8  # of a histogram; the rest is summed up
Placed = Callable[["Picture", str], str]  # what puts a picture somewhere and returns the URL that shows it


@dataclass(frozen=True)
class Figure:
    """A picture of a page: where it is, how large, what it shows in words, and a caption."""

    url: str
    size: tuple[int, int]  # pixels: a page that knows them does not jump while pictures are loaded
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
    """Return the templates; what they print is escaped."""
    from jinja2 import Environment, PackageLoader

    made = Environment(loader=PackageLoader("softshadow.report"), autoescape=True, trim_blocks=True, lstrip_blocks=True)
    made.globals.update(mark=MARK, version=softshadow.__version__)
    return made


def write(run: Run, path: Path) -> None:
    """Write the report of a run as one file."""
    page = (
        environment()
        .get_template("run.html")
        .render(
            run=run,
            heading=f"{run.technique} on {run.scene.name}",
            sections=sections(run, inline),
            warnings=named(run.warnings),
            ledger=run.ledger.to_dicts(),
            again=scene_spelled(run.scene, run.size) + options_spelled(run),
            buffers=[packed(step) for step in run.steps],
        )
    )
    path.write_text(page, encoding="utf-8")


def named(warnings: Sequence[Warning]) -> list[str]:
    """Return warnings as text, each with the name of its class."""
    return [f"{type(each).__name__}: {each}" for each in warnings]


def inline(picture: Picture, name: str) -> str:
    """Return a picture as a data URL."""
    png = BytesIO()
    picture.save(png, "PNG")
    return f"data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}"


def beside(folder: Path) -> Placed:
    """Return what writes pictures into a folder and gives their names back, relative to the page above it."""

    def place(picture: Picture, name: str) -> str:
        save_png(picture, folder / f"{name}.png")
        return f"{folder.name}/{name}.png"

    return place


def sections(run: Run, place: Placed) -> list[Section]:
    """Return the steps of a run with their pictures placed."""
    return [
        Section(
            step.index,
            step.title,
            tuple(_figures(step, place)),
            str(step.state),
            tuple(f"{draw.object}: {draw.triangles} triangles" for draw in step.draws),
        )
        for step in run.steps
    ]


def _figures(step: Step, place: Placed) -> list[Figure]:
    start = f"{step.index:02d}"
    after = f"after step {step.index}, {step.title}"

    def figure(name: str, picture: Picture, alt: str, caption: str, **more: Any) -> Figure:
        return Figure(place(picture, f"{start}-{name}"), picture.size, f"{alt} {after}", caption, **more)

    figures = [
        figure("colour", color_picture(step.image), "colour", "colour"),
        figure("depth", depth_picture(step.depth), "depth", depth_caption(step.depth)),
        figure("stencil", stencil_picture(step.stencil), "stencil counts", "stencil", counts=legend(step.stencil)),
    ]
    for number, (name, picture) in enumerate(map_pictures(step.maps).items()):
        caption = f"map: {name}, {picture.width} x {picture.height}"
        if is_visibility(name):
            caption += "; white lit, black in shadow, blue where not defined"
        figures.append(figure(f"map{number}", picture, f"map {name}", caption))
    return figures


def depth_caption(depth: np.ndarray) -> str:
    """Return the range of depths that a picture is stretched over."""
    drawn = depth[depth < 1]
    return f"depth (window z), {drawn.min():.4f} to {drawn.max():.4f}" if drawn.size else "depth (window z), all clear"


def legend(stencil: np.ndarray) -> tuple[tuple[str, str, int], ...]:
    """Return (count, colour, pixels) for the counts of a stencil buffer."""
    palette = stencil_palette()
    counts, pixels = np.unique(stencil, return_counts=True)
    rows = [(str(c), "#{:02x}{:02x}{:02x}".format(*palette[c]), int(p)) for c, p in zip(counts, pixels, strict=True)]
    rest = sum(p for _, _, p in rows[SHOWN_COUNTS:])
    return (*rows[:SHOWN_COUNTS], *((("more", "transparent", rest),) if rest else ()))


def packed(step: Step) -> dict[str, Any]:
    """Return the exact buffers of a step, deflated, for the page's script: colour, depth (bytes shuffled), stencil."""
    depth = np.ascontiguousarray(step.depth, np.float32)
    shuffled = np.ascontiguousarray(depth.view(np.uint8).reshape(-1, 4).T)
    planes = {"colour": step.image, "depth": shuffled, "stencil": step.stencil}
    return {
        name: base64.b64encode(zlib.compress(np.ascontiguousarray(plane).tobytes(), 9)).decode()
        for name, plane in planes.items()
    }
