"""Arrays that are drawn are converted once, and the memory for that is bounded."""

import numpy as np
import pytest

from softshadow.context import arrays
from softshadow.context.arrays import ConvertedArrays

ROOT = np.zeros(10, np.uint8)  # each array counts 20 bytes, with what it is made from


def make(known: ConvertedArrays, key: int, calls: list[int]) -> np.ndarray:
    def convert() -> np.ndarray:
        calls.append(key)
        return np.full(10, key, np.uint8)

    return known.get(key, ROOT, convert)


def test_an_array_is_converted_once():
    known, calls = ConvertedArrays(), []
    assert make(known, 1, calls) is make(known, 1, calls)
    assert calls == [1]


def test_the_array_drawn_longest_ago_is_forgotten_first(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(arrays, "KEPT_BYTES", 40)
    known, calls = ConvertedArrays(), []
    for key in (1, 2, 1, 3, 1, 2):
        assert make(known, key, calls)[0] == key
    assert calls == [1, 2, 3, 2]


def test_an_array_larger_than_the_bound_is_kept_until_the_next(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(arrays, "KEPT_BYTES", 5)
    known, calls = ConvertedArrays(), []
    for key in (1, 1, 2, 1):
        make(known, key, calls)
    assert calls == [1, 2, 1]
