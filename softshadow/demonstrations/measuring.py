"""The numbers that show an error of the slides."""

from typing import NamedTuple

import numpy as np

from softshadow import course, listings
from softshadow.demonstrations import area_lights, buffers, counts, light_views, projections
from softshadow.demonstrations.demonstration import WINDOW
from softshadow.errors import nearest
from softshadow.gallery import GALLERY

PROGRAMS = {
    each.name: each for file in (buffers, counts, projections, light_views, area_lights) for each in file.DEMONSTRATIONS
}
PLANES = ("colour", "depth", "stencil")


class Measured(NamedTuple):
    """What one demonstration shows.

    Attributes
    ----------
    kind, name : str             "listing", "failure", "program" or "source", and which
    what : str                   what the numbers are
    numbers : tuple of int       of a listing: pixels whose colour, depth and stencil differ without the correction; of
                                 a failure: wrong pixels, with it and with its cure; of a program: by the slide, and as
                                 it is; of a source none
    """

    kind: str
    name: str
    what: str
    numbers: tuple[int, ...]

    def __str__(self) -> str:
        if self.kind == "source":
            return self.name
        if self.kind == "listing":
            numbers = ", ".join(f"{each} {plane}" for each, plane in zip(self.numbers, PLANES, strict=True) if each)
            return f"{self.what}: {numbers}"
        return f"{self.what}: {self.numbers[0]} → {self.numbers[1]}"


def measure(number: str) -> list[Measured]:
    """Run all that shows an error, and return the numbers.

    Raises
    ------
    ValueError                   unknown number; the message has the nearest one

    Examples
    --------
    >>> [str(each) for each in measure("E64")]
    ['default of the stencil write mask, 8 bits: 0 → 255']
    """
    return [measure_one(number, each) for each in course.get(number).shown_by]


def measure_one(number: str, shown_by: str) -> Measured:
    """Return the numbers of one demonstration, as "listing:NAME", "failure:NAME", "program:NAME" or "source:TEXT".

    Raises
    ------
    ValueError                   unknown kind or name
    """
    kind, _, name = shown_by.partition(":")
    if kind == "source":
        return Measured(kind, name, "", ())
    if kind == "listing":
        return Measured(kind, name, f"pixels that differ without {number}", differences_without(name, number))
    if kind == "failure":
        failure = GALLERY[name]
        return Measured(kind, name, "wrong pixels", (failure.number_wrong, failure.number_cured))
    if kind != "program" or name not in PROGRAMS:
        raise ValueError(f"demonstration {shown_by!r}: {nearest(name, PROGRAMS)}")
    demonstration = PROGRAMS[name]
    from softshadow import gl

    with gl.create_context(*WINDOW):
        by_slide, right = demonstration.program(gl)
    return Measured(kind, name, demonstration.what, (by_slide, right))


def differences_without(name: str, number: str) -> tuple[int, int, int]:
    """Return in how many pixels of 128 x 128 colour, depth and stencil differ if one correction is left out."""
    from softshadow.testing import run_here

    listing = listings.get(name)
    without, right = (run_here(program, listings.SIZE) for program in (listing.without(number), listing.corrected))
    color = np.count_nonzero((without.color != right.color).any(axis=-1))
    depth, stencil = (np.count_nonzero(getattr(without, each) != getattr(right, each)) for each in ("depth", "stencil"))
    return int(color), int(depth), int(stencil)
