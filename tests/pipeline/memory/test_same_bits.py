"""Arrays are equal if their bytes are, wherever these lie."""

import numpy as np
import pytest

from softshadow.pipeline.memory.comparison import same_bits, same_memory

CASES = [  # two arrays, and whether they have the same bits
    (np.array([1.0, np.nan], np.float32), np.array([1.0, np.nan], np.float32), True),
    (np.array([0.0], np.float32), np.array([-0.0], np.float32), False),
    (np.arange(3000, dtype=np.int32), np.arange(3000, dtype=np.int32), True),
    (np.arange(3000, dtype=np.int32), np.arange(3000, dtype=np.int32) % 2999, False),
    (np.zeros(4, np.int32), np.zeros(4, np.float32), False),
    (np.zeros((2, 3), np.uint8), np.zeros((3, 2), np.uint8), False),
    (np.zeros(3, np.uint8), np.zeros(2, np.uint8), False),
    (np.zeros((0, 3)), np.zeros((0, 3)), True),
]


@pytest.mark.parametrize(("a", "b", "expected"), CASES)
def test_equal_bytes_are_equal_arrays(a: np.ndarray, b: np.ndarray, expected: bool) -> None:
    assert same_bits(a, b) is expected
    assert same_bits(b, a) is expected
    assert same_bits(a, a)


@pytest.mark.parametrize(("a", "b", "expected"), CASES)
def test_rows_that_lie_apart_are_compared_as_well(a: np.ndarray, b: np.ndarray, expected: bool) -> None:
    apart = np.stack([a, a], axis=-1)[..., 1]  # every second element
    assert same_bits(apart, b) is expected
    assert same_bits(b, apart) is expected


def test_bytes_behind_the_compared_ones_do_not_count() -> None:
    a, b = np.array([1, 2, 3], np.uint8), np.array([1, 2, 4], np.uint8)
    assert same_memory(a.ctypes.data, b.ctypes.data, 2)
    assert not same_memory(a.ctypes.data, b.ctypes.data, 3)
