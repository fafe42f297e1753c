"""Persistent threads; idle ones take the next piece of work.

Which thread takes which piece changes no result: a pixel lies in one band of rows, and one thread processes a band in
drawing order (`raster/bins.py`).

The threads of `concurrent.futures` cost 110 to 140 us for each piece of work that is shared, these 60.
"""

import os
import threading
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from contextvars import Context, copy_context
from functools import cache
from itertools import pairwise
from queue import SimpleQueue
from typing import TypeVar, cast

Result = TypeVar("Result")

PART_SIZE = 1 << 14  # vertices or triangles; they take some tenths of a millisecond

VARIABLE = "SOFTSHADOW_THREADS"

_threads = [0]


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


class _Piece(threading.local):
    """Whether this thread does a piece of work that is shared."""

    is_begun = False


_piece = _Piece()


def threads() -> int:
    """Return how many threads a draw may use: the number set, else SOFTSHADOW_THREADS, else the number of cores.

    The variable is read once. For a piece of work that is shared, it is one.

    Raises
    ------
    ValueError
        The environment variable is not a whole number from 1 on.
    """
    return 1 if _piece.is_begun else _threads[0] or _default_threads()


@cache
def _default_threads() -> int:
    text = os.environ.get(VARIABLE, "").strip()
    if not text:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not text.isdecimal() or int(text) < 1:
        raise ValueError(f"{VARIABLE}={text!r}: expected a number of threads, 1 or more")
    return int(text)


class _Helpers:
    """Threads that wait for jobs, functions without arguments that raise nothing; they end with the process."""

    def __init__(self) -> None:
        self._jobs: SimpleQueue[Callable[[], None]] = SimpleQueue()
        self._started, self._lock = 0, threading.Lock()

    def add(self, job: Callable[[], None], n: int) -> None:
        """Let `n` threads do a job, as soon as they are idle."""
        if self._started < n:
            with self._lock:
                for number in range(self._started, n):
                    threading.Thread(target=self._work, name=f"softshadow-{number}", daemon=True).start()
                self._started = max(self._started, n)
        for _ in range(n):
            self._jobs.put(job)

    def _work(self) -> None:
        while True:
            self._jobs.get()()


_helpers = [_Helpers()]


def _forget_helpers() -> None:  # a forked process has none of its parent's threads
    _helpers[0] = _Helpers()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_helpers)


def share(work: Callable[[int], Result], n_pieces: int, pays: bool = True) -> list[Result]:
    """Return ``[work(0), ..., work(n_pieces - 1)]``; an idle thread takes one of the pieces that are left.

    The caller takes the first one, the others the last one: so in the next call with such pieces, each thread finds
    most of what it wrote in the cache of its core.

    Parameters
    ----------
    pays : whether all pieces take 300 us together; below this, the caller does them sooner alone
    """
    n_helpers = min(threads(), n_pieces) - 1
    if n_helpers < 1 or not pays:
        return [work(number) for number in range(n_pieces)]
    numbers, results = deque(range(n_pieces)), [cast(Result, None)] * n_pieces
    # a helper takes a ticket before it begins; the caller takes those that are left when no work is left
    tickets, ends = [copy_context() for _ in range(n_helpers)], SimpleQueue[BaseException | None]()

    def until_none_is_left(take: Callable[[], int]) -> None:
        _piece.is_begun = True
        try:
            while True:
                try:
                    number = take()
                except IndexError:
                    return
                results[number] = work(number)
        finally:
            _piece.is_begun = False

    def help_the_caller() -> None:
        try:
            context = tickets.pop()
        except IndexError:
            return
        try:  # in the caller's context: NumPy's error state, use_short_cuts
            context.run(until_none_is_left, numbers.pop)
        except BaseException as problem:
            ends.put(problem)
        else:
            ends.put(None)

    _helpers[0].add(help_the_caller, n_helpers)
    try:
        until_none_is_left(numbers.popleft)
    finally:
        problems = [problem for _ in range(n_helpers - _empty(tickets)) if (problem := ends.get()) is not None]
    if problems:
        raise problems[0]
    return results


def _empty(tickets: list[Context]) -> int:
    """Take all tickets, which helpers may do at the same time, and return how many these were."""
    n = 0
    with suppress(IndexError):
        while True:
            tickets.pop()
            n += 1
    return n


def parts_of(n_items: int, size: int | None = None) -> list[tuple[int, int]]:
    """Return first and end of parts of ``range(n_items)``: one part for one thread, else parts of at least `size`.

    They are about equal, and as many for each thread. A part should take at least 150 us: see `share`.
    """
    n_threads = threads()
    n_parts = n_items // (size or PART_SIZE) // n_threads * n_threads
    if n_threads == 1 or n_parts <= 1:
        return [(0, n_items)]
    cuts = [n_items * n // n_parts for n in range(n_parts + 1)]
    return list(pairwise(cuts))
