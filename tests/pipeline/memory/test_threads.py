"""Threads: each piece of work is done once, and an exception in one reaches the caller."""

import pytest

from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.memory import threads as pool
from softshadow.pipeline.memory.threads import PART_SIZE, VARIABLE, parts_of, share


@pytest.fixture(params=[1, 3], ids="{} threads".format)
def some_threads(request):
    before = threads()
    set_threads(request.param)
    yield request.param
    set_threads(before)


@pytest.mark.parametrize("n", [0, 1, 2, 100])
def test_each_piece_is_done_once(some_threads, n):
    done: list[int] = []

    def work(number: int) -> int:
        done.append(number)
        return number**2

    assert share(work, n) == [number**2 for number in range(n)]
    assert sorted(done) == list(range(n))


def test_an_exception_in_a_piece_reaches_the_caller(some_threads):
    def fail(number: int) -> None:
        if number == 7:
            raise RuntimeError("piece 7")

    with pytest.raises(RuntimeError, match="piece 7"):
        share(fail, 20)


def test_a_piece_of_shared_work_has_one_thread(some_threads):
    assert share(lambda number: threads(), 9) == [1] * 9
    with pytest.raises(ZeroDivisionError):
        share(lambda number: 1 // number, 9)
    assert threads() == some_threads


@pytest.mark.parametrize("n", [0, 1, PART_SIZE, PART_SIZE + 1, 5 * PART_SIZE - 1])
def test_parts_make_up_the_whole(some_threads, n):
    assert [item for first, end in parts_of(n) for item in range(first, end)] == list(range(n))


@pytest.fixture
def no_threads_set(monkeypatch):
    monkeypatch.setattr(pool, "_threads", [0])
    pool._default_threads.cache_clear()
    yield monkeypatch
    pool._default_threads.cache_clear()


def test_the_environment_sets_the_number_of_threads_until_set_threads_does(no_threads_set):
    no_threads_set.setenv(VARIABLE, "3")
    assert threads() == 3
    set_threads(2)
    assert threads() == 2


def test_by_default_there_are_as_many_threads_as_cores(no_threads_set):
    no_threads_set.setenv(VARIABLE, "")
    no_threads_set.setattr(pool.os, "sched_getaffinity", lambda process: {0, 1, 5}, raising=False)
    assert threads() == 3


@pytest.mark.parametrize("value", ["0", "-1", "two", "1.5"])
def test_an_invalid_number_of_threads_in_the_environment_is_refused(no_threads_set, value):
    no_threads_set.setenv(VARIABLE, value)
    with pytest.raises(ValueError, match=f"{VARIABLE}='{value}': expected a number of threads, 1 or more"):
        threads()


def test_work_can_share_work(some_threads):
    assert share(lambda outer: sum(share(lambda inner: outer * inner, 5)), 6) == [10 * n for n in range(6)]
