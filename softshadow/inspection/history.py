"""The history of a pixel: every fragment generated there, in order, with the test that decided its fate.

At the pixel every fragment is shaded, tested and blended by the same functions that draw the picture. The last row
therefore equals the buffers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any

import numpy as np

from softshadow.context import Frame
from softshadow.framebuffer import DEFAULT
from softshadow.image import Image
from softshadow.inspection.follower import Follower, draws_to, writes
from softshadow.inspection.history_row import HistoryRow
from softshadow.inspection.history_table import heads_and_cells, html_of, text_of
from softshadow.inspection.timeline import Timeline, timeline_of


@dataclass(frozen=True)
class PixelHistory:
    """All rows of one pixel, in order; x counts from the left, y from the top, and `gl_y` from the bottom.

    `where` names what the pixel belongs to, if it is not the window.
    """

    x: int
    y: int
    gl_y: int
    rows: tuple[HistoryRow, ...]
    where: str = ""

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[HistoryRow]:
        return iter(self.rows)

    def __getitem__(self, index: int) -> HistoryRow:
        return self.rows[index]

    def to_dicts(self) -> list[dict[str, Any]]:
        """Return the rows as plain dictionaries, for JSON; the fields are those of `HistoryRow`."""
        return [asdict(row) for row in self.rows]

    @property
    def heading(self) -> str:
        """The pixel in both row orders."""
        kind, of = ("texel", f" of {self.where}") if self.where else ("pixel", "")
        return f"{kind} x={self.x} y={self.y} (GL y={self.gl_y}){of}"

    def __str__(self) -> str:
        return f"{self.heading}\n{text_of(*heads_and_cells(self.rows))}"

    def _repr_html_(self) -> str:
        return f"<p>{self.heading}</p>" + html_of(*heads_and_cells(self.rows))


def pixel_history(frame: Frame, x: int, y: int, framebuffer: int = DEFAULT, lights: Sequence[str] = ()) -> PixelHistory:
    """Return the history of a pixel of a framebuffer.

    Parameters
    ----------
    x, y : int                   column, and row from the top
    framebuffer : int            its name; the window by default
    lights : names               of GL_LIGHT0, GL_LIGHT1 ...

    Raises
    ------
    ValueError                   outside the framebuffer, or not whole numbers; or nothing was drawn to it
    """
    timeline = timeline_of(frame)
    targets = {event.index: event.target for event in timeline.events if draws_to(event, framebuffer)}
    if framebuffer == DEFAULT:
        width, height = frame.size
    elif not targets:
        raise ValueError(f"framebuffer={framebuffer}: nothing was drawn to it; expected {_framebuffers(timeline)}")
    else:
        width, height = np.max([target.size for target in targets.values() if target], axis=0)
    check_pixel(x, y, int(width), int(height))
    flipped = framebuffer == DEFAULT
    row = int(y) if flipped else int(height) - 1 - int(y)
    follower = Follower(timeline, row, int(x), tuple(lights))
    rows = follower.rows(partial(draws_to, framebuffer=framebuffer))
    where = "" if flipped else f"framebuffer {framebuffer}"
    return PixelHistory(int(x), int(y), int(height) - 1 - int(y), tuple(rows), where)


def texel_history(
    frame: Frame, image: Image, x: int, y: int, before: int, where: str, lights: Sequence[str] = ()
) -> PixelHistory:
    """Return the history of a texel.

    Parameters
    ----------
    image : Image                what stands for the texture's image in the frame's timeline
    x, y : int                   column, and row from the top
    before : int                 the number of commands that count
    where : str                  the name of the texture, in words

    Raises
    ------
    ValueError                   outside the texture, or not whole numbers
    """
    check_pixel(x, y, image.width, image.height)
    row = image.height - 1 - int(y)
    follower = Follower(timeline_of(frame), row, int(x), tuple(lights))
    return PixelHistory(int(x), int(y), row, tuple(follower.rows(partial(writes, image=image), before)), where)


def check_pixel(x: Any, y: Any, width: int, height: int) -> None:
    """Raise a ValueError unless x and y are whole numbers inside a picture."""
    for name, value, end in (("x", x, width), ("y", y, height)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 0 <= value < end:
            raise ValueError(f"{name}={value!r}: expected a whole number from 0 to {end - 1}")


def _framebuffers(timeline: Timeline) -> str:
    names = sorted({event.target.name for event in timeline.events if event.target is not None})
    return "one of " + ", ".join(map(str, names))
