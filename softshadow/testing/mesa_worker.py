"""The Mesa worker process: runs GL programs on OSMesa, each in a new context, and sends the buffers back.

`softshadow.testing.mesa` starts it as ``python -m softshadow.testing.mesa_worker`` with Mesa's environment variables.
Requests arrive on standard input, and answers leave on standard output; output of the programs is redirected to
standard error.
"""

import os
import pickle
import signal
import sys
import traceback
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np

from softshadow.testing.messages import read_message, write_message
from softshadow.testing.result import ProgramResult, read_result
from softshadow.testing.timing import Timing, read_buffers, timed

ERROR_NAMES = {
    0x0500: "GL_INVALID_ENUM",
    0x0501: "GL_INVALID_VALUE",
    0x0502: "GL_INVALID_OPERATION",
    0x0503: "GL_STACK_OVERFLOW",
    0x0504: "GL_STACK_UNDERFLOW",
    0x0505: "GL_OUT_OF_MEMORY",
    0x0506: "GL_INVALID_FRAMEBUFFER_OPERATION",
}

# contexts and their image memory; a context is never destroyed, because destroying one after another has become current
# crashes Mesa 22.3; the parent restarts the worker instead
_contexts: list[tuple[Any, np.ndarray]] = []


def main() -> None:
    """Send Mesa's version, then answer requests until the parent closes the pipe."""
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    import OpenGL

    OpenGL.ERROR_CHECKING = os.environ["SOFTSHADOW_CHECKED_PYOPENGL"] == "1"  # must precede the import of its calls
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent handles Ctrl-C, and closes the pipe
    write_message(answers, pickle.dumps(introduction()))
    while (request := read_message(requests)) is not None:
        answer = answer_request(pickle.loads(request))
        sys.stdout.flush()
        write_message(answers, answer)


def introduction() -> dict[str, str]:
    """Return the version and renderer strings, or the traceback as {"failed": traceback}."""
    try:
        gl = new_context((1, 1), raise_errors=True)
        return {"version": gl.glGetString(gl.GL_VERSION).decode(), "renderer": gl.glGetString(gl.GL_RENDERER).decode()}
    except Exception:
        return {"failed": traceback.format_exc()}


def new_context(size: tuple[int, int], raise_errors: bool) -> Any:
    """Return the namespace of a new context in GL's initial state: colour 0, depth 1, stencil 0."""
    from OpenGL import GL, osmesa

    from softshadow.testing.opengl import MesaGL

    width, height = size
    context = osmesa.OSMesaCreateContextExt(osmesa.OSMESA_RGBA, 24, 8, 16, None)
    pixels = np.zeros((height, width, 4), np.uint8)
    if not context or not osmesa.OSMesaMakeCurrent(context, pixels, GL.GL_UNSIGNED_BYTE, width, height):
        raise RuntimeError(f"OSMesa cannot create a context of {width} x {height} pixels")
    _contexts.append((context, pixels))
    end_primitive()
    everything = GL.GL_COLOR_BUFFER_BIT | GL.GL_DEPTH_BUFFER_BIT | GL.GL_STENCIL_BUFFER_BIT | GL.GL_ACCUM_BUFFER_BIT
    GL.glClear(everything)
    gl = MesaGL(raise_errors)
    gl.make_current()
    return gl


def end_primitive() -> None:
    """End a primitive that a program has left open; PyOpenGL checks no errors between glBegin and glEnd."""
    from OpenGL import GL

    with suppress(GL.GLError):
        GL.glEnd()


def answer_request(request: dict[str, Any]) -> bytes:
    """Return the pickled answer: the result of the task, or a description of the exception."""
    import cloudpickle

    errors: list[tuple[str, int]] = []
    try:
        result = TASKS[request["task"]](request, errors)
        try:
            return cloudpickle.dumps({"result": result})
        except Exception as error:
            raise TypeError(f"the program's return value cannot be sent back from Mesa's process: {error}") from error
    except BaseException as error:  # sys.exit() in a program ends the program, not the worker
        failure = {
            "type": type(error).__name__,
            "message": describe(error),
            "err": getattr(error, "err", None),
            "traceback": traceback.format_exc(),
            "errors": errors,
        }
        failure["exception"] = None
        if failure["err"] is None:  # a GLError holds pointers; other exceptions may be unpicklable as well
            with suppress(Exception):
                failure["exception"] = cloudpickle.dumps(error)
        return pickle.dumps({"failure": failure})


def run_program(request: dict[str, Any], errors: list[tuple[str, int]]) -> ProgramResult:
    """Run a program in a new context, and return its buffers; GL errors are appended to `errors`."""
    sys.path[:] = request["path"]
    program: Callable[[Any], Any] = pickle.loads(request["program"])
    gl = new_context(request["size"], request["raise_errors"])
    gl.errors = errors
    returned = program(gl)
    end_primitive()
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glReadBuffer(gl.GL_FRONT)  # an OSMesa context has no back buffer
    return read_result(gl, request["size"], returned, tuple(errors))


# -- timed frames ------------------------------------------------------------------------------------------------------
_frames: list[tuple[Any, Callable[[], Any]]] = []  # namespace and frame function from the last "prepare" task


def prepare(request: dict[str, Any], errors: list[tuple[str, int]]) -> Timing:
    """Call a frame program in a new context; tasks that follow draw the frames."""
    sys.path[:] = request["path"]
    program: Callable[[Any], Any] = pickle.loads(request["program"])
    gl = new_context(request["size"], raise_errors=True)
    frame, timing = timed(gl, lambda: program(gl))
    _frames[:] = [(gl, frame)]
    return timing


def time_frames(request: dict[str, Any], errors: list[tuple[str, int]]) -> list[Timing]:
    """Draw frames, and return their times."""
    gl, frame = _frames[0]
    return [timed(gl, frame)[1] for _ in range(request["repeats"])]


def read_frame(request: dict[str, Any], errors: list[tuple[str, int]]) -> dict[str, np.ndarray]:
    """Return the buffers of the bound framebuffer."""
    return read_buffers(_frames[0][0], request["size"])


TASKS = {"run": run_program, "prepare": prepare, "time": time_frames, "read": read_frame}


def describe(error: BaseException) -> str:
    """Return an exception's message; for PyOpenGL's GLError the call and GL's name for the error."""
    call = getattr(getattr(error, "baseOperation", None), "__name__", None)
    return str(error) if call is None else f"{call}: {ERROR_NAMES.get(getattr(error, 'err', 0), 'GL error')}"


if __name__ == "__main__":
    main()
