"""What pictures of buffers and maps show, in words with figures: for readers who do not see them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

CLEAR = 1.0  # depth where nothing was drawn
DEPTH_MAP = "ZS"  # the names of maps of depths begin with it
MOST_COUNTS = 6  # values of a stencil buffer that are listed; the others are one sum


def colors_in_words(image: np.ndarray, before: np.ndarray | None = None) -> str:
    """Return how many colours a picture (H, W, 3) uint8 has, its brightness, and in how many pixels it has changed.

    Examples
    --------
    >>> picture = np.zeros((2, 5, 3), np.uint8)
    >>> colors_in_words(picture)
    'all of one colour, #000000'
    >>> picture[0, 1] = 255
    >>> colors_in_words(picture, np.zeros((2, 5, 3), np.uint8))
    '2 colours, mean brightness 10 %, 1 of 10 pixels changed (x 1, y 0)'
    """
    channels = image.shape[-1]
    colors = np.unique(image @ (1 << np.arange(0, 8 * channels, 8)[::-1]))  # as numbers 0xrrggbb, which sort sooner
    if len(colors) == 1:
        shown = f"all of one colour, #{int(colors[0]):0{2 * channels}x}"
    else:
        shown = f"{len(colors):,} colours, mean brightness {image.mean() / 255:.0%}".replace("%", " %")
    if before is None:
        return shown
    changed = (image != before).any(axis=-1)
    return f"{shown}, {place_in_words(changed, 'changed')}"


def place_in_words(mask: np.ndarray, what: str) -> str:
    """Return how many pixels of a mask (H, W) bool are set, and in which rectangle; y is counted from the top.

    Examples
    --------
    >>> place_in_words(np.array([[False, True, True], [False, True, False]]), "differ")
    '3 of 6 pixels differ (x 1 to 2, y 0 to 1)'
    """
    number = int(np.count_nonzero(mask))
    if number in (0, mask.size):
        return f"{'no pixel' if number == 0 else 'every pixel'} {what}"
    columns, rows = (np.flatnonzero(mask.any(axis=axis)) for axis in (0, 1))
    place = f"x {span(int(columns[0]), int(columns[-1]))}, y {span(int(rows[0]), int(rows[-1]))}"
    return f"{number:,} of {mask.size:,} pixels {what} ({place})"


def span(first: int, last: int) -> str:
    """Return a range of whole numbers, or the only number of it."""
    return str(first) if first == last else f"{first} to {last}"


def counts_in_words(counts: np.ndarray) -> str:
    """Return in how many pixels each count (H, W) uint8 stands.

    Examples
    --------
    >>> counts_in_words(np.array([[0, 0, 0, 1, 2, 2]], np.uint8))
    '0 in 3 pixels, 1 in 1, 2 in 2'
    >>> counts_in_words(np.full((2, 2), 5, np.uint8))
    '5 in every pixel'
    """
    values, pixels = np.unique(counts, return_counts=True)
    if len(values) == 1:
        return f"{values[0]} in every pixel"
    shown = [f"{value} in {number:,}" for value, number in zip(values, pixels, strict=True)][:MOST_COUNTS]
    shown[0] += " pixel" if pixels[0] == 1 else " pixels"
    rest = int(pixels[MOST_COUNTS:].sum())
    return ", ".join([*shown, *([f"other values in {rest:,}"] if rest else [])])


def depths_in_words(depth: np.ndarray, clear: float | None = CLEAR) -> str:
    """Return in how much of a picture (H, W) something was drawn, and the range of its depths.

    `clear` is the value where nothing was drawn, None if there is none.

    Examples
    --------
    >>> depths_in_words(np.array([[1.0, 0.25, 0.5, 1.0]]))
    'drawn in 50 % of the pixels, 0.25 to 0.5'
    """
    drawn = np.isfinite(depth)
    if clear is not None:
        drawn &= depth != clear
    if not drawn.any():
        return "nothing drawn"
    extremes = f"{depth[drawn].min():.4g} to {depth[drawn].max():.4g}"
    return extremes if drawn.all() else f"drawn in {percent(float(drawn.mean()))} of the pixels, {extremes}"


def visibility_in_words(visibility: np.ndarray, valid: np.ndarray | None = None) -> str:
    """Return how much of the surfaces is in shadow, from a visibility (H, W) and where it is defined.

    Examples
    --------
    >>> visibility_in_words(np.array([[1.0, 1.0, 0.0, 0.5]]))
    '25 % of the surface in shadow, 25 % in part'
    >>> visibility_in_words(np.ones((2, 2)))
    'no shadow'
    """
    defined = visibility[valid] if valid is not None else visibility.ravel()
    if not defined.size or (defined >= 1).all():
        return "no shadow"
    dark, partly = float(np.mean(defined <= 0)), float(np.mean((defined > 0) & (defined < 1)))
    return f"{percent(dark)} of the surface in shadow" + (f", {percent(partly)} in part" if partly else "")


def percent(share: float) -> str:
    """Return a share as a percentage; what is not 0 or 1 is not shown as 0 or 100.

    Examples
    --------
    >>> percent(0.123), percent(0.0004), percent(0.9999), percent(0)
    ('12 %', 'less than 1 %', 'more than 99 %', '0 %')
    """
    if 0 < share < 0.005:
        return "less than 1 %"
    if 0.995 <= share < 1:
        return "more than 99 %"
    return f"{100 * share:.0f} %"


def map_in_words(name: str, values: np.ndarray, valid: np.ndarray | None = None) -> str:
    """Return what the picture of a map shows. Maps whose names begin with ZS hold depths.

    Examples
    --------
    >>> map_in_words("valid", np.array([[True, True, False, True]]))
    '3 of 4 pixels true (x 0 to 3, y 0)'
    """
    if values.dtype == np.bool_:
        return place_in_words(values, "true")
    if values.ndim == 2 and name.split()[:1] == ["visibility"]:
        return visibility_in_words(values, valid)
    if values.ndim == 2:
        if values.dtype == np.uint8:
            return counts_in_words(values)
        return depths_in_words(values, CLEAR if name.startswith(DEPTH_MAP) else None)
    if values.dtype == np.uint8:
        return colors_in_words(values)
    channels = (depths_in_words(values[..., index], None) for index in range(values.shape[2]))
    return "; ".join(f"channel {index} {words}" for index, words in enumerate(channels))


def maps_in_words(maps: Mapping[str, np.ndarray]) -> str:
    """Return what the pictures of maps show, each with its name and size."""
    return "; ".join(
        f"{name} ({values.shape[1]} x {values.shape[0]}): {map_in_words(name, values, maps.get('valid'))}"
        for name, values in maps.items()
    )
