"""Slides of lessons: the lesson's words, listing and steps; no answers."""

import pytest

from report.browser import OVERFLOWING, chromium, opened
from softshadow.lessons import lesson_slides
from softshadow.lessons.copies import lesson_files, title_of
from softshadow.lessons.deck import cells_of, notes_of, sections_of


def test_a_lesson_becomes_goal_listing_steps_question_and_exercise():
    deck = lesson_slides(8)
    titles = [slide.title for slide in deck.slides]
    assert titles[0] == deck.title == "8. Projected shadows with the stencil buffer"
    assert titles[-2:] == ["Predict, then run", "Exercise"]
    assert "Goal." in deck.slides[0].words
    assert titles[1].startswith("planar-stencil, CA:292-359")
    assert "glStencilFunc" in deck.slides[1].words
    steps = [slide for slide in deck.slides if slide.notes]
    assert [slide.title[0] for slide in steps] == ["0", "1", "2", "3"]
    assert "<b>The receiver is drawn and marks its pixels with 1.</b>" in steps[0].notes


def test_answers_and_solutions_stay_in_the_notebook():
    words = " ".join(slide.words for slide in lesson_slides("05").slides)
    assert "def solution" not in words
    assert "compare_prediction" not in words


def test_a_lesson_has_a_number_a_padded_number_or_a_name():
    assert len({lesson_slides(name).title for name in (5, "5", "05", "05_stencil_buffer")}) == 1
    with pytest.raises(ValueError, match="lesson 99: expected one of 01_what_a_shadow_is"):
        lesson_slides(99)


def test_markup_in_a_lesson_is_text_on_its_slides():
    words = lesson_slides(5).slides[0].words
    assert "<script" not in words
    assert "<strong>Goal.</strong>" in words


def test_notes_are_those_of_the_steps_if_there_are_as_many():
    cells = list(cells_of(lesson_files()[7]))
    assert len(notes_of(cells, 4)) == 4
    assert len(notes_of(cells, 5)) == 1
    assert sections_of("") == []


@pytest.mark.slow
@pytest.mark.parametrize("lesson", lesson_files(), ids=lambda path: path.stem)
def test_every_lesson_has_slides_whose_words_have_room(lesson, tmp_path):
    deck = lesson_slides(lesson.stem)
    assert deck.title == title_of(lesson)
    assert sum(bool(slide.notes) for slide in deck.slides) >= 1
    assert {"Predict, then run", "Exercise"} <= {slide.title for slide in deck.slides}
    with chromium() as browser, opened(browser, deck.save(tmp_path / "slides.html")) as page:
        page.emulate_media(media="print")
        assert page.evaluate(OVERFLOWING) == []
