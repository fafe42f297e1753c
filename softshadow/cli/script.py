"""``softshadow run``: a program written for PyOpenGL, without a screen."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import click

from softshadow.cli.arguments import Size, as_json, examples, force
from softshadow.cli.console import print_json, print_warnings_once, say_if_compiling
from softshadow.cli.replay import STEPS, print_steps
from softshadow.cli.runs import _about

BUTTONS = ("left", "middle", "right")


class Places(click.ParamType):
    """Numbers of pixels from the upper left, and perhaps a button of the mouse."""

    def __init__(self, name: str, example: str) -> None:
        self.name, self.example = name, example
        self.n_numbers = example.count(",") + 1

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[Any, ...]:
        """Return (x, y) of a text such as "20,30", or (x, y, "right")."""
        if isinstance(value, tuple):
            return value
        parts = value.split(",")
        numbers, button = parts[: self.n_numbers], parts[self.n_numbers :]
        try:
            if len(numbers) == self.n_numbers and (not button or button in [[name] for name in BUTTONS]):
                return *map(int, numbers), *button
        except ValueError:
            pass
        self.fail(
            f"{value!r}: expected {self.name} in pixels, as in {self.example} or {self.example},right", param, ctx
        )


@click.command(
    "run",
    epilog=examples("softshadow run program.py", 'softshadow run program.py --keys "a,Up" --pixel 8 6'),
)
@click.argument("program", metavar="PROGRAM.py")
@click.argument("arguments", nargs=-1)
@click.option(
    "--frames", type=int, metavar="N", help="Draw N frames.  [default: 1, and 1 for each key, click and drag]"
)
@click.option("--size", type=Size(), help="Window size in pixels.  [default: as the program asks]")
@click.option(
    "--keys",
    default="",
    metavar="KEYS",
    help='Keys like "a,Up,Ctrl+c", WheelUp, or Menu:LABEL of a GLUT menu: one after each frame.',
)
@click.option(
    "--click",
    "clicks",
    type=Places("X,Y", "20,30"),
    multiple=True,
    help="Click there, after the keys; X,Y,right for another button; repeatable.",
)
@click.option(
    "--drag",
    "drags",
    type=Places("X,Y,X,Y", "20,30,40,50"),
    multiple=True,
    help="Drag from one place to another, after the clicks; repeatable.",
)
@click.option("--window", type=click.IntRange(1), default=1, metavar="N", help="Show the program's Nth GLUT window.")
@click.option(
    "--steps", type=click.Choice(STEPS), default="auto", show_default=True,
    help="A step is a debug group (or draws under one state), a draw, or what follows a clear.",
)  # fmt: skip
@click.option("--pixel", nargs=2, type=int, metavar="X Y", help="Explain a pixel; X from the left, Y from the top.")
@click.option("-o", "--output", metavar="OUT", help="A .png, .html or .npz file, or a folder/.  [default: PROGRAM.png]")
@force
@as_json
def run(
    program: str, arguments: tuple[str, ...], frames: int | None, size: tuple[int, int] | None, keys: str,
    clicks: tuple[Any, ...], drags: tuple[Any, ...], window: int, steps: str, pixel: tuple[int, int] | None,
    output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Run a PyOpenGL program without a screen, and show its last frame.

    The program is not changed: it gets an OpenGL of this package, and GLUT, pygame or GLFW with a window that nobody
    sees. ARGUMENTS are the program's own; put -- before those that begin with a dash.
    """
    from softshadow.runs.saving import check_path
    from softshadow.windows import run_script

    target = output or (None if pixel is not None else f"{Path(program).stem}.png")
    if target is not None:
        check_path(target, force)
    with print_warnings_once(), redirect_stdout(sys.stderr):  # what the program prints is no part of the result
        say_if_compiling()
        drawn = run_script(program, arguments, frames, size, keys, clicks, steps, drags, window)
    written = None if target is None else drawn.save(target, force=force)
    if as_json:
        explained = {}
        if pixel is not None:
            explained = {"explanation": drawn.explain(*pixel), "fragments": drawn.pixel(*pixel).to_dicts()}
        titles = [step.title for step in drawn.steps]
        print_json("run", written=written, steps=titles, **explained, **_about(drawn))
        return
    if pixel is None:
        print_steps(drawn)
    else:
        click.echo(drawn.pixel(*pixel))
        click.echo(drawn.explain(*pixel))
    if written is not None:
        click.echo(written)
