"""The listings on softshadow and on Mesa's llvmpipe: as printed, as corrected, and without each of the corrections."""

import pytest

from listings.drawn_listings import corrected, printed, without
from softshadow import listings
from softshadow.testing import differences, run_on_mesa

LEFT_OUT = [(name, number) for name in listings.names() for number in listings.get(name).corrections]


@pytest.mark.mesa
@pytest.mark.parametrize("name", listings.names())
def test_listing_leaves_the_same_bits_on_mesa(name):
    listing = listings.get(name)
    assert differences(corrected(name), run_on_mesa(listing.corrected, listings.SIZE)) == ()
    assert differences(printed(name), run_on_mesa(listing.printed, listings.SIZE)) == ()


@pytest.mark.mesa
@pytest.mark.parametrize(("name", "number"), LEFT_OUT)
def test_listing_without_a_correction_leaves_the_same_bits_on_mesa(name, number):
    there = run_on_mesa(listings.get(name).without(number), listings.SIZE)
    assert differences(without(name, number), there) == ()
