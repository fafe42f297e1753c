"""The command line: ``softshadow COMMAND``. Data goes to stdout, talk to stderr.

Exit codes: 0 done, 1 a check failed, 2 wrong usage, 3 bad input, 130 interrupted, 143 ended by SIGTERM. Whatever is
slow to import is imported inside the commands, so that ``--help`` answers at once.
"""

from __future__ import annotations

import errno
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

import softshadow
from softshadow.cli.bench import bench
from softshadow.cli.failures import failures
from softshadow.cli.listings import listings
from softshadow.cli.lists import scenes, techniques
from softshadow.cli.machine import doctor, warmup
from softshadow.cli.runs import pixel, render, steps
from softshadow.cli.tours import tour
from softshadow.errors import SoftShadowError

BAD_INPUT, INTERRUPTED, ENDED = 3, 130, 143
SPELLED_HERE = {"force=True": "--force"}  # what the package's messages call by the name of an argument


class InputError(click.ClickException):
    """Bad input, said in one line."""

    exit_code = BAD_INPUT

    def show(self, file: Any = None) -> None:
        click.echo(f"error: {self.message}", err=True)


class Commands(click.Group):
    """The group of all commands: what a user's input can cause becomes one line and an exit code."""

    def invoke(self, ctx: click.Context) -> Any:
        try:
            with cleaning_up():
                return super().invoke(ctx)
        except (SoftShadowError, ValueError, TypeError, OSError, MemoryError) as error:
            # a pipe that was closed, as by head, is no mistake: click ends quietly
            if ctx.params.get("traceback") or getattr(error, "errno", None) == errno.EPIPE:
                raise
            raise InputError(_said(error)) from None
        except KeyboardInterrupt:
            click.echo("interrupted", err=True)
            raise click.exceptions.Exit(INTERRUPTED) from None


@contextmanager
def cleaning_up() -> Iterator[None]:
    """Inside, SIGTERM ends the command as Ctrl-C does: with nothing half-written left behind."""

    def end(*_: Any) -> None:
        sys.exit(ENDED)

    if threading.current_thread() is not threading.main_thread():  # only that one may listen
        yield
        return
    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _said(error: BaseException) -> str:
    message = str(error) or type(error).__name__
    for there, here in SPELLED_HERE.items():
        message = message.replace(there, here)
    return message


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Examples:  softshadow tour  |  softshadow pixel volume-zfail 160 170 --size 320x240",
)
@click.version_option(softshadow.__version__, "-V", "--version", prog_name="softshadow")
@click.option("--traceback", is_flag=True, help="Show where an error comes from, for a report of it.")
def main(traceback: bool) -> None:
    """Real-time shadow algorithms, step by step, on a software rasterizer whose every pixel explains itself."""


for command in (tour, render, steps, pixel, techniques, scenes, listings, failures, bench, warmup, doctor):
    main.add_command(command)


if __name__ == "__main__":
    sys.exit(main())
