"""A `Film`: the frames of an animation, as pictures, to look at in a notebook or to save."""

from __future__ import annotations

import os
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from softshadow import errors
from softshadow.inspection.files import is_folder, write_whole
from softshadow.inspection.pictures import Shown, notebook_display, save_png
from softshadow.inspection.words import colors_in_words, place_in_words
from softshadow.sweeps.films.changes import Change
from softshadow.sweeps.films.writers import check_film, write_film

LARGEST_SHOWN = 8_000_000  # bytes of a film that a notebook displays; editors become slow with more


@dataclass(frozen=True, eq=False, repr=False)
class Film:
    """The frames of an animation.

    Attributes
    ----------
    technique, scene : str       their names
    pictures : sequence          of every frame, (H, W, 3) uint8, row 0 on top, all of one size
    changes : tuple              what changes, with its value in every frame
    captions : tuple of str      of every frame, also where the pictures have none
    rate : int                   frames per second
    poster_frame : int           which frame stands for the film where it does not play
    warnings : tuple             of all frames, one of each kind
    """

    technique: str
    scene: str
    pictures: Sequence[np.ndarray]
    changes: tuple[Change, ...]
    captions: tuple[str, ...]
    rate: int
    poster_frame: int
    warnings: tuple[errors.Warning, ...]

    def __len__(self) -> int:
        return len(self.pictures)

    def __getitem__(self, frame: int) -> np.ndarray:
        """Return the picture of a frame."""
        return self.pictures[frame]

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels, with titles and caption."""
        height, width = self.pictures[0].shape[:2]
        return width, height

    @property
    def seconds(self) -> float:
        """How long it plays."""
        return len(self) / self.rate

    @property
    def poster(self) -> np.ndarray:
        """The picture of the poster frame."""
        return self.pictures[self.poster_frame]

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write the film, as .webp, .png (APNG), .gif or .mp4, and return the path.

        Raises
        ------
        ValueError                   another extension
        SoftShadowError              MP4 without its library; the file exists and is not ours, or cannot be written
        """
        return write_film(Path(path), self.pictures, self.rate, force)

    def save_poster(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write the poster frame as PNG, and return the path."""
        check_poster(Path(path))
        return write_whole(Path(path), lambda temporary: save_png(self.poster, temporary), force)

    def __repr__(self) -> str:
        changing = ", ".join(f"{change.labels[0]} to {change.labels[-1]}" for change in self.changes)
        width, height = self.size
        return (
            f"Film({self.technique!r}, scene {self.scene!r}, {width}x{height}, {len(self)} frames, "
            f"{self.seconds:.1f} s: {changing})"
        )

    def describe(self) -> str:
        """Return what the film shows, in words: what changes, and how far the last picture differs from the first."""
        changing = "; ".join(f"{change.labels[0]} to {change.labels[-1]}" for change in self.changes)
        differ = place_in_words((self.pictures[0] != self.pictures[-1]).any(axis=-1), "differ")
        return (
            f"Film of {self.technique} on scene {self.scene}, {len(self)} frames in {self.seconds:.1f} seconds, from "
            f"{changing}. Between the first frame and the last, {differ}. "
            f"Frame {self.poster_frame}: {colors_in_words(self.poster)}."
        )

    @cached_property
    def _webp(self) -> bytes:
        with TemporaryDirectory() as folder:
            return self.save(Path(folder) / "film.webp").read_bytes()

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Shown:
        """Return what a notebook displays: the film, or a sentence if it is too large; the poster; a text."""
        shown, metadata = notebook_display(repr(self), self.poster, self.describe())
        size, words = len(self._webp), escape(self.describe())
        if size > LARGEST_SHOWN:
            image = f'<img src="data:image/png;base64,{shown["image/png"]}" alt="{words}">'
            too_large = f"<p>The film has {size / 1e6:.1f} MB, too much for a notebook: "
            page = f'{image}{too_large}<code>film.save("film.webp")</code> writes it to a file.</p>'
        else:
            page = f'<img src="data:image/webp;base64,{b64encode(self._webp).decode()}" alt="{words}">'
        return {"text/html": page, **shown}, metadata


def check_output(path: str | os.PathLike[str]) -> None:
    """Raise an error if a film cannot be written to such a file; called before a long drawing."""
    if is_folder(path):
        raise ValueError(f"{os.fspath(path)}: is a folder; expected a film, such as film.webp")
    check_film(Path(path))


def check_poster(path: Path) -> None:
    """Raise an error if a poster cannot be written to such a file."""
    if path.suffix.lower() != ".png":
        raise ValueError(f"{path}: expected a poster with the ending .png")
