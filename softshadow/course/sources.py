"""The slides of the courses by tag, and the codes in which comments and pages point at them.

A place is a tag and the lines of the slides, saved as text: "SK:369" or "RO1:199-250". A number like E49 is that of an
error in the slides (`softshadow.course.ERRATA`).
"""

import re
from collections.abc import Callable

SOURCES = {
    "RO1": "Florica Moldoveanu, Redarea umbrelor în imagini 1, Politehnica Bucharest, 2021-22",
    "RO2": "Florica Moldoveanu, Redarea umbrelor în imagini 2, Politehnica Bucharest, 2021-22",
    "SK": "Marek Zimányi and Michal Valient, Tiene (Computer Graphics 2), Comenius University Bratislava, 2004/05",
    "CA": "Carlos Andújar, Simulació d'ombres, Universitat Politècnica de Catalunya, Barcelona, 2021",
}
PLACE = re.compile(r"\b(RO1|RO2|SK|CA):(\d+)(?:-(\d+))?")
NUMBER = re.compile(r"\bE\d+\b")


def explain_place(code: str) -> str:
    """Return what a place in the slides means.

    Raises
    ------
    ValueError                   it is no place

    Examples
    --------
    >>> explain_place("CA:620")
    "CA:620 is line 620 of the slides of Carlos Andújar, Simulació d'ombres, ..., Barcelona, 2021"
    """
    match = PLACE.fullmatch(code)
    if match is None:
        raise ValueError(f"code {code!r}: expected a tag ({', '.join(SOURCES)}), a colon and a line, like SK:369")
    tag, first, last = match.groups()
    lines = f"line {first}" if last is None else f"lines {first} to {last}"
    return f"{code} is {lines} of the slides of {SOURCES[tag]}"


def explanations(text: str, title_of: Callable[[str], str]) -> list[str]:
    """Return a sentence for each number and each course that a text mentions.

    Parameters
    ----------
    title_of                     the title of an error by its number; ValueError if there is none

    Examples
    --------
    >>> explanations("E38, CA:470, CA:482", lambda number: "one bit of the count")[0]
    'E38: error 38 of the slides: one bit of the count'
    """
    sentences = [
        f"{number}: error {number[1:]} of the slides: {title_of(number)}"
        for number in dict.fromkeys(NUMBER.findall(text))
    ]
    tags = dict.fromkeys(match[1] for match in PLACE.finditer(text))
    return sentences + [f"{tag} and a number: a line of the slides of {SOURCES[tag]}" for tag in tags]
