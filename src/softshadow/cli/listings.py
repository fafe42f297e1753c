"""``softshadow listings``: the GL listings of the course, run as printed or as corrected, here and on Mesa."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json, force
from softshadow.cli.talk import print_json, say, say_if_compiling, table

if TYPE_CHECKING:
    import numpy as np

    from softshadow.context import Frame
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

    if name is None:
        if printed or on or output:
            raise click.UsageError("--printed, --on and --output: expected the NAME of a listing")
        _list([register.get(each) for each in register.names()], as_json)
        return
    listing = register.get(name)
    target = output or f"{name}{'-printed' if printed else ''}.png"
    _refuse(target, force)
    say_if_compiling()
    result, frame = _run(listing, printed, size)
    found = _differences_on_mesa(listing, printed, size, result) if on else ()
    history = _history(frame, found) if found else None
    _write(target, result, force)
    counts = _counts(result.stencil)
    if as_json:
        print_json(
            "listings", written=target, printed=printed, size=size, stencil_counts=counts, on=on,
            differences=[vars(each) for each in found], history=history.to_dicts() if history else [],
            **_about(listing),
        )  # fmt: skip
    else:
        say(f"{listing.title} ({listing.slide}), {'as printed' if printed else 'as corrected'}; written: {target}")
        table("Stencil buffer", ["stencil", "pixels"], [[value, str(pixels)] for value, pixels in counts.items()])
        if on:
            click.echo("\n".join(map(str, found)) or "no pixel differs on Mesa")
        if history:
            click.echo(history)
    if found:
        context.exit(DIFFERENT)


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


def _run(listing: Listing, printed: bool, size: tuple[int, int]) -> tuple[ProgramResult, Frame]:
    """Return the buffers that a listing leaves, and the recording of its calls."""
    from softshadow import gl
    from softshadow.testing.result import read_result

    with gl.create_context(*size) as context:
        returned = (listing.printed if printed else listing.corrected)(gl)
        context.end_step(listing.name)
        return read_result(gl, size, returned), context.frame


def _differences_on_mesa(
    listing: Listing, printed: bool, size: tuple[int, int], ours: ProgramResult
) -> tuple[Difference, ...]:
    from softshadow.testing import differences, run_on_mesa

    return differences(ours, run_on_mesa(listing.printed if printed else listing.corrected, size))


def _history(frame: Frame, found: tuple[Difference, ...]) -> Any:
    """Return the history of the first differing pixel of the window, or None where only a map differs."""
    from softshadow.inspection import pixel_history

    for each in found:
        if each.buffer in ("color", "depth", "stencil"):
            return pixel_history(frame, each.x, each.y_from_top)
    return None


def _counts(stencil: np.ndarray) -> dict[str, int]:
    import numpy as np

    return {str(value): int(pixels) for value, pixels in zip(*np.unique(stencil, return_counts=True), strict=True)}


def _refuse(target: str, force: bool) -> None:
    """Make sure before the drawing that the pictures may be written."""
    from softshadow.inspection.files import refuse_foreign
    from softshadow.inspection.saving import is_folder

    if is_folder(target):
        return
    if Path(target).suffix.lower() != ".png":
        raise ValueError(f"{target}: expected an ending of .png, or a folder (a path that ends in /)")
    refuse_foreign(Path(target), force)


def _write(target: str, result: ProgramResult, force: bool) -> None:
    """Write the three buffers side by side into one picture, or each into a folder, which is made."""
    from functools import partial

    from softshadow.inspection.files import refuse_foreign, write_whole
    from softshadow.inspection.pictures import color_picture, contact_sheet, depth_picture, save_png, stencil_picture
    from softshadow.inspection.saving import is_folder

    pictures = {
        "image": color_picture(result.color[::-1, :, :3]),
        "depth": depth_picture(result.depth[::-1], clear=2**24 - 1),
        "stencil": stencil_picture(result.stencil[::-1]),
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
