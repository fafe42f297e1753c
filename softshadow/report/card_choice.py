"""Counting cards: pixels of a picture whose crossings with shadow volumes are to be counted by hand.

The front of a card shows the pixel in the picture, and its line of sight in a cross-section with the crossed faces
numbered. The count after each of them is left blank. The back has the answers, from the history of the pixel.
"""

from __future__ import annotations

import os
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from softshadow.errors import StateError
from softshadow.inspection.files import write_whole
from softshadow.report.card_pages import save_cards
from softshadow.report.counting_card import CountingCard
from softshadow.report.cross_sections import cross_section
from softshadow.scene import Scene
from softshadow.space import LineOfSight, line_of_sight
from softshadow.space.shadow_parts import DrawnRun, scene_of
from softshadow.space.sight_lines import COUNTING

EXTENSIONS = (".pdf", ".png")
MOST_CROSSINGS = 8  # that fit on a card
LOOKED_AT = 40  # pixels for each card
APART = 0.02  # least distance of marks on the line, as a share of the length that is drawn


@dataclass(frozen=True, eq=False, repr=False)
class CountingCards:
    """Cards of one run, to be saved as a file.

    Attributes
    ----------
    technique, scene : str       what the run drew
    image : (H, W, 3) uint8      the picture
    cards : tuple                of CountingCard
    """

    technique: str
    scene: str
    image: np.ndarray
    cards: tuple[CountingCard, ...]

    def __len__(self) -> int:
        return len(self.cards)

    def __getitem__(self, index: int) -> CountingCard:
        return self.cards[index]

    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the cards to a file, and return its path.

        ``.pdf`` has three cards on a page, with their answers on the next page, to be printed on both sides of the
        paper (turned over its long edge). ``.png`` has the answers to the right of each card.

        Raises
        ------
        ValueError                   another file name extension
        SoftShadowError              matplotlib is not installed, a file exists that this package did not write (`force`
                                     overwrites it), or the place cannot be written; no half-written file is left
        """
        if Path(path).suffix.lower() not in EXTENSIONS:
            raise ValueError(f"{path}: expected a name that ends in {' or '.join(EXTENSIONS)}")
        return write_whole(Path(path), lambda file: save_cards(self.image, self.cards, file), force)

    def __repr__(self) -> str:
        pixels = ", ".join(f"({card.x}, {card.y})" for card in self.cards)
        return f"CountingCards({self.technique!r} on {self.scene!r}, pixels {pixels})"


def counting_cards(run: DrawnRun, n: int = 6, seed: int = 0, light: str | None = None) -> CountingCards:
    """Return counting cards for pixels of a run: lit and in shadow, with few and with many crossings.

    Parameters
    ----------
    run : Run                    of a technique that counts: volume-zpass, volume-zpass-plus, volume-zfail or
                                 volume-parity
    n : int                      number of cards
    seed : int                   the same seed chooses the same pixels
    light : str                  name; the first one by default

    Raises
    ------
    StateError                   the technique does not count, or the picture has too few suitable pixels
    ValueError                   n is not positive, or there is no such light

    Examples
    --------
    >>> import softshadow as ss
    >>> run = ss.run("volume-zpass", "boxes", (160, 120))
    >>> [(card.line.end, len(card.line.crossings)) for card in ss.counting_cards(run, n=3)]
    [(1, 1), (0, 2), (0, 0)]
    """
    if n < 1:
        raise ValueError(f"n={n!r}: expected a positive number of cards")
    if run.technique not in COUNTING:
        raise StateError(f"technique {run.technique!r} counts no faces; expected one of {', '.join(COUNTING)}")
    lines = _varied(_candidates(run, n, seed, light), n)
    if len(lines) < n:
        raise StateError(
            f"n={n}: {len(lines)} pixels of this picture have crossings that can be told apart; expected fewer cards, "
            "or a larger picture"
        )
    size, scene = run.steps[0].frame.size, scene_of(run)
    cards = [
        CountingCard(number, run.technique, line, cross_section(scene, (line.x, line.y), size, line.light))
        for number, line in enumerate(lines, 1)
    ]
    return CountingCards(run.technique, scene.name, run.steps[-1].image, tuple(cards))


def _candidates(run: DrawnRun, n: int, seed: int, light: str | None) -> list[LineOfSight]:
    """Return lines of sight of random pixels, half of them in shadow, whose crossings can be told apart."""
    stencil, depth = run.steps[-1].stencil, run.steps[-1].depth
    random = np.random.default_rng(seed)
    shifted = [np.roll(stencil, (dy, dx), (0, 1)) for dy in (-1, 0, 1) for dx in (-1, 0, 1)]
    inner = np.all([each == stencil for each in shifted], axis=0) & (depth < 1)
    lines = []
    for mask in (inner & (stencil == 0), inner & (stencil != 0)):
        for y, x in random.permutation(np.argwhere(mask))[: LOOKED_AT // 2 * n].tolist():
            line = line_of_sight(run, x, y, light)
            if _is_drawable(line, scene_of(run)):
                lines.append(line)
    return lines


def _is_drawable(line: LineOfSight, scene: Scene) -> bool:
    """Return whether there is room for the numbers of all crossings, and all are nearer than infinity."""
    if line.point is None or len(line.crossings) > MOST_CROSSINGS:
        return False
    places = [each.place for each in line.crossings]
    if any(place is None for place in places):
        return False
    everything = np.concatenate([thing.world_positions for thing in scene.objects])
    size = float(np.ptp(everything, axis=0).max())
    along = np.sort([float(np.linalg.norm(place - line.eye)) for place in (*places, line.point) if place is not None])
    return bool((np.diff(along) > APART * size).all() and along[-1] < 3 * size)


def _varied(lines: list[LineOfSight], n: int) -> list[LineOfSight]:
    """Return n lines of as many kinds as possible; a kind is the stencil value and the number of crossings.

    The kind without crossings comes last: there is nothing to count.
    """
    kinds: dict[tuple[bool, int, int], list[LineOfSight]] = defaultdict(list)
    for line in lines:
        kinds[not line.crossings, len(line.crossings), line.end or 0].append(line)
    chosen: list[LineOfSight] = []
    while len(chosen) < n and any(kinds.values()):
        for _, of_kind in sorted(kinds.items()):
            if of_kind and len(chosen) < n:
                chosen.append(of_kind.pop(0))
    return chosen
