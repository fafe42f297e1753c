"""freeglut itself: Debian's libglut under Xvfb, with Mesa's llvmpipe, driven by PyOpenGL in a process of its own."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from softshadow.traces import Call, Trace

VERSION = 30400  # whose calls and numbers are imitated
GLUT_VERSION = 508
SECONDS = 120


def need(*commands: str) -> None:
    """Skip the test if freeglut or one of some commands is missing."""
    missing = [command for command in (*commands, "xvfb-run") if shutil.which(command) is None]
    if missing:
        pytest.skip(f"needs {' and '.join(missing)}")
    name = ctypes.util.find_library("glut")
    if name is None or not hasattr(ctypes.CDLL(name), "glutBitmapString"):
        pytest.skip("needs freeglut (libglut3.12)")


def run(program: Path, *arguments: str, tracer: tuple[str, ...] = ()) -> str:
    """Run a program on freeglut; return what it writes to its standard error."""
    environment = {
        **os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "GALLIUM_DRIVER": "llvmpipe",
        "GALLIUM_OVERRIDE_CPU_CAPS": "sse4.1",  # no fused multiply-add, as in softshadow.testing
    }  # fmt: skip
    environment.pop("PYOPENGL_PLATFORM", None)
    log = program.with_suffix(".log")
    command = [*tracer, sys.executable, str(program), *arguments]
    screen = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24", "sh", "-c", 'log=$1; shift; exec "$@" 2>"$log"', "sh"]
    done = subprocess.run([*screen, str(log), *command], env=environment, timeout=SECONDS, check=False)
    written = log.read_text() if log.exists() else ""
    assert done.returncode == 0, written
    return written


def traced_calls(program: Path, *arguments: str) -> list[Call]:
    """Return the GL calls of a program on freeglut, as apitrace records them."""
    trace = program.with_suffix(".trace")
    run(program, *arguments, tracer=("apitrace", "trace", "--api", "gl", "-o", str(trace)))
    return [call for call in Trace(trace) if call.name.startswith("gl") and not call.name.startswith("glX")]
