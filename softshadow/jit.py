"""The one spelling of a kernel, and the folder its machine code is kept in.

Numba's own cache does not see that a function in another file has changed. The folder is therefore named after a hash
of all sources that can take part in a kernel: an edit is answered by new code, never by a stale result.
"""

import gc
import hashlib
import os
import shutil
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba.core import event

# all that kernels are in, and all that these import: its constants are part of the compiled code
KERNEL_SOURCES = (
    "bench/plain_loops.py", "errors.py", "framebuffer.py", "image.py", "jit.py", "matrices.py", "pixel_store.py",
    "pixels.py", "state", "texture.py", "tokens.py", "pipeline", "programs", "scene", "truth",
)  # fmt: skip
KEPT_VERSIONS = 8
# no kernel is called from C: its wrapper for that would take a twentieth of the time of compilation
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}


@cache
def source_hash() -> str:
    """Return the hash of every source that kernels are made of, 16 hex digits."""
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
    """Return the folder for compiled kernels, or None where none can be written (then nothing is kept)."""
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
            _forget_old(folder.parent)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return None


def _forget_old(folder: Path) -> None:
    """Delete the code of all versions but the last few that were used: each edit and upgrade makes a folder."""
    versions = sorted((entry for entry in folder.iterdir() if entry.is_dir()), key=lambda entry: entry.stat().st_mtime)
    for version in versions[:-KEPT_VERSIONS]:
        shutil.rmtree(version, ignore_errors=True)


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function of the fragment, vertex or geometry loops (decorator).

    IEEE arithmetic as written (no fastmath), no bounds or division checks, runs without the interpreter lock.
    With ``NUMBA_DISABLE_JIT=1`` the function stays plain Python.
    """
    folder = cache_folder()
    config: Any = numba.config  # its settings are made when Numba is imported; type checkers see none
    kept = config.CACHE_DIR
    # the folder is read when the decorator runs, so a user's own setting is back before anybody else can see ours
    config.CACHE_DIR = str(folder) if folder else ""
    try:
        return numba.njit(cache=folder is not None, **OPTIONS)(function)
    finally:
        config.CACHE_DIR = kept


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function into each kernel that calls it (decorator): what it is called with there is folded away.

    For one that kernels call in a place or two this is also the faster way to compile it: as a kernel of its own it
    gets a wrapper, a cache entry and machine code that nothing uses.
    """
    return numba.njit(inline="always", **OPTIONS)(function)


class _CollectAfterwards(event.Listener):
    """Lets garbage collection wait while Numba compiles, where looking for garbage took a tenth of the time."""

    def __init__(self) -> None:
        self.depth = 0  # kernels are compiled inside the compilation of others, under one lock
        self.collected = True

    def on_start(self, event: event.Event) -> None:
        if self.depth == 0:
            self.collected = gc.isenabled()
            gc.disable()
        self.depth += 1

    def on_end(self, event: event.Event) -> None:
        self.depth -= 1
        if self.depth == 0 and self.collected:
            gc.enable()


event.register("numba:compile", _CollectAfterwards())


def read_only(array: np.ndarray) -> np.ndarray:
    """Return a view that cannot be written to.

    To the compiler it is another type: a kernel that gets users' arrays, which are read-only, gets all its arrays so,
    or it would be compiled twice.
    """
    view = array.view()
    view.flags.writeable = False
    return view
