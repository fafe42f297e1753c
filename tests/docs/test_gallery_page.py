"""The gallery: every technique and its program, every failure with its answer; pictures say what they show."""

import importlib
import re
import sys

import numpy as np
import pytest

import softshadow as ss
from paths import ROOT
from softshadow import techniques


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, set[str]]:
    """The text of a small gallery, and the names of its files."""
    sys.path.insert(0, str(ROOT / "docs"))
    try:
        gallery = importlib.import_module("gallery_page").gallery
    finally:
        sys.path.pop(0)
    folder = tmp_path_factory.mktemp("site") / "gallery"
    text = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    text = gallery(text, folder, ["thin-wall", "sunlight"], [ss.failures["mask-1"]])
    return text, {file.name for file in folder.iterdir()}


def test_pictures_and_reports_of_the_page_are_its_files(page: tuple[str, set[str]]) -> None:
    text, files = page
    assert set(re.findall(r'(?:src|href)="gallery/([^"]+)"', text)) == files
    assert "<!--" not in text


def test_every_technique_has_a_picture_of_a_scene_and_its_program(page: tuple[str, set[str]]) -> None:
    text, files = page
    names = techniques.names()
    assert [name for name in names if f"thin-wall-{name}.webp" not in files] == []
    assert [name for name in names if f"sunlight-{name}.webp" not in files] == ["map-cube"]
    assert re.findall(r'<details id="program-([^"]+)">', text) == names
    assert text.count("```python") == len(names)


def test_pictures_have_words_that_say_what_they_show(page: tuple[str, set[str]]) -> None:
    words = re.findall(r'alt="([^"]*)"', page[0])
    assert len(words) == page[0].count("<img")
    (zfail,) = [each for each in words if each.startswith("Scene thin-wall, shadows by volume-zfail: ")]
    run = ss.run("volume-zfail", "thin-wall", (160, 120))
    dark = np.mean(run.visibility[run.valid] == 0)
    assert zfail.endswith(f": {100 * dark:.0f} % of the surface in shadow; 0 pixels differ from ray casting")
    failure = ss.failures["mask-1"]
    before, after = (each for each in words if "drawn by" in each)
    assert f"with a mistake: {failure.number_wrong:,} pixels are wrong" in before
    assert f"with the cure: {failure.number_cured:,} pixels are wrong" in after
    assert [each for each in words if not each.startswith("Scene ")] == []


def test_answers_are_behind_a_click(page: tuple[str, set[str]]) -> None:
    failure = ss.failures["mask-1"]
    before, _, answer = page[0].partition("<summary>What is wrong, and why?</summary>")
    assert failure.title in answer
    assert failure.title not in before
    assert f"{failure.number_wrong} wrong pixels before, {failure.number_cured} after" in answer
