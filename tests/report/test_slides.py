"""Slides: one for each step, with the buffers' own numbers; one file that shows and prints."""

import re
from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from report.browser import OVERFLOWING, chromium, opened
from report.pages import read_page
from softshadow.report.slide_deck import CALL_LINES, shown_calls
from softshadow.report.slide_pictures import digits
from softshadow.report.slide_view import COLUMNS, ROWS, slide_view

SIZE = (64, 48)


@pytest.fixture(scope="module")
def run():
    return ss.run("volume-zfail", "torus", SIZE)


@pytest.fixture(scope="module")
def deck(run):
    return ss.slides(run)


def test_each_step_has_a_slide_between_the_title_and_a_question_with_its_answer(run, deck):
    titles = [slide.title for slide in deck.slides]
    assert titles[0] == "volume-zfail on torus"
    assert titles[1:-2] == [f"{step.index}  {step.title}" for step in run.steps]
    view = slide_view(run.steps)
    assert titles[-2] == titles[-1] == f"Why is pixel x={view.x}, y={view.y} in shadow?"
    assert deck.slides[-2].words == ""
    assert "torus" in deck.slides[-1].words


def test_digits_are_the_counts_of_the_buffer(run):
    view = slide_view(run.steps)
    for step in run.steps:
        written = re.findall(r"<text [^>]*>(-?\d+)</text>", digits(step.stencil, view, ""))
        assert np.array_equal(np.array(written, np.int64) % 256, view.part_of(step.stencil).ravel())


def test_a_count_below_zero_is_written_with_its_sign(run):
    view = slide_view(run.steps)
    drawing = digits(np.full((48, 64), 255, np.uint8), view, "")
    assert set(re.findall(r"<text [^>]*>(-?\d+)</text>", drawing)) == {"-1"}


def test_the_part_that_is_shown_has_the_most_edges_of_counts(run):
    def edges(left: int, top: int) -> int:
        """Count the pixels of a part that differ from the one to the right or the one below in the whole picture."""
        total = 0
        for step in run.steps:
            counts = step.stencil.astype(int)
            for y in range(top, top + ROWS):
                for x in range(left, left + COLUMNS):
                    right = x + 1 < SIZE[0] and counts[y, x + 1] != counts[y, x]
                    total += right or (y + 1 < SIZE[1] and counts[y + 1, x] != counts[y, x])
        return int(total)

    view = slide_view(run.steps)
    assert (view.width, view.height) == (COLUMNS, ROWS)
    assert 0 <= view.left <= view.x < view.left + COLUMNS <= SIZE[0]
    assert 0 <= view.top <= view.y < view.top + ROWS <= SIZE[1]
    others = [
        edges(left, top) for left in range(0, SIZE[0] - COLUMNS + 1, 8) for top in range(0, SIZE[1] - ROWS + 1, 8)
    ]
    assert edges(view.left, view.top) >= max(others)
    assert run.shadow_mask[view.y, view.x]


def test_a_picture_smaller_than_the_part_is_shown_whole():
    view = slide_view(ss.run("blob", "boxes", (8, 6)).steps)
    assert (view.left, view.top, view.width, view.height) == (0, 0, 8, 6)


def test_calls_that_change_are_shown_and_those_without_room_are_counted():
    many = [f"glLightf(GL_LIGHT{number}, GL_SPOT_CUTOFF, 30)" for number in range(CALL_LINES + 5)]
    calls, left_out = shown_calls([], many)
    assert [call for call, _ in calls] == many[:CALL_LINES]
    assert left_out == 5
    assert shown_calls(many, many) == ((), 0)


def test_a_step_tells_what_it_changed(run, deck):
    (_, *steps) = deck.slides[:-2]
    assert "Changed" not in " ".join(steps[0].notes)  # there is nothing before it
    notes = " ".join(steps[1].notes)  # count back faces
    assert f"stencil at {int((run[1].stencil != run[0].stencil).sum())} pixels" in notes
    assert "colour at" not in notes
    assert ("glDepthMask(GL_FALSE)", "new") in steps[1].calls
    assert ("glEnable(GL_LIGHTING)", "gone") in steps[1].calls


def test_maps_are_shown_where_nothing_is_counted():
    slides = ss.slides(ss.run("map", "boxes", SIZE, map_size=32)).slides
    captions = [caption for slide in slides for _, caption in slide.figures]
    assert any(caption.startswith("map ZS: depth map") for caption in captions)
    assert not any(caption.startswith("stencil") for caption in captions[:2])


def test_the_file_is_whole_and_loads_nothing(deck, tmp_path):
    path = deck.save(tmp_path / "slides.html")
    page = read_page(path)
    assert [url for _, _, url in page.urls if not url.startswith("data:")] == []
    assert path.stat().st_size < 500_000
    assert repr(deck) == f"Slides('volume-zfail on torus', {len(deck)} slides)"


def test_a_file_of_another_name_or_of_somebody_else_is_refused(deck, tmp_path):
    with pytest.raises(ValueError, match=r"slides.pdf: expected a name that ends in .html"):
        deck.save(tmp_path / "slides.pdf")
    (tmp_path / "mine.html").write_text("mine")
    with pytest.raises(ss.SoftShadowError, match="was not written by softshadow"):
        deck.save(tmp_path / "mine.html")
    deck.save(tmp_path / "mine.html", force=True)


def test_a_recorded_program_has_slides_without_a_question():
    with ss.record(16, 12) as recording:
        ss.gl.glRectf(-0.5, -0.5, 0.5, 0.5)
    titles = [slide.title for slide in ss.slides(recording.run).slides]
    assert len(titles) == 1 + len(recording.run.steps)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("technique", "scene", "options"),
    [("volume-zfail", "torus", {}), ("map", "boxes", {}), ("volume-wedges", "soft-slab", {})],
)
def test_keys_turn_the_slides_and_each_is_a_page_on_paper(technique, scene, options, tmp_path: Path):
    deck = ss.slides(ss.run(technique, scene, (160, 120), **options))
    path = deck.save(tmp_path / "slides.html")
    with chromium() as browser, opened(browser, path) as page:
        current = "document.querySelector('.slide.current').id"
        assert page.evaluate(current) == "slide-1"
        for _ in range(2):
            page.keyboard.press("ArrowRight")
        page.keyboard.press("ArrowLeft")
        assert page.evaluate(current) == "slide-2"
        assert page.evaluate("location.hash") == "#2"
        page.keyboard.press("End")
        assert page.evaluate(current) == f"slide-{len(deck)}"
        assert page.is_disabled("#next")
        page.keyboard.press("Home")
        page.click("#next")
        assert page.evaluate(current) == "slide-2"
        page.emulate_media(media="print")
        assert page.evaluate(OVERFLOWING) == []
        axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="needs axe-playwright-python")
        assert axe.Axe().run(page).response["violations"] == []
        pdf = page.pdf(prefer_css_page_size=True)
        assert len(re.findall(rb"/Type /Page\b", pdf)) == len(deck)
