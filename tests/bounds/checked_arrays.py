"""Kernels as plain Python whose arrays refuse negative indices, which NumPy and Numba count from the end.

A negative index is no foreign memory, but it is never meant: a kernel that computes one reads the wrong cell.
"""

import functools
from collections.abc import Callable
from typing import Any

import numba
import numpy as np


class Checked(np.ndarray):
    """An array whose elements are found by numbers from 0 on."""

    def __getitem__(self, key: Any) -> Any:
        refuse_negative(key, self.shape)
        return super().__getitem__(key)

    def __setitem__(self, key: Any, value: Any) -> None:
        refuse_negative(key, self.shape)
        super().__setitem__(key, value)


def refuse_negative(key: Any, shape: tuple[int, ...]) -> None:
    """Raise IndexError for a negative number in an index, and for a slice that begins or ends below 0."""
    for part in key if type(key) is tuple else (key,):
        numbers = (part.start, part.stop) if type(part) is slice else (part,)
        for number in numbers:
            if isinstance(number, int | np.integer) and number < 0:
                raise IndexError(f"index {number} of an array of shape {shape}")


def checked(argument: Any) -> Any:
    """Return an argument of a kernel with all its arrays checked."""
    if type(argument) is np.ndarray:
        return argument.view(Checked)
    if isinstance(argument, tuple) and hasattr(argument, "_fields"):
        return type(argument)(*map(checked, argument))
    return argument


def check_kernels() -> None:
    """Let every kernel that is made from now on check its arrays; for NUMBA_DISABLE_JIT=1."""

    def njit(*_: Any, **__: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
        def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
            @functools.wraps(function)
            def kernel(*arguments: Any) -> Any:
                return function(*map(checked, arguments))

            return kernel

        return decorate

    numba.njit = njit
