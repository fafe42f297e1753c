"""`run_script`: a program written for PyOpenGL, run unchanged, and its last frame as a `Run`."""

from __future__ import annotations

import os
import runpy
import sys
import traceback
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from softshadow.context import make_current, thread
from softshadow.errors import CallsLeftOut, SoftShadowError
from softshadow.recordings.recorded_run import run_of
from softshadow.recordings.steps import check_way
from softshadow.runs import Run
from softshadow.runs.perform import checked_size
from softshadow.windows.desktop import Desktop, ProgramEnded, running
from softshadow.windows.events import click_of, drag_of, keys_of
from softshadow.windows.facades import modules_for, replaced_modules

ENDS = (ProgramEnded, SystemExit)


def run_script(
    path: str | os.PathLike[str],
    arguments: Sequence[str] = (),
    frames: int | None = None,
    size: tuple[int, int] | None = None,
    keys: str = "",
    clicks: Sequence[tuple[int, int] | tuple[int, int, str]] = (),
    steps: str = "auto",
    drags: Sequence[tuple[int, int, int, int] | tuple[int, int, int, int, str]] = (),
    window: int = 1,
) -> Run:
    """Run a program that draws by PyOpenGL with GLUT, pygame or GLFW, without a screen; return its last frame.

    ``OpenGL``, ``pygame`` and ``glfw`` are modules of this package while the program runs. It ends after its last
    frame. After each frame before it, a key is pressed or a click or drag happens, as long as there are any.

    Parameters
    ----------
    path : path of a Python file
    arguments : sequence of str  for the program's ``sys.argv``
    frames : int                 how many to draw; by default one more than keys and clicks
    size : (width, height)       of the window; by default, what the program asks for
    keys : str                   like "a,b,Up,Ctrl+c"; also "WheelUp", "WheelDown", and "Menu:label" for an entry of a
                                 GLUT menu
    clicks : sequence of (x, y)  or (x, y, "right"), after the keys; y from the top
    steps : str                  how to divide the frame: "groups", "draws", "clears" or "auto"
    drags : sequence of (x, y, to_x, to_y)  or with the button, too; after the clicks
    window : int                 which window of a GLUT program is shown, in the order in which they are opened

    Raises
    ------
    SoftShadowError              there is no such file, or the program fails (its own error is the cause) or opens no
                                 window
    ValueError                   an argument has a wrong value
    """
    check_way(steps)
    program = Path(path)
    if not program.is_file():
        raise SoftShadowError(f"{path}: there is no such file")
    events = [*keys_of(keys), *map(click_of, clicks), *map(drag_of, drags)]
    n_frames = len(events) + 1 if frames is None else frames
    if n_frames < 1:
        raise ValueError(f"frames={frames}: expected 1 or more")
    if window < 1:
        raise ValueError(f"window={window}: expected 1 or more")
    desktop = Desktop(None if size is None else checked_size(size), n_frames, events, window, program=str(program))
    before = thread.context
    try:
        modules = modules_for(program)
        with running(desktop), replaced_modules(modules), _as_main(program, arguments), suppress(*ENDS):
            runpy.run_path(str(program), run_name="__main__")
    except Exception as error:
        raise SoftShadowError(_told(error, str(program))) from error
    finally:
        make_current(before)
    return _run_of(desktop, program.name, steps)


def _told(error: Exception, program: str) -> str:
    """Return an error of a program, with the line of the program at which it happened."""
    lines = [line for frame, line in traceback.walk_tb(error.__traceback__) if frame.f_code.co_filename == program]
    if isinstance(error, SyntaxError) and error.lineno is not None:
        lines = [error.lineno]
    where = f" line {lines[-1]}" if lines else ""
    kind = "" if isinstance(error, SoftShadowError) else f"{type(error).__name__}: "
    return f"{Path(program).name}{where}: {kind}{error}"


@contextmanager
def _as_main(program: Path, arguments: Sequence[str]) -> Iterator[None]:
    """Set sys.argv and the folder of imports as Python does for a program."""
    argv, path = sys.argv, list(sys.path)
    sys.argv = [str(program), *arguments]
    sys.path.insert(0, str(program.resolve().parent))
    try:
        yield
    finally:
        sys.argv, sys.path[:] = argv, path


def _run_of(desktop: Desktop, name: str, steps: str) -> Run:
    context = desktop.context
    if context is None:
        which = f"window {desktop.shown}" if desktop.shown > 1 else "window"
        raise SoftShadowError(f"{name}: the program opened no {which}")
    context.finish()
    messages = [
        CallsLeftOut(f"{call} ({count} call{'' if count == 1 else 's'}), missing call")
        for call, count in desktop.left_out.items()
    ]
    messages += [CallsLeftOut(note) for note in desktop.notes]
    if desktop.frame < desktop.n_frames:
        messages.append(CallsLeftOut(f"the program drew {desktop.frame} of {desktop.n_frames} frames and ended"))
    for message in messages:
        warnings.warn(message, stacklevel=3)
    options = {"program": name, "frame": max(0, min(desktop.frame, desktop.n_frames) - 1)}
    return run_of("recording", context.frame, options, tuple(messages), steps)
