"""What the slides of the course say: their sources, their errors, the terms of four languages, and the passes table.

Nothing is drawn here. `softshadow.demonstrations` runs what shows each error.
"""

from softshadow.course import buffer_errata, map_errata, planar_errata, soft_errata, volume_errata
from softshadow.course.erratum import Erratum
from softshadow.course.sources import SOURCES, explain_place, explanations
from softshadow.errors import nearest

__all__ = ["ERRATA", "SOURCES", "Erratum", "explain_codes", "explain_place", "get"]

FILES = (volume_errata, planar_errata, map_errata, buffer_errata, soft_errata)
ERRATA = {
    each.number: each
    for each in sorted((each for file in FILES for each in file.ERRATA), key=lambda each: int(each.number[1:]))
}


def get(number: str) -> Erratum:
    """Return the error of a number.

    Raises
    ------
    ValueError                   unknown number; the message has the nearest one

    Examples
    --------
    >>> get("E34").title
    'the occluder is drawn last'
    """
    if number not in ERRATA:
        raise ValueError(f"unknown error {number!r}: {nearest(str(number), ERRATA)}")
    return ERRATA[number]


def explain_codes(text: str) -> list[str]:
    """Return a sentence for each number (E49) and each course (SK, CA, RO1, RO2) that a text mentions.

    Examples
    --------
    >>> explain_codes("E34")
    ['E34: error 34 of the slides: the occluder is drawn last']
    """
    return explanations(text, lambda number: get(number).title)
