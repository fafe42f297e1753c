"""Two folders exchange their names in one operation, so that each name always is that of a whole folder."""

import ctypes
import os
import sys
import tempfile
from pathlib import Path

AT_FDCWD, RENAME_EXCHANGE = -100, 2  # of Linux, <fcntl.h> and <linux/fs.h>


def exchange(one: Path, other: Path) -> None:
    """Exchange the names of two folders beside each other.

    Linux does this in one operation. Elsewhere, and on file systems that cannot do it, a process that is killed between
    two of the three renamings leaves both folders whole, one of them under a name that begins with that of `one`.

    Raises
    ------
    OSError                      the names cannot be changed
    """
    if sys.platform == "linux" and _exchanged_at_once(one, other):
        return
    aside = Path(tempfile.mkdtemp(prefix=one.name, dir=one.parent))
    other.rename(aside / other.name)
    one.rename(other)
    (aside / other.name).rename(one)
    aside.rmdir()


def _exchanged_at_once(one: Path, other: Path) -> bool:
    rename = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    return rename is not None and not rename(AT_FDCWD, os.fsencode(one), AT_FDCWD, os.fsencode(other), RENAME_EXCHANGE)
