"""``softshadow failures``: the list, one description, its images and its page."""

from pathlib import Path

import pytest
from PIL import Image

import softshadow as ss
from cli.invocation import error_of, invoke_ok, json_of, usage_error_of

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
    assert f"with the failure:\n{failure.wrong.pixel(x, y)}" in text
    assert f"with the cure:\n{failure.cured.pixel(x, y)}" in text
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
    assert "did you mean 'mask-1'" in usage_error_of("failures", "mask1")
    assert "expected an ending of .png or .html" in usage_error_of("failures", "mask-1", "-o", "a.gif")
    Path("mine.png").write_text("my homework")
    assert error_of("failures", "mask-1", *SMALL, "-o", "mine.png").endswith("--force overwrites it")
    for words in ([], ["mask-1", "--numbers"]):
        assert "expected the name of a FAILURE" in usage_error_of("failures", *words, "-o", "a.png")
    assert "--open: expected a file to write" in usage_error_of("failures", "mask-1", "--open")


def test_numbers_of_one_failure_are_one_row() -> None:
    failure = ss.failures["acne"].at((80, 60))
    numbers = [failure.number_wrong, failure.number_cured, failure.number_uncounted]
    heads, row = invoke_ok("failures", "acne", "--numbers", *SMALL).stdout.splitlines()
    assert "not counted" in heads
    assert row.split()[:5] == ["acne", "maps", *map(str, numbers)]
    (facts,) = json_of("failures", "acne", "--numbers", *SMALL)["failures"]
    assert [facts["number_wrong"], facts["number_cured"], facts["number_uncounted"]] == numbers
