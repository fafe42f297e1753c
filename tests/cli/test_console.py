"""Console output: tables on a terminal and in a pipe, warnings once and by name, JSON of NumPy values."""

import io
import json
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

from softshadow.cli import console
from softshadow.errors import OpenMesh, PartlyReadFile

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


def test_table_on_a_terminal_is_ruled_and_takes_brackets_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stdout", terminal)
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("NO_COLOR", "1")
    console.table("Files", ["faces", "file", "note"], ROWS)
    lines = terminal.getvalue().splitlines()
    assert "Files" in lines[0]
    assert "│     7 │ [bold]duck[/bold].obj │ :smile: │" in lines


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
    for folder, said in ((tmp_path, "compiling kernels, only the first time ...\n"), (None, "set NUMBA_CACHE_DIR")):
        monkeypatch.setattr("softshadow.kernel_cache.cache_folder", lambda value=folder: value)
        console.say_if_compiling()
        assert said in capsys.readouterr().err
    monkeypatch.setattr("softshadow.kernel_cache.cache_folder", lambda: tmp_path)
    (tmp_path / "fill.nbi").write_bytes(b"")
    console.say_if_compiling()
    assert capsys.readouterr().err == ""
