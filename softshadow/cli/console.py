"""Output of the commands: messages, warnings and errors on stderr, results as JSON or tables on stdout."""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

CHECK_FAILED = 1  # exit code: buffers differ, a workload has become slower, an error exceeds its bound
BOLD, DIM, RED, GREEN, YELLOW = {"bold": True}, {"dim": True}, {"fg": "red"}, {"fg": "green"}, {"fg": "yellow"}
# how cells of tables are coloured, by their whole text: verdicts of fragments, and counts that change
CELL_STYLES = (
    (r"passed", GREEN),
    (r".* failed|scissor|clipped", RED),
    (r"culled|clear|written|-", DIM),
    (r"\d+ -> \d+", BOLD),
)


def say(text: str) -> None:
    """Print a message on stderr."""
    click.echo(text, err=True)


def say_marked(kind: str, text: str) -> None:
    """Print a message on stderr after its kind, which is coloured: error or warning."""
    say(f"{colored(f'{kind}:', sys.stderr, **(RED if kind == 'error' else YELLOW), bold=True)} {text}")


def say_written(*paths: Path | str, opened: bool = False) -> None:
    """Print the paths of written files on stderr, in a line each; with `opened`, show the last one in the browser.

    Raises
    ------
    SoftShadowError              there is no browser
    """
    for path in paths:
        say(f"written: {path}{'/' if Path(path).is_dir() and not str(path).endswith('/') else ''}")
    if opened:
        import webbrowser

        from softshadow.errors import SoftShadowError

        if not webbrowser.open(Path(paths[-1]).resolve().as_uri()):
            raise SoftShadowError(f"{paths[-1]}: is written, but no browser was found that --open could open it in")


# -- colours and width -------------------------------------------------------------------------------------------------
def colored(text: str, stream: Any, **style: Any) -> str:
    """Return a text in a style if the stream is a terminal that shows colours (https://no-color.org)."""
    shows = stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
    return click.style(text, **style) if shows else text


@contextmanager
def fitted() -> Iterator[None]:
    """Fit the tables that are made inside the block to the terminal, in colours; in a pipe they are plain."""
    if not sys.stdout.isatty():
        yield
        return
    from softshadow.inspection.tables import printed_on

    def styled(text: str, head: bool) -> str:
        cell = text.strip()
        style = BOLD if head else next((style for found, style in CELL_STYLES if re.fullmatch(found, cell)), None)
        return text.replace(cell, colored(cell, sys.stdout, **style)) if style else text

    with printed_on(shutil.get_terminal_size().columns, styled):
        yield


def show(text: Any) -> None:
    """Print a result on stdout; its tables fit the terminal, and so do its paragraphs."""
    with fitted():
        lines = str(text).splitlines()
    click.echo("\n".join(wrapped(line) for line in lines))


def show_code(title: str, lines: Sequence[tuple[str, int, str]]) -> None:
    """Print source on stdout: of each line the steps that execute it, its number, and its text."""
    import textwrap

    terminal = sys.stdout.isatty()
    gutter = max([5, *(len(steps) for steps, _, _ in lines)])
    click.echo(colored(f"{'steps':>{gutter}} line  {title}", sys.stdout, bold=True))
    for steps, number, text in lines:
        executed = bool(steps) or not text.strip()
        margin = f"{steps:>{gutter}} {number:4d}  "
        parts = [text]
        if terminal:
            indent = " " * (len(text) - len(text.lstrip()) + 4)
            width = max(shutil.get_terminal_size().columns - len(margin), 20)
            parts = textwrap.wrap(text, width, subsequent_indent=indent, break_on_hyphens=False) or [""]
        for part in parts:
            click.echo((margin + (part if executed else colored(part, sys.stdout, **DIM))).rstrip())
            margin = " " * len(margin)


def wrapped(line: str) -> str:
    """Return a line that is longer than the terminal as lines of whole words, indented as the first; others as is."""
    width = shutil.get_terminal_size().columns
    if not sys.stdout.isatty() or len(click.unstyle(line)) <= width:
        return line
    import textwrap

    indent = line[: len(line) - len(line.lstrip())]
    return textwrap.fill(line, width, subsequent_indent=indent, break_on_hyphens=False, break_long_words=False)


def table(title: str, columns: list[str], rows: list[list[str]]) -> None:
    """Print a table on stdout: on a terminal under its title and fitted to the width, in a pipe plain columns."""
    from softshadow.inspection.tables import text_table

    if sys.stdout.isatty():
        click.echo(wrapped(colored(title, sys.stdout, italic=True)))
    with fitted():
        click.echo(text_table(columns, rows))


# -- JSON, warnings ----------------------------------------------------------------------------------------------------
def print_json(command: str, **contents: Any) -> None:
    """Print the result of a command as JSON, with its schema."""
    click.echo(json.dumps({"schema": f"softshadow/{command}/1", **contents}, indent=2, default=_plain))


def _plain(value: Any) -> Any:
    """Return NumPy numbers and arrays, and paths, as values that JSON can represent."""
    if hasattr(value, "tolist"):
        return value.tolist()
    return str(value)


@contextmanager
def print_warnings_once() -> Iterator[None]:
    """Print each warning of this package once, in one line with its class name."""
    from softshadow.errors import Warning as SoftShadowWarning

    printed: set[str] = set()
    with warnings.catch_warnings():
        show = warnings.showwarning
        warnings.simplefilter("always", SoftShadowWarning)

        def print_once(message: Any, category: Any, *where: Any, **more: Any) -> None:
            if not issubclass(category, SoftShadowWarning):
                show(message, category, *where, **more)
                return
            line = f"{category.__name__}: {message}"
            if line not in printed:
                printed.add(line)
                say_marked("warning", line)

        warnings.showwarning = print_once
        yield


def say_if_compiling() -> bool:
    """Print a message if the kernel cache is empty; return whether compiled kernels will be cached now."""
    from softshadow.kernel_cache import announcement, cache_folder, is_empty

    folder = cache_folder()
    if folder is not None and not is_empty(folder):
        return False
    say(announcement())
    return folder is not None
