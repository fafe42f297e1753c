"""docs/replay.md: its commands run, its programs run, and its outputs are true."""

import re
import shlex
import shutil
from pathlib import Path

import pytest

import softshadow as ss
from cli.invocation import invoke_ok
from paths import ROOT, TRACE
from windows.window_programs import GLUT

PAGE = (ROOT / "docs" / "replay.md").read_text(encoding="utf-8")
LINES = [line for block in re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL) for line in block.splitlines()]
PROGRAMS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
PRINTED = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(TRACE, "program.trace")
    Path("program.py").write_text(GLUT)


@pytest.mark.parametrize("line", LINES)
def test_line_of_the_page_runs(line: str) -> None:
    program, *arguments = shlex.split(line)
    assert program == "softshadow"
    invoke_ok(*arguments)


@pytest.mark.parametrize("text", PROGRAMS)
def test_program_of_the_page_runs(text: str) -> None:
    exec(text, {"ss": ss})


def test_printed_histories_are_what_is_printed() -> None:
    _, history, sentence = PRINTED
    assert invoke_ok("replay", "program.trace", "--frame", 2, "--pixel", 16, 12).stdout.startswith(history)
    told = invoke_ok("run", "program.py", "--pixel", 8, 6).stdout.splitlines()[-1]
    start, _, end = sentence.strip().partition(" ... ")
    assert told.startswith(start)
    assert told.endswith(end)


def test_recording_takes_five_lines() -> None:
    assert len(PRINTED[0].splitlines()) == 5
