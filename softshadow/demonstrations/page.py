"""The entries of docs/corrections.md, as Markdown: every error of the slides with what shows it, measured."""

from softshadow.course import Erratum
from softshadow.course.sources import explain_place
from softshadow.demonstrations.measuring import Measured, measure
from softshadow.demonstrations.pictures import pairs_of

COMMANDS = {"listing": "softshadow listings", "failure": "softshadow failures"}


def entry(erratum: Erratum) -> str:
    """Return one error as Markdown, with its numbers measured now, and pictures where they differ."""
    lines = [
        f"**{erratum.number}: {erratum.title}** ({erratum.place})",
        "",
        f"- The slide: {erratum.says}",
        f"- {'Why it looks wrong' if erratum.stands else 'Why it is wrong'}: {erratum.wrong}",
        f"- Right: {erratum.right}",
        *(f"- {shown(erratum.number, each)}" for each in measure(erratum.number)),
    ]
    pictures = [f"```{{raw}} html\n{pair.html()}\n```" for pair in pairs_of(erratum.number)]
    return "\n\n".join(["\n".join(lines), *pictures])


def shown(number: str, measured: Measured) -> str:
    """Return one line: what to run, and what it shows."""
    if measured.kind == "source":
        return f"Source: {measured}"
    if measured.kind == "program":
        return f"`softshadow errata {number}`: {measured}"
    return f"`{COMMANDS[measured.kind]} {measured.name}`: {measured}"


def entries(errata: tuple[Erratum, ...]) -> str:
    """Return several errors as Markdown."""
    return "\n\n".join(entry(each) for each in errata)


def places(erratum: Erratum) -> list[str]:
    """Return a sentence for each place of an error in the slides."""
    return [explain_place(place.strip()) for place in erratum.place.split(",")]
