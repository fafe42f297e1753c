"""``softshadow errata``: the errors in the slides of the course, each with what shows it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import as_json, examples
from softshadow.cli.console import print_json, say_if_compiling, show, table
from softshadow.cli.names import ErratumNumber

if TYPE_CHECKING:
    from softshadow.course import Erratum


@click.command(epilog=examples("softshadow errata", "softshadow errata E64", "softshadow errata --source SK:369"))
@click.argument("number", type=ErratumNumber(), metavar="[NUMBER]", required=False)
@click.option("--source", metavar="CODE", help="Say what a place like SK:369 is.")
@as_json
def errata(number: str | None, source: str | None, as_json: bool) -> None:
    """List the errors in the slides of the course, or run what shows one.

    Numbers like E49 in listings, failures and comments are those of this list.
    """
    from softshadow import course

    if number and source:
        raise click.UsageError("--source: expected no NUMBER besides")
    if source:
        text = course.explain_place(source)
        print_json("errata", source=text) if as_json else show(text)
    elif number is None:
        _list(list(course.ERRATA.values()), as_json)
    else:
        say_if_compiling()
        _one(course.get(number), as_json)


def _list(errata: list[Erratum], as_json: bool) -> None:
    if as_json:
        print_json("errata", errata=[vars(each) for each in errata])
        return
    table("Errors in the slides", ["number", "place", "what is right"],
          [[each.number, each.place, each.title] for each in errata])  # fmt: skip


def _one(erratum: Erratum, as_json: bool) -> None:
    from softshadow.demonstrations import measure
    from softshadow.demonstrations.page import places, shown

    measured = measure(erratum.number)
    if as_json:
        shown_by: list[dict[str, Any]] = [each._asdict() for each in measured]
        print_json("errata", errata=[vars(erratum) | {"measured": shown_by}])
        return
    reason = "why it looks wrong" if erratum.stands else "why it is wrong"
    lines = [f"{erratum.number}: {erratum.title}", "", *places(erratum), "", f"the slide: {erratum.says}",
             f"{reason}: {erratum.wrong}", f"right: {erratum.right}", "",
             *(shown(erratum.number, each) for each in measured)]  # fmt: skip
    show("\n".join(lines))
