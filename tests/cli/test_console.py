"""Console output: tables on a terminal and in a pipe, warnings once and by name, JSON of NumPy values."""

import io
import json
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from softshadow.cli import console
from softshadow.errors import OpenMesh, PartlyReadFile, SoftShadowError

ROWS = [["7", "[bold]duck[/bold].obj", ":smile:"], ["1234", "b", ""]]


class Terminal(io.StringIO):
    """A stream that claims to be a terminal."""

    def isatty(self) -> bool:
        return True


def test_table_in_a_pipe_is_plain_columns(capsys: pytest.CaptureFixture) -> None:
    console.table("Files", ["faces", "file", "note"], ROWS)
    header, first, second = capsys.readouterr().out.splitlines()
    assert header.split() == ["faces", "file", "note"]
    assert first.split() == ROWS[0]
    assert second.split() == ["1234", "b"]


def terminal_for(monkeypatch: pytest.MonkeyPatch, columns: int = 80) -> Terminal:
    """Make stdout a terminal without colours, until the test ends."""
    stream = Terminal()
    monkeypatch.setattr(sys, "stdout", stream)
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", str(columns))
    return stream


def test_table_on_a_terminal_has_a_title_and_takes_brackets_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_for(monkeypatch)
    console.table("Files", ["faces", "file", "note"], ROWS)
    title, heads, first, _ = terminal.getvalue().splitlines()
    assert (title, heads.split()) == ("Files", ["faces", "file", "note"])
    assert first == "    7  [bold]duck[/bold].obj  :smile:"


@pytest.mark.parametrize("columns", [40, 60, 80, 120])
def test_table_loses_nothing_at_any_width(columns: int, monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_for(monkeypatch, columns)
    counts = "  ".join(f"{value}: {1000 + value}" for value in range(30))
    console.table("Steps", ["step", "title", "draws", "stencil: pixels"], [["0", "count back faces", "3", counts]])
    text = terminal.getvalue()
    assert max(map(len, text.splitlines())) <= columns
    assert [f"{value}: {1000 + value}" in text for value in range(30)] == [True] * 30
    assert "count back faces" in text


def test_verdicts_are_coloured_unless_that_is_unwanted(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_for(monkeypatch)
    for no_color, term in (("1", "xterm"), ("", "dumb")):
        monkeypatch.setenv("NO_COLOR", no_color)
        monkeypatch.setenv("TERM", term)
        console.table("Pixel", ["verdict"], [["passed"]])
    assert "\x1b" not in terminal.getvalue()
    monkeypatch.setenv("TERM", "xterm")
    console.table("Pixel", ["verdict"], [["passed"], ["depth failed"]])
    assert "\x1b[32mpassed" in terminal.getvalue()
    assert "\x1b[31mdepth failed" in terminal.getvalue()


def test_code_is_wrapped_below_its_indentation(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = terminal_for(monkeypatch, 40)
    console.show_code("maps.py: use", [("0 1", 7, "    call(first_argument, second_argument)"), ("", 8, "")])
    assert terminal.getvalue().splitlines()[1:3] == [
        "  0 1    7      call(first_argument,",
        "                    second_argument)",
    ]


def test_written_files_are_named_and_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", lambda address: opened.append(address) or len(opened) == 1)
    console.say_written(tmp_path, tmp_path / "a.png", opened=True)
    assert capsys.readouterr().err == f"written: {tmp_path}/\nwritten: {tmp_path}/a.png\n"
    assert opened == [(tmp_path / "a.png").as_uri()]
    with pytest.raises(SoftShadowError, match="is written, but no browser was found"):
        console.say_written(tmp_path / "a.png", opened=True)


def test_warning_is_said_once_by_name(capsys: pytest.CaptureFixture) -> None:
    with console.print_warnings_once():
        for kind in (OpenMesh, OpenMesh, PartlyReadFile):
            warnings.warn("the mesh is open", kind, stacklevel=1)
    said = capsys.readouterr()
    assert said.err == "warning: OpenMesh: the mesh is open\nwarning: PartlyReadFile: the mesh is open\n"
    assert said.out == ""


def test_warning_of_somebody_else_passes() -> None:
    with pytest.warns(UserWarning, match="of somebody else"), console.print_warnings_once():
        warnings.warn("of somebody else", UserWarning, stacklevel=1)


def test_json_takes_numbers_arrays_and_paths(capsys: pytest.CaptureFixture) -> None:
    console.print_json("try", count=np.uint8(3), values=np.eye(2), path=Path("a") / "b")
    answer = json.loads(capsys.readouterr().out)
    assert answer == {"schema": "softshadow/try/1", "count": 3, "values": [[1, 0], [0, 1]], "path": "a/b"}


def test_compiling_is_announced_when_nothing_is_in_the_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    for folder, said in ((tmp_path, "compiling kernels, only the first time; "), (None, "set NUMBA_CACHE_DIR")):
        monkeypatch.setattr("softshadow.kernel_cache.cache_folder", lambda value=folder: value)
        console.say_if_compiling()
        assert said in capsys.readouterr().err
    monkeypatch.setattr("softshadow.kernel_cache.cache_folder", lambda: tmp_path)
    (tmp_path / "fill.nbi").write_bytes(b"")
    console.say_if_compiling()
    assert capsys.readouterr().err == ""
