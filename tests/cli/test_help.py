"""Help: it is fast, and its examples run."""

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from checking.exercises import EXERCISE, RIGHT
from cli.invocation import invoke, invoke_ok
from paths import SCENES, TRACE
from softshadow import __version__
from softshadow.cli import main
from windows.window_programs import GLUT

COMMANDS = list(main.commands)
SLOW = ("warmup", "bench", "tour")  # draw with all techniques, or compile every state that they draw with
SMALL = {
    **{command: ["--size", "48x36"] for command in ("tour", "render", "steps", "failures", "listings")},
    "animate": ["--size", "32x24", "--frames", "3"],
    "compare": ["--size", "24x18"],
    "bench": ["--size", "48x36", "--rounds", "1"],
    "lessons": ["--no-start"],
}
HEAVY = ("numpy", "numba", "trimesh", "PIL", "pydantic", "jinja2", "rich")


def examples(command: str) -> list[str]:
    """Return the command lines in the epilog of a command."""
    epilog = (main.commands[command] if command else main).epilog or ""
    return [line.strip() for line in epilog.partition("Examples:")[2].strip().splitlines()]


def test_every_command_shows_examples_one_in_a_line() -> None:
    assert [command for command in ["", *COMMANDS] if not 2 <= len(examples(command)) <= 4] == []
    for command in ["", *COMMANDS]:
        shown = invoke_ok(*([command] if command else []), "--help").stdout.splitlines()
        assert [line for line in examples(command) if f"    {line}" not in shown] == []
    assert all(line.startswith("softshadow ") for command in ["", *COMMANDS] for line in examples(command))


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    "line",
    [
        pytest.param(line, marks=[pytest.mark.slow] if line.split()[1] in SLOW else [])
        for command in ["", *COMMANDS]
        for line in examples(command)
    ],
)
def test_example_of_help_runs(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(SCENES / "crate.obj", "bunny.obj")
    shutil.copy(TRACE, "program.trace")
    Path("program.py").write_text(GLUT)
    Path("exercise.py").write_text(EXERCISE)
    Path("student.py").write_text(RIGHT)
    Path("sweep.toml").write_text(
        'technique = "map"\nsize = "24x18"\nmeasure = ["hard"]\noptions.map_size = [16, 32]\n'
    )
    _, command, *arguments = shlex.split(line)
    small = SMALL.get(command, []) if arguments else []  # a list has no size
    small = ["--size", "120x90"] if command == "listings" and "--pixel" in arguments else small
    invoke_ok(command, *arguments, *small)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_tells_what_the_command_does_and_its_options(command: str) -> None:
    text = invoke_ok(command, "--help").stdout
    assert f"Usage: softshadow {command}" in text
    assert "--json" in text
    assert text == invoke_ok(command, "-h").stdout


def test_help_of_every_command_imports_nothing_slow() -> None:
    program = f"""
import sys
from softshadow.cli import main
for words in [[], *([name] for name in main.commands)]:
    try:
        main([*words, "--help"])
    except SystemExit as end:
        assert end.code == 0
print("imported:", sorted(set({HEAVY!r}) & set(sys.modules)))
"""
    output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert output.stdout.splitlines()[-1] == "imported: []"


def test_version_is_told_and_nothing_else() -> None:
    assert invoke_ok("--version").stdout == f"softshadow, version {__version__}\n"


def test_module_is_the_program() -> None:
    command = [sys.executable, "-m", "softshadow", "--version"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.startswith("softshadow, version")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["rendr"], "Did you mean 'render'?"),
        (["render"], "expected the name of a TECHNIQUE, or --all"),
        (["steps"], "Missing argument 'TECHNIQUE'"),
        (["render", "map", "--all"], "expected the name of a TECHNIQUE, or --all"),
        (["render", "map", "--eye", "1,2"], "expected X,Y,Z"),
        (["listings", "map", "--pixel", "1"], "expected X,Y in pixels, as in 160,170"),
        (["--sise"], "No such option"),
        (["render", "map", "--sise", "4x4"], "No such option"),
        (["render", "map", "--size", "640"], "expected WIDTHxHEIGHT in pixels, as in 640x480"),
        (["render", "map", "--size", "axb"], "expected WIDTHxHEIGHT in pixels, as in 640x480"),
        (["render", "map", "--light", "1,2"], "expected X,Y,Z (a point)"),
        (["render", "map", "--light", "up"], "expected X,Y,Z (a point)"),
        (["render", "map", "--scene", "boxes", "--mesh", "a.obj"], "--scene and --mesh: expected only one of them"),
        (["render", "map", "--scene", "duck.glb"], "this is a model file; expected --mesh duck.glb"),
        (["render", "map", "-O", "bias"], "--option 'bias': expected KEY=VALUE"),
        (["pixel", "map", "left", "3"], "'left' is not a valid integer"),
    ],
)
def test_wrong_usage_is_exit_code_2_and_says_what_was_expected(words: list[str], said: str) -> None:
    answer = invoke(*words)
    assert answer.exit_code == 2
    assert said in answer.stderr
    assert answer.stderr.startswith("error: ")
    assert answer.stderr.splitlines()[-1].startswith("help: softshadow")
    assert answer.stdout == ""


def test_program_without_arguments_shows_its_help() -> None:
    answer = invoke()
    assert answer.exit_code == 2
    assert "Usage: softshadow" in answer.output


@pytest.mark.skipif(not hasattr(os, "pipe"), reason="no pipes")
def test_reader_that_has_gone_is_no_error() -> None:
    read, write = os.pipe()
    os.close(read)
    command = [sys.executable, "-m", "softshadow", "techniques"]
    ended = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True)
    os.close(write)
    assert ended.stderr == ""
