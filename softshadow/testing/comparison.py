"""Comparison of the buffers that GL programs leave, on softshadow and on Mesa: every difference and its first pixel."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.testing.mesa import check_program, run_on_mesa
from softshadow.testing.result import ProgramResult, read_result

if TYPE_CHECKING:
    from softshadow.context import Frame
    from softshadow.inspection.history import PixelHistory

WINDOW = ("color", "depth", "stencil")
GLProgram = Callable[[Any], Any]


@dataclass(frozen=True, eq=False)
class BufferDifference:
    """The difference between two buffers with the same name.

    Attributes
    ----------
    buffer : "color", "depth", "stencil", or a value the program returned: "returned", "returned[2]", "returned['map']"
    count : int                  number of differing pixels (texels, elements)
    x, y : int                   the first of them, row by row from the bottom, as in GL
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
class ProgramComparison:
    """The results of a program on softshadow and on Mesa; true if they are equal.

    Attributes
    ----------
    ours, theirs : ProgramResult       softshadow's and Mesa's result
    differences : one for each buffer that differs
    history : PixelHistory or None     all fragments at the first differing pixel of the window, on softshadow
    """

    ours: ProgramResult
    theirs: ProgramResult
    differences: tuple[BufferDifference, ...]
    history: "PixelHistory | None" = None

    def __bool__(self) -> bool:
        return not self.differences

    def __str__(self) -> str:
        if self:
            return "no pixel differs"
        return "\n".join(map(str, [*self.differences, *([self.history] if self.history else [])]))

    def __repr__(self) -> str:
        return f"<ProgramComparison: {self}>"


def difference(buffer: str, ours: np.ndarray, theirs: np.ndarray) -> BufferDifference | None:
    """Return the difference between two arrays (h, w[, c]), or None; NaN equals NaN, and 0.0 equals -0.0.

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
    return BufferDifference(
        buffer, count, x, y, pixels.shape[0] - 1 - y, rows[0][y, x].tolist(), rows[1][y, x].tolist()
    )


def differences(ours: ProgramResult, theirs: ProgramResult) -> tuple[BufferDifference, ...]:
    """Return the differences of colour, depth and stencil, and of the arrays that two programs returned.

    Raises
    ------
    ValueError                   only one program returned some array, or two arrays have different shapes
    """
    mine, other = returned_arrays(ours.returned), returned_arrays(theirs.returned)
    if mine.keys() != other.keys():
        raise ValueError(f"the programs returned {', '.join(mine) or 'no array'} and {', '.join(other) or 'no array'}")
    pairs = [(name, getattr(ours, name), getattr(theirs, name)) for name in WINDOW]
    pairs += [(name, mine[name], other[name]) for name in mine]
    return tuple(each for pair in pairs if (each := difference(*pair)) is not None)


def returned_arrays(returned: Any) -> dict[str, Any]:
    """Return the arrays and numbers that a program returned, alone or in a list, tuple or dict, by name.

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


def run_here(program: GLProgram, size: tuple[int, int]) -> ProgramResult:
    """Run a program in a new context of `softshadow.gl` of (width, height) pixels, and return its buffers."""
    return run_recorded(program, size)[0]


def run_recorded(program: GLProgram, size: tuple[int, int]) -> "tuple[ProgramResult, Frame]":
    """Run a program on softshadow, and return its buffers and the recording of its calls, for pixel histories.

    Raises
    ------
    TypeError                    the program is not callable, or the size is not a pair
    """
    from softshadow import gl  # loads the kernels, which a Mesa worker does not need

    check_program(program, size)
    with gl.create_context(*size) as context:
        returned = program(gl)
        context.end_step(getattr(program, "__name__", "program"))
        return read_result(gl, size, returned), context.frame


def history_of_first(frame: "Frame", differences: tuple[BufferDifference, ...]) -> "PixelHistory | None":
    """Return the history of the window's first differing pixel, or None if the window does not differ."""
    from softshadow.inspection import pixel_history

    first = next((each for each in differences if each.buffer in WINDOW), None)
    return None if first is None else pixel_history(frame, first.x, first.y_from_top)


def compare(program: GLProgram, size: tuple[int, int] = (640, 480), driver: str = "llvmpipe") -> ProgramComparison:
    """Run a program on softshadow and on Mesa, and return both results with their differences.

    Parameters
    ----------
    program : callable           ``program(gl)`` with PyOpenGL's names; arrays and numbers that it returns, alone or in
        a list, tuple or dict, are compared as well
    size : (width, height) of the default framebuffer
    driver : "llvmpipe" or "softpipe"
    """
    (ours, frame), theirs = run_recorded(program, size), run_on_mesa(program, size, driver)
    differing = differences(ours, theirs)
    return ProgramComparison(ours, theirs, differing, history_of_first(frame, differing))
