"""The sample of combinations covers what it says."""

import itertools

import pytest

from combinations import sampled

AXES = ("abcd", [1, 2, 3], [False, True])


def quick(cases: list) -> list[tuple]:
    """Return the values of the cases in the quick lane."""
    return [case.values for case in cases if not case.marks]


@pytest.mark.parametrize("strength", [1, 2])
def test_all_combinations_are_in_the_long_lane(strength: int) -> None:
    assert [case.values for case in sampled(*AXES, strength=strength)] == list(itertools.product(*AXES))


def test_every_pair_of_values_is_in_the_sample() -> None:
    for first, second in itertools.combinations(range(len(AXES)), 2):
        met = {(values[first], values[second]) for values in quick(sampled(*AXES))}
        assert met == set(itertools.product(AXES[first], AXES[second]))


def test_every_value_is_in_a_sample_of_strength_1() -> None:
    sample = quick(sampled(*AXES, strength=1))
    assert [set(values) for values in zip(*sample, strict=True)] == [set(axis) for axis in AXES]
    assert len(sample) == 4
