"""``softshadow failures``: known failures of the course's algorithms, each next to its cure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json, check_opened, examples, force, open_file, output_option
from softshadow.cli.console import print_json, say_if_compiling, say_written, show, table
from softshadow.cli.names import FailureName

if TYPE_CHECKING:
    from softshadow.gallery import Failure


@click.command(
    epilog=examples(
        "softshadow failures",
        "softshadow failures mask-1 -o mask-1.png",
        "softshadow failures mask-1 --numbers",
    )
)
@click.argument("name", type=FailureName(), metavar="[FAILURE]", required=False)
@click.option("--numbers", is_flag=True, help="Draw all failures, or the named one, and list the wrong pixels.")
@click.option("--size", type=Size(), default="240x180", show_default=True, help="Size of each image in pixels.")
@output_option("Write both images side by side (.png), or the description as a page (.html).")
@open_file
@force
@as_json
def failures(
    name: str | None, numbers: bool, size: tuple[int, int], output: str | None, opened: bool, force: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """List known failures, or show one next to its cure.

    With --numbers, only the numbers of wrong pixels are printed, of one failure or of all: with the failure, with the
    cure, and with the cure where pixels are not counted, as at creases.
    """
    from softshadow import failures as gallery

    check_opened(opened, output)
    if output and (name is None or numbers):
        raise click.UsageError("--output: expected the name of a FAILURE, and no --numbers")
    if name is None or numbers:
        chosen = list(gallery.values()) if name is None else [gallery[name]]
        _list([failure.at(size) for failure in chosen], numbers, as_json)
        return
    failure = gallery[name].at(size)
    if output:
        _refuse(output, force)
    say_if_compiling()
    if output:
        _write(failure, output, force)
        say_written(output, opened=opened)
    if as_json:
        histories = {side: run.pixel(*failure.pixel).to_dicts() for side, run in _sides(failure)}
        print_json("failures", written=output, size=size, history=histories, failures=[_with_numbers(failure)])
        return
    show(failure.explain())
    for side, run in _sides(failure):
        click.echo(f"\n{side}:")
        show(run.pixel(*failure.pixel))


def _sides(failure: Failure) -> list[tuple[str, Any]]:
    return [("with the failure", failure.wrong), ("with the cure", failure.cured)]


def _list(failures: list[Failure], numbers: bool, as_json: bool) -> None:
    if numbers:
        say_if_compiling()
    if as_json:
        print_json("failures", failures=[_with_numbers(each) if numbers else _about(each) for each in failures])
        return
    columns = ["name", "family", "what goes wrong"]
    if numbers:
        columns[2:2] = ["wrong pixels", "cured", "not counted"]
    table("Failures", columns, [_row(each, numbers) for each in failures])


def _row(failure: Failure, numbers: bool) -> list[str]:
    pixels = (failure.number_wrong, failure.number_cured, failure.number_uncounted) if numbers else ()
    return [failure.name, failure.family, *map(str, pixels), failure.title]


def _about(failure: Failure) -> dict[str, Any]:
    return {
        "name": failure.name,
        "title": failure.title,
        "family": failure.family,
        "reference": failure.reference,
        "reason": failure.reason,
    }


def _with_numbers(failure: Failure) -> dict[str, Any]:
    return _about(failure) | {
        "scene": failure.scene.name,
        "counted": failure.counted,
        "number_wrong": failure.number_wrong,
        "number_cured": failure.number_cured,
        "number_uncounted": failure.number_uncounted,
        "floor": failure.floor,
        "why_floor": failure.why_floor,
        "pixel": failure.pixel if failure.number_wrong > failure.number_cured else None,
        "diff": failure.diff,
    }


def _refuse(output: str, force: bool) -> None:
    """Check before drawing that the output file may be written."""
    from softshadow.inspection.files import refuse_foreign

    if Path(output).suffix.lower() not in (".png", ".html"):
        raise ValueError(f"{output}: expected an ending of .png or .html")
    refuse_foreign(Path(output), force)


def _write(failure: Failure, output: str, force: bool) -> None:
    from functools import partial

    from softshadow.inspection.files import write_whole

    if Path(output).suffix.lower() == ".png":
        import numpy as np

        from softshadow.inspection.pictures import save_png

        write_whole(Path(output), partial(save_png, np.asarray(failure.picture())), force)
    else:
        from softshadow.gallery.failure_page import write_page

        write_whole(Path(output), partial(write_page, failure), force)
