"""Threads: each piece of work is done once, and what goes wrong in one is told."""

import pytest

from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.bands import PART, parts_of, share


@pytest.fixture(params=[1, 3], ids="{} threads".format)
def some_threads(request):
    before = threads()
    set_threads(request.param)
    yield request.param
    set_threads(before)


@pytest.mark.parametrize("count", [0, 1, 2, 100])
def test_each_piece_is_done_once(some_threads, count):
    done: list[int] = []

    def work(number: int) -> int:
        done.append(number)
        return number**2

    assert share(work, count) == [number**2 for number in range(count)]
    assert sorted(done) == list(range(count))


def test_what_a_piece_raises_reaches_the_caller(some_threads):
    def fail(number: int) -> None:
        if number == 7:
            raise RuntimeError("piece 7")

    with pytest.raises(RuntimeError, match="piece 7"):
        share(fail, 20)


@pytest.mark.parametrize("count", [0, 1, PART, PART + 1, 5 * PART - 1])
def test_parts_make_up_the_whole(some_threads, count):
    assert [n for first, end in parts_of(count) for n in range(first, end)] == list(range(count))
