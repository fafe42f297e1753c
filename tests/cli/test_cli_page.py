"""docs/cli.md: its commands run, and its outputs are true. README.md: its command draws its picture."""

import re
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from checking.exercises import EXERCISE, RIGHT
from cli.invocation import invoke_ok, json_of
from paths import ROOT, SCENES, TRACE
from softshadow.cli import main
from windows.window_programs import GLUT

PAGE = (ROOT / "docs" / "cli.md").read_text(encoding="utf-8")
LINES = [line for block in re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL) for line in block.splitlines()]
PRINTED = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
SHARED = {"schema", "technique", "scene", "size", "options", "warnings"}
ASKED = {
    "tour": ["-o", "t"],
    "render": ["planar", "-o", "a.png"],
    "steps": ["planar"],
    "pixel": ["planar", "3", "4"],
    "compare": ["planar", "map"],
    "slides": ["lesson:05"],
    "techniques": [],
    "scenes": [],
    "listings": [],
    "failures": [],
    "errata": [],
    "doctor": [],
    "animate": ["planar", "--light-path", "orbit", "--frames", "2", "-o", "a.webp"],
    "bench": ["w5", "--rounds", "1", "--size", "16x12"],
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(SCENES / "crate.obj", "bunny.obj")
    shutil.copy(TRACE, "program.trace")
    Path("program.py").write_text(GLUT)
    Path("exercise.py").write_text(EXERCISE)
    for name in ("student.py", "anna.py", "ben.py"):
        Path(name).write_text(RIGHT)
    Path("sweep.toml").write_text('technique = "blob"\nsize = "24x18"\n')
    for name in ("lesson.toml", "crate.obj"):
        shutil.copy(SCENES / name, name)


# bench compiles every state that it draws with; the block of the README draws the tour; check starts a process for each
# program, and tests/cli/test_help.py runs one; the others draw all techniques or failures
LONG = (
    "softshadow bench ", "softshadow tour", "softshadow check exercise.py ", "softshadow compare --all-soft",
    "softshadow failures --numbers", "softshadow render --all",
)  # fmt: skip


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    "line",
    [
        pytest.param(line, marks=pytest.mark.slow if line.startswith(LONG) else ())
        for line in LINES
        if line != "softshadow warmup"  # tests/cli/test_help.py runs it
    ],
)
def test_line_of_the_page_runs(line: str) -> None:
    program, command, *arguments = shlex.split(line.split(" > ")[0])
    assert program == "softshadow"
    # later sizes win; the pixels are those of the full size
    sized = command in ("tour", "render", "steps") or (command in ("bench", "failures") and arguments)
    size = {"compare": "24x18", "animate": "24x18"}.get(command, "48x36" if sized else None)
    size = "80x60" if command == "failures" and size else size
    started = ["--no-start"] if command == "lessons" and arguments else []
    invoke_ok(command, *arguments, *(["--size", size] if size else []), *started)


def test_every_command_is_on_the_page() -> None:
    assert {shlex.split(line)[1] for line in LINES} == set(main.commands)


def test_printed_tables_and_sentences_are_what_is_printed() -> None:
    steps, sentence = PRINTED
    assert invoke_ok("steps", "volume-zfail").stdout == steps
    assert invoke_ok("pixel", "volume-zfail", 160, 170).stdout.endswith(sentence)


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    "command",
    [pytest.param(name, marks=pytest.mark.slow if name == "tour" else ()) for name in ASKED],  # all techniques
)
def test_keys_of_the_json_are_those_of_the_page(command: str) -> None:
    row = re.search(rf"\| `softshadow/{command}/1` \| (.*) \|", PAGE)[1]
    keys, _, keys_of_rows = row.partition(": ")
    size = ["--size", "16x12"] if command in ("tour", "render", "steps", "pixel", "compare") else []
    answer = json_of(command, *ASKED[command], *size)
    shared = SHARED if command in ("render", "steps", "pixel") else {"schema"}
    assert set(answer) == shared | set(re.findall(r"`(.*?)`", keys))
    if keys_of_rows:
        rows = answer[re.findall(r"`(.*?)`", keys)[-1]]
        assert set(rows[0]) == set(re.findall(r"`(.*?)`", keys_of_rows))


def test_picture_of_the_readme_is_made_by_the_command_beside_it() -> None:
    text = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    command, name = re.search(r"Made by `softshadow (.*?)`, which writes it as `(.*?)`", text).groups()
    picture = re.search(r"!\[.*?\]\((docs/images/.*?)\)", text)[1]
    invoke_ok(*shlex.split(command))
    with Image.open(name) as drawn, Image.open(ROOT / picture) as shown:
        np.testing.assert_array_equal(np.asarray(drawn.convert("RGB")), np.asarray(shown.convert("RGB")))
