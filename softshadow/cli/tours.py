"""``softshadow tour``: draw one scene with all techniques, into a folder with an HTML page."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext

import click

from softshadow.cli.arguments import (
    SceneArguments,
    as_json,
    examples,
    force,
    open_file,
    output_option,
    scene_arguments,
)
from softshadow.cli.console import print_json, print_warnings_once, say, say_if_compiling, say_written


@contextmanager
def _progress(stops: int) -> Iterator[Callable[[str], None]]:
    """Yield a function that shows the current stop of the tour: in a bar on a terminal, else in a line each."""
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


@click.command(epilog=examples("softshadow tour", "softshadow tour --mesh bunny.obj --size 320x240 -o bunny-tour"))
@scene_arguments("240x180")
@output_option("Output folder.", "FOLDER", default="softshadow-tour", show_default=True)
@open_file
@force
@as_json
def tour(scene: SceneArguments, size: tuple[int, int], output: str, opened: bool, force: bool, as_json: bool) -> None:
    """Draw a scene with every technique, as an HTML page.

    The output folder holds the page, index.html, and images and buffers of every step.
    """
    from softshadow.tour.compilation import compiling_ahead

    start = time.perf_counter()
    with print_warnings_once():
        ahead = compiling_ahead() if say_if_compiling() else nullcontext()
        with ahead:
            from softshadow.tour.stops import STOPS
            from softshadow.tour.writing import write_tour

            tour_scene = scene.load()
            arguments = scene.text(size)
            with _progress(len(STOPS)) as show:
                index = write_tour(tour_scene, size, output, force=force, progress=show, arguments=arguments)
    seconds = time.perf_counter() - start
    runs = len(list(index.parent.glob("*/run.npz")))
    say(f"{runs} runs in {seconds:.1f} s")
    say(f"To explain a pixel:  softshadow pixel volume-zfail {size[0] // 2} {size[1] * 3 // 4} {arguments}")
    if as_json:
        print_json("tour", index=index, runs=runs, seconds=seconds, scene=tour_scene.name, size=size)
    say_written(index, opened=opened)
