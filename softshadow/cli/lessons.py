"""``softshadow lessons``: copies of the lessons to work in."""

from __future__ import annotations

from importlib.util import find_spec

import click

from softshadow.cli.arguments import as_json, examples
from softshadow.cli.console import print_json, say, say_written, table


@click.command(epilog=examples("softshadow lessons", "softshadow lessons my-lessons/"))
@click.argument("folder", metavar="[FOLDER]", required=False)
@click.option("--start/--no-start", default=True, help="Start JupyterLab in the folder, if it is installed.")
@as_json
def lessons(folder: str | None, start: bool, as_json: bool) -> None:
    """List the lessons of the course, or copy them as notebooks into a folder.

    Files that are in the folder already are kept, since they may have somebody's answers. Without jupytext the lessons
    are copied as Python files with cells.
    """
    from softshadow.lessons.copies import copy_lessons, lesson_files, title_of

    files = lesson_files()
    titles = [{"name": file.stem, "title": title_of(file)} for file in files]
    if folder is None:
        if as_json:
            print_json("lessons", lessons=titles)
        else:
            table("Lessons of the course", ["name", "title"], [list(each.values()) for each in titles])
            say("softshadow lessons FOLDER copies them")
        return
    copies = copy_lessons(folder)
    if as_json:
        print_json("lessons", lessons=titles, written=copies.written, kept=copies.kept)
    say_written(*copies.written)
    for path in copies.kept:
        say(f"kept: {path}")
    if start and not as_json:
        start_jupyterlab(folder)


def start_jupyterlab(folder: str) -> None:
    """Start JupyterLab in a folder and wait until it ends; without it, say how to open the lessons."""
    if find_spec("jupyterlab") is None:
        say("JupyterLab is not installed (pip install jupyterlab); any editor with notebooks opens the files, too")
        return
    import subprocess
    import sys

    subprocess.run([sys.executable, "-m", "jupyterlab", "--notebook-dir", folder], check=False)
