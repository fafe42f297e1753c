"""The history of a pixel: every fragment generated there, in order, with the test that decided its fate.

At the pixel every fragment is shaded, tested and blended by the same functions that draw the picture. The last row
therefore equals the buffers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from softshadow.context import Frame
from softshadow.framebuffer import DEFAULT
from softshadow.image import Image
from softshadow.inspection.follower import Follower, images_in
from softshadow.inspection.history_row import HistoryRow
from softshadow.inspection.history_table import heads_and_cells, html_of, text_of
from softshadow.inspection.timeline import timeline_of


@dataclass(frozen=True)
class PixelHistory:
    """All rows of one pixel, in order; x counts from the left, y from the top, and `gl_y` from the bottom.

    `where` names what the pixel belongs to, if it is not the window; `kind` is "pixel" or "texel".
    """

    x: int
    y: int
    gl_y: int
    rows: tuple[HistoryRow, ...]
    where: str = ""
    kind: str = "pixel"

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[HistoryRow]:
        return iter(self.rows)

    def __getitem__(self, index: int) -> HistoryRow:
        return self.rows[index]

    def __repr__(self) -> str:
        return f"PixelHistory({self.heading}, {len(self)} rows)"

    def to_dicts(self) -> list[dict[str, Any]]:
        """Return the rows as plain dictionaries, for JSON; the fields are those of `HistoryRow`."""
        return [asdict(row) for row in self.rows]

    @property
    def heading(self) -> str:
        """The pixel in both row orders."""
        of = f" of {self.where}" if self.where else ""
        return f"{self.kind} x={self.x} y={self.y} (GL y={self.gl_y}){of}"

    def __str__(self) -> str:
        return f"{self.heading}\n{text_of(*heads_and_cells(self.rows))}"

    def _repr_html_(self) -> str:
        return f"<p>{self.heading}</p>" + html_of(*heads_and_cells(self.rows))


def pixel_history(frame: Frame, x: int, y: int, framebuffer: int = DEFAULT, lights: Sequence[str] = ()) -> PixelHistory:
    """Return the history of a pixel of a framebuffer.

    Parameters
    ----------
    x, y : int                   column, and row from the top
    framebuffer : int            its name; the window by default. Where its size has changed, the last one counts
    lights : names               of GL_LIGHT0, GL_LIGHT1 ...

    Raises
    ------
    ValueError                   outside the framebuffer, or not whole numbers; or nothing was drawn to it
    """
    timeline = timeline_of(frame)
    targets = [event.target for event in timeline.events if event.target and event.target.name == framebuffer]
    if framebuffer == DEFAULT:
        targets = [timeline.window]
    if not targets:
        names = sorted({event.target.name for event in timeline.events if event.target is not None})
        raise ValueError(f"framebuffer={framebuffer}: nothing was drawn to it; expected one of {names}")
    width, height = targets[-1].size
    check_pixel(x, y, width, height)
    row = int(y) if targets[0].flipped else height - 1 - int(y)
    images = {id(image): image for target in targets for image in images_in(target)}
    rows = Follower(timeline, row, int(x), tuple(lights)).rows(list(images.values()), framebuffer=framebuffer)
    where = "" if framebuffer == DEFAULT else f"framebuffer {framebuffer}"
    return PixelHistory(int(x), int(y), height - 1 - int(y), tuple(rows), where)


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
    rows = Follower(timeline_of(frame), row, int(x), tuple(lights)).rows([image], before)
    return PixelHistory(int(x), int(y), row, tuple(rows), where, "texel")


def check_pixel(x: Any, y: Any, width: int, height: int) -> None:
    """Raise a ValueError unless x and y are whole numbers inside a picture."""
    for name, value, end in (("x", x, width), ("y", y, height)):
        if isinstance(value, bool) or not isinstance(value, int | np.integer) or not 0 <= value < end:
            raise ValueError(f"{name}={value!r}: expected a whole number from 0 to {end - 1}")
