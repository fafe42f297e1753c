"""Pictures of the errors of the slides: with the error and without, where a buffer shows the difference."""

import base64
import re
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from softshadow import course, listings
from softshadow.demonstrations.pictures import pairs_of
from softshadow.gallery import GALLERY
from softshadow.testing import run_here


def test_a_listing_is_shown_without_the_correction_and_with_it() -> None:
    pair = next(pairs_of("E47"))
    name = course.get("E47").shown_by[0].removeprefix("listing:")
    listing = listings.get(name)
    shown = [run_here(each, listings.SIZE).color[::-1, :, :3] for each in (listing.without("E47"), listing.corrected)]
    assert all(np.array_equal(*each) for each in zip(pair.pictures, shown, strict=True))
    assert pair.captions == ("without E47", "corrected")
    differ = int((shown[0] != shown[1]).any(axis=-1).sum())
    assert all(f"{differ:,} of 16,384 pixels differ" in words for words in pair.words)


def test_a_failure_is_shown_beside_its_cure() -> None:
    number, name = next(
        (each.number, each.shown_by[0].removeprefix("failure:"))
        for each in course.ERRATA.values()
        if each.shown_by[0].startswith("failure:")
    )
    pair = next(pairs_of(number))
    assert np.array_equal(pair.pictures[0], GALLERY[name].wrong.image)
    assert np.array_equal(pair.pictures[1], GALLERY[name].cured.image)


def test_a_program_is_shown_by_what_it_reads() -> None:
    (pair,) = pairs_of("E66")
    wrong = (np.abs(pair.pictures[0].astype(int) - pair.pictures[1]) > 1).any(axis=-1).sum()
    assert 600 < wrong < 800  # 723 against the box in world space; the cure rounds some pixels otherwise


def test_where_colours_are_the_same_another_buffer_is_shown() -> None:
    (pair,) = pairs_of("E44")
    assert pair.captions == ("by the slide (stencil)", "right (stencil)")
    assert "5 in 4,096" in pair.words[1]
    assert "5 in" not in pair.words[0]


@pytest.mark.parametrize("number", ["E4", "E14", "E64"])
def test_numbers_and_sources_have_no_picture(number: str) -> None:
    assert list(pairs_of(number)) == []


def test_html_holds_both_pictures_with_words() -> None:
    (pair,) = pairs_of("E66")
    images = re.findall(r'src="data:image/webp;base64,([^"]*)".*?loading="lazy" alt="([^"]*)"', pair.html())
    assert [words for _, words in images] == list(pair.words)
    assert [Image.open(BytesIO(base64.b64decode(data))).size for data, _ in images] == [(128, 128)] * 2
