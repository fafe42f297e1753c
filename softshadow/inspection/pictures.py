"""Buffers as pictures, and pictures as PNG files.

A picture is an array: colours (H, W, 3) uint8, or stencil counts (H, W) uint8, which are shown in `stencil_palette`.
imageio writes the files. Pillow is used for what imageio cannot do: the file's comment, a palette PNG, and text.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.inspection.files import MARK

# Okabe & Ito 2008, "Color universal design": colours that colour-blind people can tell apart
OKABE_ITO = (
    (0x22, 0x22, 0x22), (0xE6, 0x9F, 0x00), (0x56, 0xB4, 0xE9), (0x00, 0x9E, 0x73), (0xF0, 0xE4, 0x42),
    (0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00),
)  # fmt: skip
WRAPPED = ((0xE7, 0xA6, 0xC8), (0xCC, 0x79, 0xA7))  # 254 and 255: Okabe & Ito's purple means "below zero"
CLEAR_DEPTH = (0x26, 0x2B, 0x44)  # where nothing was drawn: not a grey, so that it does not look like a depth
UNDEFINED = (0x8A, 0xA0, 0xC8)  # where a visibility is not defined: not a grey, so that it does not look like penumbra
LABEL_COLOR = (0x22, 0x22, 0x22)
LABEL_HEIGHT, GAP = 14, 4  # pixels
MOST_COLUMNS = 3  # of a contact sheet


def stencil_palette() -> np.ndarray:
    """Return the colour of every stencil count, (256, 3) uint8.

    0 to 6 have Okabe & Ito's colours; higher counts repeat them, lighter each time. 254 and 255, which stand for -2 and
    -1 in a counter that wraps, have a hue of their own.
    """
    return _palette().copy()


@cache
def _palette() -> np.ndarray:
    palette = np.empty((256, 3), np.uint8)
    for count in range(256):
        turn, base = divmod(count, len(OKABE_ITO))
        lighter = 1 - 0.75**turn
        palette[count] = np.rint(np.array(OKABE_ITO[base]) * (1 - lighter) + 255 * lighter)
    palette[254:] = WRAPPED
    return palette


# -- pictures of buffers and maps --------------------------------------------------------------------------------------
def depth_picture(depth: np.ndarray, clear: float = 1.0, limits: tuple[float, float] | None = None) -> np.ndarray:
    """Return depths (H, W) as greys: near is light, far is dark, over the range of the depths that are not `clear`.

    With `limits` (near, far) the greys are those of this range, in which all drawn depths must lie.
    """
    drawn = (depth != clear) & np.isfinite(depth)
    picture = np.empty((*depth.shape, 3), np.uint8)
    picture[:] = CLEAR_DEPTH
    if drawn.any():
        near, far = limits or (float(depth[drawn].min()), float(depth[drawn].max()))
        far = far if far > near else near + 1
        grey = np.rint(255 - 205 * (depth[drawn].astype(np.float64) - near) / (far - near))
        picture[drawn] = grey.astype(np.uint8)[:, None]
    return picture


def map_pictures(maps: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return a picture of each map of a step; a visibility is marked where the map "valid" says it is not defined."""
    return {
        name: visibility_picture(values, maps.get("valid")) if is_visibility(name) else map_picture(values)
        for name, values in maps.items()
    }


def is_visibility(name: str) -> bool:
    """Return whether a map's name is that of a visibility: "visibility", or "visibility of lamp 1"."""
    return name.split()[0] == "visibility"


def map_picture(values: np.ndarray) -> np.ndarray:
    """Return a picture of a map: bool as black and white, uint8 as counts, (H, W, 3) as colours, floats as depths."""
    if values.dtype == np.bool_:
        return np.repeat((values * np.uint8(255))[..., None], 3, axis=2)
    if values.ndim == 3 and values.shape[2] == 2:  # such as depth and squared depth
        values = np.concatenate([values, np.zeros_like(values[..., :1])], axis=2)
    if values.ndim == 3:
        return values if values.dtype == np.uint8 else to_bytes(values[..., :3])
    return values if values.dtype == np.uint8 else depth_picture(values)


def visibility_picture(visibility: np.ndarray, valid: np.ndarray | None = None) -> np.ndarray:
    """Return a picture of a visibility (H, W): 1 white, 0 black, `UNDEFINED` where `valid` (H, W) bool is False."""
    picture = np.repeat(to_bytes(visibility)[..., None], 3, axis=2)
    if valid is not None:
        picture[~valid] = UNDEFINED
    return picture


def to_bytes(values: np.ndarray) -> np.ndarray:
    """Return values in [0, 1] as 0-255, rounded."""
    return np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8)


def colors_of(picture: np.ndarray) -> np.ndarray:
    """Return a picture as colours (H, W, 3): counts take those of the palette."""
    return picture if picture.ndim == 3 else _palette()[picture]


# -- sheets ------------------------------------------------------------------------------------------------------------
def contact_sheet(
    rows: Sequence[tuple[str, Sequence[np.ndarray] | Mapping[str, np.ndarray]]],
    largest_width: int = 972,
    size: tuple[int, int] | None = None,
) -> np.ndarray:
    """Return one picture with a labelled row of pictures for each step; pictures of a mapping have their names above.

    All places are equally large. Pictures of this `size` (width, height; by default that of the first) are enlarged or
    shrunk by a whole number to fill the width; others are fitted in. A row of more than three goes on below.
    """
    named = [(label, row if isinstance(row, Mapping) else {}, _listed(row)) for label, row in rows]
    height, width = named[0][2][0].shape[:2] if size is None else size[::-1]
    columns = min(MOST_COLUMNS, max(len(pictures) for _, _, pictures in named))
    room = largest_width // columns - GAP
    times, over = max(1, room // width), max(1, -(-width // room))
    width, height = max(1, width * times // over), max(1, height * times // over)
    placed, labels, top = [], [], 0
    for label, names, pictures in named:
        if label:
            labels.append((1, top + 1, label))
            top += LABEL_HEIGHT
        titles = list(names)
        for start in range(0, len(pictures), columns):
            line = [fitted(colors_of(picture), width, height) for picture in pictures[start : start + columns]]
            for column, picture in enumerate(line):
                left = column * (width + GAP)
                if titles:
                    labels.append((left + 1, top + 1, titles[start + column]))
                placed.append((left, top + (LABEL_HEIGHT if titles else 0), picture))
            top += max(len(picture) for picture in line) + GAP + (LABEL_HEIGHT if titles else 0)
    sheet = np.full((top - GAP, columns * (width + GAP) - GAP, 3), 255, np.uint8)
    for left, upper, picture in placed:
        sheet[upper : upper + picture.shape[0], left : left + picture.shape[1]] = picture
    return labelled(sheet, labels)


def _listed(row: Sequence[np.ndarray] | Mapping[str, np.ndarray]) -> list[np.ndarray]:
    return list(row.values() if isinstance(row, Mapping) else row)


def fitted(picture: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return a picture in the largest size of its own shape that fits into a width and a height."""
    scale = min(width / picture.shape[1], height / picture.shape[0])
    return resized(picture, max(1, round(picture.shape[1] * scale)), max(1, round(picture.shape[0] * scale)))


def resized(picture: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return a picture in another size; each pixel takes the nearest one of the original."""
    rows = (2 * np.arange(height) + 1) * picture.shape[0] // (2 * height)
    columns = (2 * np.arange(width) + 1) * picture.shape[1] // (2 * width)
    return picture[rows[:, None], columns]


def labelled(picture: np.ndarray, labels: Sequence[tuple[int, int, str]]) -> np.ndarray:
    """Return a picture with labels written on it: x and y of the top left corner, and the text."""
    from PIL import Image, ImageDraw

    canvas = Image.fromarray(picture)
    draw: Any = ImageDraw.Draw(canvas)
    for x, y, text in labels:
        draw.text((x, y), text, fill=LABEL_COLOR)
    return np.asarray(canvas)


# -- files and notebooks -----------------------------------------------------------------------------------------------
def png(picture: np.ndarray) -> bytes:
    """Return a PNG with the mark of this package; that of counts is a palette PNG whose indices are the counts."""
    from PIL.PngImagePlugin import PngInfo

    comment = PngInfo()
    comment.add_text("Comment", MARK)
    if picture.ndim == 2:
        return _palette_png(picture, comment)
    import imageio.v3 as imageio

    return imageio.imwrite("<bytes>", picture, extension=".png", plugin="pillow", pnginfo=comment)


def _palette_png(counts: np.ndarray, comment: Any) -> bytes:
    from PIL import Image

    picture = Image.fromarray(np.ascontiguousarray(counts))
    picture.putpalette(_palette().tobytes())  # changes the mode to P and leaves the pixels as they are
    file = BytesIO()
    picture.save(file, "PNG", pnginfo=comment)
    return file.getvalue()


def save_png(picture: np.ndarray, path: Path) -> None:
    """Write a picture as a PNG file."""
    path.write_bytes(png(picture))


Shown = tuple[dict[str, str], dict[str, dict[str, str]]]  # data by type, and metadata of each, as notebooks take them


def notebook_display(text: str, picture: np.ndarray, alt: str) -> Shown:
    """Return what a notebook displays: a picture, and a text for where pictures cannot be shown.

    `alt` says what the picture shows. It is the metadata that notebooks and pages made of them give to screen readers.
    """
    data = {"text/plain": text, "image/png": b64encode(png(picture)).decode()}
    return data, {"image/png": {"alt": " ".join(alt.split())}}
