"""What an error in the slides is: what they say, why it is wrong, what is right, and what shows it."""

from dataclasses import dataclass

KINDS = ("listing", "failure", "program", "source")


@dataclass(frozen=True)
class Erratum:
    """An error in the slides, or something they leave unsaid.

    Attributes
    ----------
    number : str                 like "E38"
    place : str                  like "CA:470, CA:482"; explained by `softshadow.course.sources`
    title : str                  the correction in a few words
    says : str                   what the slide says, in its own words where they are short
    wrong : str                  why that is wrong
    right : str                  what is right
    shown_by : tuple of str      "listing:NAME", "failure:NAME" or "program:NAME", which can be run; "source:TEXT" where
                                 nothing can be
    stands : bool                the slide is right although it looks wrong: what it says and what is right agree
    """

    number: str
    place: str
    title: str
    says: str
    wrong: str
    right: str
    shown_by: tuple[str, ...]
    stands: bool = False
