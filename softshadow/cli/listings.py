"""``softshadow listings``: the course's GL listings, as printed or corrected, on softshadow and on Mesa."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import (
    Pixel,
    Size,
    as_json,
    check_opened,
    examples,
    force,
    open_file,
    output_option,
)
from softshadow.cli.console import CHECK_FAILED, print_json, say_if_compiling, say_written, show, show_code, table
from softshadow.cli.names import ListingName
from softshadow.cli.runs import print_steps, stencil_histograms, step_facts

WHAT_CODES_ARE = (
    "E49 is error 49 of the slides: softshadow errata E49. SK:369 is line 369 of a course's slides: softshadow errata "
    "--source SK:369."
)

if TYPE_CHECKING:
    from softshadow.inspection.history import PixelHistory
    from softshadow.listings import Listing
    from softshadow.runs import Run
    from softshadow.testing import BufferDifference


@click.command(
    epilog=examples(
        "softshadow listings",
        "softshadow listings volume-zpass --printed -o zpass-as-printed.png",
        "softshadow listings volume-zpass --diff",
        "softshadow listings planar-stencil --pixel 60,80",
    )
)
@click.argument("name", type=ListingName(), metavar="[LISTING]", required=False)
@click.option("--printed", is_flag=True, help="Run it as printed on the slide, without corrections.")
@click.option("--diff", is_flag=True, help="Print the GL calls that the corrections change, as a diff, and no more.")
@click.option("--pixel", type=Pixel(), help="Print the history of a pixel: X from the left, Y from the top.")
@click.option("--on", type=click.Choice(["mesa"]), help="Run it on Mesa as well, and show the first different pixel.")
@click.option("--size", type=Size(), default="128x128", show_default=True, help="Window size in pixels.")
@output_option("Write the buffers after each step as one .png, or into a folder/ with state and buffers.")
@open_file
@force
@as_json
@click.pass_context
def listings(
    context: click.Context, name: str | None, printed: bool, diff: bool, pixel: tuple[int, int] | None, on: str | None,
    size: tuple[int, int], output: str | None, opened: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """List the course's GL listings, or show one.

    Prints the code, the steps, and the effect of the corrections. The numbers before each line of the code are the
    steps that execute it, and its line in the file.
    """
    from softshadow import listings as registry
    from softshadow.lessons import run_listing

    check_opened(opened, output)
    if name is None:
        if printed or diff or on or output or pixel:
            raise click.UsageError("--printed, --diff, --pixel, --on and --output: expected the name of a LISTING")
        _list([registry.get(each) for each in registry.names()], as_json)
        return
    listing = registry.get(name)
    if diff:
        if printed or on or output or pixel:
            raise click.UsageError("--diff: expected no --printed, --pixel, --on or --output besides")
        say_if_compiling()
        _print_diff(listing, size, as_json)
        return
    if output:
        _refuse(output, force)
    say_if_compiling()
    run = run_listing(name, printed, size)
    differences, first = _on_mesa(listing, printed, size) if on else ((), None)
    written = [_write(output, run, force)] if output else []
    if as_json:
        history = run.pixel(*pixel) if pixel else None
        _print_json(listing, run, printed, on, differences, first, history, output)
    elif pixel:
        show(run.pixel(*pixel))
    else:
        _print(listing, run, printed)
    if on and not as_json:
        click.echo("\n".join(map(str, differences)) or "no pixel differs on Mesa")
        if first:
            show(first)
    say_written(*written, opened=opened)
    if differences:
        context.exit(CHECK_FAILED)


def _on_mesa(
    listing: Listing, printed: bool, size: tuple[int, int]
) -> tuple[tuple[BufferDifference, ...], PixelHistory | None]:
    """Return the differences from Mesa, and the history of the first different pixel."""
    from softshadow import testing

    program = listing.printed if printed else listing.corrected
    result, frame = testing.run_recorded(program, size)
    differences = testing.differences(result, testing.run_on_mesa(program, size))
    return differences, testing.history_of_first(frame, differences)


# -- output ------------------------------------------------------------------------------------------------------------
def _print(listing: Listing, run: Run, printed: bool) -> None:
    from softshadow.lessons import run_listing
    from softshadow.listings.source import code_of

    version = "as printed" if printed else "as corrected" if listing.corrections else "nothing to correct"
    show(f"{listing.name}: {listing.title} ({listing.slide}), {version}")
    for excerpt in code_of(listing, () if printed else None):
        click.echo()
        show_code(
            f"{excerpt.file}: {excerpt.function}",
            [(" ".join(map(str, line.steps)), line.number, line.text) for line in excerpt.lines],
        )
    click.echo()
    print_steps(run)
    _print_codes(listing)
    if not listing.corrections:
        return
    click.echo()
    table("Corrections", ["number", "correction"], [list(each) for each in listing.corrections.items()])
    changed, pixel = _effect_of_corrections(listing, run.size)
    click.echo("\nas printed and as corrected:")
    click.echo("\n".join(map(str, changed)) or "no pixel differs")
    for which, as_printed in (("as printed", True), ("as corrected", False)):
        if pixel:
            click.echo(f"\n{which}:")
            show(run_listing(listing.name, as_printed, run.size).pixel(*pixel))


def _print_diff(listing: Listing, size: tuple[int, int], as_json: bool) -> None:
    from softshadow.lessons import listing_difference

    difference = listing_difference(listing.name, size)
    if as_json:
        print_json("listings", size=size, diff=difference, **_about(listing))
        return
    show(f"{listing.name} ({listing.slide}): - as printed, + as corrected")
    show(difference or "nothing to correct")
    _print_codes(listing)


def _print_codes(listing: Listing) -> None:
    """Print what the numbers of the corrections and the place of the slide mean."""
    from softshadow.course import explain_codes

    click.echo()
    show("\n".join(explain_codes(f"{listing.slide} {' '.join(listing.corrections)}")))


def _print_json(
    listing: Listing, run: Run, printed: bool, on: str | None, differences: tuple[BufferDifference, ...],
    first: PixelHistory | None, history: PixelHistory | None, output: str | None,
) -> None:  # fmt: skip
    from softshadow.listings.source import code_of

    corrected, _ = _effect_of_corrections(listing, run.size)
    print_json(
        "listings", written=output, printed=printed, size=run.size,
        stencil_counts={str(value): pixels for value, pixels in stencil_histograms(run)[-1].items()}, on=on,
        differences=[vars(each) for each in differences], history=first.to_dicts() if first else [],
        correcting=[vars(each) for each in corrected], steps=step_facts(run),
        fragments=history.to_dicts() if history else None,
        code=[
            {"file": each.file, "function": each.function, "lines": [vars(line) for line in each.lines]}
            for each in code_of(listing, () if printed else None)
        ],
        **_about(listing),
    )  # fmt: skip


def _list(listings: list[Listing], as_json: bool) -> None:
    if as_json:
        print_json("listings", listings=[_about(each) for each in listings])
        return
    rows = [[each.name, each.title, each.slide, " ".join(each.corrections) or "-"] for each in listings]
    table("Listings", ["name", "title", "slide", "corrections"], rows)
    show(f"\n{WHAT_CODES_ARE}")


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
) -> tuple[tuple[BufferDifference, ...], tuple[int, int] | None]:
    """Return the differences between the printed and the corrected listing, and the first such pixel of the window."""
    from softshadow.testing import differences, history_of_first, run_recorded

    (printed, frame), (corrected, _) = (run_recorded(program, size) for program in (listing.printed, listing.corrected))
    changes = differences(printed, corrected)
    history = history_of_first(frame, changes)
    return changes, (history.x, history.y) if history else None


# -- files -------------------------------------------------------------------------------------------------------------
def _refuse(target: str, force: bool) -> None:
    """Check before drawing that the images may be written."""
    from softshadow.inspection.files import is_folder, refuse_foreign

    if is_folder(target):
        return
    if Path(target).suffix.lower() != ".png":
        raise ValueError(f"{target}: expected an ending of .png, or a folder (a path that ends in /)")
    refuse_foreign(Path(target), force)


def _write(target: str, run: Run, force: bool) -> Path:
    """Write the buffers after each step: one image with a row for each, or a folder as `Run.save` writes it."""
    from softshadow.inspection.files import is_folder, write_whole
    from softshadow.inspection.pictures import contact_sheet, depth_picture, map_pictures, save_png

    if is_folder(target):
        return run.save(target, force)
    rows = [
        (
            f"{step.index}  {step.title}{''.join(f' [{name}]' for name in step.maps)}",
            (step.image, depth_picture(step.depth), step.stencil, *map_pictures(step.maps).values()),
        )
        for step in run.steps
    ]
    sheet = contact_sheet(rows)
    return write_whole(Path(target), lambda path: save_png(sheet, path), force)
