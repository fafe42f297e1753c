"""Combinations of parameters: a sample in the quick lane, all of them in the long one."""

import itertools
from collections.abc import Collection
from typing import Any

import numpy as np
import pytest


def sampled(*axes: Collection[Any], strength: int = 2) -> list[Any]:
    """Return all combinations of the axes as pytest parameters; those outside a sample are marked slow.

    In the sample every value of an axis occurs (strength 1), or meets every value of every other axis (strength 2).
    Ties between equally useful combinations are broken with a fixed seed, so the sample is the same in every session.
    """
    combinations = list(itertools.product(*(range(len(axis)) for axis in axes)))
    order = np.random.default_rng(len(combinations)).permutation(len(combinations)).tolist()

    def covered(index: int) -> set[tuple[tuple[int, int], ...]]:
        return set(itertools.combinations(enumerate(combinations[index]), strength))

    missing = set().union(*map(covered, order))
    sample = set()
    while missing:
        best = max(order, key=lambda index: len(covered(index) & missing))
        sample.add(best)
        missing -= covered(best)
    return with_quick(list(itertools.product(*axes)), sample)


def with_quick(cases: Collection[Any], quick: Collection[int]) -> list[Any]:
    """Return cases (tuples of values) as pytest parameters; all but those with a quick index are marked slow."""
    return [pytest.param(*case, marks=() if i in quick else pytest.mark.slow) for i, case in enumerate(cases)]
