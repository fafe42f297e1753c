"""The folder that caches the machine code of kernels.

Numba's cache does not notice changes of functions in other files. So the folder is named by a hash of all sources that
can be part of a kernel: after an edit, everything is compiled again and no stale code is used.
"""

import hashlib
import os
import shutil
import sys
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

# all files with kernels, and all files these import: constants become part of the compiled code
KERNEL_SOURCES = (
    "bench/plain_loops.py", "color_values.py", "context/matrix_kinds.py", "context/matrix_products.py",
    "encoded_pixels.py", "errors.py", "framebuffer.py", "frozen.py", "gl/bezier.py", "gl/mipmap_scaling.py", "image.py",
    "jit", "kernel_cache.py", "matrices.py", "packed_colors.py", "packed_floats.py", "pixel_store.py",
    "pixel_transfer.py", "pixels.py", "state", "texel_codes.py", "texture.py", "tokens.py", "pipeline", "programs",
    "scene", "truth",
)  # fmt: skip
MAX_VERSIONS = 8


@cache
def source_hash() -> str:
    """Return the hash of all kernel sources, 16 hex digits."""
    root = Path(__file__).parent
    digest = hashlib.blake2b(digest_size=8)
    for block in KERNEL_SOURCES:
        path = root / block
        for file in [path] if path.is_file() else sorted(path.rglob("*.py")):
            digest.update(str(file.relative_to(root)).encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


@cache
def cache_folder() -> Path | None:
    """Return the cache folder for compiled kernels; None if it cannot be written, then nothing is cached."""
    if "NUMBA_CACHE_DIR" in os.environ:
        base = Path(os.environ["NUMBA_CACHE_DIR"])
    elif sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local"))
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    folder = base / "softshadow" / source_hash()
    try:
        if not folder.exists():
            folder.mkdir(parents=True, exist_ok=True)
            _delete_old_versions(folder.parent)
        with suppress(OSError):  # as in a folder of another user
            os.utime(folder)  # it is in use, even where no file is added
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return None


def _delete_old_versions(folder: Path) -> None:
    """Delete all but the most recently used versions: each edit and each upgrade makes a new folder."""
    versions = sorted((entry for entry in folder.iterdir() if entry.is_dir()), key=lambda entry: entry.stat().st_mtime)
    for version in versions[:-MAX_VERSIONS]:
        shutil.rmtree(version, ignore_errors=True)


def is_empty(folder: Path) -> bool:
    """Return whether no compiled kernel is in the cache folder."""
    return next(folder.rglob("*.nbi"), None) is None


def announcement() -> str:
    """Return what to tell people who wait for the compiler."""
    if cache_folder() is None:
        return "compiling kernels at every start, because no cache folder is writable (set NUMBA_CACHE_DIR) ..."
    return "compiling kernels, only the first time; `softshadow warmup` does it beforehand ..."


class KernelGroup:
    """Kernels that are compiled together and take seconds: one picture is finished earlier without them.

    Parameters
    ----------
    name : str               of the empty file in the cache folder that says that they are on disk
    pays_after : int         work without them, in a unit of the caller's, from which compiling them pays
    """

    def __init__(self, name: str, pays_after: int = 0) -> None:
        self.pays_after = pays_after
        self._name, self._done = name, 0
        self._known: bool | None = None

    def are_compiled(self) -> bool:
        """Return whether the kernels were compiled before, by this process or one before it."""
        if self._known is None:
            folder = cache_folder()
            self._known = folder is not None and (folder / self._name).exists()
        return self._known

    def note_compiled(self) -> None:
        """Note that the kernels are compiled from now on."""
        if self._known:
            return
        self._known, folder = True, cache_folder()
        if folder is not None:
            with suppress(OSError):  # the folder was deleted meanwhile
                (folder / self._name).touch()

    def want(self) -> None:
        """Let the next work pay for compiling: many frames are expected."""
        self.pays_after = 0

    def pay_for(self, work: int, at_once: bool = False) -> bool:
        """Return whether to use the kernels for so much work: they are compiled, or compiling them pays now."""
        if self.are_compiled():
            return True
        self._done += work
        if self._done < self.pays_after and not at_once:
            return False
        self.note_compiled()
        return True
