"""Output of the commands: messages and warnings on stderr, results as JSON or tables on stdout."""

from __future__ import annotations

import json
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

CHECK_FAILED = 1  # exit code: buffers differ, or a workload has become slower


def say(text: str) -> None:
    """Print a message on stderr."""
    click.echo(text, err=True)


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
            line = f"warning: {category.__name__}: {message}"
            if line not in printed:
                printed.add(line)
                say(line)

        warnings.showwarning = print_once
        yield


def say_if_compiling() -> bool:
    """Print a message if the kernel cache is empty; return whether compiled kernels will be cached now."""
    from softshadow.kernel_cache import cache_folder, is_empty

    folder = cache_folder()
    if folder is None:
        say("compiling kernels at every start, because no cache folder is writable (set NUMBA_CACHE_DIR) ...")
        return False
    if not is_empty(folder):
        return False
    say("compiling kernels, only the first time ...")
    return True


def table(title: str, columns: list[str], rows: list[list[str]]) -> None:
    """Print a table on stdout: with borders on a terminal, plain columns in a pipe."""
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table

        bordered = Table(title=title, title_justify="left")
        for name, cells in zip(columns, zip(*rows, strict=True), strict=True):
            bordered.add_column(name, justify="right" if all(cell.isdigit() for cell in cells) else "left")
        for row in rows:
            bordered.add_row(*row)
        Console(markup=False, emoji=False).print(bordered)  # file names may contain [brackets]
        return
    from softshadow.inspection.tables import text_table

    click.echo(text_table(columns, rows))
