"""Threads:

Bands of rows on a persistent pool. Each pixel is processed in drawing order by one thread, whatever their number.
"""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

ROWS = 16  # of a band; measured flat within 3 % from 1 to 16
WORTH = 200_000  # fragments from which the hand-over to other threads is small against the work

_threads = [0]
_pool: dict[int, ThreadPoolExecutor] = {}


def set_threads(n: int) -> None:
    """Set how many threads a draw may use. Results do not depend on it.

    Raises
    ------
    ValueError
        `n` is not a whole number from 1 on.
    """
    if isinstance(n, bool) or not isinstance(n, int) or n < 1:
        raise ValueError(f"n={n!r}: expected a number of threads, 1 or more")
    _threads[0] = n


def threads() -> int:
    """Return how many threads a draw may use: as many as there are cores, unless set."""
    if _threads[0]:
        return _threads[0]
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def in_bands(work: Callable[[int, int], None], first_row: int, end_row: int, fragments: int) -> None:
    """Call ``work(first, end)`` for all rows, in bands on the threads where there is enough to do."""
    n = threads()
    if n == 1 or fragments < WORTH or end_row - first_row <= ROWS:
        work(first_row, end_row)
        return
    if n not in _pool:
        _pool[n] = ThreadPoolExecutor(n, thread_name_prefix="softshadow")
    starts = range(first_row, end_row, ROWS)
    list(_pool[n].map(lambda start: work(start, min(start + ROWS, end_row)), starts))
