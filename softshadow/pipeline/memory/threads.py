"""A persistent thread pool; idle threads take the next piece of work.

Which thread takes which piece changes no result: a pixel lies in one band of rows, and one thread processes a band in
drawing order (`raster/bins.py`).
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from functools import cache
from itertools import pairwise
from threading import Lock
from typing import TypeVar, cast

Result = TypeVar("Result")

PART_SIZE = 1 << 14  # vertices or triangles; they take some tenths of a millisecond

VARIABLE = "SOFTSHADOW_THREADS"

_threads = [0]
_pool: dict[int, ThreadPoolExecutor] = {}
_pool_lock = Lock()


def set_threads(n: int) -> None:
    """Set how many threads a draw may use in this process; results do not depend on it.

    Raises
    ------
    ValueError
        `n` is not a whole number from 1 on.
    """
    if isinstance(n, bool) or not isinstance(n, int) or n < 1:
        raise ValueError(f"n={n!r}: expected a number of threads, 1 or more")
    _threads[0] = n


def threads() -> int:
    """Return how many threads a draw may use: the number set, else SOFTSHADOW_THREADS, else the number of cores.

    The variable is read once.

    Raises
    ------
    ValueError
        The environment variable is not a whole number from 1 on.
    """
    return _threads[0] or _default_threads()


@cache
def _default_threads() -> int:
    text = os.environ.get(VARIABLE, "").strip()
    if not text:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not text.isdecimal() or int(text) < 1:
        raise ValueError(f"{VARIABLE}={text!r}: expected a number of threads, 1 or more")
    return int(text)


def share(work: Callable[[int], Result], n_pieces: int) -> list[Result]:
    """Return ``[work(0), ..., work(n_pieces - 1)]``; the next idle thread takes the next piece."""
    limit = threads()
    n_threads = min(limit, n_pieces)
    if n_threads <= 1:
        return [work(number) for number in range(n_pieces)]
    numbers, results = iter(range(n_pieces)), [cast(Result, None)] * n_pieces

    def until_none_is_left() -> None:
        for number in numbers:  # the threads share the iterator: each number is handed out once
            results[number] = work(number)

    with _pool_lock:
        if limit not in _pool:
            _pool[limit] = ThreadPoolExecutor(limit, thread_name_prefix="softshadow")
    # the caller is the first thread; the others get its context (NumPy's error state, use_short_cuts)
    others = [_pool[limit].submit(copy_context().run, until_none_is_left) for _ in range(n_threads - 1)]
    try:
        until_none_is_left()
    finally:
        for other in others:
            if not other.cancel():  # not started yet: no work is left for it
                other.result()
    return results


def parts_of(n_items: int, size: int | None = None) -> list[tuple[int, int]]:
    """Return first and end of parts of ``range(n_items)``: one part for one thread, else parts of `size` (PART_SIZE).

    They are about equal, and as many for each thread. A part should take longer than its hand-over to another thread.
    """
    n_parts, n_threads = -(-n_items // (size or PART_SIZE)), threads()
    if n_threads == 1 or n_parts <= 1:
        return [(0, n_items)]
    n_parts = -(-n_parts // n_threads) * n_threads
    cuts = [n_items * n // n_parts for n in range(n_parts + 1)]
    return [(first, end) for first, end in pairwise(cuts) if first < end]


def share_chunks(work: Callable[[int, int], None], n_items: int, size: int) -> None:
    """Call ``work(first, end)`` for chunks of ``range(n_items)`` on idle threads; one thread gets a single chunk."""
    size = size if threads() > 1 else max(n_items, 1)
    share(lambda n: work(n * size, min(n * size + size, n_items)), -(-n_items // size))
