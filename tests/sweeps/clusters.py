"""Schedulers, workers and clients as processes on the loopback address, which tests may kill."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

PATIENCE = 240  # seconds for what takes a few on a quiet machine; compiled kernels included


class Processes:
    """Processes of a test; all that are left are ended with it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._started: list[subprocess.Popen[bytes]] = []

    def start(self, *command: str) -> subprocess.Popen[bytes]:
        """Start a Python module in a session of its own; its output goes to a file."""
        log = self.folder / f"process-{len(self._started)}.log"
        with log.open("wb") as file:
            process = subprocess.Popen(
                [sys.executable, "-m", *command], stdout=file, stderr=subprocess.STDOUT, cwd=self.folder,
                start_new_session=True,
            )  # fmt: skip
        self._started.append(process)
        return process

    def log(self, process: subprocess.Popen[bytes]) -> str:
        """Return what a process has printed."""
        return (self.folder / f"process-{self._started.index(process)}.log").read_text(errors="replace")

    def scheduler(self, name: str) -> tuple[subprocess.Popen[bytes], str]:
        """Start a scheduler, and return it with its address."""
        file = self.folder / f"{name}.json"
        where = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file))
        process = self.start("distributed.cli.dask_scheduler", *where)
        wait_until(file.exists, "the scheduler writes its address")
        return process, json.loads(file.read_text())["address"]

    def worker(self, address: str, memory_limit: str | None = None) -> subprocess.Popen[bytes]:
        """Start a worker with one thread; with a limit of memory it is ended and started again where it needs more."""
        options = ("--nthreads", "1", "--no-dashboard", "--local-directory", str(self.folder / "workers"))
        watched = ("--no-nanny",) if memory_limit is None else ("--memory-limit", memory_limit)
        return self.start("distributed.cli.dask_worker", address, *options, *watched)

    def sweep(self, *arguments: str) -> subprocess.Popen[bytes]:
        """Start ``softshadow sweep``."""
        return self.start("softshadow", "sweep", *arguments)

    def kill_session(self, process: subprocess.Popen[bytes]) -> None:
        """Kill a process and all that it has started, without a chance to clean up."""
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def end(self) -> None:
        """Kill all that are left."""
        for process in self._started:
            if process.poll() is None:
                self.kill_session(process)


@contextmanager
def processes(folder: Path) -> Iterator[Processes]:
    """Give processes, and end them."""
    started = Processes(folder)
    try:
        yield started
    finally:
        started.end()


def wait_until(condition: Callable[[], bool], what: str) -> None:
    """Wait until a condition holds; fail after `PATIENCE` seconds."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"waited in vain: {what}"
        time.sleep(0.05)


def lines_of(journal: Path) -> list[bytes]:
    """Return the whole lines of points in a journal."""
    return journal.read_bytes().split(b"\n")[1:-1] if journal.exists() else []
