"""Progress on a terminal, in a file, and as events."""

import contextlib
import os
import re
import sys

import pytest

from softshadow.cli.sweep_progress import described, duration, progress_shown
from softshadow.sweeps import Progress


def everything_written(master: int) -> str:
    """What was written to a terminal whose other end is closed: one read may return only the first part of it."""
    parts = []
    with os.fdopen(master, "rb", buffering=0) as terminal, contextlib.suppress(OSError):  # Linux ends with EIO
        while part := terminal.read(4096):
            parts.append(part)
    return b"".join(parts).decode()


@pytest.mark.parametrize("columns", [60, 120])
def test_bar_on_a_terminal_shows_everything_however_narrow_it_is(columns: int, monkeypatch: pytest.MonkeyPatch) -> None:
    pty = pytest.importorskip("pty")
    master, slave = pty.openpty()
    monkeypatch.setenv("COLUMNS", str(columns))
    monkeypatch.setenv("TERM", "xterm")
    with os.fdopen(slave, "w", encoding="utf-8") as terminal:
        monkeypatch.setattr(sys, "stderr", terminal)
        with progress_shown(as_json=False, of="frames") as (started, report):
            started("http://127.0.0.1:8787/status")
            for done in range(4):
                report(Progress(done, done // 3, 3, 2))
        monkeypatch.undo()
    plain = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", everything_written(master))
    assert "dashboard: http://127.0.0.1:8787/status" in plain
    words = " ".join(plain.replace("━", " ").split())
    assert "3 of 3 frames done, 1 failed, 0 left, " in words
    assert words.endswith(" frames/s, 2 workers")
    assert "━" in plain


def test_lines_of_a_file_have_no_control_characters(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_shown(as_json=False) as (started, report):
        started("http://127.0.0.1:8787/status")
        for done in range(3):
            report(Progress(done, 0, 2))
    first, last = capsys.readouterr().err.splitlines()
    assert first == "dashboard: http://127.0.0.1:8787/status"
    assert re.fullmatch(r"2 of 2 points done, 0 failed, 0 left, [\d.]+ points/s, 1 worker", last)


def test_time_that_is_left_follows_from_the_rate() -> None:
    said = described(Progress(10, 1, 7210, 3), 2.0)
    assert said == "10 of 7210 points done, 1 failed, 7200 left, 2.0 points/s, about 1:00:00 left, 3 workers"
    assert duration(3723.4) == "1:02:03"
