"""Where the machine code of a kernel is on disk.

Numba names the folder by the path of the source file, and asks for the file's time and content. So a second environment
with the same version would compile everything again, although `softshadow.kernel_cache.KernelGroup` says that all is
there. The cache folder is named by a hash of all sources of kernels, so neither is needed for those of this package.
"""

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, Self

from softshadow.kernel_cache import cache_folder

PACKAGE = Path(__file__).parent.parent


@cache
def folder_for(sources: str) -> Path | None:
    """Make and return the folder for kernels whose sources are in a folder of this package; None if there is none."""
    base, path = cache_folder(), Path(os.path.abspath(sources))
    if base is None or not path.is_relative_to(PACKAGE):
        return None
    folder = base / (".".join(path.relative_to(PACKAGE).parts) or PACKAGE.name)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return None
    return folder


class KernelPlace:
    """The place of a kernel of this package, as one of Numba's cache locators.

    Parameters
    ----------
    folder : Path          of the machine code of all kernels in a folder of the package
    line : int             where the kernel begins in its file
    """

    def __init__(self, folder: Path, line: int) -> None:
        self._folder, self._line = folder, line

    @classmethod
    def from_function(cls, function: Callable[..., Any], file: str) -> Self | None:
        """Return the place; None for functions of other packages, and where nothing can be stored."""
        folder = folder_for(os.path.dirname(file))
        return None if folder is None else cls(folder, function.__code__.co_firstlineno)

    def ensure_cache_path(self) -> None:
        """Do nothing: the folder is there."""

    def get_cache_path(self) -> str:
        """Return the path of the folder."""
        return str(self._folder)

    def get_source_stamp(self) -> tuple[()]:
        """Return what stands for the version of the source: nothing, as the name of the cache folder tells it."""
        return ()

    def get_disambiguator(self) -> str:
        """Return what tells functions of the same name apart."""
        return str(self._line)
