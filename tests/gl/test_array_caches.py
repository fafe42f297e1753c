"""Caches of arrays are bounded."""

from softshadow.context.arrays import Cache


def test_the_oldest_value_is_evicted_first():
    cache = Cache(bytes=40)
    for key in (1, 2):
        cache.put(key, key, 20)
    assert cache.use(1) == 1
    cache.put(3, 3, 20)
    assert [cache.get(key) for key in (1, 2, 3)] == [1, None, 3]
    assert cache.bytes == 40


def test_a_value_larger_than_the_cache_stays_until_the_next():
    cache = Cache(bytes=5)
    cache.put(1, "a", 10)
    assert cache.get(1) == "a"
    cache.put(2, "b", 10)
    assert cache.get(1) is None
    assert cache.bytes == 10


def test_the_number_of_values_is_bounded():
    cache = Cache(entries=2)
    for key in range(5):
        cache.put(key, key, 0)
    assert len(cache) == 2


def test_a_value_that_is_replaced_is_not_counted_twice():
    cache = Cache()
    cache.put(1, "a", 10)
    cache.put(1, "b", 20)
    assert (cache.get(1), cache.bytes) == ("b", 20)
