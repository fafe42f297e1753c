"""The errors in the slides: all of them are there, each with a place, a correction and something that shows it."""

import re

import pytest

from softshadow import course, listings
from softshadow.course.erratum import KINDS
from softshadow.course.sources import PLACE
from softshadow.demonstrations import PROGRAMS
from softshadow.gallery import GALLERY

INVENTORY = [f"E{number}" for number in range(1, 70)]  # 63 that do not work as printed, and 6 half-truths
RIGHT_AFTER_ALL = {"E37", "E39", "E41", "E59"}
errata = pytest.mark.parametrize("erratum", list(course.ERRATA.values()), ids=list(course.ERRATA))


def test_all_errors_are_there_in_order() -> None:
    assert list(course.ERRATA) == INVENTORY
    assert {number for number, each in course.ERRATA.items() if each.stands} == RIGHT_AFTER_ALL


@errata
def test_an_error_has_a_place_and_all_its_sentences(erratum: course.Erratum) -> None:
    assert all(PLACE.fullmatch(place) for place in erratum.place.split(", "))
    for text in (erratum.says, erratum.wrong, erratum.right):
        assert len(text) > 5
    assert all(text[-1] in ".:" for text in (erratum.wrong, erratum.right))
    assert erratum.title[-1] not in ".:"


@errata
def test_what_shows_an_error_exists_and_corrects_it(erratum: course.Erratum) -> None:
    assert erratum.shown_by
    for each in erratum.shown_by:
        kind, _, name = each.partition(":")
        assert kind in KINDS
        if kind == "listing":
            assert erratum.number in listings.get(name).corrections
        elif kind == "failure":
            assert name in GALLERY
        elif kind == "program":
            assert name in PROGRAMS


def test_every_program_shows_an_error() -> None:
    used = {each.partition(":")[2] for error in course.ERRATA.values() for each in error.shown_by}
    assert set(PROGRAMS) <= used


def test_only_history_is_shown_by_a_source_alone() -> None:
    alone = [n for n, each in course.ERRATA.items() if all(shown.startswith("source:") for shown in each.shown_by)]
    assert alone == ["E14"]


def test_every_listing_and_failure_is_shown_where_it_corrects() -> None:
    for name in listings.names():
        assert set(listings.get(name).corrections) <= set(course.ERRATA)
    for failure in GALLERY.values():
        assert set(re.findall(r"\bE\d+\b", failure.reference)) <= set(course.ERRATA)


def test_codes_are_explained() -> None:
    text = " ".join(course.explain_codes("E38, CA:470, CA:482, SK:9"))
    assert text.count("E38: error 38 of the slides: all bits of the count are tested") == 1
    assert text.count("Barcelona") == text.count("Bratislava") == 1
    assert course.explain_codes("Donnelly & Lauritzen 2006") == []
    assert course.explain_place("RO1:77-82").startswith("RO1:77-82 is lines 77 to 82 of the slides of Florica")
    with pytest.raises(ValueError, match="code 'XY:3': expected a tag"):
        course.explain_place("XY:3")
    with pytest.raises(ValueError, match="unknown error 'E99'"):
        course.get("E99")


def test_every_failure_explains_its_codes() -> None:
    for failure in GALLERY.values():
        tags = {match[1] for match in PLACE.finditer(failure.reference)}
        assert len(failure.codes) == len(set(re.findall(r"\bE\d+\b", failure.reference))) + len(tags)
