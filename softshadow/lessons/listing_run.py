"""A listing of the course as a run, with its buffers after every step of the slide."""

from __future__ import annotations

from softshadow.gallery.call_difference import call_difference
from softshadow.gallery.course_stage import listing_scene, listing_technique
from softshadow.gallery.expected import without_warnings
from softshadow.gallery.failure import Setting
from softshadow.listings import SIZE, get
from softshadow.runs import Run, run


def run_listing(name: str, printed: bool = False, size: tuple[int, int] = SIZE) -> Run:
    """Return the run of a listing: as it is corrected, or as its slide prints it.

    Parameters
    ----------
    name : str                   of the listing, see `softshadow.listings.names`
    printed : bool               without the corrections
    size : (width, height) of the window, in pixels

    Raises
    ------
    ValueError                   an unknown name; the message has the nearest one

    Examples
    --------
    >>> run_listing("stencil-quads").steps.titles
    ['the first quad marks its pixels', 'the second quad where there is no mark']
    """
    listing = get(name)
    with without_warnings():
        return run(listing_technique(listing, () if printed else listing.corrections), listing_scene(listing), size)


def listing_difference(name: str, size: tuple[int, int] = SIZE) -> str:
    """Return the corrections of a listing as a diff of GL calls: - as printed, + as corrected; empty if none.

    Parameters
    ----------
    name : str                   of the listing, see `softshadow.listings.names`
    size : (width, height) of the window, in pixels

    Raises
    ------
    ValueError                   an unknown name; the message has the nearest one

    Examples
    --------
    >>> print(listing_difference("volume-five-passes").splitlines()[1])
    - glStencilFunc(GL_EQUAL, 1, 1)
    """
    listing = get(name)
    scene = listing_scene(listing)
    (_, printed), (_, corrected) = (
        Setting(listing_technique(listing, numbers)).draw(scene, size) for numbers in ((), listing.corrections)
    )
    return call_difference(printed, corrected, len(printed) + len(corrected))
