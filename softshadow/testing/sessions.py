"""Sessions: a prepared frame program, here or in its own Mesa process, whose frames can be timed one by one.

Times are taken in the process that runs the program, so they include no messages and no read-outs.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from softshadow import gl
from softshadow.context import make_current
from softshadow.pipeline import set_threads, threads
from softshadow.pipeline.fast.visibility_cache import clear_visibility_cache
from softshadow.testing.mesa import DRIVERS, MesaError, Worker, mesa_available, mesa_reason, program_request
from softshadow.testing.timing import FrameProgram, Timing, read_buffers, timed

TIMEOUT = 600.0  # seconds; softpipe needs minutes where llvmpipe needs seconds


class Session(Protocol):
    """A frame program that has been called; `prepared` is the time of this call."""

    prepared: Timing

    def time(self, repeats: int = 1) -> list[Timing]:
        """Draw frames, and return their times."""
        ...

    def warm_up(self) -> None:
        """Draw a frame that is not timed, so that all code is compiled afterwards."""
        ...

    def buffers(self) -> dict[str, np.ndarray]:
        """Return the buffers after the last frame, see `read_buffers`."""
        ...

    def close(self) -> None:
        """Release everything."""
        ...


class OwnSession:
    """A frame program on softshadow, in this process.

    Parameters
    ----------
    program : FrameProgram
    size : (width, height) of the window
    draw_threads : int           number of threads for its draws
    """

    def __init__(self, program: FrameProgram, size: tuple[int, int], draw_threads: int = 1) -> None:
        self._size, self._threads = size, draw_threads
        self._context = gl.create_context(*size)
        make_current(self._context.before)
        self._frame, self.prepared = self._inside(lambda: timed(gl, lambda: program(gl)))

    def time(self, repeats: int = 1) -> list[Timing]:
        """Draw frames, and return their times; the recording of each frame is discarded."""
        return [self._inside(lambda: timed(gl, self._frame))[1] for _ in range(repeats)]

    def warm_up(self) -> None:
        """Draw a frame that is not timed, so that all code is compiled afterwards."""
        self.time()

    def buffers(self) -> dict[str, np.ndarray]:
        """Return the buffers after the last frame, see `read_buffers`."""
        result: dict[str, np.ndarray] = self._inside(lambda: read_buffers(gl, self._size))
        return result

    def close(self) -> None:
        """Release the context and its buffers."""
        del self._context, self._frame

    def _inside(self, work: Callable[[], Any]) -> Any:
        """Call a function with this session's context and number of threads, then discard the recording."""
        context, threads_before = make_current(self._context), threads()
        set_threads(self._threads)
        try:
            return work()
        finally:
            set_threads(threads_before)
            self._context.frame.clear()
            clear_visibility_cache(self._context.storage)
            self._context.storage.geometry_cache = None
            make_current(context)


class MesaSession:
    """A frame program on Mesa, in a process of its own.

    Parameters
    ----------
    program : FrameProgram       picklable
    size : (width, height) of the window
    driver : "llvmpipe" or "softpipe"
    draw_threads : int           number of threads of llvmpipe; with 1 it draws on the calling thread
    checked : bool               False: PyOpenGL as fast as it can be, without asking for errors after each call

    Raises
    ------
    MesaError                    Mesa is missing, or the program caused a GL error
    """

    def __init__(
        self,
        program: FrameProgram,
        size: tuple[int, int],
        driver: str = "llvmpipe",
        draw_threads: int = 1,
        checked: bool = True,
    ) -> None:
        if driver not in DRIVERS:
            raise ValueError(f"driver={driver!r}: expected one of {', '.join(DRIVERS)}")
        if not mesa_available():
            raise MesaError(mesa_reason())
        self._size = size
        # LP_NUM_THREADS=1 would add a rasterizer thread to the calling thread, which makes two
        self._worker = Worker(driver, 0 if draw_threads == 1 else draw_threads, checked)
        try:
            self.prepared: Timing = self._ask("prepare", **program_request(program, size))
        except BaseException:
            self.close()
            raise

    def time(self, repeats: int = 1) -> list[Timing]:
        """Draw frames, and return their times."""
        timings: list[Timing] = self._ask("time", repeats=repeats)
        return timings

    def warm_up(self) -> None:
        """Draw a frame."""
        self.time()

    def buffers(self) -> dict[str, np.ndarray]:
        """Return the buffers after the last frame, see `read_buffers`."""
        result: dict[str, np.ndarray] = self._ask("read", size=self._size)
        return result

    def close(self) -> None:
        """End the process."""
        self._worker.stop()

    def _ask(self, task: str, **more: Any) -> Any:
        return self._worker.ask({"task": task, **more}, TIMEOUT)
