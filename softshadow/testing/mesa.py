"""GL programs on Mesa: run a program in a worker process and return its buffers.

Each driver has one worker, which stays alive. It is replaced after `PROGRAMS_PER_WORKER` programs (a context takes
2.5 MiB and is never destroyed), after a crash and after a time-out. llvmpipe runs without fused multiply-add, so that
its results do not depend on the CPU.
"""

import atexit
import contextlib
import ctypes.util
import functools
import importlib.util
import inspect
import os
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any

from softshadow.errors import SoftShadowError, nearest
from softshadow.testing.messages import read_message, write_message
from softshadow.testing.result import ProgramResult

EXPECTED_VERSION = "22.3.6"  # the version that softshadow reproduces
DRIVERS = ("llvmpipe", "softpipe")
PROGRAMS_PER_WORKER = 200
START_TIMEOUT = 60.0  # seconds for a worker to import PyOpenGL and create its first context
LARGEST_SIDE = 16384  # Mesa's own limit
INSTALL = "install them with: apt install libosmesa6 libglu1-mesa; pip install 'softshadow[mesa]'"


class MesaError(SoftShadowError):
    """Mesa is missing, its process has ended, or a program failed in it; `err` is GL's error code, if there is one."""

    def __init__(self, message: str, err: int | None = None) -> None:
        super().__init__(message)
        self.err = err


class RemoteTraceback(Exception):
    """The worker's traceback of a failed program: the cause of the exception that `run_on_mesa` raises."""

    def __str__(self) -> str:
        return f'\n"""\n{self.args[0]}"""'


@functools.cache
def mesa_reason() -> str:
    """Return why programs cannot run on Mesa here and what to install; the empty string if they can."""
    packages = {"OpenGL": "PyOpenGL", "cloudpickle": "cloudpickle"}
    missing = [f"Python package {name}" for key, name in packages.items() if importlib.util.find_spec(key) is None]
    missing += [f"library lib{name}" for name in ("OSMesa", "GLU") if ctypes.util.find_library(name) is None]
    return f"Mesa is not available, missing: {', '.join(missing)} ({INSTALL})" if missing else ""


def mesa_available() -> bool:
    """Return whether programs can run on Mesa here; `mesa_reason` tells why not."""
    return not mesa_reason()


def mesa_version(driver: str = "llvmpipe") -> str:
    """Return Mesa's version, such as "22.3.6"; `EXPECTED_VERSION` is the version that softshadow reproduces."""
    with _lock:
        version = _worker(driver).introduction["version"]  # "4.5 (Compatibility Profile) Mesa 22.3.6"
    return version.rpartition("Mesa ")[2].split()[0]


def mesa_gl() -> Any:
    """Return Mesa's namespace (functions and tokens of GL and GLU), inside a program run by `run_on_mesa`.

    Raises
    ------
    RuntimeError                 in any other process: PyOpenGL is imported in Mesa's own process only
    """
    module = sys.modules.get("softshadow.testing.opengl")
    if module is None:
        raise RuntimeError("mesa_gl() works inside a program given to softshadow.testing.run_on_mesa(program, size)")
    return module.current()


def run_on_mesa(
    program: Callable[[Any], Any],
    size: tuple[int, int],
    driver: str = "llvmpipe",
    *,
    raise_errors: bool = True,
    timeout: float = 60.0,
) -> ProgramResult:
    """Run a program in a new context of Mesa, and return its buffers.

    Parameters
    ----------
    program : callable           ``program(gl)`` with PyOpenGL's names; its return value must be picklable
    size : (width, height) of the default framebuffer (RGBA8, 24-bit depth, 8-bit stencil; cleared to 0, 1, 0)
    driver : "llvmpipe" or "softpipe"
    raise_errors : bool          False: GL errors are only recorded, as in plain GL
    timeout : float              seconds

    Raises
    ------
    MesaError                    Mesa is missing, crashed or timed out, or the program caused a GL error (see `err`)
    Exception                    the exception that the program raised, with the worker's traceback as its cause
    """
    check_program(program, size)
    width, height = size
    if not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise ValueError(f"size={size!r}: width and height must be between 1 and {LARGEST_SIDE}")
    request = {"task": "run", "raise_errors": raise_errors, **program_request(program, (int(width), int(height)))}
    with _lock:
        result: ProgramResult = _worker(driver).ask(request, timeout)
    return result


def check_program(program: Any, size: Any) -> None:
    """Check the arguments of the functions that run a program.

    Raises
    ------
    TypeError                    the program is not callable, or the size is not a pair
    """
    if not callable(program):
        raise TypeError(f"program={program!r}: expected a function program(gl), not what it returned")
    if not isinstance(size, tuple | list) or len(size) != 2:
        raise TypeError(f"size={size!r}: expected (width, height)")


def program_request(program: Callable[[Any], Any], size: tuple[int, int]) -> dict[str, Any]:
    """Return the part of a worker request that describes a program: its pickle, the window size and the import path.

    Raises
    ------
    MesaError                    programs cannot run on Mesa here; the message says what to install
    """
    if not mesa_available():
        raise MesaError(mesa_reason())
    return {"program": _pickled(program), "size": size, "path": [entry or os.getcwd() for entry in sys.path]}


def _pickled(program: Callable[[Any], Any]) -> bytes:
    import cloudpickle

    function = inspect.unwrap(program)
    while isinstance(function, functools.partial):
        function = inspect.unwrap(function.func)
    module = sys.modules.get(getattr(function, "__module__", None) or "")
    # pickle a user's module by value: the worker may have imported an older version of it
    by_value = module is not None and module.__name__ != "__main__" and not module.__name__.startswith("softshadow")
    try:
        if by_value:
            cloudpickle.register_pickle_by_value(module)
        return cloudpickle.dumps(program)
    except Exception as error:
        raise MesaError(f"program {program!r} cannot be sent to Mesa's process: {error}") from error
    finally:
        if by_value:
            cloudpickle.unregister_pickle_by_value(module)


def _failure(failure: dict[str, Any]) -> Exception:
    error: Any = None
    if failure["type"] == "StateError" and "no current context" in failure["message"]:
        # `from softshadow.gl import *`: there is no softshadow context in the worker
        error = MesaError(
            "the program calls softshadow.gl directly; to run on Mesa it must call the namespace that it gets as its "
            "argument: gl.glBegin(gl.GL_TRIANGLES) in a function program(gl)"
        )
    elif failure["exception"] is not None:
        with contextlib.suppress(Exception):  # its class may exist only in the worker
            error = pickle.loads(failure["exception"])
    if not isinstance(error, Exception):
        error = MesaError(f"on Mesa: {failure['type']}: {failure['message']}", failure["err"])
    error.__cause__ = RemoteTraceback(failure["traceback"])
    return error


class Worker:
    """A Mesa process and the pipes to it; with `rasterizer_threads` 0 llvmpipe draws on the calling thread.

    Without `checked`, PyOpenGL does not ask for errors after each call, and its own functions are called as they are.
    """

    def __init__(self, driver: str, rasterizer_threads: int = 0, checked: bool = True) -> None:
        environment = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join(entry or os.getcwd() for entry in sys.path),
            "PYOPENGL_PLATFORM": "osmesa",
            "GALLIUM_DRIVER": driver,
            "GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1",  # no fused multiply-add
            "LP_NUM_THREADS": str(rasterizer_threads),
            "SOFTSHADOW_CHECKED_PYOPENGL": str(int(checked)),
        }
        self.driver = driver
        self.programs = 0
        self.process = subprocess.Popen(
            # -P: keep the current folder out of the import path, so that numpy does not import a user's random.py
            [sys.executable, "-P", "-m", "softshadow.testing.mesa_worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
        )
        self.answers: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self.reader = threading.Thread(target=self._read, name=f"mesa {driver}", daemon=True)
        self.reader.start()
        self.introduction = self._receive(START_TIMEOUT)
        if "failed" in self.introduction:
            self.stop()
            raise MesaError(f"Mesa does not start ({INSTALL}):\n{self.introduction['failed']}")

    def ask(self, request: dict[str, Any], timeout: float) -> Any:
        """Send a request and return the answer; after a time-out end the process, so that no late answer arrives.

        Raises
        ------
        MesaError, Exception         as `run_on_mesa`
        """
        self.programs += 1
        assert self.process.stdin is not None
        with contextlib.suppress(OSError):  # the process has ended: `_receive` reports it
            write_message(self.process.stdin, pickle.dumps(request))
        answer = self._receive(timeout)
        if "failure" in answer:
            raise _failure(answer["failure"])
        return answer["result"]

    def _receive(self, timeout: float) -> dict[str, Any]:
        try:
            answer = self.answers.get(timeout=timeout)
        except queue.Empty:
            self.stop()
            raise MesaError(f"Mesa ({self.driver}) gave no answer within {timeout:g} s and was stopped") from None
        except BaseException:  # Ctrl-C while waiting: the answer would arrive late
            self.stop()
            raise
        if answer is None:
            code = self.process.wait()
            self.stop()
            raise MesaError(f"Mesa's process ({self.driver}) ended while it ran a program (exit code {code})")
        result: dict[str, Any] = pickle.loads(answer)
        return result

    def _read(self) -> None:
        assert self.process.stdout is not None
        message: bytes | None = b""
        while message is not None:
            message = read_message(self.process.stdout)
            self.answers.put(message)

    def stop(self) -> None:
        """End the process and close the pipes."""
        self.process.kill()
        self.process.wait()
        self.reader.join()
        for pipe in (self.process.stdin, self.process.stdout):
            assert pipe is not None
            with contextlib.suppress(OSError):  # closing flushes data that a dead process has not read
                pipe.close()

    @property
    def usable(self) -> bool:
        """Whether the process is alive and may draw another program."""
        return self.process.poll() is None and self.programs < PROGRAMS_PER_WORKER


_workers: dict[str, Worker] = {}
_lock = threading.Lock()  # one program at a time


def _worker(driver: str) -> Worker:
    if driver not in DRIVERS:
        raise ValueError(f"driver={driver!r}: {nearest(driver, DRIVERS)}")
    if not mesa_available():
        raise MesaError(mesa_reason())
    worker = _workers.get(driver)
    if worker is not None and not worker.usable:
        _workers.pop(driver).stop()
        worker = None
    if worker is None:
        worker = _workers[driver] = Worker(driver)
    return worker


@atexit.register
def stop_workers() -> None:
    """End all Mesa processes; the next program starts a new one."""
    with _lock:
        while _workers:
            _workers.popitem()[1].stop()
