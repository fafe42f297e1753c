"""Drawn arrays are converted once; the memory of the conversions is bounded."""

import numpy as np
import pytest

from softshadow.context import arrays
from softshadow.context.arrays import ConvertedArrays

ROOT = np.zeros(10, np.uint8)  # each array takes 20 bytes, source included


def get(cache: ConvertedArrays, key: int, calls: list[int]) -> np.ndarray:
    def convert() -> np.ndarray:
        calls.append(key)
        return np.full(10, key, np.uint8)

    return cache.get(key, ROOT, convert)


def test_an_array_is_converted_once():
    cache, calls = ConvertedArrays(), []
    assert get(cache, 1, calls) is get(cache, 1, calls)
    assert calls == [1]


def test_the_least_recently_drawn_array_is_evicted_first(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(arrays, "CACHE_BYTES", 40)
    cache, calls = ConvertedArrays(), []
    for key in (1, 2, 1, 3, 1, 2):
        assert get(cache, key, calls)[0] == key
    assert calls == [1, 2, 3, 2]


def test_an_array_larger_than_the_cache_stays_until_the_next(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(arrays, "CACHE_BYTES", 5)
    cache, calls = ConvertedArrays(), []
    for key in (1, 1, 2, 1):
        get(cache, key, calls)
    assert calls == [1, 2, 1]
