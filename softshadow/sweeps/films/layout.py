"""The pictures of a film: the panels of a frame in a grid, each under its title, and a caption below.

All frames of a film have the same size, with even sides, as most video formats need them.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from softshadow.inspection.pictures import GAP, LABEL_COLOR, fitted
from softshadow.sweeps.films.panels import Limits, Panel, panel_picture

MOST_COLUMNS = 4
PAPER = 255  # the grey of the ground
MARGIN = 4  # pixels beside a text
SMALLEST_TEXT, LARGEST_TEXT, WIDTH_PER_TEXT = 10, 20, 24  # pixels; a picture 320 wide has text of 13
LINE = 1.4  # height of a line of text, in sizes of the text


@cache
def _font(size: int) -> Any:
    """Return Pillow's own font, so that no font of the machine changes the picture."""
    from PIL import ImageFont

    return ImageFont.load_default(size)


def text_size(width: int) -> int:
    """Return the size of the text, in pixels, for a picture of a width."""
    return min(max(width // WIDTH_PER_TEXT, SMALLEST_TEXT), LARGEST_TEXT)


def line_height(size: int) -> int:
    """Return the height of a line of text, in pixels."""
    return round(LINE * size)


def text_width(text: str, size: int) -> float:
    """Return the width of a text, in pixels."""
    return float(_font(size).getlength(text))


def wrapped(parts: Sequence[str], size: int, width: int) -> list[str]:
    """Return the parts of a caption in as few lines as fit the width; a part longer than a line is broken."""
    lines: list[str] = []
    for part in parts:
        joined = f"{lines[-1]}   {part}" if lines else part
        if lines and text_width(joined, size) <= width:
            lines[-1] = joined
        else:
            lines += broken(part, size, width)
    return lines


def broken(text: str, size: int, width: int) -> list[str]:
    """Return a text in lines of at most a width in pixels, broken between words, and inside a word only if it must."""
    lines = [""]
    for word in text.split():
        joined = f"{lines[-1]} {word}".lstrip()
        if text_width(joined, size) <= width:
            lines[-1] = joined
            continue
        lines += [""] if lines[-1] else []
        for character in word:
            if lines[-1] and text_width(lines[-1] + character, size) > width:
                lines.append("")
            lines[-1] += character
    return lines


class Layout:
    """The grid that all frames of a film share.

    Parameters
    ----------
    frames                       the panels of every frame; the grid has room for the largest number of them
    captions                     the parts of the caption of every frame; none at all without captions
    size : (width, height)       of a panel, in pixels; panels of another shape are fitted in
    """

    def __init__(
        self, frames: Sequence[Sequence[Panel]], captions: Sequence[Sequence[str]], size: tuple[int, int]
    ) -> None:
        n_panels = max(map(len, frames))
        self.panel_width, self.panel_height = size
        self.n_columns = min(n_panels, MOST_COLUMNS)
        n_rows = -(-n_panels // self.n_columns)
        self.width = even(self.n_columns * (self.panel_width + GAP) - GAP)
        self.title_size = text_size(self.panel_width)
        titles = {panel.title for panels in frames for panel in panels} if n_panels > 1 else set()
        self.titles = {each: broken(each, self.title_size, self.panel_width - 2 * MARGIN) for each in titles}
        self.title_height = max(map(len, self.titles.values()), default=0) * line_height(self.title_size)
        self.row_height = self.title_height + self.panel_height + GAP
        self.caption_top = n_rows * self.row_height - GAP
        self.caption_size = text_size(self.width)
        room = self.width - 2 * MARGIN
        self.captions = [wrapped(parts, self.caption_size, room) for parts in captions]
        n_lines = max(map(len, self.captions), default=0)
        self.height = even(self.caption_top + n_lines * line_height(self.caption_size))

    def picture(self, frame: int, panels: Sequence[Panel], limits: Limits) -> np.ndarray:
        """Return a frame of the film, (height, width, 3) uint8."""
        from PIL import Image, ImageDraw

        canvas = np.full((self.height, self.width, 3), PAPER, np.uint8)
        texts = []
        for index, panel in enumerate(panels):
            row, column = divmod(index, self.n_columns)
            left, top = column * (self.panel_width + GAP), row * self.row_height
            for number, line in enumerate(self.titles.get(panel.title, ())):
                texts.append((left, top + number * line_height(self.title_size), self.title_size, line))
            shown = fitted(panel_picture(panel, limits), self.panel_width, self.panel_height)
            top += self.title_height
            canvas[top : top + shown.shape[0], left : left + shown.shape[1]] = shown
        for number, line in enumerate(self.captions[frame] if self.captions else ()):
            texts.append((0, self.caption_top + number * line_height(self.caption_size), self.caption_size, line))
        image = Image.fromarray(canvas)
        draw = ImageDraw.Draw(image)
        for left, top, text_pixels, text in texts:
            middle = top + line_height(text_pixels) / 2
            draw.text((left + MARGIN, middle), text, fill=LABEL_COLOR, font=_font(text_pixels), anchor="lm")
        return np.asarray(image)


def even(length: int) -> int:
    """Return a length in pixels, or one more if it is odd."""
    return length + length % 2
