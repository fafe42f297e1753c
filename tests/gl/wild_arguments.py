"""Sequences of calls in which a third of the arguments are of the wrong kind, or numbers that nobody expects."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from gl.facade_calls import CALLS, World

WILD: list[Any] = [
    None, "a", "", b"xy", float("nan"), float("inf"), -float("inf"), 1e300, -1e300, 2**31, -(2**31) - 1, 2**63, 2**70,
    10**400, -1, -7, 0, 1.5, 1j, [], [1], [None], ["a"], [1, [2, 3]], {}, object(), np.zeros(0), np.zeros((2, 2)),
    np.array("x"), np.array(["a", "b"]), np.float32(2.5), np.int8(-3), np.array([1.5]), True, range(3), (1, 2, 3),
    10**6, 65536, 0x0DE1, 0x1406,
]  # fmt: skip
WILDNESS = 0.35  # how many of the arguments are wild
MISCOUNTED = 0.03  # how many of the calls have an argument too few or too many
LENGTH = 30  # calls
NAMES = sorted(CALLS)
# draw as many strips as a number says, here and on Mesa: a million of them take minutes
REPEATING = ("gluDisk", "gluPartialDisk", "gluCylinder", "gluSphere", "glEvalMesh1", "glEvalMesh2")
MOST_STRIPS = 100


def wild_calls(gl: Any, world: World, seed: int) -> Iterator[tuple[str, list[Any]]]:
    """Yield the names and arguments of a sequence; the same ones for the same seed."""
    rng = np.random.default_rng([5, seed])
    for _ in range(LENGTH):
        name = NAMES[rng.integers(len(NAMES))]
        arguments = world.values(gl, CALLS[name])
        for i in range(len(arguments)):
            if rng.random() < WILDNESS:
                arguments[i] = WILD[rng.integers(len(WILD))]
                if name in REPEATING and isinstance(arguments[i], int | float) and arguments[i] > MOST_STRIPS:
                    arguments[i] = MOST_STRIPS
        if rng.random() < MISCOUNTED:
            arguments = arguments[:-1] if rng.random() < 0.5 else [*arguments, 1]
        yield name, arguments
