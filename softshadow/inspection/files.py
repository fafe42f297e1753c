"""Writing files: whole or not at all, and never over a file that this package has not written."""

from __future__ import annotations

import os
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path

from softshadow.errors import SoftShadowError

MARK = "made by softshadow"  # every writer puts it at the start of its files, or they count as foreign the next time
DESCRIPTION = "softshadow.json"  # the member of an npz that says what the others are
START = 4096  # bytes in which the mark of a PNG, HTML or text file must stand


def own(path: Path) -> bool:
    """Return whether this package has written a file: its mark stands at the start, or as a member of an npz."""
    if path.suffix == ".npz":
        try:
            with zipfile.ZipFile(path) as archive:
                return f"{DESCRIPTION}.npy" in archive.namelist()
        except (OSError, zipfile.BadZipFile):
            return False
    with path.open("rb") as file:
        return MARK.encode() in file.read(START)


def refuse_foreign(path: Path, force: bool) -> None:
    """Make sure that a file may be written.

    Raises
    ------
    SoftShadowError              it exists and is not ours, is a folder, or its folder does not exist
    """
    if path.is_dir():
        raise SoftShadowError(f"{path}: is a folder, expected the name of a file")
    if not path.parent.is_dir():
        raise SoftShadowError(f"{path}: the folder {path.parent} does not exist")
    if path.exists() and not force and not own(path):
        raise SoftShadowError(f"{path}: exists and was not written by softshadow; force=True overwrites it")


def write_whole(path: Path, write: Callable[[Path], object], force: bool = False) -> Path:
    """Let `write` make the file under another name in the same folder, then give it its name at once.

    Raises
    ------
    SoftShadowError              see `refuse_foreign`, or the folder cannot be written
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
        temporary.chmod(0o666 & ~_umask())  # mkstemp's files are for the owner only
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
