"""softshadow slides: of techniques and of lessons."""

from pathlib import Path

import pytest

from cli.invocation import error_of, invoke_ok, json_of, usage_error_of


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_slides_of_a_technique_are_written() -> None:
    told = json_of("slides", "planar", "--size", "48x36", "-O", "method=offset", "-o", "a.html")
    assert told["title"] == "planar on torus"
    assert told["written"] == "a.html"
    assert "method=offset" in Path("a.html").read_text()


def test_slides_of_a_lesson_print_nothing_of_its_code() -> None:
    answer = invoke_ok("slides", "lesson:3")
    assert answer.stdout == ""
    assert "written: slides.html" in answer.stderr


@pytest.mark.parametrize("more", [["--size", "9x9"], ["--scene", "boxes"], ["-O", "bias=1"], ["--light", "1,2,3"]])
def test_a_lesson_takes_no_scene_size_or_option(more: list[str]) -> None:
    assert usage_error_of("slides", "lesson:3", *more) == "lesson:3: a lesson has its own scene, size and options"


def test_wrong_names_are_told_before_anything_is_drawn() -> None:
    assert "unknown technique 'volume-zfial': did you mean 'volume-zfail'" in usage_error_of("slides", "volume-zfial")
    assert "lesson '99': expected one of 01_what" in usage_error_of("slides", "lesson:99")
    assert "expected a name that ends in .html" in usage_error_of("slides", "map", "-o", "a.pdf")
    Path("slides.html").write_text("mine")
    assert "was not written by softshadow; --force overwrites it" in error_of("slides", "map")
