"""Scratch arrays never share memory while they are in use, and use the memory of earlier ones."""

import threading
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow.pipeline.memory import scratch as module
from softshadow.pipeline.memory.scratch import LINE, POOLED, SMALLEST, apart, row_columns, scratch

LARGE = SMALLEST // 4


def address(array):
    return array.__array_interface__["data"][0]


@pytest.fixture
def empty_pool(monkeypatch):
    monkeypatch.setattr(module, "_pool", module._Pool())


def test_memory_is_reused_once_nothing_refers_to_it(empty_pool):
    first = scratch((2, LARGE), np.float32)
    where = address(first)
    part = first[1, 5:]
    del first
    other = scratch((2, LARGE), np.int32)
    assert not np.shares_memory(other, part)  # a view keeps the block in use
    del part
    assert address(scratch((2, LARGE), np.int32)) == where


def test_memory_is_reused_beside_arrays_that_stay_in_use(empty_pool):
    kept = [scratch(LARGE, np.int32) for _ in range(5)]
    where = address(scratch(LARGE, np.int32))
    assert where not in map(address, kept)
    assert {address(scratch(LARGE, np.int32)) for _ in range(10)} == {where}
    released = address(kept.pop(2))
    both = scratch(LARGE, np.int32), scratch(LARGE, np.int32)
    assert set(map(address, both)) == {where, released}


def test_a_scratch_array_has_the_requested_shape_and_type():
    for shape in (0, 3, (4, 5), LARGE, np.int64(LARGE), (3, np.int64(LARGE)), (LARGE, 0)):
        for kind in (np.uint8, np.int32, np.float64):
            array = scratch(shape, kind)
            assert array.dtype == kind
            assert array.shape == np.empty(shape, kind).shape
            assert array.flags.c_contiguous
            assert array.flags.writeable
            assert array.flags.aligned


@given(st.lists(st.tuples(st.integers(SMALLEST // 4, SMALLEST), st.booleans()), max_size=30))
def test_arrays_in_use_never_share_memory(requests):
    in_use = []
    for number, (size, keep) in enumerate(requests):
        array = scratch(size, np.int32)
        array[:] = number
        if keep:
            in_use.append((number, array))
    for number, array in in_use:
        assert (array == number).all()


def test_pooled_memory_is_bounded_and_arrays_in_use_survive():
    half = POOLED // 8
    arrays = [scratch(half // 4, np.int32) for _ in range(9)]  # more than the pool holds
    for n, array in enumerate(arrays):
        array[:100] = n
    assert [int(array[0]) for array in arrays] == list(range(9))


def test_threads_have_memory_of_their_own():
    mine, theirs = scratch(LARGE, np.int32), []
    thread = threading.Thread(target=lambda: theirs.append(scratch(LARGE, np.int32)))
    thread.start()
    thread.join()
    assert not np.shares_memory(mine, theirs[0])


@pytest.mark.parametrize("shape", [1, 32, (2, 5)])
@pytest.mark.parametrize("kind", [np.uint8, np.int64])
def test_an_array_that_lies_apart_has_its_cache_lines_alone(shape, kind):
    arrays = [apart(shape, kind) for _ in range(20)]
    places = sorted(map(address, arrays))
    assert all(end - begin >= arrays[0].nbytes + LINE for begin, end in pairwise(places))
    assert all(each.shape == np.empty(shape).shape and each.dtype == kind for each in arrays)
    assert all(each.flags.c_contiguous and each.flags.writeable and each.flags.aligned for each in arrays)
    base = arrays[0].base  # bytes that nothing else uses, before and behind
    assert LINE <= address(arrays[0]) - address(base) <= base.nbytes - arrays[0].nbytes - LINE


def test_columns_of_rows_are_those_of_one_thread():
    ours = row_columns(7)
    assert ours.shape[0] == 2
    assert ours.shape[1] >= 7
    assert row_columns(3) is ours
    longer = row_columns(ours.shape[1] + 1)
    assert longer.shape == (2, ours.shape[1] + 1)
    theirs = []
    thread = threading.Thread(target=lambda: theirs.append(row_columns(7)))
    thread.start()
    thread.join()
    assert not np.shares_memory(theirs[0], longer)
