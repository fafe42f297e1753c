"""Writing files and folders whole or not at all, and never over a file that this package did not write.

Everything is written under a temporary name beside its place, and then takes this place in one operation. A process
that is killed leaves the temporary file or folder; the next one that writes there deletes it.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from platform import node

from softshadow.errors import SoftShadowError
from softshadow.inspection.exchange import exchange

MARK = "made by softshadow"  # stands at the start of every file; without it a file counts as foreign
DESCRIPTION = "softshadow.json"  # the member of an npz that describes the others
MARKED_AT_END = (".pdf", ".webp", ".mp4")  # these formats have their comments behind the contents
START = 4096  # bytes; the mark of a PNG, GIF, HTML or text file must stand within them
HOST = re.sub(r"\W", "", node())
TEMPORARY = re.compile(r"\.softshadow-(\w*)-([0-9]{1,10})-.*", re.DOTALL)


def own(path: Path) -> bool:
    """Return whether this package wrote a file: its mark stands at the start, or an npz has its description."""
    if not path.is_file():
        return False
    try:
        if path.suffix == ".npz":
            with zipfile.ZipFile(path) as archive:
                return f"{DESCRIPTION}.npy" in archive.namelist()
        if path.suffix in MARKED_AT_END:
            return MARK.encode() in path.read_bytes()
        with path.open("rb") as file:
            return MARK.encode() in file.read(START)
    except (OSError, ValueError, zipfile.BadZipFile):
        return False


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
    SoftShadowError              the file exists and is not ours, it is no regular file, or its folder does not exist
    """
    with _named(path):
        if path.is_dir():
            raise SoftShadowError(f"{path}: is a folder, expected the name of a file")
        if not path.parent.is_dir():
            raise SoftShadowError(f"{path}: the folder {path.parent} does not exist")
        if not path.exists():
            return
        if not path.is_file():
            raise SoftShadowError(f"{path}: is not a regular file, expected the name of a file")
        if not force and not own(path):
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
    with _named(path):
        _delete_abandoned(path.parent)
        handle, name = tempfile.mkstemp(prefix=_prefix(), suffix=path.suffix, dir=path.parent)
        os.close(handle)
        temporary = Path(name)
        try:
            write(temporary)
            temporary.chmod(0o666 & ~_umask())  # mkstemp creates files that only the owner can read
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    return path


def write_folder(folder: Path, write: Callable[[Path], object], is_replaced: Callable[[Path], bool]) -> Path:
    """Write a temporary folder, then let it take the place of an earlier one in one operation.

    The current folder of this process stays where it is: files are moved into it one by one.

    Parameters
    ----------
    write : callable             writes the files into the folder that it is given the path of
    is_replaced : callable       whether an entry of the earlier folder is left out; all others stay, unless the new
                                 folder has one of the same name

    Raises
    ------
    SoftShadowError              the folder cannot be made or written
    """
    place = folder.resolve()
    with _named(folder):
        _delete_abandoned(place.parent)
        stays = place == Path.cwd() or place in Path.cwd().parents or os.path.ismount(place)
        stays = stays or not os.access(place.parent, os.W_OK)
        beside = place if stays else place.parent
        temporary = Path(tempfile.mkdtemp(prefix=_prefix(), dir=beside))
        try:
            write(temporary)
            temporary.chmod(place.stat().st_mode if place.exists() else 0o777 & ~_umask())
            if not place.exists():
                temporary.rename(place)
                return folder
            kept = [entry for entry in place.iterdir() if entry != temporary and not is_replaced(entry)]
            if not stays:
                for entry in kept:
                    _link(entry, temporary / entry.name)
                exchange(temporary, place)
                return folder
            for entry in set(place.iterdir()) - {temporary, *kept}:
                _delete(entry)
            _move_files(temporary, place)
        finally:
            shutil.rmtree(temporary, ignore_errors=True)
    return folder


def make_parents(folder: Path) -> None:
    """Create the folders that a folder shall lie in.

    Raises
    ------
    SoftShadowError              one of them cannot be made; or what shall be the folder is something else
    """
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        if folder.exists() and not folder.is_dir():
            raise SoftShadowError(f"{folder}: is a file, expected the name of a folder")
    except OSError as error:
        raise SoftShadowError(f"{folder}: the folder cannot be made ({error.strerror})") from None


@contextmanager
def _named(path: Path) -> Iterator[None]:
    """Turn errors of the operating system into one that names the path."""
    try:
        yield
    except (OSError, ValueError) as error:  # a ValueError for a name with a zero byte
        if isinstance(error, ValueError) and "null byte" not in str(error):
            raise
        reason = getattr(error, "strerror", None) or error
        raise SoftShadowError(f"{path}: cannot be written ({reason})") from None


def _link(entry: Path, new: Path) -> None:
    """Add what is kept of an earlier folder to the new one, by links to the same files where they can be made."""
    if new.exists() and not (entry.is_dir() and new.is_dir()):
        return
    if entry.is_dir() and not entry.is_symlink():
        new.mkdir(exist_ok=True)
        for inner in entry.iterdir():
            _link(inner, new / inner.name)
        return
    try:
        os.link(entry, new, follow_symlinks=False)
    except OSError:  # as on file systems without links
        shutil.copy2(entry, new, follow_symlinks=False)


def _move_files(source: Path, target: Path) -> None:
    """Move all files of a folder into another one, over those of the same names."""
    for place, _, names in os.walk(source):
        for name in names:
            path = Path(place, name)
            new = target / path.relative_to(source)
            new.parent.mkdir(parents=True, exist_ok=True)
            path.replace(new)


def _delete(entry: Path) -> None:
    if entry.is_dir() and not entry.is_symlink():
        shutil.rmtree(entry)
    else:
        entry.unlink()


def _prefix() -> str:
    """Return how the names of this process's temporary files begin."""
    return f".softshadow-{HOST}-{os.getpid()}-"


def _delete_abandoned(folder: Path) -> None:
    """Delete the temporary files and folders of processes of this machine that have ended without doing so."""
    if sys.platform == "win32":  # which has no question whether a process lives
        return
    with suppress(OSError):
        for entry in folder.glob(".softshadow-*"):
            match = TEMPORARY.fullmatch(entry.name)
            if match and match[1] == HOST and not _is_alive(int(match[2])):
                with suppress(OSError):
                    _delete(entry)


def _is_alive(process: int) -> bool:
    try:
        os.kill(process, 0)  # sends nothing
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # another user's
        return True
    return True


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
