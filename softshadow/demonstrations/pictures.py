"""What an error of the slides looks like: two pictures of what shows it, with the error and without."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from html import escape
from io import BytesIO
from typing import Any

import numpy as np

from softshadow import course, listings
from softshadow.demonstrations.demonstration import WINDOW
from softshadow.demonstrations.measuring import PROGRAMS
from softshadow.gallery import GALLERY
from softshadow.inspection.pictures import colors_of, depth_picture
from softshadow.inspection.words import colors_in_words, counts_in_words, depths_in_words, place_in_words

QUALITY = 80  # of WebP
CAPTIONS = {
    "listing": ("without {number}", "corrected"),
    "failure": ("with the failure", "with the cure"),
    "program": ("by the slide", "right"),
}
IN_WORDS: dict[str, Callable[[np.ndarray], str]] = {
    "colour": colors_in_words,
    "stencil": counts_in_words,
    "depth": depths_in_words,
}


@dataclass(frozen=True, eq=False)
class Pair:
    """Two pictures (H, W, 3) uint8, row 0 on top, with captions and what they show in words."""

    pictures: tuple[np.ndarray, np.ndarray]
    captions: tuple[str, str]
    words: tuple[str, str]

    def html(self) -> str:
        """Return both pictures beside each other, as HTML that needs no other file."""
        parts = zip(self.pictures, self.captions, self.words, strict=True)
        return f'<div class="thumbnails">{"".join(figure(*part) for part in parts)}</div>'


def figure(picture: np.ndarray, caption: str, words: str) -> str:
    """Return a picture with its caption as HTML."""
    height, width = picture.shape[:2]
    source = f'src="data:image/webp;base64,{webp(picture)}" width="{width}" height="{height}" loading="lazy"'
    return f'<figure><img {source} alt="{escape(words)}"><figcaption>{escape(caption)}</figcaption></figure>'


def pairs_of(number: str) -> Iterator[Pair]:
    """Yield the pictures of all that shows an error and whose pictures differ."""
    for shown_by in course.get(number).shown_by:
        kind, _, name = shown_by.partition(":")
        versions = VERSIONS_OF[kind](name, number) if kind in VERSIONS_OF else []
        captions = [each.format(number=number) for each in CAPTIONS.get(kind, ())]
        different = [each for each in versions if (each[1] != each[2]).any()]
        if different:
            buffer, wrong, right = different[0]
            yield pair(f"{kind} {name}", buffer, (wrong, right), captions)


def pair(what: str, buffer: str, values: tuple[np.ndarray, np.ndarray], captions: list[str]) -> Pair:
    """Return the pictures of two versions of a buffer, "colour", "stencil" or "depth"."""
    differs = values[0] != values[1]
    place = place_in_words(differs.any(axis=-1) if differs.ndim == 3 else differs, "differ")
    pictures = tuple(depth_picture(each) if buffer == "depth" else colors_of(each) for each in values)
    say = IN_WORDS[buffer]
    words = [
        f"{what}, {buffer} {caption}: {say(each)}; {place}" for each, caption in zip(values, captions, strict=True)
    ]
    noted = [caption if buffer == "colour" else f"{caption} ({buffer})" for caption in captions]
    return Pair((pictures[0], pictures[1]), (noted[0], noted[1]), (words[0], words[1]))


Versions = list[tuple[str, np.ndarray, np.ndarray]]  # buffer, by the slide, right; row 0 on top


def of_listing(name: str, number: str) -> Versions:
    """Return the buffers of a listing without a correction, and with all."""
    from softshadow.testing import run_here

    listing = listings.get(name)
    without, right = (run_here(program, listings.SIZE) for program in (listing.without(number), listing.corrected))
    return [
        ("colour", without.color[::-1, :, :3], right.color[::-1, :, :3]),
        ("stencil", without.stencil[::-1], right.stencil[::-1]),
        ("depth", without.depth[::-1], right.depth[::-1]),
    ]


def of_failure(name: str, number: str) -> Versions:
    """Return the pictures of a failure and of its cure."""
    return [("colour", GALLERY[name].wrong.image, GALLERY[name].cured.image)]


def of_program(name: str, number: str) -> Versions:
    """Return what a program reads last of a buffer, and before that: it counts by the slide first, then as it is."""
    from softshadow import gl

    watching = Watching(gl)
    with gl.create_context(*WINDOW):
        PROGRAMS[name].program(watching)
    return [(buffer, read[-2], read[-1]) for buffer, read in watching.read.items() if len(read) > 1]


VERSIONS_OF = {"listing": of_listing, "failure": of_failure, "program": of_program}


class Watching:
    """A gl namespace that keeps the colours and stencil values that a program reads of the whole window."""

    def __init__(self, gl: Any) -> None:
        self.gl = gl
        self.read: dict[str, list[np.ndarray]] = {}

    def __getattr__(self, name: str) -> Any:
        return getattr(self.gl, name)

    def glReadPixels(self, x: int, y: int, width: int, height: int, format: int, type: int) -> Any:
        """Read, and keep the picture."""
        pixels = self.gl.glReadPixels(x, y, width, height, format, type)
        channels = {self.gl.GL_RGBA: 4, self.gl.GL_STENCIL_INDEX: 1}.get(format)
        if (width, height) == WINDOW and channels and type == self.gl.GL_UNSIGNED_BYTE:
            data = pixels if isinstance(pixels, bytes) else np.asarray(pixels).tobytes()
            values = np.frombuffer(data, np.uint8).reshape(height, width, channels)[::-1]
            buffer, picture = ("colour", values[..., :3]) if channels == 4 else ("stencil", values[..., 0])
            self.read.setdefault(buffer, []).append(picture)
        return pixels


def webp(picture: np.ndarray) -> str:
    """Return a picture (H, W, 3) as WebP in base64."""
    from PIL import Image

    file = BytesIO()
    Image.fromarray(np.ascontiguousarray(picture)).save(file, "WEBP", quality=QUALITY)
    return b64encode(file.getvalue()).decode()
