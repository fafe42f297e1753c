"""The buffers that a check expects: of a solution, of a listing, of a saved run, or from a file of arrays."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow import listings
from softshadow.checking.exercise import Check, Exercise
from softshadow.checking.source import cut_traceback
from softshadow.errors import SoftShadowError
from softshadow.inspection.files import DESCRIPTION
from softshadow.lessons.program_check import BUFFERS
from softshadow.runs import Run, load_run
from softshadow.testing import run_recorded
from softshadow.testing.result import ProgramResult

if TYPE_CHECKING:
    from softshadow.context import Frame


DEEPEST = 2**24 - 1  # the largest depth of the window


@dataclass(frozen=True, eq=False)
class Expected:
    """The expected buffers of a check, and the recording of the solution; None if a file has only the buffers."""

    buffers: ProgramResult
    frame: Frame | None


def expected_of(exercise: Exercise, check: Check) -> Expected:
    """Return what a check with buffers expects.

    Raises
    ------
    SoftShadowError              the solution fails, or the file has not the buffers
    ValueError                   there is no such listing
    """
    solution = check.expected
    if isinstance(solution, str) and solution.endswith(".npz"):
        if is_saved_run(Path(solution)):
            return of_saved_run(Path(solution), exercise.size)
        return Expected(read_buffers(Path(solution), exercise.size, check.buffers), None)
    if isinstance(solution, str):
        solution = listings.get(solution.removeprefix("listing:")).corrected
    assert solution is not None, "loading has completed the check"
    return solved(exercise, solution)


def solved(exercise: Exercise, solution: Callable[[Any], Any]) -> Expected:
    """Run a solution, and return its buffers."""
    try:
        result, frame = run_recorded(solution, exercise.size)
    except Exception as error:  # a teacher's program may fail in any way
        told = cut_traceback(error, Path(exercise.source))
        raise SoftShadowError(f"{exercise.source}: the solution fails\n{told}") from error
    return Expected(replace(result, returned=None), frame)


def is_saved_run(path: Path) -> bool:
    """Return whether an .npz file is a run that this package saved."""
    try:
        with zipfile.ZipFile(path) as file:
            return f"{DESCRIPTION}.npy" in file.namelist()
    except (OSError, zipfile.BadZipFile):
        return False


def of_saved_run(path: Path, size: tuple[int, int]) -> Expected:
    """Return the buffers after the last step of a saved run, and its recording.

    Raises
    ------
    SoftShadowError              the file is damaged, or the run is of another size or depth format
    """
    run = load_run(path)
    if run.size != size:
        width, height = run.size
        raise SoftShadowError(f"{path}: the run has {width} x {height} pixels; expected {size[0]} x {size[1]}")
    if run.frame.depth_format != "d24":
        raise SoftShadowError(f"{path}: the run has the depth format {run.frame.depth_format}; expected d24")
    return Expected(buffers_of_run(run), run.frame)


def buffers_of_run(run: Run) -> ProgramResult:
    """Return the window's buffers at the end of a run with depths of 24 bits, first row = bottom row."""
    color, depth, stencil = (buffer[::-1] for buffer in run.steps[-1].buffers)
    return ProgramResult(color, np.rint(depth.astype(np.float64) * DEEPEST).astype(np.uint32), stencil)


def read_buffers(path: Path, size: tuple[int, int], names: tuple[str, ...] = BUFFERS) -> ProgramResult:
    """Return the buffers in an .npz file: `color` (h, w, 4), `depth` and `stencil` (h, w), bottom row first.

    Buffers that are not named are zero if the file has none.

    Raises
    ------
    SoftShadowError              the file cannot be read, or lacks a buffer, or has one of another size
    """
    width, height = size
    shapes = {"color": (height, width, 4), "depth": (height, width), "stencil": (height, width)}
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] if name in file or name in names else np.zeros(shapes[name]) for name in BUFFERS}
    except (OSError, ValueError, KeyError, zipfile.BadZipFile) as error:
        raise SoftShadowError(f"{path}: expected an .npz file with the arrays {', '.join(names)} ({error})") from None
    for name, array in arrays.items():
        if array.shape != shapes[name]:
            raise SoftShadowError(f"{path}: {name} has the shape {array.shape}; expected {shapes[name]}")
    return ProgramResult(arrays["color"], arrays["depth"], arrays["stencil"])


def save_buffers(path: Path, buffers: ProgramResult) -> None:
    """Write buffers so that `read_buffers` reads them."""
    np.savez(path, **{name: getattr(buffers, name) for name in BUFFERS})
