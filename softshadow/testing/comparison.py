"""Run one program here and on Mesa, or two programs here, and say where the first pixel differs."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.testing.mesa import check, run_on_mesa
from softshadow.testing.result import ProgramResult, read_result

if TYPE_CHECKING:
    from softshadow.context import Frame
    from softshadow.inspection.history import PixelHistory

WINDOW = ("color", "depth", "stencil")
Program = Callable[[Any], Any]


@dataclass(frozen=True, eq=False)
class Difference:
    """Where two buffers of one name differ.

    Attributes
    ----------
    buffer : "color", "depth", "stencil", or "returned", "returned[2]", "returned['map']": what the program returned
    count : int                  differing pixels (texels, elements)
    x, y : int                   the first of them by rows from the bottom, as in GL
    y_from_top : int             the same row in an image whose row 0 is on top
    ours, theirs : the two values there
    """

    buffer: str
    count: int
    x: int
    y: int
    y_from_top: int
    ours: Any
    theirs: Any

    def __str__(self) -> str:
        where = f"x={self.x}, y={self.y} (row {self.y_from_top} from the top)"
        return f"{self.buffer}: {self.count} differ, first at {where}: {self.ours} and {self.theirs}"


@dataclass(frozen=True, eq=False)
class Comparison:
    """Two results of a program and their differences; true where there are none.

    Attributes
    ----------
    ours, theirs : what the program left here and there
    differences : one for each buffer that differs
    history : PixelHistory or None     every fragment that met the first differing pixel of the window, here
    """

    ours: ProgramResult
    theirs: ProgramResult
    differences: tuple[Difference, ...]
    history: "PixelHistory | None" = None

    def __bool__(self) -> bool:
        return not self.differences

    def __str__(self) -> str:
        if self:
            return "no pixel differs"
        return "\n".join(map(str, [*self.differences, *([self.history] if self.history else [])]))

    def __repr__(self) -> str:
        return f"<Comparison: {self}>"


def difference(buffer: str, ours: np.ndarray, theirs: np.ndarray) -> Difference | None:
    """Return where two arrays of shape (h, w[, c]) differ, or None; NaN equals NaN, and 0.0 differs from -0.0 never.

    Raises
    ------
    ValueError                   the shapes differ
    """
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    if ours.shape != theirs.shape:
        raise ValueError(f"{buffer}: shapes {ours.shape} and {theirs.shape} cannot be compared")
    differs = np.atleast_1d((ours != theirs) & ~((ours != ours) & (theirs != theirs)))
    pixels = differs.any(axis=-1) if differs.ndim == 3 else np.atleast_2d(differs)
    count = int(np.count_nonzero(pixels))
    if count == 0:
        return None
    y, x = (int(index) for index in np.argwhere(pixels)[0])
    rows = [np.atleast_2d(array) if array.ndim < 3 else array for array in (ours, theirs)]
    return Difference(buffer, count, x, y, pixels.shape[0] - 1 - y, rows[0][y, x].tolist(), rows[1][y, x].tolist())


def differences(ours: ProgramResult, theirs: ProgramResult) -> tuple[Difference, ...]:
    """Return the differences of colour, depth, stencil and of the arrays that the two programs returned.

    Raises
    ------
    ValueError                   one program returned arrays that the other did not, or arrays of other shapes
    """
    mine, other = returned_arrays(ours.returned), returned_arrays(theirs.returned)
    if mine.keys() != other.keys():
        raise ValueError(f"the programs returned {', '.join(mine) or 'no array'} and {', '.join(other) or 'no array'}")
    pairs = [(name, getattr(ours, name), getattr(theirs, name)) for name in WINDOW]
    pairs += [(name, mine[name], other[name]) for name in mine]
    found = (difference(*pair) for pair in pairs)
    return tuple(one for one in found if one is not None)


def returned_arrays(returned: Any) -> dict[str, Any]:
    """Return the arrays and numbers among what a program returned: itself, or the items of a list, tuple or dict.

    Examples
    --------
    >>> returned_arrays([7, "text", np.zeros(2)])
    {'returned[0]': 7, 'returned[2]': array([0., 0.])}
    """
    if isinstance(returned, dict):
        items = [(f"returned[{key!r}]", value) for key, value in returned.items()]
    elif isinstance(returned, list | tuple):
        items = [(f"returned[{index}]", value) for index, value in enumerate(returned)]
    else:
        items = [("returned", returned)]
    return {name: value for name, value in items if isinstance(value, np.ndarray | np.number | int | float)}


def run_here(program: Program, size: tuple[int, int]) -> ProgramResult:
    """Return the buffers that a program leaves in a fresh context of `softshadow.gl` of (width, height) pixels."""
    return run_recorded(program, size)[0]


def run_recorded(program: Program, size: tuple[int, int]) -> "tuple[ProgramResult, Frame]":
    """Return the buffers that a program leaves here, and the recording of its calls, which knows the pixels' histories.

    Raises
    ------
    TypeError                    the program cannot be called, or the size is not a pair
    """
    from softshadow import gl  # brings the kernels, which a Mesa worker has no use for

    check(program, size)
    with gl.create_context(*size) as context:
        returned = program(gl)
        context.end_step(getattr(program, "__name__", "program"))
        return read_result(gl, size, returned), context.frame


def history_of_first(frame: "Frame", found: tuple[Difference, ...]) -> "PixelHistory | None":
    """Return the history of the window's first differing pixel; None where nothing of the window differs."""
    from softshadow.inspection import pixel_history

    first = next((each for each in found if each.buffer in WINDOW), None)
    return None if first is None else pixel_history(frame, first.x, first.y_from_top)


def compare(program: Program, size: tuple[int, int] = (640, 480), driver: str = "llvmpipe") -> Comparison:
    """Return what a program leaves here and on Mesa, and every difference.

    Parameters
    ----------
    program : callable           ``program(gl)`` with PyOpenGL's names; arrays and numbers that it returns, alone or in
        a list, tuple or dict, are compared, too
    size : (width, height) of the default framebuffer
    driver : "llvmpipe" or "softpipe"
    """
    (ours, frame), theirs = run_recorded(program, size), run_on_mesa(program, size, driver)
    found = differences(ours, theirs)
    return Comparison(ours, theirs, found, history_of_first(frame, found))
