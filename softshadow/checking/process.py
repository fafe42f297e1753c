"""A student's function run in a process of its own, which ends in any case, and the verdicts from there."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import IO

import softshadow.errors
from softshadow.checking.exercise import Exercise
from softshadow.checking.expected import Expected, save_buffers
from softshadow.checking.limits import Limits
from softshadow.checking.verdict import Verdict
from softshadow.errors import SoftShadowError

START_SECONDS = 600  # until the process has compiled and loaded its kernels, which is not the student's time
LOOK_SECONDS = 0.02
KEPT_OUTPUT = 2000  # bytes
PACKAGE = Path(softshadow.errors.__file__).parents[1]


def run_submission(
    submission: Path, exercise: Exercise, checks: Sequence[int], expected: Mapping[int, Expected], limits: Limits
) -> list[Verdict]:
    """Return the verdicts of those checks of an exercise that run one function of a student's file.

    Parameters
    ----------
    checks : sequence of int     indices of checks with the same `program`
    expected : dict              the buffers of the checks that compare buffers, by index

    Raises
    ------
    SoftShadowError              the process did not begin with the student's file
    """
    with TemporaryDirectory(prefix="softshadow-check-", ignore_cleanup_errors=True) as name:
        folder, scratch = Path(name) / "job", Path(name) / "scratch"
        folder.mkdir()
        scratch.mkdir()
        for index, each in expected.items():
            save_buffers(folder / f"expected-{index}.npz", each.buffers)
        job = folder / "job.json"
        facts = {
            "exercise": exercise.source, "checks": list(checks), "submission": str(submission.resolve()),
            "megabytes": limits.megabytes,
        }  # fmt: skip
        job.write_text(json.dumps(facts), encoding="utf-8")
        ended, output = _run(job, scratch, limits.seconds)
        if not (folder / "ready").exists():
            raise SoftShadowError(f"{exercise.source}: the checking process failed at its start\n{output}")
        report = folder / "report.json"
        if report.exists():
            rows = json.loads(report.read_text(encoding="utf-8"))
            verdicts = [Verdict(**{key: value for key, value in row.items() if key != "passed"}) for row in rows]
        else:
            verdicts = [_without_report(ended, limits)] * len(checks)
        return [replace(each, output=output) for each in verdicts]


def _run(job: Path, scratch: Path, seconds: float) -> tuple[int | None, str]:
    """Run the process; return its exit code, None if the time was over, and the beginning of its output."""
    path = os.pathsep.join([str(PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])])
    environment = {**os.environ, "PYTHONPATH": path}
    process = subprocess.Popen(
        [sys.executable, "-u", "-m", "softshadow.checking.child", str(job)], cwd=scratch, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True, env=environment,
    )  # fmt: skip
    assert process.stdout is not None
    kept = bytearray()
    reader = threading.Thread(target=_read, args=(process.stdout, kept), daemon=True)
    reader.start()
    try:
        ended = _wait(process, job.parent / "ready", seconds)
    finally:
        _kill(process)
    reader.join(timeout=1)  # a process that left the group may keep the pipe open
    return ended, bytes(kept).decode("utf-8", "replace").strip()


def _wait(process: subprocess.Popen[bytes], ready: Path, seconds: float) -> int | None:
    deadline, started = time.monotonic() + START_SECONDS, False
    while time.monotonic() < deadline:
        if not started and ready.exists():
            deadline, started = time.monotonic() + seconds, True
        with suppress(subprocess.TimeoutExpired):
            return process.wait(LOOK_SECONDS)
    return None


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End the process and all that it started."""
    with suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    process.wait()


def _read(pipe: IO[bytes], kept: bytearray) -> None:
    """Read all output, so that the program never waits, and keep its beginning."""
    with pipe:
        while block := pipe.read1(1 << 16):  # type: ignore[attr-defined]
            kept += block[: KEPT_OUTPUT - len(kept)]


def _without_report(ended: int | None, limits: Limits) -> Verdict:
    if ended is None:
        return Verdict("time", f"The program was ended after {limits.seconds:g} s: is there an endless loop?")
    if ended < 0:
        name = signal.Signals(-ended).name
        return Verdict("signal", f"The program was killed by the signal {name}.")
    return Verdict("exited", f"The process ended with exit code {ended} before the function returned.")
