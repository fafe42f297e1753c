"""Buffers as pictures: colour as it is, depth stretched over what was drawn, stencil as a palette of counts.

Pillow is imported where it is needed. Every picture carries the mark of this package.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.inspection.files import MARK
from softshadow.inspection.step import Step

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

# Okabe & Ito 2008, "Color universal design": told apart by colour-blind eyes; 0 is dark, then as different as can be
OKABE_ITO = (
    (0x22, 0x22, 0x22), (0xE6, 0x9F, 0x00), (0x56, 0xB4, 0xE9), (0x00, 0x9E, 0x73), (0xF0, 0xE4, 0x42),
    (0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00),
)  # fmt: skip
WRAPPED = ((0xE7, 0xA6, 0xC8), (0xCC, 0x79, 0xA7))  # 254 and 255: Okabe & Ito's purple means "below zero"
CLEAR_DEPTH = (0x26, 0x2B, 0x44)  # where nothing was drawn: no grey, so that it is not taken for a depth
UNDEFINED = (0x8A, 0xA0, 0xC8)  # where a visibility is not defined: a hue, so that it is not taken for half a shadow
LABEL_HEIGHT, GAP = 14, 4


def stencil_palette() -> np.ndarray:
    """Return the colour of every count, (256, 3) uint8.

    0 to 6 are Okabe & Ito's colours; higher counts repeat them ever lighter; 254 and 255, which are -2 and -1 of a
    counter that wraps, have a hue of their own.
    """
    palette = np.empty((256, 3), np.uint8)
    for count in range(256):
        turn, base = divmod(count, len(OKABE_ITO))
        lighter = 1 - 0.75**turn
        palette[count] = np.rint(np.array(OKABE_ITO[base]) * (1 - lighter) + 255 * lighter)
    palette[254:] = WRAPPED
    return palette


def color_picture(image: np.ndarray) -> Picture:
    """Return a picture of colours (H, W, 3) uint8."""
    from PIL import Image

    return Image.fromarray(np.ascontiguousarray(image))


def stencil_picture(stencil: np.ndarray) -> Picture:
    """Return a palette picture of a stencil buffer (H, W) uint8: its indices are the counts themselves."""
    from PIL import Image

    picture = Image.fromarray(np.ascontiguousarray(stencil), "L")
    picture.putpalette(stencil_palette().tobytes())  # turns the picture into one of mode P, indices unchanged
    return picture


def depth_picture(depth: np.ndarray, clear: float = 1.0) -> Picture:
    """Return a picture of depths (H, W): near is light, far is dark, over the range of what is not `clear`."""
    from PIL import Image

    drawn = (depth != clear) & np.isfinite(depth)
    picture = np.empty((*depth.shape, 3), np.uint8)
    picture[:] = CLEAR_DEPTH
    if drawn.any():
        near, far = float(depth[drawn].min()), float(depth[drawn].max())
        far = far if far > near else near + 1
        grey = np.rint(255 - 205 * (depth[drawn].astype(np.float64) - near) / (far - near))
        picture[drawn] = grey.astype(np.uint8)[:, None]
    return Image.fromarray(picture)


def map_pictures(maps: Mapping[str, np.ndarray]) -> dict[str, Picture]:
    """Return a picture of each map of a step: visibilities as light and shadow where they are valid, others by kind."""
    return {
        name: visibility_picture(values, maps.get("valid")) if is_visibility(name) else map_picture(values)
        for name, values in maps.items()
    }


def is_visibility(name: str) -> bool:
    """Return whether a map is named as a visibility: of all lights, or "visibility of lamp 1"."""
    return name.split()[0] == "visibility"


def map_picture(values: np.ndarray) -> Picture:
    """Return a picture of a named map: bool as black and white, uint8 as counts, depths and other floats as greys."""
    if values.dtype == np.bool_:
        return color_picture(np.repeat((values * np.uint8(255))[..., None], 3, axis=2))
    if values.ndim == 3:
        return color_picture(values if values.dtype == np.uint8 else to_bytes(values[..., :3]))
    if values.dtype == np.uint8:
        return stencil_picture(values)
    return depth_picture(values)


def visibility_picture(visibility: np.ndarray, valid: np.ndarray | None = None) -> Picture:
    """Return a picture of a visibility (H, W): 1 white, 0 black, `UNDEFINED` where it is not valid (H, W) bool."""
    picture = np.repeat(to_bytes(visibility)[..., None], 3, axis=2)
    if valid is not None:
        picture[~valid] = UNDEFINED
    return color_picture(picture)


def to_bytes(values: np.ndarray) -> np.ndarray:
    """Return values in [0, 1] as 0-255, rounded."""
    return np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8)


def save_png(picture: Picture, path: Path) -> None:
    """Write a PNG with the mark of this package."""
    from PIL.PngImagePlugin import PngInfo

    notes = PngInfo()
    notes.add_text("Comment", MARK)
    picture.save(path, "PNG", pnginfo=notes)


def contact_sheet(rows: Sequence[tuple[str, Sequence[Picture]]], largest_width: int = 972) -> Picture:
    """Return one picture with a labelled row for each step, shrunk or enlarged by a whole number to fill the width."""
    from PIL import Image, ImageDraw

    width, height = rows[0][1][0].size
    columns = max(len(pictures) for _, pictures in rows)
    room = largest_width // columns - GAP
    times, over = max(1, room // width), max(1, -(-width // room))
    width, height = max(1, width * times // over), max(1, height * times // over)
    sheet = Image.new("RGB", (columns * (width + GAP) - GAP, len(rows) * (height + LABEL_HEIGHT + GAP) - GAP), "white")
    draw: Any = ImageDraw.Draw(sheet)
    for row, (label, pictures) in enumerate(rows):
        top = row * (height + LABEL_HEIGHT + GAP)
        draw.text((1, top + 1), label, fill=(34, 34, 34))
        for column, picture in enumerate(pictures):
            scaled = picture.convert("RGB").resize((width, height), Image.Resampling.NEAREST)
            sheet.paste(scaled, (column * (width + GAP), top + LABEL_HEIGHT))
    return sheet


def sheet_of(steps: Sequence[Step]) -> Picture:
    """Return the contact sheet of a run: colour, depth and stencil after every step."""
    rows = [
        (
            f"{step.index}  {step.title}",
            (color_picture(step.image), depth_picture(step.depth), stencil_picture(step.stencil)),
        )
        for step in steps
    ]
    return contact_sheet(rows)


def shown(text: str, picture: Picture) -> dict[str, str]:
    """Return what a notebook shows: a picture, and a text for where there are none."""
    png = BytesIO()
    picture.save(png, "PNG")
    return {"text/plain": text, "image/png": b64encode(png.getvalue()).decode()}
