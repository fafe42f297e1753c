"""Counting cards on pages, drawn with matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from textwrap import wrap
from typing import Any

import numpy as np

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import MARK
from softshadow.report.counting_card import CountingCard

WIDTH, HEIGHT = 8.27, 11.69  # inches: A4
ROWS = 3  # cards on a page
MARGIN = 0.35  # inches round each card
SECTION = (WIDTH - 3.6 - MARGIN, 2.16)  # inches
DOTS = 130  # per inch of a PNG
LIGHT, CASTER, RECEIVER, VOLUME, RAY = "#b8860b", "#7a4a2b", "#666666", "#1f4e9c", "#b3261e"  # as in cross-sections
INK, CUT = "#222222", "#999999"


def save_cards(image: np.ndarray, cards: Sequence[CountingCard], path: Path) -> None:
    """Write cards as a PDF with fronts and backs on alternate pages, or as a PNG with backs at the right.

    Raises
    ------
    SoftShadowError              matplotlib is not installed; the message says how to install it
    """
    try:
        import matplotlib.backends.backend_pdf  # noqa: F401  # a build without it fails here, too
    except ImportError:
        raise SoftShadowError("counting cards need matplotlib: pip install 'softshadow[notebook]'") from None
    if path.suffix.lower() == ".pdf":
        _save_pdf(image, cards, path)
    else:
        figure = _figure(2 * WIDTH, len(cards) * HEIGHT / ROWS)
        for row, card in enumerate(cards):
            _draw_front(figure, (0, row), len(cards), card, image)
            _draw_back(figure, (1, row), len(cards), card)
        figure.savefig(path, dpi=DOTS, metadata={"Software": None, "Comment": MARK})


def _save_pdf(image: np.ndarray, cards: Sequence[CountingCard], path: Path) -> None:
    from matplotlib.backends.backend_pdf import PdfPages

    # without a date, so that the same cards are the same file
    with PdfPages(path, metadata={"CreationDate": None, "Creator": MARK, "Title": "Counting cards"}) as pages:
        for start in range(0, len(cards), ROWS):
            front, back = _figure(WIDTH, HEIGHT), _figure(WIDTH, HEIGHT)
            for row, card in enumerate(cards[start : start + ROWS]):
                _draw_front(front, (0, row), ROWS, card, image)
                _draw_back(back, (0, row), ROWS, card)
            pages.savefig(front)
            pages.savefig(back)


def _figure(width: float, height: float) -> Any:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), facecolor="white")


class _Area:
    """The place of one card on a figure; positions in it are inches from its top left corner."""

    def __init__(self, figure: Any, place: tuple[int, int], rows: int) -> None:
        self.figure = figure
        self.width, self.height = figure.get_size_inches()
        self.left = place[0] * WIDTH
        self.top = self.height - place[1] * HEIGHT / ROWS
        if place[1] + 1 < rows:
            self._cut()

    def axes(self, left: float, top: float, width: float, height: float) -> Any:
        """Return axes on a rectangle."""
        bottom = (self.top - top - height) / self.height
        return self.figure.add_axes(((self.left + left) / self.width, bottom, width / self.width, height / self.height))

    def text(self, left: float, top: float, words: str, size: float = 10, **more: Any) -> None:
        """Write words, their top at a place."""
        place = ((self.left + left) / self.width, (self.top - top) / self.height)
        # names of scenes may contain dollar signs, which are no formulas
        self.figure.text(*place, words.replace("$", r"\$"), size=size, color=INK, va="top", **more)

    def box(self, left: float, top: float, words: str, width: float = 0.62, height: float = 0.42) -> None:
        """Draw a box to write into, with an answer in it or empty."""
        axes = self.axes(left, top, width, height)
        axes.set(xticks=[], yticks=[])
        axes.text(0.5, 0.5, words, ha="center", va="center", size=13, weight="bold", color=RAY)

    def _cut(self) -> None:
        axes = self.axes(0, HEIGHT / ROWS - 0.01, WIDTH, 0.02)
        axes.axhline(0, color=CUT, linestyle=(0, (4, 4)), linewidth=0.8)
        axes.set_axis_off()


def _draw_front(figure: Any, place: tuple[int, int], rows: int, card: CountingCard, image: np.ndarray) -> None:
    area = _Area(figure, place, rows)
    area.text(MARGIN, 0.2, f"Card {card.number}: pixel {card.x}, {card.y}", 13, weight="bold")
    area.text(MARGIN, 0.47, "\n".join(wrap(card.rule, 125)), 9)
    _draw_picture(area.axes(MARGIN, 0.85, 3.1, 2.1), card, image)
    _draw_section(area.axes(3.6, 0.82, *SECTION), card)
    _draw_boxes(area, card, answered=False)


def _draw_back(figure: Any, place: tuple[int, int], rows: int, card: CountingCard) -> None:
    area = _Area(figure, place, rows)
    area.text(MARGIN, 0.2, f"Card {card.number}: answers", 13, weight="bold")
    lines = [f"The count starts from {card.line.start}.", *card.answers]
    if not card.answers:
        lines.append("No face is counted on the way.")
    area.text(MARGIN, 0.5, "\n".join([*lines, "", card.result]), 10.5, linespacing=1.4)
    _draw_boxes(area, card, answered=True)


def _draw_boxes(area: _Area, card: CountingCard, answered: bool) -> None:
    """Draw a box for the count at the start and after each crossing."""
    counts = [card.line.start, *(each.count for each in card.line.crossings)]
    labels = ["start", *(f"after {number}" for number in range(1, len(counts)))]
    for number, (label, count) in enumerate(zip(labels, counts, strict=True)):
        area.text(MARGIN + 0.72 * number, 3.07, label, 8)
        area.box(MARGIN + 0.72 * number, 3.22, str(count) if answered or number == 0 else "")
    lit = card.line.end == 0
    choice = ("lit" if lit else "in shadow") if answered else "lit or in shadow?"
    area.text(MARGIN + 0.72 * len(counts) + 0.1, 3.32, f"P is drawn {choice}", 11)


def _draw_picture(axes: Any, card: CountingCard, image: np.ndarray) -> None:
    height, width = image.shape[:2]
    axes.imshow(image, interpolation="nearest", extent=(0, width, height, 0))
    radius = 0.03 * width
    for color, line_width in (("white", 3.5), (RAY, 1.5)):  # seen on light and on dark colours
        x, y = card.x + 0.5, card.y + 0.5
        circle = np.linspace(0, 2 * np.pi, 60)
        axes.plot(x + radius * np.cos(circle), y + radius * np.sin(circle), color=color, linewidth=line_width)
        axes.plot([x, x], [y - 1.6 * radius, y - radius], color=color, linewidth=line_width)
    axes.set(xticks=[], yticks=[], xlim=(0, width), ylim=(height, 0))


def _draw_section(axes: Any, card: CountingCard) -> None:
    """Draw the section with the line of sight; crossings have the numbers of the order of the count."""
    section = card.section
    assert section.eye is not None
    assert section.point is not None
    for near, far in section.sides:
        axes.plot(*np.transpose([near, far]), color=VOLUME, linewidth=1.2)
    for thing in section.scene.objects:
        for line in section.outlines[thing.name]:
            if thing.receives:
                axes.plot(*line.T, color=RECEIVER, linewidth=2)
            else:
                axes.fill(*line.T, facecolor="#d9c3b0", edgecolor=CASTER, linewidth=1.2)
    end = max([section.point, *card.places], key=lambda place: float(np.linalg.norm(place - section.eye)))
    beyond = end + 0.08 * (end - section.eye)
    axes.plot(*np.transpose([section.eye, section.point]), color=RAY, linewidth=1.6)
    axes.plot(*np.transpose([section.point, beyond]), color=RAY, linewidth=1, linestyle=(0, (3, 2)))
    shown = _frame(axes, card, beyond)
    for number, place in enumerate(card.places, 1):
        axes.plot(*place, "o", color="white", markeredgecolor=RAY, markersize=11, zorder=4)
        axes.text(*place, str(number), size=7.5, ha="center", va="center", color=INK, zorder=5)
    for place, words, above in ((section.eye, "eye", 5), (section.point, "P", -12)):
        axes.plot(*place, "o", color=RAY, markersize=5, zorder=4)
        axes.annotate(words, place, (0, above), textcoords="offset points", size=9, weight="bold", ha="center")
    _draw_light(axes, card, shown)


def _frame(axes: Any, card: CountingCard, beyond: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Show what matters on the card, and return its lower left and upper right corner."""
    section = card.section
    points = [section.eye, section.point, beyond, *card.places]
    points += [
        point for thing in section.scene.casters if not thing.receives
        for line in section.outlines[thing.name] for point in line
    ]  # fmt: skip
    if section.light.position[3]:
        points.append(section.center)
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    room = 0.08 * float((high - low).max())
    width, height = high - low + 2 * room
    ratio = SECTION[0] / SECTION[1]  # of the axes: one unit is as long to the right as upwards
    half = np.array([max(width, ratio * height), max(height, width / ratio)]) / 2
    low, high = (low + high) / 2 - half, (low + high) / 2 + half
    axes.set(xticks=[], yticks=[], xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    return low, high


def _draw_light(axes: Any, card: CountingCard, shown: tuple[np.ndarray, np.ndarray]) -> None:
    section, (low, high) = card.section, shown
    if section.light.position[3]:
        axes.plot(*section.center, "*", color=LIGHT, markersize=13, zorder=4)
        axes.annotate(section.light.name, section.center, (9, -3), textcoords="offset points", size=9, parse_math=False)
        return
    towards, size = section.center / np.linalg.norm(section.center), float((high - low).min())
    assert section.eye is not None
    at_left = section.eye[0] > (low[0] + high[0]) / 2  # the eye is at the other side
    start = np.array([low[0] + 0.25 * size if at_left else high[0] - 0.25 * size, high[1] - 0.15 * size])
    end = start - 0.25 * size * towards
    axes.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": LIGHT, "linewidth": 2})
    axes.annotate(section.light.name, start, (4, 2), textcoords="offset points", size=9, parse_math=False)
