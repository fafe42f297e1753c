"""``softshadow listings``: the GL listings of the course, run as printed or as corrected, here and on Mesa."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json, force
from softshadow.cli.console import print_json, say, say_if_compiling, table

if TYPE_CHECKING:
    import numpy as np

    from softshadow.inspection.history import PixelHistory
    from softshadow.listings import Listing
    from softshadow.testing import Difference, ProgramResult

DIFFERENT = 1  # the exit code where a comparison failed


@click.command(
    epilog="Examples:  softshadow listings  |  softshadow listings volume-zpass --printed -o zpass-as-printed.png"
)
@click.argument("name", required=False)
@click.option("--printed", is_flag=True, help="As the slide prints it, without the corrections.")
@click.option("--on", type=click.Choice(["mesa"]), help="Run it there, too, and tell the first pixel that differs.")
@click.option("--size", type=Size(), default="128x128", show_default=True, help="Of the window.")
@click.option(
    "-o", "--output", metavar="OUT", help="A .png, or a folder/ for a picture of each buffer.  [default: NAME.png]"
)
@force
@as_json
@click.pass_context
def listings(
    context: click.Context, name: str | None, printed: bool, on: str | None, size: tuple[int, int],
    output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """List the GL listings of the course, or run one and show the buffers it leaves."""
    from softshadow import listings as register
    from softshadow import testing

    if name is None:
        if printed or on or output:
            raise click.UsageError("--printed, --on and --output: expected the NAME of a listing")
        _list([register.get(each) for each in register.names()], as_json)
        return
    listing = register.get(name)
    target = output or f"{name}{'-printed' if printed else ''}.png"
    _refuse(target, force)
    say_if_compiling()
    program = listing.printed if printed else listing.corrected
    result, frame = testing.run_recorded(program, size)
    found = testing.differences(result, testing.run_on_mesa(program, size)) if on else ()
    history = testing.history_of_first(frame, found)
    changed, histories = _changed(listing, size)
    _write(target, result, force)
    counts = _counts(result.stencil)
    if as_json:
        print_json(
            "listings", written=target, printed=printed, size=size, stencil_counts=counts, on=on,
            differences=[vars(each) for each in found], history=history.to_dicts() if history else [],
            correcting=[vars(each) for each in changed], **_about(listing),
        )  # fmt: skip
    else:
        say(f"{listing.title} ({listing.slide}), {'as printed' if printed else 'as corrected'}; written: {target}")
        table("Stencil buffer", ["stencil", "pixels"], [[value, str(pixels)] for value, pixels in counts.items()])
        _say_corrections(listing, changed, histories)
        if on:
            click.echo("\n".join(map(str, found)) or "no pixel differs on Mesa")
        if history:
            click.echo(history)
    if found:
        context.exit(DIFFERENT)


def _say_corrections(listing: Listing, changed: tuple[Difference, ...], histories: list[PixelHistory]) -> None:
    """Print the corrections, how many pixels they change, and the first of these as printed and as corrected."""
    if not listing.corrections:
        click.echo("\nnothing to correct")
        return
    click.echo("")
    table("Corrections", ["number", "correction"], [list(each) for each in listing.corrections.items()])
    click.echo("\nas printed and as corrected:")
    click.echo("\n".join(map(str, changed)) or "no pixel differs")
    for which, history in zip(("as printed", "as corrected"), histories, strict=False):
        click.echo(f"\n{which}, {history}")
    click.echo("")


def _list(found: list[Listing], as_json: bool) -> None:
    if as_json:
        print_json("listings", listings=[_about(each) for each in found])
        return
    rows = [[each.name, each.title, each.slide, " ".join(each.corrections) or "-"] for each in found]
    table("Listings", ["name", "title", "slide", "corrections"], rows)


def _about(listing: Listing) -> dict[str, Any]:
    return {
        "name": listing.name,
        "title": listing.title,
        "family": listing.family,
        "slide": listing.slide,
        "corrections": dict(listing.corrections),
    }


def _changed(listing: Listing, size: tuple[int, int]) -> tuple[tuple[Difference, ...], list[PixelHistory]]:
    """Return what differs between the slide as printed and as corrected, and both histories of the first such pixel."""
    from softshadow.testing import differences, history_of_first, run_recorded

    (printed, before), (corrected, after) = (
        run_recorded(program, size) for program in (listing.printed, listing.corrected)
    )
    found = differences(printed, corrected)
    return found, [each for frame in (before, after) if (each := history_of_first(frame, found))]


def _counts(stencil: np.ndarray) -> dict[str, int]:
    import numpy as np

    return {str(value): int(pixels) for value, pixels in zip(*np.unique(stencil, return_counts=True), strict=True)}


def _refuse(target: str, force: bool) -> None:
    """Make sure before the drawing that the pictures may be written."""
    from softshadow.inspection.files import is_folder, refuse_foreign

    if is_folder(target):
        return
    if Path(target).suffix.lower() != ".png":
        raise ValueError(f"{target}: expected an ending of .png, or a folder (a path that ends in /)")
    refuse_foreign(Path(target), force)


def _write(target: str, result: ProgramResult, force: bool) -> None:
    """Write the three buffers side by side into one picture, or each into a folder, which is made."""
    from functools import partial

    from softshadow.inspection.files import is_folder, refuse_foreign, write_whole
    from softshadow.inspection.pictures import contact_sheet, depth_picture, save_png

    pictures = {
        "image": result.color[::-1, :, :3],
        "depth": depth_picture(result.depth[::-1], clear=2**24 - 1),
        "stencil": result.stencil[::-1],
    }
    if is_folder(target):
        folder = Path(target)
        folder.mkdir(parents=True, exist_ok=True)
        files = {folder / f"{name}.png": picture for name, picture in pictures.items()}
    else:
        files = {Path(target): contact_sheet([("colour, depth, stencil", tuple(pictures.values()))])}
    for path in files:  # all of them before the first is written
        refuse_foreign(path, force)
    for path, picture in files.items():
        write_whole(path, partial(save_png, picture), force)
