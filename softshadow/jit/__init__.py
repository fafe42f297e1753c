"""The decorators that compile kernels."""

import gc
import logging
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numba
import numpy as np
from numba.core import event

from softshadow.jit.stored_code import KernelDispatcher
from softshadow.kernel_cache import announcement, cache_folder

# no kernel is called from C, and a wrapper for it would take a twentieth of the compile time
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function of the fragment, vertex or geometry loops (decorator).

    IEEE arithmetic as written (no fastmath), no bounds or division checks, no interpreter lock (nogil). A kernel makes
    no arrays: so references to arrays need not be counted, which took longer than many a loop.
    With ``NUMBA_DISABLE_JIT=1`` the function stays plain Python.
    """
    return _dispatcher_of(function, counts_references=False)


def wide_kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel whose loops, and those of all kernels in it, are mostly long (decorator), else as `kernel`.

    They use the longest vectors that the processor has. Short loops would take longer with these.
    """
    return _dispatcher_of(function, counts_references=False, is_wide=True)


def allocating_kernel(function: Callable[..., Any]) -> Any:
    """Compile a function that makes arrays (decorator), else as `kernel`; loops in it should call kernels."""
    return _dispatcher_of(function, counts_references=True)


def copied_kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel that is copied into each kernel that calls it (decorator).

    Its types are found once, where `inlined` finds them in each caller anew.
    """
    return _dispatcher_of(function, counts_references=False, forceinline=True)


def _dispatcher_of(function: Callable[..., Any], *, counts_references: bool, is_wide: bool = False, **more: Any) -> Any:
    config: Any = numba.config  # type checkers do not see its settings, which Numba creates at import
    if config.DISABLE_JIT:
        return function
    as_in_njit = {"nopython": True, "boundscheck": None}
    options = {**as_in_njit, "_nrt": counts_references, **OPTIONS, **more}
    dispatcher = KernelDispatcher(function, targetoptions=options)
    dispatcher.set_wide(is_wide)
    folder = cache_folder()
    if folder:
        users_folder = config.CACHE_DIR
        # the folder is read at once, so the user's own setting can be restored right after it
        config.CACHE_DIR = str(folder)
        try:
            dispatcher.enable_caching()
        finally:
            config.CACHE_DIR = users_folder
    return dispatcher


def inlined(function: Callable[..., Any]) -> Any:
    """Inline a function into each kernel that calls it (decorator); constant arguments are folded.

    A function that kernels call in one or two places also compiles faster this way: a kernel of its own would get a
    wrapper, a cache entry and machine code that are never used.
    """
    return numba.njit(inline="always", **OPTIONS)(function)


def announce_compiling() -> None:
    """Log that a program waits for its kernels, which takes up to a minute; without handlers, that is printed."""
    config: Any = numba.config
    if not config.DISABLE_JIT:
        logging.getLogger("softshadow").warning("softshadow: %s", announcement())


class _PauseCollection(event.Listener):
    """Pauses garbage collection while Numba compiles: it took a tenth of the compile time."""

    def __init__(self) -> None:
        self.depth = 0  # compilations are nested, under one lock
        self.was_enabled = True

    def on_start(self, event: event.Event) -> None:
        if self.depth == 0:
            self.was_enabled = gc.isenabled()
            gc.disable()
        self.depth += 1

    def on_end(self, event: event.Event) -> None:
        self.depth -= 1
        if self.depth == 0 and self.was_enabled:
            gc.enable()


event.register("numba:compile", _PauseCollection())


def read_only(array: np.ndarray) -> np.ndarray:
    """Return a view that cannot be written to.

    Read-only arrays are a type of their own for the compiler. Users' arrays are read-only, so a kernel that gets them
    must get all arrays read-only; otherwise it would be compiled twice.
    """
    view = array.view()
    view.flags.writeable = False
    return view


class _Nesting(threading.local):
    depth = 0


# a kernel and the types of its arguments, in the order of the first calls
Kernels = dict[tuple[Any, tuple[Any, ...]], None]


@contextmanager
def rehearsing() -> Iterator[Kernels]:
    """Inside the block, run kernels that are not compiled yet as plain Python, and note which ones are called.

    Calls between kernels are not noted. ``kernel.compile(types)`` compiles a noted one, or finds it in the cache.
    """
    kernels: Kernels = {}
    nesting = _Nesting()
    dispatcher: Any = KernelDispatcher
    compile_for_args = dispatcher._compile_for_args

    def note_call(kernel: Any, *arguments: Any) -> Callable[..., Any]:
        if nesting.depth == 0:
            kernels.setdefault((kernel, tuple(map(kernel.typeof_pyval, arguments))))

        def interpret(*arguments: Any) -> Any:
            nesting.depth += 1
            try:
                result = kernel.py_func(*arguments)
            finally:
                nesting.depth -= 1
            return result if nesting.depth else _python_value(result)

        return interpret  # which Numba calls in place of the compiled kernel

    dispatcher._compile_for_args = note_call
    try:
        yield kernels
    finally:
        dispatcher._compile_for_args = compile_for_args


def _python_value(result: Any) -> Any:
    """Return the result of an interpreted kernel as a compiled one returns it: numbers are Python's own."""
    if type(result) is tuple:
        return tuple(map(_python_value, result))
    return result.item() if isinstance(result, np.generic) else result
