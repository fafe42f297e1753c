"""``softshadow replay``: a frame of a program that apitrace has recorded."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import Size, as_json, examples, force
from softshadow.cli.console import print_json, print_warnings_once, say, say_if_compiling, table
from softshadow.cli.runs import _about

if TYPE_CHECKING:
    from softshadow.recordings.frames import Frames
    from softshadow.recordings.left_out import LeftOut
    from softshadow.runs import Run

STEPS = ("auto", "groups", "draws", "clears")
MOST_LISTED = 12  # kinds of calls on a terminal; --json has all


@click.command(
    epilog=examples(
        "softshadow replay program.trace --list",
        "softshadow replay program.trace --frame 2 --pixel 16 12",
    )
)
@click.argument("trace", metavar="FILE.trace")
@click.option("--list", "lists", is_flag=True, help="List the frames of the file, and draw nothing.")
@click.option("--frame", type=int, help="The frame, from 0; -1 is the last one.  [default: 0]")
@click.option("--until", type=int, metavar="CALL", help="Stop after this call; the frame is the one that contains it.")
@click.option(
    "--steps", type=click.Choice(STEPS), default="auto", show_default=True,
    help="A step is a debug group (or draws under one state), a draw, or what follows a clear.",
)  # fmt: skip
@click.option("--size", type=Size(), help="Window size in pixels.  [default: as the viewports need]")
@click.option("--pixel", nargs=2, type=int, metavar="X Y", help="Explain a pixel; X from the left, Y from the top.")
@click.option("-o", "--output", metavar="OUT", help="A .png, .html or .npz file, or a folder/.  [default: FILE.png]")
@force
@as_json
def replay(
    trace: str, lists: bool, frame: int | None, until: int | None, steps: str, size: tuple[int, int] | None,
    pixel: tuple[int, int] | None, output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Replay a frame of an OpenGL program that apitrace has recorded.

    Draws the frame step by step, and lists the calls that had to be left out. The suffix of OUT selects the result: an
    image (.png), a report (.html), all buffers (.npz), or a folder with an image of every step.
    """
    if frame is not None and until is not None:
        raise click.UsageError("--frame and --until: expected only one of them")
    if lists:
        _list(trace, as_json)
        return
    from softshadow.recordings.replaying import replay_frame
    from softshadow.runs.saving import check_path

    target = output or (None if pixel is not None else f"{Path(trace).stem}.png")
    if target is not None:
        check_path(target, force)
    with print_warnings_once():
        say_if_compiling()
        replayed = replay_frame(trace, frame or 0, until, steps, size)
    run = replayed.run
    written = None if target is None else run.save(target, force=force)
    if as_json:
        left_out = [{**vars(each), "text": str(each)} for each in replayed.left_out]
        asked = {} if pixel is None else {"explanation": run.explain(*pixel), "fragments": run.pixel(*pixel).to_dicts()}
        titles = [step.title for step in run.steps]
        print_json("replay", written=written, steps=titles, left_out=left_out, **asked, **_about(run))
        return
    _say_left_out(replayed.left_out)
    if pixel is None:
        print_steps(run)
    else:
        click.echo(run.pixel(*pixel))
        click.echo(run.explain(*pixel))
    if written is not None:
        click.echo(written)


def _list(trace: str, as_json: bool) -> None:
    from softshadow.recordings.replaying import frames_of

    found = frames_of(trace)
    if as_json:
        rows: list[dict[str, Any]] = [{"frame": index, **vars(each)} for index, each in enumerate(found.frames)]
        damage = None if found.damage is None else str(found.damage)
        print_json("replay", frames=rows, contexts=found.contexts, damage=damage)
        return
    table(f"{trace}: {len(found.frames)} frames", ["frame", "calls", "draws", "window", "context"], _rows(found))
    if found.damage is not None:
        say(f"warning: {found.damage}")


def _rows(found: Frames) -> list[list[str]]:
    several = len(found.contexts) > 1
    return [
        [
            str(index),
            f"{each.first} to {each.last}{'' if each.is_complete else ' (not complete)'}",
            str(each.draws),
            "{} x {}".format(*each.sizes[each.context]) if each.context in each.sizes else "-",
            f"{each.context:#x}" + (f" of {len(each.sizes)}" if several else ""),
        ]
        for index, each in enumerate(found.frames)
    ]


def _say_left_out(left_out: tuple[LeftOut, ...]) -> None:
    listed = sorted(left_out, key=lambda each: not each.in_frame)
    for each in listed[:MOST_LISTED]:
        say(f"left out{'' if each.in_frame else ' before this frame'}: {each}")
    if len(listed) > MOST_LISTED:
        say(f"left out: {len(listed) - MOST_LISTED} more kinds of calls (--json lists them)")


def print_steps(run: Run) -> None:
    """Print the steps of a recorded program: their draws and fragments."""
    rows = [
        [str(index), counts.title, str(counts.draws), str(counts.triangles), str(counts.all_fragments)]
        for index, counts in enumerate(run.ledger.steps)
    ]
    table(repr(run), ["step", "title", "draws", "triangles", "fragments"], rows)
