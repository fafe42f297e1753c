"""Writing files whole or not at all, and never over a file that this package did not write."""

from __future__ import annotations

import os
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path

from softshadow.errors import SoftShadowError

MARK = "made by softshadow"  # stands at the start of every file; without it a file counts as foreign
DESCRIPTION = "softshadow.json"  # the member of an npz that describes the others
MARKED_AT_END = (".pdf", ".webp", ".mp4")  # these formats have their comments behind the contents
START = 4096  # bytes; the mark of a PNG, GIF, HTML or text file must stand within them


def own(path: Path) -> bool:
    """Return whether this package wrote a file: its mark stands at the start, or an npz has its description."""
    if path.suffix == ".npz":
        try:
            with zipfile.ZipFile(path) as archive:
                return f"{DESCRIPTION}.npy" in archive.namelist()
        except (OSError, zipfile.BadZipFile):
            return False
    if path.suffix in MARKED_AT_END:
        return MARK.encode() in path.read_bytes()
    with path.open("rb") as file:
        return MARK.encode() in file.read(START)


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Return whether a path names a folder: one that exists, or a path that ends in a slash.

    A `Path` drops the slash at its end, so a `Path` without an extension that does not exist yet counts as a folder.
    """
    slash_dropped = isinstance(path, Path) and not path.suffix and not path.exists()
    return slash_dropped or str(path).endswith(("/", os.sep)) or Path(path).is_dir()


def refuse_foreign(path: Path, force: bool) -> None:
    """Raise an error unless a file may be written.

    Raises
    ------
    SoftShadowError              the file exists and is not ours, it is a folder, or its folder does not exist
    """
    if path.is_dir():
        raise SoftShadowError(f"{path}: is a folder, expected the name of a file")
    if not path.parent.is_dir():
        raise SoftShadowError(f"{path}: the folder {path.parent} does not exist")
    if path.exists() and not force and not own(path):
        raise SoftShadowError(f"{path}: exists and was not written by softshadow; force=True overwrites it")


def write_whole(path: Path, write: Callable[[Path], object], force: bool = False) -> Path:
    """Write a temporary file, then rename it atomically.

    Parameters
    ----------
    write : callable             writes the file that it is given the path of

    Raises
    ------
    SoftShadowError              see `refuse_foreign`; or the folder cannot be written
    """
    refuse_foreign(path, force)
    try:
        handle, name = tempfile.mkstemp(prefix=".", suffix=path.suffix, dir=path.parent)
    except OSError as error:
        raise SoftShadowError(f"{path}: cannot be written ({error.strerror})") from None
    os.close(handle)
    temporary = Path(name)
    try:
        write(temporary)
        temporary.chmod(0o666 & ~_umask())  # mkstemp creates files that only the owner can read
        temporary.replace(path)
    except OSError as error:
        raise SoftShadowError(f"{path}: cannot be written ({error.strerror or error})") from None
    finally:
        temporary.unlink(missing_ok=True)
    return path


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
