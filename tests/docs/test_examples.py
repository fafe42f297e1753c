"""Every example of the pages: programs run, command lines are understood by the command line, and code fits a page.

Cells (```{code-cell}) run when the documentation is built; docs/cli.md, docs/replay.md and README.md have tests of
their own, which run all their lines.
"""

import re
import shlex
import shutil
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import click
import pytest

import softshadow as ss
from cli.invocation import invoke_ok
from paths import ROOT, SCENES, TRACE
from softshadow import gl
from softshadow.cli import main
from softshadow.lessons.copies import lesson_files
from windows.window_programs import GLUT

PAGES = [*sorted((ROOT / "docs").glob("*.md")), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
FENCE = re.compile(r"^```(\S*)[^\n]*\n(.*?)^```", re.DOTALL | re.MULTILINE)
LONGEST = 90  # characters of code that a page shows at 900 pixels (furo: 46em of text); longer lines are wrapped
RUN_ELSEWHERE = ("cli.md", "replay.md", "README.md")
TAKES_LONG = ("sweeps.md", "benchmarks.md", "report.md", "space.md", "notebook.md", "comparing.md", "scenes.md")
ASKING = {"listings", "techniques", "scenes", "doctor", "failures", "lessons", "pixel", "cards"}


def blocks(page: Path, *kinds: str) -> list[str]:
    """Return the code blocks of these kinds that a page shows."""
    found = FENCE.findall(page.read_text(encoding="utf-8"))
    return [text for kind, text in found if kind in kinds and ":tags: [remove-input]" not in text]


def command_lines() -> list[tuple[str, str]]:
    """Return (page, line) of all calls of softshadow in blocks and in sentences, without what stands around them."""
    found = []
    for page in PAGES:
        text = FENCE.sub("", page.read_text(encoding="utf-8"))
        found += [
            (page.name, " ".join(line.split()))
            for line in re.findall(r"`(softshadow [a-z]+ [^`]+)`", text)
            if not re.search(r"\b[A-Z]{4,}\b|\.\.\.", line)  # a placeholder
        ]
        for block in blocks(page, "sh"):
            for line in block.replace("\\\n", " ").splitlines():
                called = re.match(r"(?:\w+=\S+ )*(?:\S*uv run (?:--no-dev )?)?(?:[\w.]+/bin/)?(softshadow .*)", line)
                found += [(page.name, called[1].partition(" > ")[0])] if called else []
    return found


LINES = command_lines()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(SCENES / "crate.obj", "bunny.obj")
    shutil.copy(TRACE, "program.trace")
    Path("program.py").write_text(GLUT)
    sweep = 'technique = "map"\nsize = "24x18"\nmeasure = ["hard"]\npicture = true\noptions.map_size = [16, 32]\n'
    for name in ("sweep.toml", "sizes.toml"):
        Path(name).write_text(sweep)
    for name in ("lesson.toml", "crate.obj"):
        shutil.copy(SCENES / name, name)


def test_there_are_lines_and_programs_to_check() -> None:
    assert len(LINES) > 90
    assert {page for page, _ in LINES} >= {"README.md", "install.md", "classroom.md", "cli.md", "failures.md"}


@pytest.mark.parametrize(("page", "line"), LINES, ids=lambda text: text)
def test_command_line_of_a_page_is_understood(page: str, line: str, folder: None) -> None:
    _, name, *arguments = shlex.split(line, comments=True)
    command = main.commands[name]
    with command.make_context(name, arguments, parent=click.Context(main, info_name="softshadow")):
        pass


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    sorted({line for page, line in LINES if page not in RUN_ELSEWHERE and line.split()[1] in ASKING}),
)
def test_command_line_of_a_page_that_asks_runs(line: str, folder: None) -> None:
    _, name, *arguments = shlex.split(line, comments=True)
    if "--on" in arguments or "--numbers" in arguments:
        pytest.skip("draws on Mesa, or every failure: tests/cli runs it")
    small = ["--size", "80x60"] if name == "failures" and arguments else []
    invoke_ok(name, *arguments, *small, *(["--no-start"] if name == "lessons" and arguments else []))


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    sorted(
        {
            line
            for page, line in LINES
            if page not in RUN_ELSEWHERE and line.split()[1] in ("render", "slides", "run", "sweep", "compare")
        }
    ),
)
def test_command_line_of_a_page_that_draws_runs(line: str, folder: None) -> None:
    invoke_ok(*shlex.split(line, comments=True)[1:])


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, marks=pytest.mark.slow if page.name in TAKES_LONG else ())
        for page in PAGES
        if blocks(page, "python") and page.name not in RUN_ELSEWHERE
    ],
    ids=lambda page: page.name,
)
def test_programs_of_a_page_run_one_after_the_other(page: Path, folder: None) -> None:
    if page.name == "comparing.md" and not ss.testing.mesa_available():
        pytest.skip(ss.testing.mesa_reason())
    names: dict[str, Any] = {"ss": ss, "gl": gl, "__name__": "example"}
    with ExitStack() as stack:
        if page.name == "why.md":  # a part of a program
            stack.enter_context(gl.create_context(8, 6))
            names["numbers"] = [0]
        for text in blocks(page, "python"):
            exec(compile(text, str(page), "exec"), names)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_shown_code_fits_a_page_of_900_pixels(page: Path) -> None:
    shown = "\n".join(blocks(page, "python", "sh", "toml", "{code-cell}"))
    assert [line for line in shown.splitlines() if len(line) > LONGEST] == []


@pytest.mark.parametrize("lesson", lesson_files(), ids=lambda file: file.stem)
def test_cells_of_lessons_fit_a_page_of_900_pixels(lesson: Path) -> None:
    cells = re.split(r"^# %%", lesson.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    code = [line for cell in cells if not cell.startswith(" [markdown]") for line in cell.splitlines()]
    assert code
    assert [line for line in code if len(line) > LONGEST] == []
