"""``softshadow tour``: all techniques on one scene, into a folder of pictures with a page to read."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext

import click

from softshadow.cli.arguments import as_json, chosen_scene, force, scene_arguments, spelled
from softshadow.cli.console import named_warnings, print_json, say, say_if_compiling


@contextmanager
def _progress(stops: int) -> Iterator[Callable[[str], None]]:
    """Give a function that shows which stop of the tour is drawn: a bar on a terminal, else a line each."""
    if not sys.stderr.isatty():
        yield say
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=stops + 1)

        def advance(title: str) -> None:
            bar.update(task, advance=1, description=title)

        yield advance


@click.command(epilog="Examples:  softshadow tour  |  softshadow tour --mesh bunny.obj --size 320x240 -o bunny-tour")
@scene_arguments("240x180")
@click.option("-o", "--output", metavar="FOLDER", default="softshadow-tour", show_default=True, help="Where to.")
@force
@as_json
def tour(
    scene: str | None, mesh: str | None, light: tuple[float, ...] | None, size: tuple[int, int], output: str,
    force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Draw a scene with every technique: pictures and buffers of every step, and a page to read them by."""
    from softshadow.tour.compilation import compiling_ahead

    start = time.perf_counter()
    with named_warnings():
        ahead = compiling_ahead() if say_if_compiling() else nullcontext()
        with ahead:
            from softshadow.tour.stops import STOPS
            from softshadow.tour.writing import write_tour

            drawn = chosen_scene(scene, mesh, light)
            arguments = spelled(scene, mesh, light, size)
            with _progress(len(STOPS)) as show:
                index = write_tour(drawn, size, output, force=force, progress=show, arguments=arguments)
    seconds = time.perf_counter() - start
    runs = len(list(index.parent.glob("*/run.npz")))
    say(f"{runs} runs in {seconds:.1f} s; open the page in a browser.")
    say(f"Why is a pixel dark? Ask:  softshadow pixel volume-zfail {size[0] // 2} {size[1] * 3 // 4} {arguments}")
    if as_json:
        print_json("tour", index=index, runs=runs, seconds=seconds, scene=drawn.name, size=size)
    else:
        click.echo(index)
