"""``softshadow listings``: the course's GL listings, as printed or corrected, on softshadow and on Mesa."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json, examples, force
from softshadow.cli.console import CHECK_FAILED, print_json, say, say_if_compiling, table

if TYPE_CHECKING:
    import numpy as np

    from softshadow.inspection.history import PixelHistory
    from softshadow.listings import Listing
    from softshadow.testing import BufferDifference, ProgramResult


@click.command(
    epilog=examples("softshadow listings", "softshadow listings volume-zpass --printed -o zpass-as-printed.png")
)
@click.argument("name", required=False)
@click.option("--printed", is_flag=True, help="Run it as printed on the slide, without corrections.")
@click.option("--on", type=click.Choice(["mesa"]), help="Run it on Mesa as well, and show the first different pixel.")
@click.option("--size", type=Size(), default="128x128", show_default=True, help="Window size in pixels.")
@click.option(
    "-o", "--output", metavar="OUT", help="A .png file, or a folder/ with one image per buffer.  [default: NAME.png]"
)
@force
@as_json
@click.pass_context
def listings(
    context: click.Context, name: str | None, printed: bool, on: str | None, size: tuple[int, int],
    output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """List the course's GL listings, or run one.

    It writes the buffers as an image, and prints the effect of the corrections.
    """
    from softshadow import listings as registry
    from softshadow import testing

    if name is None:
        if printed or on or output:
            raise click.UsageError("--printed, --on and --output: expected the NAME of a listing")
        _list([registry.get(each) for each in registry.names()], as_json)
        return
    listing = registry.get(name)
    target = output or f"{name}{'-printed' if printed else ''}.png"
    _refuse(target, force)
    say_if_compiling()
    program = listing.printed if printed else listing.corrected
    result, frame = testing.run_recorded(program, size)
    differences = testing.differences(result, testing.run_on_mesa(program, size)) if on else ()
    history = testing.history_of_first(frame, differences)
    corrected, histories = _effect_of_corrections(listing, size)
    _write(target, result, force)
    pixels = _stencil_histogram(result.stencil)
    if as_json:
        print_json(
            "listings", written=target, printed=printed, size=size, stencil_counts=pixels, on=on,
            differences=[vars(each) for each in differences], history=history.to_dicts() if history else [],
            correcting=[vars(each) for each in corrected], **_about(listing),
        )  # fmt: skip
    else:
        say(f"{listing.title} ({listing.slide}), {'as printed' if printed else 'as corrected'}; written: {target}")
        table("Stencil buffer", ["stencil", "pixels"], [[value, str(number)] for value, number in pixels.items()])
        _print_corrections(listing, corrected, histories)
        if on:
            click.echo("\n".join(map(str, differences)) or "no pixel differs on Mesa")
        if history:
            click.echo(history)
    if differences:
        context.exit(CHECK_FAILED)


def _print_corrections(
    listing: Listing, corrected: tuple[BufferDifference, ...], histories: list[PixelHistory]
) -> None:
    """Print the corrections, the number of pixels they change, and both histories of the first such pixel."""
    if not listing.corrections:
        click.echo("\nno corrections")
        return
    click.echo("")
    table("Corrections", ["number", "correction"], [list(each) for each in listing.corrections.items()])
    click.echo("\nas printed and as corrected:")
    click.echo("\n".join(map(str, corrected)) or "no pixel differs")
    for which, history in zip(("as printed", "as corrected"), histories, strict=False):
        click.echo(f"\n{which}, {history}")
    click.echo("")


def _list(listings: list[Listing], as_json: bool) -> None:
    if as_json:
        print_json("listings", listings=[_about(each) for each in listings])
        return
    rows = [[each.name, each.title, each.slide, " ".join(each.corrections) or "-"] for each in listings]
    table("Listings", ["name", "title", "slide", "corrections"], rows)


def _about(listing: Listing) -> dict[str, Any]:
    return {
        "name": listing.name,
        "title": listing.title,
        "family": listing.family,
        "slide": listing.slide,
        "corrections": dict(listing.corrections),
    }


def _effect_of_corrections(
    listing: Listing, size: tuple[int, int]
) -> tuple[tuple[BufferDifference, ...], list[PixelHistory]]:
    """Return the differences between the printed and the corrected listing, and both histories of the first pixel."""
    from softshadow.testing import differences, history_of_first, run_recorded

    (printed, before), (corrected, after) = (
        run_recorded(program, size) for program in (listing.printed, listing.corrected)
    )
    changes = differences(printed, corrected)
    return changes, [each for frame in (before, after) if (each := history_of_first(frame, changes))]


def _stencil_histogram(stencil: np.ndarray) -> dict[str, int]:
    import numpy as np

    return {str(value): int(pixels) for value, pixels in zip(*np.unique(stencil, return_counts=True), strict=True)}


def _refuse(target: str, force: bool) -> None:
    """Check before drawing that the images may be written."""
    from softshadow.inspection.files import is_folder, refuse_foreign

    if is_folder(target):
        return
    if Path(target).suffix.lower() != ".png":
        raise ValueError(f"{target}: expected an ending of .png, or a folder (a path that ends in /)")
    refuse_foreign(Path(target), force)


def _write(target: str, result: ProgramResult, force: bool) -> None:
    """Write the three buffers as one image, side by side, or as three images in a folder."""
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
    for path in files:  # check all files before writing the first one
        refuse_foreign(path, force)
    for path, picture in files.items():
        write_whole(path, partial(save_png, picture), force)
