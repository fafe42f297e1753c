"""The pictures of slides, as SVG that prints sharply: a picture with a marked part, and the counts of that part."""

from __future__ import annotations

from html import escape

import numpy as np

from softshadow.inspection.pictures import stencil_palette
from softshadow.report.page import data_url
from softshadow.report.slide_view import SlideView

CELL = 10  # units of the drawing for each cell of counts
MARK = "#d55e00"  # Okabe & Ito's vermilion, with white beside it
NEGATIVE_FROM = 251  # counts that a counter which wraps has below 0 (as in reports)
LIGHT = 128  # luminance from which black digits are easier to read than white ones


def marked_picture(picture: np.ndarray, view: SlideView, alt: str) -> str:
    """Return a picture (H, W, 3) with a frame around the part and a ring around the pixel."""
    height, width = picture.shape[:2]
    line = width / 320
    part = f'x="{view.left}" y="{view.top}" width="{view.width}" height="{view.height}" fill="none"'
    ring = f'cx="{view.x + 0.5}" cy="{view.y + 0.5}" r="{4 * line:g}" fill="none"'
    marks = "".join(
        f'<rect {part} stroke="{color}" stroke-width="{wide * line:g}"/>'
        f'<circle {ring} stroke="{color}" stroke-width="{wide * line:g}"/>'
        for color, wide in (("#fff", 3), (MARK, 1.5))
    )
    return _svg(width, height, alt, _image(picture) + marks)


def plain_picture(picture: np.ndarray, alt: str) -> str:
    """Return a picture (H, W) or (H, W, 3) as it is."""
    height, width = picture.shape[:2]
    return _svg(width, height, alt, _image(picture))


def digits(stencil: np.ndarray, view: SlideView, alt: str) -> str:
    """Return the counts of the part, one cell for each pixel, with a frame around the pixel."""
    counts = view.part_of(stencil)
    dark = stencil_palette().astype(np.float64) @ (0.299, 0.587, 0.114) < LIGHT
    cells = []
    for (row, column), count in np.ndenumerate(counts.astype(np.int64)):
        text = count - 256 if count >= NEGATIVE_FROM else count
        small = ' class="s"' if len(str(text)) > 2 else ""
        color = ' fill="#fff"' if dark[count] else ""
        cells.append(f'<text x="{CELL * column + 5}" y="{CELL * row + 7.4:g}"{small}{color}>{text}</text>')
    x, y = CELL * (view.x - view.left), CELL * (view.y - view.top)
    ring = "".join(
        f'<rect x="{x}" y="{y}" width="{CELL}" height="{CELL}" fill="none" stroke="{color}" stroke-width="{wide}"/>'
        for color, wide in (("#fff", 3), (MARK, 1.6))
    )
    width, height = CELL * view.width, CELL * view.height
    body = _image(counts, (width, height)) + f'<g class="digits">{"".join(cells)}</g>' + ring
    return _svg(width, height, alt, body)


def _image(picture: np.ndarray, size: tuple[int, int] | None = None) -> str:
    width, height = size or (picture.shape[1], picture.shape[0])
    return f'<image href="{data_url(picture)}" width="{width}" height="{height}" preserveAspectRatio="none"/>'


def _svg(width: int, height: int, alt: str, body: str) -> str:
    return f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{escape(alt)}">{body}</svg>'
