"""The register: names, slides, corrections, and programs with any choice of them."""

import re

import pytest

from softshadow import course, listings
from softshadow.listings.listing import Listing


def test_unknown_listing_is_told_the_nearest_one():
    with pytest.raises(ValueError, match="unknown listing 'volume-zpas': did you mean 'volume-zpass'"):
        listings.get("volume-zpas")


def test_unknown_correction_is_told_those_that_there_are():
    with pytest.raises(ValueError, match="listing planar: unknown correction 'E99': expected one of E33, E34"):
        listings.get("planar").without("E99")
    with pytest.raises(ValueError, match="listing planar-stencil: unknown correction 'E1': it has none"):
        listings.get("planar-stencil").with_only("E1")


def test_program_gets_the_corrections_that_it_was_asked_for():
    def calls(gl, corrected):
        yield "the only step"
        return sorted(corrected)

    listing = Listing("x", "x", "tools", "CA:1", calls, {"E1": "", "E2": ""})
    programs = (listing.printed, listing.corrected, listing.with_only("E1"), listing.without("E1"))
    assert [program(None) for program in programs] == [[], ["E1", "E2"], ["E1"], ["E2"]]


@pytest.mark.parametrize("name", listings.names())
def test_listing_names_its_slide_by_text_and_lines(name):
    listing = listings.get(name)
    assert listing.name == name
    assert all(re.fullmatch(r"(RO1|RO2|SK|CA):\d+(-\d+)?", part) for part in listing.slide.split(", "))
    assert listing.calls.__doc__.startswith(listing.slide.split(":")[0])


def test_every_correction_of_a_listing_is_told():
    told = set(course.ERRATA)
    made = {number for name in listings.names() for number in listings.get(name).corrections}
    assert sorted(made - told) == []
