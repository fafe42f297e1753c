"""``softshadow lessons``: the list, the copies, and files that are there already."""

import json
from pathlib import Path

import pytest

from cli.invocation import error_of, invoke_ok, json_of
from softshadow.lessons.copies import lesson_files, title_of


def test_lessons_are_listed_in_order() -> None:
    listed = json_of("lessons")["lessons"]
    assert [each["name"] for each in listed] == [file.stem for file in lesson_files()]
    text = invoke_ok("lessons").stdout
    assert all(each["title"] in text for each in listed)


def test_copies_are_notebooks_without_results_and_equal_each_time(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        invoke_ok("lessons", tmp_path / folder, "--no-start")
    copies = sorted((tmp_path / "a").iterdir())
    assert [copy.stem for copy in copies] == [file.stem for file in lesson_files()]
    for copy, lesson in zip(copies, lesson_files(), strict=True):
        notebook = json.loads(copy.read_text(encoding="utf-8"))
        assert title_of(lesson) in "".join(notebook["cells"][0]["source"])
        assert not any(cell.get("outputs") for cell in notebook["cells"])
        assert copy.read_bytes() == (tmp_path / "b" / copy.name).read_bytes()


def test_a_copy_with_answers_is_kept(tmp_path: Path) -> None:
    invoke_ok("lessons", tmp_path, "--no-start")
    first, *others = sorted(tmp_path.iterdir())
    first.write_text("my answers")
    others[0].unlink()
    said = invoke_ok("lessons", tmp_path, "--no-start").stderr
    assert first.read_text() == "my answers"
    assert f"kept: {first}" in said
    assert f"written: {others[0]}" in said


def test_without_jupytext_lessons_are_python_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.lessons.copies.find_spec", lambda name: None)
    invoke_ok("lessons", tmp_path, "--no-start")
    assert {copy.suffix for copy in tmp_path.iterdir()} == {".py"}


def test_a_file_in_place_of_the_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    assert "taken" in error_of("lessons", tmp_path / "taken", "--no-start")
