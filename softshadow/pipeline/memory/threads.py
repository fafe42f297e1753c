"""A persistent thread pool; idle threads take the next piece of work.

Which thread takes which piece changes no result: a pixel lies in one band of rows, and one thread processes a band in
drawing order (`raster/bins.py`).
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from threading import Lock
from typing import TypeVar, cast

Result = TypeVar("Result")

PART = 1 << 15  # vertices or triangles; some tenths of a millisecond

VARIABLE = "SOFTSHADOW_THREADS"

_threads = [0]
_pool: dict[int, ThreadPoolExecutor] = {}
_making = Lock()


def set_threads(n: int) -> None:
    """Set how many threads a draw may use, in this process. Results do not depend on it.

    Raises
    ------
    ValueError
        `n` is not a whole number from 1 on.
    """
    if isinstance(n, bool) or not isinstance(n, int) or n < 1:
        raise ValueError(f"n={n!r}: expected a number of threads, 1 or more")
    _threads[0] = n


def threads() -> int:
    """Return how many threads a draw may use: what was set, else SOFTSHADOW_THREADS, else as many as there are cores.

    Raises
    ------
    ValueError
        The environment variable is not a whole number from 1 on.
    """
    if _threads[0]:
        return _threads[0]
    given = os.environ.get(VARIABLE, "").strip()
    if not given:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not given.isdecimal() or int(given) < 1:
        raise ValueError(f"{VARIABLE}={given!r}: expected a number of threads, 1 or more")
    return int(given)


def share(work: Callable[[int], Result], count: int) -> list[Result]:
    """Return ``[work(0), ..., work(count - 1)]``, each called on the thread that is idle next."""
    most = threads()
    n = min(most, count)
    if n <= 1:
        return [work(number) for number in range(count)]
    numbers, results = iter(range(count)), [cast(Result, None)] * count

    def until_none_is_left() -> None:
        for number in numbers:  # the threads share the iterator: each number is handed out once
            results[number] = work(number)

    with _making:
        if n > 1 and most not in _pool:
            _pool[most] = ThreadPoolExecutor(most, thread_name_prefix="softshadow")
    # the caller is the first thread; the others get its context (NumPy's error state, use_short_cuts)
    others = [_pool[most].submit(copy_context().run, until_none_is_left) for _ in range(n - 1)]
    try:
        until_none_is_left()
    finally:
        for other in others:
            if not other.cancel():  # not started yet: no work is left for it
                other.result()
    return results


def parts_of(count: int, size: int = PART) -> list[tuple[int, int]]:
    """Return first and end of the parts of ``range(count)`` to share: one part for one thread, else of `size` each.

    A part should take longer than its hand-over to another thread.
    """
    if threads() == 1:
        return [(0, count)]
    return [(first, min(first + size, count)) for first in range(0, max(count, 1), size)]


def share_chunks(work: Callable[[int, int], None], count: int, size: int) -> None:
    """Call ``work(first, end)`` for chunks of ``range(count)`` on the idle threads; one thread gets one chunk."""
    size = size if threads() > 1 else max(count, 1)
    share(lambda n: work(n * size, min(n * size + size, count)), -(-count // size))
