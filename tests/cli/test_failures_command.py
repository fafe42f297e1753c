"""``softshadow failures``: the list, one description, its images and its page."""

from pathlib import Path

import pytest
from PIL import Image

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, json_of

SMALL = ("--size", "80x60")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_failures_are_listed_without_running_them() -> None:
    lines = invoke_ok("failures").stdout.splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(ss.failures)
    assert [row["name"] for row in json_of("failures")["failures"]] == list(ss.failures)


def test_story_has_both_numbers_the_diff_and_both_histories() -> None:
    failure = ss.failures["mask-1"].at((80, 60))
    text = invoke_ok("failures", "mask-1", *SMALL).stdout
    assert text.startswith(failure.explain())
    x, y = failure.pixel
    assert f"with the failure, {failure.wrong.pixel(x, y)}" in text
    assert f"with the cure, {failure.cured.pixel(x, y)}" in text
    (row,) = json_of("failures", "mask-1", *SMALL)["failures"]
    assert (row["number_wrong"], row["number_cured"], row["pixel"]) == (failure.number_wrong, 0, [x, y])
    assert row["diff"] == failure.diff


def test_picture_and_page_are_written() -> None:
    assert "written: two.png" in invoke_ok("failures", "mask-1", *SMALL, "-o", "two.png").stderr
    with Image.open("two.png") as picture:
        assert picture.size == ss.failures["mask-1"].at((80, 60)).picture().size
    invoke_ok("failures", "mask-1", *SMALL, "-o", "story.html")
    page = Path("story.html").read_text(encoding="utf-8")
    assert "- glStencilFunc(GL_EQUAL, 0, 1)" in page
    assert "data:image/png;base64," in page
    assert page.count("<table>") == 2


def test_unknown_failure_other_ending_and_foreign_file_are_refused() -> None:
    assert "did you mean 'mask-1'" in error_of("failures", "mask1")
    assert "expected an ending of .png or .html" in error_of("failures", "mask-1", "-o", "a.gif")
    Path("mine.png").write_text("my homework")
    assert error_of("failures", "mask-1", *SMALL, "-o", "mine.png").endswith("--force overwrites it")
    answer = invoke("failures", "-o", "a.png")
    assert answer.exit_code == 2
    assert "expected the NAME of a failure" in answer.stderr
