"""What the commands say: talk and warnings on stderr, data as JSON or tables on stdout."""

from __future__ import annotations

import json
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click


def say(text: str) -> None:
    """Say something on stderr."""
    click.echo(text, err=True)


def print_json(command: str, **contents: Any) -> None:
    """Print the answer of a command as JSON, with the name of its form."""
    click.echo(json.dumps({"schema": f"softshadow/{command}/1", **contents}, indent=2, default=_plain))


def _plain(value: Any) -> Any:
    """Return NumPy's numbers and arrays, and paths, as JSON takes them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    return str(value)


@contextmanager
def named_warnings() -> Iterator[None]:
    """Inside, each warning of this package is said once, as one line with its name."""
    from softshadow.errors import Warning as SoftShadowWarning

    said: set[str] = set()
    with warnings.catch_warnings():
        show = warnings.showwarning
        warnings.simplefilter("always", SoftShadowWarning)

        def say_once(message: Any, category: Any, *where: Any, **more: Any) -> None:
            if not issubclass(category, SoftShadowWarning):
                show(message, category, *where, **more)
                return
            line = f"warning: {category.__name__}: {message}"
            if line not in said:
                said.add(line)
                say(line)

        warnings.showwarning = say_once
        yield


def say_if_compiling() -> bool:
    """Say that the kernels have to be compiled, when nothing is in the cache yet; return whether they will be kept."""
    from softshadow.kernel_cache import cache_folder, is_empty

    folder = cache_folder()
    if folder is None:
        say("compiling kernels, each time (no cache folder can be written; NUMBA_CACHE_DIR names another) ...")
        return False
    if is_empty(folder):
        say("compiling kernels, once ...")
        return True
    return False


def table(title: str, columns: list[str], rows: list[list[str]]) -> None:
    """Print a table on stdout: ruled on a terminal, plain columns in a pipe."""
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table

        ruled = Table(title=title, title_justify="left")
        for name, cells in zip(columns, zip(*rows, strict=True), strict=True):
            ruled.add_column(name, justify="right" if all(cell.isdigit() for cell in cells) else "left")
        for row in rows:
            ruled.add_row(*row)
        Console(markup=False, emoji=False).print(ruled)  # names of files may have [brackets]
        return
    from softshadow.inspection.tables import text_table

    click.echo(text_table(columns, rows))
