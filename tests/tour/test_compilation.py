"""The second process of a tour that finds nothing compiled."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from softshadow.tour import compilation
from softshadow.tour.compilation import compiling_ahead

TOUR = """
import sys
from pathlib import Path
from numba.core import event

class Watch(event.Listener):
    def on_start(self, event):
        function = event.data["dispatcher"].py_func
        print(f"{function.__module__.split('.')[-1]}.{function.__qualname__}")

    def on_end(self, event):
        pass

event.register("numba:compile", Watch())
import softshadow
from softshadow.tour.writing import write_tour
write_tour(softshadow.Scene.named("torus"), (64, 48), sys.argv[1])
"""

REHEARSAL = """
import softshadow
from softshadow.jit import KernelDispatcher, rehearsing

with rehearsing() as kernels:
    rehearsed = softshadow.run("map", "boxes", (8, 6), map_size=8)

called, compile_for = set(), KernelDispatcher._compile_for_args

def note(kernel, *arguments):
    called.add(kernel)
    return compile_for(kernel, *arguments)

KernelDispatcher._compile_for_args = note
run = softshadow.run("map", "boxes", (8, 6), map_size=8)
print(len(called), called == {kernel for kernel, _ in kernels}, (run.image == rehearsed.image).all())
"""


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[subprocess.Popen]:
    """The processes that are started, of which each sleeps, for draws of two threads."""
    processes, start = [], subprocess.Popen

    def sleep(*_: object, **options: object) -> subprocess.Popen:
        processes.append(start([sys.executable, "-c", "import time; time.sleep(60)"], **options))
        return processes[-1]

    monkeypatch.setattr(subprocess, "Popen", sleep)
    monkeypatch.setattr(compilation, "cores", lambda: 2)
    monkeypatch.delenv("SOFTSHADOW_THREADS", raising=False)
    return processes


def test_the_second_process_ends_with_the_tour(started: list[subprocess.Popen]) -> None:
    with compiling_ahead():
        assert [helper.poll() for helper in started] == [None]
    assert started[0].returncode


def test_the_second_process_ends_with_a_tour_that_fails(started: list[subprocess.Popen]) -> None:
    with pytest.raises(KeyboardInterrupt), compiling_ahead():
        raise KeyboardInterrupt
    assert started[0].returncode


@pytest.mark.parametrize(("cores", "threads"), [(1, ""), (2, "1")])
def test_with_one_core_or_thread_there_is_no_second_process(
    cores: int, threads: str, started: list[subprocess.Popen], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compilation, "cores", lambda: cores)
    monkeypatch.setenv("SOFTSHADOW_THREADS", threads)
    with compiling_ahead():
        assert started == []


def test_where_no_process_can_be_started_the_tour_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise OSError("no more processes")

    monkeypatch.setattr(subprocess, "Popen", fail)
    monkeypatch.setattr(compilation, "cores", lambda: 2)
    monkeypatch.delenv("SOFTSHADOW_THREADS", raising=False)
    visited = False
    with compiling_ahead():
        visited = True
    assert visited


@pytest.mark.slow  # a process that compiles
def test_a_rehearsal_notes_the_kernels_of_a_run_and_draws_the_same_picture(tmp_path: Path) -> None:
    """In a process of its own, where no kernel is compiled yet."""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    environment.pop("NUMBA_DISABLE_JIT", None)
    command = [sys.executable, "-c", REHEARSAL]
    printed = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout
    n_called, are_noted, same = printed.split()
    assert int(n_called) > 10
    assert are_noted == same == "True"


@pytest.mark.slow
def test_the_tour_compiles_nothing_that_was_compiled_ahead(tmp_path: Path) -> None:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache"), "SOFTSHADOW_THREADS": "2"}
    environment.pop("NUMBA_DISABLE_JIT", None)
    subprocess.run([sys.executable, "-m", compilation.__name__], env=environment, check=True)
    command = [sys.executable, "-c", TOUR, str(tmp_path / "tour")]
    compiled = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.split()
    assert compiled == []
