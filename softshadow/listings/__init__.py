"""The GL listings of the course, as printed and as corrected, and the register that lists them by name.

Each listing is a function of a GL namespace: `softshadow.gl`, or any other with the same names. It is one function with
a switch at every place where the slide has to be corrected, so that it can run as printed, with all corrections, or
with all but one. The corrections have the numbers of docs/corrections.md.

The slides are named by text and line: RO1 and RO2 (Moldoveanu, "Redarea umbrelor în imagini" 1 and 2, Politehnica
Bucharest 2021-22), SK (Zimányi & Valient, Comenius University Bratislava 2004/05) and CA (Andújar, Universitat
Politècnica de Catalunya, 2021).
"""

from softshadow.errors import nearest
from softshadow.listings import depth_and_stencil, maps, planar, volumes
from softshadow.listings.listing import Listing
from softshadow.listings.stage import SIZE

__all__ = ["SIZE", "Listing", "get", "names"]

REGISTER = {listing.name: listing for file in (depth_and_stencil, planar, volumes, maps) for listing in file.LISTINGS}


def names() -> list[str]:
    """Return the names of all listings, in the order of the course.

    Examples
    --------
    >>> names()[:3]
    ['stencil-setup', 'stencil-quads', 'offset-formula']
    """
    return list(REGISTER)


def get(name: str) -> Listing:
    """Return the listing of a name.

    Raises
    ------
    ValueError                   unknown name; the message has the nearest one

    Examples
    --------
    >>> get("volume-zpass").slide
    'RO1:169-277'
    """
    if name not in REGISTER:
        raise ValueError(f"unknown listing {name!r}: {nearest(str(name), REGISTER)}")
    return REGISTER[name]
