"""The folder of a tour: what it may replace, and how finished files are moved into it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import own

INDEX = "index.html"


def refuse_foreign_folder(folder: Path, force: bool) -> None:
    """Raise an error unless a tour may be written to a folder.

    Raises
    ------
    SoftShadowError              the folder cannot be created, or holds files that are not of a tour
    """
    if not folder.parent.is_dir():
        raise SoftShadowError(f"{folder}: the folder {folder.parent} does not exist")
    if folder.exists() and not folder.is_dir():
        raise SoftShadowError(f"{folder}: is a file, expected the name of a folder")
    if force or not folder.exists() or not any(folder.iterdir()):
        return
    if not is_tour(folder):
        raise SoftShadowError(f"{folder}: holds files that are not of a tour; force=True adds the tour to them")


def is_tour(folder: Path) -> bool:
    """Return whether a folder holds a tour and nothing else."""
    index = folder / INDEX
    return index.is_file() and all(path.is_file() and own(path) for path in files_in(folder))


def files_in(folder: Path) -> Iterator[Path]:
    """Yield all files and links in a folder and its subfolders; links are not followed."""
    for place, folders, names in os.walk(folder):
        for name in (*names, *folders):
            path = Path(place, name)
            if name in names or path.is_symlink():
                yield path
